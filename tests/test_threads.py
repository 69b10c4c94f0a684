"""BLAS has one thread inside the library's own work, and what the user had set afterwards."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from multiprocessing import get_context

import numpy as np
import pytest
from threadpoolctl import ThreadpoolController, threadpool_limits

from lcp_piles import ExactSolver, contact_system, nt30, prove_contacts, push_path, solve, verify
from lcp_piles.linear import banded
from lcp_piles.linear.kernel import kernel
from lcp_piles.linear.threads import one_thread
from lcp_piles.methods.newton import newton

BLAS = ThreadpoolController().select(user_api="blas")
SOLUTION = solve(nt30(4))
CALLS = {
    "solve": lambda: solve(nt30(10)),
    "solve by floats": lambda: solve(nt30(10), "newton"),
    "prove_contacts": lambda: prove_contacts(nt30(4)),
    "newton": lambda: newton(contact_system(nt30(10))),
    "push_path": lambda: push_path("nt30", 10, until=1),
    "verify": lambda: verify(nt30(7), SEVEN),
    "kernel": lambda: kernel(contact_system(nt30(12)).B),
}
SEVEN = solve(nt30(7))  # it has mechanisms, which verify counts


def threads() -> set[int]:
    return {library["num_threads"] for library in BLAS.info()}


@pytest.mark.skipif(not BLAS.info(), reason="no BLAS whose threads can be set")
@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS.keys())
def test_a_factorisation_has_one_thread_and_the_setting_comes_back(call, monkeypatch) -> None:
    seen: list[set[int]] = []
    factor = banded.cholesky

    def watched(*arguments):
        seen.append(threads())
        return factor(*arguments)

    for module in ("kernel", "stiffness", "definite"):
        monkeypatch.setattr(f"lcp_piles.linear.{module}.cholesky", watched)
    with threadpool_limits(2, user_api="blas"):
        call()
        assert threads() == {2}
    assert seen
    assert set.union(*seen) == {1}


@pytest.mark.skipif(not BLAS.info(), reason="no BLAS whose threads can be set")
def test_an_exact_solver_has_one_thread(monkeypatch) -> None:
    import scipy.sparse.linalg

    seen: list[set[int]] = []
    real = scipy.sparse.linalg.splu

    def watched(*arguments, **options):
        seen.append(threads())
        return real(*arguments, **options)

    monkeypatch.setattr("scipy.sparse.linalg.splu", watched)
    with threadpool_limits(2, user_api="blas"):
        ExactSolver(np.eye(100, dtype=np.int64)).solve([1] * 100)
        assert threads() == {2}
    assert seen == [{1}]


def failing() -> None:
    with one_thread():
        with one_thread():
            assert threads() == {1}
        assert threads() == {1}  # the inner one does not lift the limit of the outer one
        raise ZeroDivisionError


@pytest.mark.skipif(not BLAS.info(), reason="no BLAS whose threads can be set")
def test_the_setting_comes_back_after_an_error_and_from_within() -> None:
    with threadpool_limits(2, user_api="blas"):
        with pytest.raises(ZeroDivisionError):
            failing()
        assert threads() == {2}


@pytest.mark.skipif(not BLAS.info(), reason="no BLAS whose threads can be set")
@pytest.mark.parametrize("first_out", ["the other", "this"])
def test_calls_that_overlap_leave_the_setting_as_it_was(first_out) -> None:
    """Were each to put back what it found, the second one out would leave one thread for good."""
    inside, leave = threading.Event(), threading.Event()

    def work() -> None:
        with one_thread():
            inside.set()
            leave.wait(10)

    before = threads()
    other = threading.Thread(target=work)
    other.start()
    inside.wait(10)
    assert threads() == {1}
    with one_thread():
        assert threads() == {1}
        if first_out == "the other":
            leave.set()
            other.join(10)
    leave.set()
    other.join(10)
    assert threads() == before
    with threadpool_limits(2, user_api="blas"):  # and the user can set it again
        assert threads() == {2}
        with one_thread():
            assert threads() == {1}
        assert threads() == {2}


def _in_child(queue) -> None:
    before = threads()
    with one_thread():
        inside = threads()
    queue.put((before, inside, threads()))


@pytest.mark.skipif(not BLAS.info(), reason="no BLAS whose threads can be set")
@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
def test_a_child_forked_from_within_starts_with_the_setting_of_the_user() -> None:
    context = get_context("fork")
    queue = context.SimpleQueue()
    with threadpool_limits(2, user_api="blas"), one_thread():
        child = context.Process(target=_in_child, args=(queue,))
        child.start()
        found = queue.get()
        child.join(10)
        assert threads() == {1}
    assert found == ({2}, {1}, {2})


def test_libraries_that_are_loaded_late_are_limited_too() -> None:
    """A fresh process that has not imported scipy's LAPACK before the first limit."""
    program = """
import lcp_piles
from threadpoolctl import threadpool_info
from lcp_piles.linear.threads import one_thread
with one_thread():
    from scipy.linalg import lapack
    from scipy.sparse.linalg import splu
    print({each["num_threads"] for each in threadpool_info() if each["user_api"] == "blas"})
print({each["num_threads"] for each in threadpool_info() if each["user_api"] == "blas"})
"""
    environment = dict(os.environ) | {"OPENBLAS_NUM_THREADS": "2", "OMP_NUM_THREADS": "2"}
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True
    )
    inside, after = done.stdout.splitlines()
    assert inside == "{1}"
    assert after in ("{1}", "{2}")  # one on a machine of one core
