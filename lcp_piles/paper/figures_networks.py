"""The paper's scenes and force networks (its sections 3 and 5)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ..errors import SolveError
from ..files.tables import csv_text
from ..methods.z.z_algorithm import z_algorithm
from ..pictures.drawing import page
from ..pictures.plotting import draw_network, draw_scene
from ..scenes.kinds import pile
from ..scenes.names import end_name
from ..scenes.scene import Scene
from ..scenes.symmetry import mirror
from ..solution.solution import ContactState, Solution, Solved
from ..solve import solve
from .plate import Plate, both, floor_label, floors, panel_title, stacked


def scene_plate(kind: str, layers: int) -> Plate:
    """The discs of a pile with their indices, the held ones grey."""
    scene = pile(kind, layers)
    rows = [
        [
            end_name(disc.id),
            *both(disc.position[0]),
            *both(disc.position[1]),
            *("free" if h is None else h for h in disc.held),
        ]
        for disc in scene.discs
    ]
    header = ["disc", "x", "x_decimal", "y", "y_decimal", "dx", "dy"]
    return Plate(page(draw_scene(scene)), {".csv": csv_text(header, rows)})


def network_plate(
    kind: str, layers: int, by_z: bool = False, remark: Callable[[Solved], str] | None = None
) -> Plate:
    """The force network of a pile, on every floor that `floors` names.

    With `by_z` a last panel shows the network as the Z algorithm of the paper leaves it on the
    last of these floors: contacts that carry nothing and are still in its equations are osculatory
    there, while the optimal partition finds them open, moved apart by a mechanism. `remark` is what
    a panel says of its solution below its title.
    """
    solutions = {floor_label(floor): solve(pile(kind, layers, **floor)) for floor in floors(kind)}
    titles = {label: panel_title(solution.scene) for label, solution in solutions.items()}
    if by_z:
        label, solution = list(solutions.items())[-1]
        solutions[f"{label} by Z"] = as_z_leaves(solution.scene)
        titles[f"{label} by Z"] = titles[label] + ", as the Z algorithm ends"
    axes = stacked([solution.scene for solution in solutions.values()])
    rows = []
    for ax, (label, solution) in zip(axes, solutions.items(), strict=True):
        _, *more = draw_network(solution, ax).get_title().split("\n")
        if remark is not None and solution.status == "solved":
            more.append(remark(solution))
        ax.set_title("\n".join([titles[label], *more]), fontsize=11 - bool(more))
        rows += [[label, *row] for row in contact_rows(solution)]
    return Plate(page(axes[0]), {".csv": csv_text(["floor", *CONTACT_HEADER], rows)})


def hong_remark(solution: Solved) -> str:
    """How a pile NT60 differs from what the paper says of it, after Hong (section 5)."""
    scene = solution.scene
    base = max(disc.position[1] * -1 for disc in scene.discs)
    count = sum(
        not contact.normal[1] and -scene.disc(contact.a).position[1] != base and bool(force)
        for contact, force in zip(scene.contacts, solution.forces, strict=True)
    )
    return f"horizontal contacts with force above the base row: {count} (the paper: none)"


CONTACT_HEADER = ["a", "b", "force", "force_decimal", "gap", "gap_decimal", "state"]


def contact_rows(solution: Solution) -> list[list[object]]:
    """A row for each contact of a solved scene, with the columns of `CONTACT_HEADER`."""
    return [
        [end_name(c.a), end_name(c.b), *both(force), *both(gap), state]
        for c, force, gap, state in zip(
            solution.scene.contacts, solution.forces, solution.gaps, solution.states, strict=True
        )
    ]


def as_z_leaves(scene: Scene) -> Solved:
    """The solution of the Z algorithm with the states that its last set Z says.

    A contact with force is closed, one of Z open, and one with neither osculatory: it touches in
    the state that the algorithm ended in, though it need not touch in another solution.
    """
    result = z_algorithm(scene)
    solution = result.solution
    if solution.status != "solved":
        raise SolveError(f"the Z algorithm ended with {result.status} on this scene: no network")
    image = mirror(scene)
    Z = set(result.Z) | (set() if image is None else {int(image.contacts[k]) for k in result.Z})
    states: list[ContactState] = [
        "closed" if force else "open" if k in Z else "osculatory"
        for k, force in enumerate(solution.forces)
    ]
    return replace(solution, states=tuple(states))
