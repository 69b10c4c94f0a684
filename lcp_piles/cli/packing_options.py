"""Words of the command line about a packing: a table of discs in place of a scene."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

from ..errors import InputError
from ..files.column_rows import is_table
from ..files.read_forces import DISC_COLUMNS
from ..files.read_packing import read_packing
from ..packings.packing import Packing
from ..packings.walls import SIDES, Wall
from ..scenes.kinds import KINDS
from .options import is_kind, number, refuse_parameters


def add_packing(parser: argparse.ArgumentParser) -> None:
    """Options for a table of discs; they have no defaults here, so that those given are known."""
    group = parser.add_argument_group(
        "packings",
        "a table or LAMMPS dump of discs may stand for SCENE, in any units; there --floor takes "
        "its height",
    )
    group.add_argument(
        "--disc-columns",
        type=columns,
        metavar="WHAT=NAME,...",
        help=f"which columns of discs are what ({known(DISC_COLUMNS)} are understood)",
    )
    for name, (axis, sign) in SIDES.items():
        if name in _OF_KINDS:
            continue
        where = f"{'above' if sign > 0 else 'below'} this {'xy'[axis] if axis >= 0 else 'height'}"
        group.add_argument(f"--{name}", type=number, metavar="X", help=f"a wall: discs are {where}")
    group.add_argument(
        "--wall",
        type=_wall,
        action="append",
        metavar="NAME=POINT:NORMAL",
        help="another wall, such as slope=0,0:1,2; the normal points to where the discs are",
    )
    group.add_argument("--period", type=number, metavar="P", help="the packing repeats along x")
    group.add_argument(
        "--touching",
        type=number,
        metavar="T",
        help="gap up to which discs may push, as a part of the sum of their radii (default: 0.01)",
    )
    group.add_argument(
        "--contact-stiffness", type=number, metavar="K", help="force of a unit of overlap (1)"
    )
    group.add_argument(
        "--gravity", type=number, metavar="G", help="weight of a unit of weight or mass (1)"
    )


def packing_of(options: argparse.Namespace, allowed: Sequence[str] = ()) -> Packing | None:
    """The packing that the words ask for, None where they ask for a scene.

    Some options may be `allowed` for scenes too.
    """
    own = ("disc_columns", *SIDES, "wall", *_HOW)
    given = {name: getattr(options, name) for name in own if getattr(options, name) is not None}
    if is_kind(options) or not is_table(options.kind):
        for name in given.keys() - _OF_KINDS - set(allowed):
            word = "--" + name.replace("_", "-")
            options.parser.error(f"{word}: {options.kind} is no table of discs")
        return None
    refuse_parameters(options, "is a table of discs", leave_out=[*SIDES])
    walls: dict[str, Any] = {name: _height(options, name) for name in SIDES if name in given}
    walls |= dict(given.get("wall", ()))
    how = {_HOW[name]: given[name] for name in _HOW if name in given}
    return read_packing(options.kind, given.get("disc_columns"), supports=walls, **how)


def _height(options: argparse.Namespace, name: str) -> float:
    """Where a wall is; the word is not read yet where a kind has a parameter of this name."""
    word, parser = getattr(options, name), options.parser
    assert isinstance(parser, argparse.ArgumentParser)
    try:
        return number(word) if isinstance(word, str) else float(word)
    except argparse.ArgumentTypeError as error:
        parser.error(f"--{name}: {error}")


_HOW = {
    "period": "period",
    "touching": "tolerance",
    "contact_stiffness": "stiffness",
    "gravity": "gravity",
}
"""Options by what `read_packing` calls them."""
_OF_KINDS = {parameter.name for kind in KINDS.values() for parameter in kind.parameters}
"""Options that kinds of scenes have by themselves."""


def columns(text: str) -> dict[str, str]:
    """Columns by what they are, as a type of an option."""
    found = {}
    for part in text.split(","):
        what, equals, name = part.partition("=")
        if not (what and equals and name):
            raise argparse.ArgumentTypeError(f"{part!r} is not of the form WHAT=NAME")
        found[what] = name
    return found


def known(columns: dict[str, Any]) -> str:
    """The names that are understood by themselves."""
    return ", ".join(name for names in columns.values() for name in names)


def _wall(text: str) -> tuple[str, Wall]:
    name, equals, rest = text.partition("=")
    point, colon, normal = rest.partition(":")
    if not (name and equals and colon):
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form NAME=POINT:NORMAL")
    vectors = [tuple(map(number, part.split(","))) for part in (point, normal)]
    try:
        return name, Wall(*vectors)
    except InputError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
