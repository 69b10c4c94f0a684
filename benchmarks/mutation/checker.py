"""The mutants of the checker of certificates, each against the certificates of the tests.

    python -m benchmarks.mutation.checker

A mutant lives if it proves every certificate of `tests/certified.py` in the same words, takes what
is just within the limits, and refuses every forgery of `tests/forged_certificates.py`. Those that
live are printed (`notes/mutation.md`). Needs mutmut and libcst.
"""

from __future__ import annotations

import ast
import json
import os
import signal
import sys
from functools import cache
from multiprocessing import Pool
from pathlib import Path
from textwrap import indent
from types import ModuleType

from tqdm import tqdm

from benchmarks.mutation.mutants import Mutant, mutants
from lcp_piles.certificates import check_certificate as checker
from tests.certified import MAKERS, made
from tests.forged_certificates import FORGERIES, sound

_SECONDS = 20
_SHORT = 10**6  # bytes of a file: what is longer asks for patience, and has a test of its own
_FILE = str(checker.__file__)
TEXT = Path(_FILE).read_text(encoding="utf-8")


def is_caught(mutant: Mutant) -> bool:
    """Whether any certificate tells the mutant from the checker; endless loops are caught."""
    signal.signal(signal.SIGALRM, _late)
    signal.alarm(_SECONDS)
    try:
        return is_told_apart(_with(mutant))
    except Exception:
        return True
    finally:
        signal.alarm(0)


def is_told_apart(text: str) -> bool:
    """Whether any certificate tells a checker of this text from the checker.

    What is not among its faults goes through: the checker promises to end in none but those.
    """
    module = ModuleType("mutated")
    exec(compile(text, _FILE, "exec"), vars(module))

    def said(data: bytes) -> list[str] | None:
        try:
            return module.check(data)  # type: ignore[no-any-return]
        except module.FAULTS:
            return None

    return any(said(data) != words for data, words in cases())


@cache
def cases() -> list[tuple[bytes, list[str] | None]]:
    """Certificates with what the checker says of them; None where it refuses."""
    entries = (*map(made, MAKERS), *sound())
    genuine = [json.dumps(entry).encode() for entry in entries]
    forged = [make() for make in FORGERIES.values()]
    known = [(text, checker.check(text)) for text in genuine]
    return [*known, *((text, None) for text in forged if len(text) < _SHORT)]


def _with(mutant: Mutant) -> str:
    """The text of the checker with the mutant in place."""
    *owner, name = mutant.name.split(".")
    body: list[ast.stmt] = ast.parse(TEXT).body
    for outer in owner:
        (body,) = (x.body for x in body if isinstance(x, ast.ClassDef) and x.name == outer)
    (place,) = (x for x in body if isinstance(x, ast.FunctionDef) and x.name == name)
    lines = TEXT.splitlines()
    changed = indent(mutant.source, " " * place.col_offset).splitlines()
    lines[place.lineno - 1 : place.end_lineno] = changed
    return "\n".join(lines)


def _is_of_words(mutant: Mutant) -> bool:
    """Whether it only takes the message of a refusal away."""
    return mutant.old.startswith("need(") and mutant.new.endswith(", None)")


def _late(*_: object) -> None:
    raise TimeoutError


def main() -> None:
    """Print the mutants that live, and how many there were."""
    cases()  # once, before the processes are made
    everything = [m for m in mutants(_FILE) if not _is_of_words(m)]
    with Pool(os.cpu_count()) as pool:
        caught = list(tqdm(pool.imap(is_caught, everything, chunksize=4), total=len(everything)))
    alive = [mutant for mutant, dead in zip(everything, caught, strict=True) if not dead]
    print(f"{len(everything)} mutants, {len(everything) - len(alive)} caught")
    for mutant in alive:
        print(f"  {mutant.line} {mutant.name}: {mutant.old!r} -> {mutant.new!r}")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
