"""A plugin of pytest that runs the tests it is given against mutants, and names those that live.

    pip install mutmut
    python -m pytest -p benchmarks.mutation.plugin --mutate lcp_piles/pivoting/checks.py \
        --sample 40 tests/test_scaling.py

Tests are collected once. A forked process puts the code of a mutant in the place of a function's
own, and runs the tests, the quickest first, until one fails; one that runs ten times as long as all
of them does without mutants is named too. What runs only when a module is imported cannot be
changed so.
"""

from __future__ import annotations

import gc
import os
import resource
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from pathlib import Path
from random import Random
from types import FunctionType, SimpleNamespace
from typing import Any, TypeAlias

import pytest

from .mutants import Mutant, mutants

_NO, _YES = 0, 1
Functions: TypeAlias = dict[tuple[str, str], list[FunctionType]]


def pytest_addoption(parser: Any) -> None:
    """The modules to change, how many mutants of each, and the seed of the choice."""
    parser.addoption("--mutate", action="append", default=[], metavar="FILE")
    parser.addoption("--sample", type=int, default=40)
    parser.addoption("--seed", type=int, default=1997)


@pytest.hookimpl(tryfirst=True)
def pytest_runtestloop(session: Any) -> bool | None:
    """In the place of the tests: the tests against every mutant."""
    option = session.config.option
    if not option.mutate:
        return None
    seconds = {}
    for item in session.items:
        before = _children()
        if _forked(partial(_fails, [item])) == _NO:
            seconds[item] = _children() - before
    tests = sorted(seconds, key=seconds.__getitem__)
    limit = int(10 * sum(seconds.values())) + 10
    functions = _functions()
    gc.freeze()
    for file in option.mutate:
        path = str(Path(file).resolve())
        made = [mutant for mutant in mutants(file) if (path, mutant.name) in functions]
        chosen = Random(option.seed).sample(made, min(option.sample, len(made)))
        ends = {
            mutant: _forked(partial(_killed, mutant, functions, tests), limit) for mutant in chosen
        }
        for mutant, end in ends.items():
            if end != _YES:
                print("lives:" if end == _NO else f"ends with {end}:", mutant)
        killed = sum(end == _YES for end in ends.values())
        print(f"{file}: {killed} of {len(chosen)} killed, of {len(made)} that there are")
    return True


def _killed(mutant: Mutant, functions: Functions, tests: list[Any]) -> bool:
    for function in functions[str(Path(mutant.file).resolve()), mutant.name]:
        space: dict[str, Any] = {}
        code = compile(mutant.source, mutant.file, "exec", annotations.compiler_flag, True)
        exec(code, function.__globals__, space)
        new = space[mutant.name.rpartition(".")[2]]
        function.__code__ = new.__code__
        function.__defaults__, function.__kwdefaults__ = new.__defaults__, new.__kwdefaults__
    return _fails(tests)


def _fails(tests: list[Any]) -> bool:
    """Whether one of the tests fails, in the order given."""
    failed = []
    watch = SimpleNamespace(pytest_runtest_logreport=lambda report: failed.append(report.failed))
    tests[0].config.pluginmanager.register(watch)
    for test, following in pairwise([*tests, None]):
        test.config.hook.pytest_runtest_protocol(item=test, nextitem=following)
        if any(failed):
            return True
    return False


def _forked(answer: Callable[[], bool], limit: int = 600) -> int:
    """`_YES` or `_NO`, or what ended a process of its own; `limit` in seconds of its work."""
    if pid := os.fork():
        return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    silent = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(silent, stream)
    resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
    try:
        os._exit(_YES if answer() else _NO)
    except BaseException:
        os._exit(_YES)


def _children() -> float:
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def _functions() -> Functions:
    """All functions that Python has, by file and qualified name."""
    found: Functions = {}
    for x in gc.get_objects():
        if isinstance(x, FunctionType):
            found.setdefault((x.__code__.co_filename, x.__code__.co_qualname), []).append(x)
    return found
