"""What is kept of a sample: a line of JSON, with its number k and what was observed of it.

A sample that could not be had is a line with its error in the place of what was observed.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from typing import Any

from ..disorder.proved_sample import Sample

Observe = Callable[[Sample], dict[str, Any]]
"""What is observed of a sample, as values that JSON has: a function that workers can import."""

FAILED = "failed"
"""The field of a line that has the error of a sample, and no sample."""
_LONGEST = 500
_BEGINNING = re.compile(r'\{"k": (\d{1,18})[,}]', re.ASCII)


def forces_of(sample: Sample) -> dict[str, Any]:
    """All of a sample: what statistics are made of.

    The contacts that carry a force are those whose force is not zero.

    >>> from lcp_piles import Uniform, nt60, pile_family, proved_sample
    >>> sorted(forces_of(proved_sample(pile_family(nt60(2)), Uniform(1), seed=0, k=0)))
    ['error', 'forces', 'mechanisms', 'road', 'verdict']
    """
    return {
        "forces": sample.forces.tolist(),
        "error": sample.error,
        "mechanisms": sample.mechanisms,
        "verdict": sample.verdict,
        "road": sample.road,
    }


def line_of(sample: Sample, observe: Observe) -> str:
    """The line of a sample; what JSON cannot hold is an error of `observe`."""
    return json.dumps({"k": sample.k} | observe(sample), allow_nan=False)


def failed_line(k: int, seed: int, error: Exception) -> str:
    """The line of a sample that raised an error."""
    text = f"{type(error).__name__}: {error}"
    return json.dumps({"k": k, "seed": seed, FAILED: text[:_LONGEST]})


def number_of_line(line: str) -> int | None:
    """The k of a line, None where it is not one of ours; the rest is read by whoever wants it."""
    found = _BEGINNING.match(line)
    return int(found[1]) if found and line.endswith("}") else None


def is_whole(line: str) -> bool:
    """Whether a line is JSON to its end."""
    try:
        json.loads(line)
    except ValueError:
        return False
    return True


def is_failed(line: str) -> bool:
    """Whether a line is that of a sample that failed."""
    return FAILED in line and FAILED in json.loads(line)
