"""A solution as a graph, for whoever asks about paths, cycles and communities of force."""

from __future__ import annotations

from typing import Any

from ..solution.solution import Solution
from .optional import needed
from .solution_tables import as_solved, normal_array, positions


def graph(solution: Solution) -> Any:
    """The contact network of a solved scene as an undirected graph of networkx (extra `graph`).

    Parameters
    ----------
    solution : Solved
        A scene in balance.

    Returns
    -------
    networkx.Graph
        Nodes are the ids of discs, with `position` (radii), `load` (w) and `fixed`, and the names
        of supports, which have none of these. Edges are contacts, with `force` (w), `gap` (w tau),
        `state`, and `normal`, which points to the node `towards`.

    Raises
    ------
    NotSolvedError
        Where the scene is not solved.
    MissingExtraError
        Without networkx.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> graph(solve(nt60(2))).edges[(1, 1), (2, 2)]["state"]
    'closed'
    """
    solved = as_solved(solution)
    scene = solved.scene
    made = needed("networkx", "graph").Graph()
    for disc, place in zip(scene.discs, positions(scene).tolist(), strict=True):
        load = tuple(float(x) for x in disc.load)
        made.add_node(disc.id, position=tuple(place), load=load, fixed=disc.fixed)
    made.add_nodes_from(scene.supports)
    for contact, force, gap, state, normal in zip(
        scene.contacts,
        solved.force_array.tolist(),
        solved.gap_array.tolist(),
        solved.states,
        normal_array(scene).tolist(),
        strict=True,
    ):
        attributes = {"force": force, "gap": gap, "state": state, "normal": tuple(normal)}
        made.add_edge(contact.a, contact.b, towards=contact.a, **attributes)
    return made
