"""A solution as plain tables: a row a contact, or a row a disc, with named columns."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal, get_args

import numpy as np

from ..errors import InputError
from ..numbers.exact import surd
from ..numbers.vectors import ExactVector, FloatArray
from ..scenes.names import end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution, Solved, Vector
from .optional import needed

AXES = "xyz"
Rows = Literal["contacts", "discs"]
Structured = np.ndarray[Any, np.dtype[np.void]]
_Columns = Iterator[tuple[str, Any, Any]]


def table(solution: Solution, rows: Rows = "contacts") -> Structured:
    """The contacts, or the discs, of a solved scene as a structured array, in the scene's order.

    Parameters
    ----------
    solution : Solved
        A scene in balance.
    rows : {"contacts", "discs"}, default "contacts"
        What stands in a row.

    Returns
    -------
    structured array, shape (contacts,) or (discs,)
        Columns are read by name: numbers as floats, names and exact numbers (columns `..._exact`,
        empty for floating-point solutions) as text. Forces are in w, gaps and displacements in w
        tau, positions in radii. `i` and `j` number the discs of a contact, -1 stands for a support;
        x, y, z is the contact point.

    Raises
    ------
    InputError
        For other rows.
    NotSolvedError
        Where the scene is not solved.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> found = table(solve(nt60(2)))
    >>> found["b"].tolist(), found["force"].round(3).tolist(), found["force_exact"][0]
    (['(2,1)', '(2,2)'], [0.577, 0.577], '1/3*sqrt(3)')
    >>> table(solve(nt60(2)), "discs")["dy_exact"].tolist()
    ['-2/3', '0', '0']
    """
    if rows not in get_args(Rows):
        raise InputError("the rows of the table", rows, "one of " + ", ".join(get_args(Rows)))
    solved = as_solved(solution)
    columns = list(_contacts(solved) if rows == "contacts" else _discs(solved))
    count = len(solved.scene.contacts if rows == "contacts" else solved.scene.discs)
    found: Structured = np.empty(count, dtype=[(name, kind) for name, kind, _ in columns])
    for name, _, values in columns:
        found[name] = values
    return found


def data_frame(solution: Solution, rows: Rows = "contacts") -> Any:
    """The contacts, or the discs, of a solved scene as a DataFrame of pandas (extra `tables`).

    Parameters
    ----------
    solution : Solved
        A scene in balance.
    rows : {"contacts", "discs"}, default "contacts"
        What stands in a row.

    Returns
    -------
    pandas.DataFrame
        The columns of `table`.

    Raises
    ------
    NotSolvedError
        Where the scene is not solved.
    MissingExtraError
        Without pandas.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> data_frame(solve(nt60(2)))["force"].round(3).tolist()
    [0.577, 0.577]
    """
    return needed("pandas", "tables").DataFrame(table(solution, rows))


def as_solved(solution: Solution) -> Solved:
    """The solution of a scene that has one; `NotSolvedError` for the others."""
    if solution.status != "solved":
        solution.forces  # noqa: B018 - says what there is instead
    assert isinstance(solution, Solved)
    return solution


def positions(scene: Scene) -> FloatArray:
    """Lattice points of the discs, shape (discs, axes)."""
    return np.array([[float(x) for x in disc.position] for disc in scene.discs])


def normal_array(scene: Scene) -> FloatArray:
    """The normal of every contact, shape (contacts, axes)."""
    values, which = scene.normals
    found = np.array([[float(x) for x in normal] for normal in values])
    return found.reshape(-1, scene.dimension)[which]


def contact_points(scene: Scene) -> FloatArray:
    """Where contacts touch disc a, shape (contacts, axes)."""
    radii = np.array([float(disc.radius) for disc in scene.discs])
    a = scene.ends[0]
    return positions(scene)[a] - radii[a, None] * normal_array(scene)


def _contacts(solution: Solved) -> _Columns:
    scene = solution.scene
    contacts = scene.contacts
    i, j = scene.ends
    yield "a", object, [end_name(contact.a) for contact in contacts]
    yield "b", object, [end_name(contact.b) for contact in contacts]
    yield "i", np.int64, i
    yield "j", np.int64, j
    yield from _per_axis("", contact_points(scene))
    yield from _per_axis("normal_", normal_array(scene))
    yield "compliance", np.float64, [float(surd(contact.compliance)) for contact in contacts]
    yield "initial_gap", np.float64, [float(contact.gap) for contact in contacts]
    yield "bilateral", np.bool_, [contact.bilateral for contact in contacts]
    yield "force", np.float64, solution.force_array
    yield "gap", np.float64, solution.gap_array
    yield "state", "U10", solution.states
    yield "gap_unique", np.bool_, solution.gap_unique or False
    yield "force_exact", object, _exact(solution.forces)
    yield "gap_exact", object, _exact(solution.gaps)


def _discs(solution: Solved) -> _Columns:
    scene = solution.scene
    discs = scene.discs
    yield "id", object, [end_name(disc.id) for disc in discs]
    yield from _per_axis("", positions(scene))
    yield from _per_axis("load_", np.array([[float(x) for x in disc.load] for disc in discs]))
    held = [[np.nan if h is None else float(h) for h in disc.held] for disc in discs]
    yield from _per_axis("held_", np.array(held))
    yield from _per_axis("d", solution.displacement_array)
    exact = _exact(solution.displacements)
    for axis, name in enumerate(AXES[: scene.dimension]):
        yield f"{name}_exact", object, [str(disc.position[axis]) for disc in discs]
        yield f"d{name}_exact", object, exact[axis :: scene.dimension]


def _per_axis(name: str, vectors: FloatArray) -> _Columns:
    for axis, column in zip(AXES, vectors.T, strict=False):
        yield name + axis, np.float64, column


def _exact(vector: Vector) -> list[str]:
    if isinstance(vector, ExactVector):
        return [str(x) for x in vector]
    return [""] * len(vector)
