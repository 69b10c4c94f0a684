"""What is found, in lines of text."""

from __future__ import annotations

from collections.abc import Sequence

from ..crosscheck import CrossCheck
from ..fields.base_load import base_load
from ..fields.base_pressure import base_pressure
from ..fields.disc_contacts import Number
from ..fields.field import Table, cell_text
from ..numbers.exact import ZERO, Surd, decimal
from ..scenes.kind import has_unique_forces
from ..scenes.names import DiscId, contact_name, end_name
from ..scenes.scene import Contact, Scene
from ..solution.describe import brief
from ..solution.loose import falling, rattlers
from ..solution.solution import Solution, Solved

_LONGEST = 160
_SHOWN = 8
VERDICTS = {
    "stable": "stable",
    "saddle": "a saddle: a real pile slides off this equilibrium",
    "neutral": "neutral: it moves without gain or loss of energy at second order",
    "undecided": "undecided: negative compliances make the energy indefinite",
}


def summary(solution: Solution, *, digits: int = 6, check: CrossCheck | None = None) -> str:
    """What the command line prints of a solution: one fact a line."""
    record = solution.record
    lines = [
        ("scene", describe(solution.scene)),
        ("status", _status(solution)),
        ("exact", f"{'yes' if solution.exact else 'no'}; {record.proof}"),
        ("size", _size(solution)),
    ]
    if solution.status == "solved":
        counts = [f"{solution.count(s)} {s}" for s in ("closed", "open", "osculatory")]
        lines.append(("contacts", ", ".join(counts)))
        contact, force = solution.largest_force()
        lines.append(
            ("largest force", f"{contact_name((contact.a, contact.b))}: {number(force, digits)} w")
        )
        lines += [("under the axis", text) for text in _under_axis(solution, digits)]
        lines += _promises(solution)
        lines += _those("rattlers", rattlers(solution), "that no force holds")
    if solution.status == "unstable":
        lines += _those("collapse", falling(solution), "that it moves")
    if check is not None:
        lines.append(("floating point", _checked(check)))
    lines.append(("pivots", str(record.pivots)))
    lines.append(("method", f"{record.method}, {record.arithmetic}"))
    return aligned(lines)


def aligned(lines: Sequence[tuple[str, str]]) -> str:
    """Names and what is said of them, one below the other."""
    width = max(len(name) for name, _ in lines)
    return "\n".join(f"{name:<{width}}  {text}" for name, text in lines)


def table_text(table: Table, digits: int) -> str:
    """A table for people: its facts, then aligned columns, numbers in decimals to the right."""
    rows = [[cell_text(cell, digits) for cell in row] for row in table.rows]
    names = [column.name for column in table.columns]
    widths = [max(map(len, column)) for column in zip(names, *rows, strict=True)]
    numbers = [
        all(not isinstance(row[k], str) for row in table.rows) for k in range(len(table.columns))
    ]

    def line(cells: Sequence[str]) -> str:
        padded = (
            cell.rjust(width) if right else cell.ljust(width)
            for cell, width, right in zip(cells, widths, numbers, strict=True)
        )
        return "  ".join(padded).rstrip()

    facts = [f"{name}: {cell_text(cell, digits)}" for name, cell in table.facts]
    return "\n".join([*facts, *map(line, [names, *rows])])


def describe(scene: Scene) -> str:
    """The scene in one line, with all its parameters."""
    if scene.origin is None:
        return brief(scene)
    named = [f"{name.replace('_', ' ')} {_cut(str(x))}" for name, x in scene.origin.parameters]
    return ", ".join([scene.origin.kind.title, *named])


def number(value: Surd | float, digits: int) -> str:
    """An exact number with its decimals; long ones are cut in the middle."""
    if isinstance(value, float):
        return f"{value:.{digits}g}"
    text = str(value)
    shown = _cut(text)
    near = decimal(value, digits)
    return shown if near == text else f"{shown} = {near}"


def _cut(text: str) -> str:
    if len(text) <= _LONGEST:
        return text
    return f"{text[:40]} ... {text[-40:]} ({len(text)} characters)"


def _status(solution: Solution) -> str:
    if solution.status == "unstable":
        return "unstable: no forces balance the load, and the collapse motion is verified"
    if solution.status == "unresolved":
        return "unresolved: nothing is proved about this scene"
    return "solved"


def _size(solution: Solution) -> str:
    record = solution.record
    whole = f"{record.whole_dof} degrees of freedom, {record.whole_contacts} contacts"
    if record.part == "whole":
        return f"{whole}, all of them solved for"
    return f"{whole}; solved on the symmetric half: {record.dof} and {record.contacts}"


def _under_axis(solution: Solution, digits: int) -> list[str]:
    """The normal force on the base at the places nearest to the axis, one or a few."""
    found: list[tuple[DiscId, Number, Surd]] = []  # with the square of the distance
    if solution.scene.dimension == 2:
        found = [(p.disc, p.normal, p.x * p.x) for p in base_pressure(solution)]
    else:
        for place in base_load(solution):
            square = sum((x * x for x in place.across), ZERO)
            found.append((place.disc, place.load, square))
    if not found:
        return ["no disc of the pile is movable"]
    nearest = min(square for *_, square in found)
    return [
        f"{end_name(disc)}: {number(load, digits)} w"
        for disc, load, square in found
        if square == nearest
    ]


def _those(name: str, discs: Sequence[DiscId], what: str) -> list[tuple[str, str]]:
    """How many discs there are of a sort, and which, as far as a line goes; nothing for none."""
    some = ", ".join(map(end_name, discs[:_SHOWN])) + ", ..." * (len(discs) > _SHOWN)
    count = f"{len(discs)} disc{'' if len(discs) == 1 else 's'}"
    return [(name, f"{count} {what}: {some}")] if discs else []


def _promises(solution: Solution) -> list[tuple[str, str]]:
    lines = []
    stability = solution.stability
    if stability is not None:
        count = stability.mechanisms
        mechanisms = f"{count} mechanism{'' if count == 1 else 's'}"
        lines.append(("stability", f"{VERDICTS[stability.verdict]} ({mechanisms})"))
    several = solution.gap_unique.count(False)
    if several:
        lines.append(("gaps", f"{several} of them are not unique: one solution is shown"))
    if solution.forces_unique is False:
        lines.append(("forces", "not unique: rigid contacts can share the load in several ways"))
    if not solution.scene.definite:
        what = "existence and uniqueness are not promised"
        if has_unique_forces(solution.scene):
            what = "its forces are unique all the same, its stability is not decided"
        lines.append(("promise", f"a negative compliance: {what}"))
    return lines


def contact_lines(
    solution: Solved, contacts: Sequence[Contact], digits: int
) -> list[tuple[str, str]]:
    """Name of each contact, and its state, force and gap."""
    lines = []
    for contact in contacts:
        k = solution.contact_index(contact.a, contact.b)
        force, gap = number(solution.forces[k], digits), number(solution.gaps[k], digits)
        text = f"{solution.states[k]}, force {force} w, gap {gap} w tau"
        lines.append((contact_name((contact.a, contact.b)), text))
    return lines


def _checked(check: CrossCheck) -> str:
    text = f"largest difference of a force {check.largest_difference:.1e} w"
    if not check.differing:
        return text + ", the same states"
    some = ", ".join(
        f"{contact_name((c.a, c.b))} {one}/{two}" for c, one, two in check.differing[:3]
    )
    more = ", ..." if len(check.differing) > 3 else ""
    return f"{text}, {len(check.differing)} states named differently ({some}{more})"
