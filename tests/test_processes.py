"""All public values and errors cross to another process and back, however it was started."""

from __future__ import annotations

import multiprocessing
import pickle
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np
import pytest
from flint import fmpz
from scipy.sparse import issparse

import lcp_piles
from lcp_piles import (
    FIELDS,
    HERTZ,
    KINDS,
    METHODS,
    ExactSolver,
    FileFormatError,
    InputError,
    LcpPilesError,
    NotSolvedError,
    SolveError,
    Surd,
    VerificationError,
    compare,
    contact_bounds,
    contact_lcp,
    contact_system,
    continuation,
    cross_check,
    deform,
    first_order,
    force_bounds,
    lcp,
    lemke,
    linear_program,
    nt30,
    nt60,
    prove_contacts,
    push_path,
    slide,
    solve,
    stress,
    surd,
    tss,
    verify,
    z_algorithm,
    z_lcp,
)
from lcp_piles.linear.sparse_exact import SingularError
from lcp_piles.mechanics.motions import CollapseError
from lcp_piles.methods.newton import newton
from lcp_piles.numbers.vectors import ExactVector

VALUES: dict[str, Callable[[], Any]] = {
    "surd": lambda: surd("2 - 1/3*sqrt(3)"),
    "scene": lambda: nt30(3, push="sqrt(3)"),
    "own scene": lambda: nt60(3).without([(1, 1)]),
    "kinds": lambda: KINDS,
    "methods": lambda: METHODS,
    "fields": lambda: FIELDS,
    "contact system": lambda: contact_system(nt30(3)),
    "contact lcp": lambda: contact_lcp(contact_system(nt60(3))),
    "lcp": lambda: lcp([[2, 1], [1, 2]], [-5, -6]),
    "lcp of a pile": lambda: contact_lcp(contact_system(nt60(3))).problem,
    "lemke, solved": lambda: lemke([[2, 1], [1, 2]], [-5, -6]),
    "lemke, a ray": lambda: lemke([[-1]], [-1]),
    "z on an lcp": lambda: z_lcp([[1, 0, 2], [2, 1, 0], [0, 2, 1]], [1, 1, 1], start=[0]),
    "exact solver": lambda: ExactSolver(np.array([[2, 1], [1, 2]])),
    "solved": lambda: solve(nt30(3)),
    "solved by floats": lambda: solve(nt30(3), "newton"),
    "unstable": lambda: solve(nt60(4).without([(4, 1)])),
    "unresolved": lambda: solve(nt60(4).without([(4, 1)]), "newton"),
    "verification": lambda: verify(nt60(3), solve(nt60(3))),
    "cross check": lambda: cross_check(solve(nt30(3))),
    "a method's outcome": lambda: METHODS["proved"].run(contact_system(nt30(3))),
    "float state": lambda: newton(contact_system(nt30(3))),
    "proof": lambda: prove_contacts(nt30(3)),
    "z": lambda: z_algorithm(nt30(4)),
    "comparison": lambda: compare("tbs", [2]),
    "push": lambda: push_path("nt30", 2),
    "path": lambda: continuation(nt30(2), nt30(2, push="sqrt(3)")),
    "stress": lambda: stress(solve(nt30(3))),
    "first order": lambda: first_order(solve(nt30(3))),
    "deformed": lambda: deform(solve(nt30(3)), 1e-4, HERTZ),
    "slide": lambda: slide(deform(solve(tss(3)), 1e-3)),
    "linear programme": lambda: linear_program([1, 1], [[1, 1]], [2]),
    "friction": lambda: force_bounds(nt60(3), "1/2", {((1, 1), (2, 1)): 1}),
    "all of friction": lambda: contact_bounds(nt60(3), "1/2"),
}


def _collapse() -> None:
    contact_lcp(contact_system(replace(nt60(2), contacts=())))


def _singular() -> None:
    ExactSolver(np.array([[1, 1], [1, 1]])).solve([1, 0])


def _unsolved() -> Any:
    return solve(nt60(4).without([(4, 1)])).forces


def _raise(error: Exception) -> None:
    raise error


ERRORS: dict[str, tuple[type[LcpPilesError], Callable[[], Any]]] = {
    "input": (InputError, lambda: solve(nt30(3), "simplex")),
    "a value that does not pickle": (InputError, lambda: surd(lambda: 0)),  # type: ignore[arg-type]
    "not solved": (NotSolvedError, _unsolved),
    "file": (FileFormatError, lambda: lcp_piles.load("/no/such/file")),
    "collapse": (CollapseError, _collapse),
    "singular": (SingularError, _singular),
    "solve": (SolveError, lambda: prove_contacts(nt30(3, floor_compliance=0))),
    "verification": (VerificationError, lambda: _raise(VerificationError("false"))),
}


def content(value: Any) -> Any:
    """A value as plain data, to be compared; what is only remembered is left out."""
    if isinstance(value, ExactVector):
        return [str(x) for x in value]
    if isinstance(value, fmpz | Surd):
        return str(value)
    if isinstance(value, np.ndarray):
        return (value.dtype.str, content(value.tolist()))
    if issparse(value):
        return value.toarray().tolist()
    if is_dataclass(value) and not isinstance(value, type):
        parts = {f.name: content(getattr(value, f.name)) for f in fields(value)}
        return (type(value).__name__, parts)
    if isinstance(value, dict):
        return {str(key): content(x) for key, x in value.items()}
    if isinstance(value, list | tuple):
        return [content(x) for x in value]
    if callable(value):
        return getattr(value, "__qualname__", type(value).__name__)
    if isinstance(value, int | float | str | bool | type(None)):
        return repr(value)
    if type(value).__repr__ is not object.__repr__:
        return repr(value)
    return type(value).__name__


def echo(values: list[Any]) -> list[Any]:
    """In another process: what came there, and goes back."""
    return values


def made(name: str) -> Any:
    """In another process: a value that is made there."""
    return VALUES[name]()


def fail(name: str) -> Any:
    """In another process: the call that ends in an error."""
    return ERRORS[name][1]()


@pytest.fixture(scope="module", name="values")
def _values() -> dict[str, Any]:
    return {name: make() for name, make in VALUES.items()}


@pytest.mark.parametrize("name", VALUES)
def test_a_value_survives_pickle(name: str) -> None:
    value = VALUES[name]()
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        again = pickle.loads(pickle.dumps(value, protocol))
        assert type(again) is type(value)
        assert content(again) == content(value)


@pytest.mark.parametrize("name", ERRORS)
def test_an_error_survives_pickle(name: str) -> None:
    kind, call = ERRORS[name]
    with pytest.raises(kind) as caught:
        call()
    error = caught.value
    error.add_note("a note")
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), again.args) == (type(error), str(error), error.args)
    assert content(vars(again)) == content(vars(error))
    assert again.__notes__ == ["a note"]


@pytest.fixture(
    params=[
        m for m in ("fork", "spawn", "forkserver") if m in multiprocessing.get_all_start_methods()
    ],
    name="pool",
)
def _pool(request: pytest.FixtureRequest) -> Iterator[ProcessPoolExecutor]:
    context = multiprocessing.get_context(request.param)
    with ProcessPoolExecutor(1, mp_context=context) as pool:
        yield pool


@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
def test_values_cross_and_one_bad_sample_does_not_break_the_pool(
    pool: ProcessPoolExecutor, values: dict[str, Any]
) -> None:
    """A process for all of it: starting one takes longer than the rest."""
    for name, (kind, call) in ERRORS.items():
        with pytest.raises(kind) as there:
            pool.submit(fail, name).result(60)
        with pytest.raises(kind) as here:
            call()
        if name != "a value that does not pickle":  # its message has an address
            assert str(there.value) == str(here.value)
    back = pool.submit(echo, list(values.values())).result(60)
    for value, again in zip(values.values(), back, strict=True):
        assert content(again) == content(value)
    solved = pool.submit(made, "solved").result(60)
    assert list(solved.forces) == list(values["solved"].forces)
    assert solved.force((1, 1), (2, 2)) == values["solved"].force((1, 1), (2, 2))


def test_what_came_back_still_works(values: dict[str, Any]) -> None:
    """Lazily computed parts are computed anew."""

    def again(name: str) -> Any:
        return pickle.loads(pickle.dumps(values[name]))

    assert lemke(again("lcp of a pile")).z == lemke(values["lcp of a pile"]).z
    assert again("contact lcp").problem.M == values["contact lcp"].problem.M
    assert again("exact solver").solve([1, 1]) == values["exact solver"].solve([1, 1])
    path = again("push")
    assert path.force((1, 1), (2, 2), 100) == values["push"].force((1, 1), (2, 2), 100)
    assert verify(nt30(3), again("solved")).ok
    assert solve(again("own scene")).states == solve(values["own scene"]).states
    scene = again("scene")
    assert scene == values["scene"]
    assert solve(scene).status == "solved"
