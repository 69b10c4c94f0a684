"""The mutants of the checker of certificates, each against the certificates of the tests.

    python -m benchmarks.mutation.checker

A mutant lives if it proves every certificate of `tests/certified.py` in the same words, takes what
is just within the limits, and refuses every forgery of `tests/forged_certificates.py`. Those that
live are printed; `notes/mutation.md` says which of them change nothing. Needs mutmut and libcst.
"""

from __future__ import annotations

import ast
import json
import os
import signal
import sys
from collections.abc import Callable
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


def is_caught(mutant: Mutant) -> bool:
    """Whether any certificate tells the mutant from the checker; endless loops are caught."""
    signal.signal(signal.SIGALRM, _late)
    signal.alarm(_SECONDS)
    try:
        check = mutated(mutant)
        return any(_said(check, data) != words for data, words in (*_genuine(), *_forged()))
    except Exception:
        return True
    finally:
        signal.alarm(0)


def mutated(mutant: Mutant) -> Callable[[bytes], list[str]]:
    """The function `check` of a module like the checker, with the mutant in place."""
    text = Path(_FILE).read_text()
    *owner, name = mutant.name.split(".")
    body: list[ast.stmt] = ast.parse(text).body
    for outer in owner:
        (body,) = (x.body for x in body if isinstance(x, ast.ClassDef) and x.name == outer)
    (place,) = (x for x in body if isinstance(x, ast.FunctionDef) and x.name == name)
    lines = text.splitlines()
    changed = indent(mutant.source, " " * place.col_offset).splitlines()
    lines[place.lineno - 1 : place.end_lineno] = changed
    module = ModuleType("mutated")
    exec(compile("\n".join(lines), _FILE, "exec"), vars(module))
    return module.check  # type: ignore[no-any-return]


def _is_of_words(mutant: Mutant) -> bool:
    """Whether it only takes the message of a refusal away."""
    return mutant.old.startswith("need(") and mutant.new.endswith(", None)")


def _late(*_: object) -> None:
    raise TimeoutError


def _said(check: Callable[[bytes], list[str]], data: bytes) -> list[str] | None:
    """The words of a check; None where it refuses."""
    try:
        return check(data)
    except TimeoutError:
        raise
    except Exception:
        return None


_CASES: dict[str, list[tuple[bytes, list[str] | None]]] = {}


def _genuine() -> list[tuple[bytes, list[str] | None]]:
    if "genuine" not in _CASES:
        entries = [*(made(name) for name in MAKERS), *sound()]
        texts = [json.dumps(entry).encode() for entry in entries]
        _CASES["genuine"] = [(text, checker.check(text)) for text in texts]
    return _CASES["genuine"]


def _forged() -> list[tuple[bytes, list[str] | None]]:
    if "forged" not in _CASES:
        texts = [make() for make in FORGERIES.values()]
        _CASES["forged"] = [(text, None) for text in texts if len(text) < _SHORT]
    return _CASES["forged"]


def main() -> None:
    """Print the mutants that live, and how many there were."""
    _genuine()
    _forged()
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
