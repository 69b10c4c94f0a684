"""CGAL's solver of quadratic programmes, which is exact: `exact_programmes.cpp`, built at need.

It needs g++ and Debian's libcgal-dev. The program goes on running, so that an answer costs no start
of a process, but it is given its numbers as text.
"""

from __future__ import annotations

import atexit
import subprocess
from collections.abc import Iterable
from fractions import Fraction
from functools import cache
from pathlib import Path
from shutil import which
from tempfile import TemporaryDirectory
from typing import IO

from benchmarks.lcp.judge import NoAnswerError
from benchmarks.lcp.public_problems import PublicQP

_SOURCE = Path(__file__).with_name("exact_programmes.cpp")


@cache
def present() -> bool:
    """Whether it can be built; if so, it has been."""
    if which("g++") is None or not Path("/usr/include/CGAL/QP_functions.h").exists():
        return False
    _program()
    return True


@cache
def _program() -> tuple[IO[str], IO[str]]:
    """What to write to and to read from."""
    folder = TemporaryDirectory()
    target = str(Path(folder.name) / "solver")
    words = ["g++", "-O2", "-DNDEBUG", "-o", target, str(_SOURCE), "-lgmp", "-lmpfr"]
    subprocess.run(words, check=True, capture_output=True)
    running = subprocess.Popen([target], text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    atexit.register(folder.cleanup)
    atexit.register(running.kill)
    assert running.stdin is not None
    assert running.stdout is not None
    return running.stdin, running.stdout


def cgal(problem: PublicQP) -> list[Fraction]:
    """The solution x of a quadratic programme."""
    case = problem.case
    lower_triangle = (x for i, row in enumerate(case.P) for x in row[: i + 1])
    bounds = (x for pair in zip(case.lower, case.upper, strict=True) for x in pair)
    numbers = (*lower_triangle, *case.c, *(x for row in case.G for x in row), *case.h, *bounds)
    return exact(len(case.c), len(case.h), numbers)


def exact(n: int, m: int, numbers: Iterable[Fraction | None]) -> list[Fraction]:
    """The x of the programme with these numbers, in the order that the program asks for."""
    to, back = _program()
    print(n, m, *("-" if x is None else x for x in numbers), file=to, flush=True)
    status, *words = back.readline().split()
    if status != "optimal":
        raise NoAnswerError(status)
    return [Fraction(x) for x in words]
