"""Words of the command line that several commands share: which scene, numbers, sizes, digits.

What a kind of scene depends on is known to the kinds: their parameters are the options, read by
themselves. A word that cannot be read is a mistake in the usage, and says so.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Sequence
from functools import partial
from math import isfinite
from typing import Any, TypeVar

from ..errors import InputError
from ..files.column_rows import is_table
from ..files.safe_write import check_ending
from ..files.scene_file import load_scene
from ..numbers.exact import Surd, surd
from ..packings.walls import SIDES
from ..scenes.kind import Kind, Parameter
from ..scenes.kinds import KINDS, pile
from ..scenes.named_contact import named_contact
from ..scenes.scene import Contact, Scene

Value = TypeVar("Value")
_OTHER_NUMBERS = (
    *("until", "stiffness", "friction", "tolerance", "disc-radius", "disc-weight"),
    *("period", "touching", "contact-stiffness", "gravity", "exact"),
)
"""Options that take a number and are no parameter of a kind."""
CERTIFICATE = "write a certificate of it, that anyone can check without this program"
"""What `--certificate` does, in all commands that have it."""
SIZE = "layers"
"""The parameter over whose values `compare` goes."""


def add_kind(parser: argparse.ArgumentParser, kinds: Sequence[Kind]) -> None:
    """The kind of scene, one of these."""
    named = "; ".join(f"{kind.name}: {kind.help}" for kind in kinds)
    parser.add_argument("kind", choices=[kind.name for kind in kinds], help=named)


def add_scene(parser: argparse.ArgumentParser, name: str = "") -> None:
    """A scene: a kind with its parameters, or a file; `scene_of` has what was asked for.

    It is an option with this name, or without one the word of the command.
    """
    kinds = list(KINDS.values())
    named = "; ".join(f"{kind.name}: {kind.help}" for kind in kinds)
    help = f"a kind of scene, or a scene file or result file (notes/result-format.md); {named}"
    how: dict[str, Any] = {"dest": "kind", "required": True} if name else {}
    mark_file(
        parser.add_argument(name or "kind", metavar="SCENE", help=help.replace("%", "%%"), **how)
    )
    add_parameters(parser, kinds)


def is_kind(options: argparse.Namespace) -> bool:
    """Whether the scene is a kind and no file; what is neither is a mistake in the usage."""
    if options.kind not in KINDS and not os.path.exists(options.kind):
        kinds = ", ".join(KINDS)
        options.parser.error(f"{options.kind!r} is neither a kind ({kinds}) nor a file")
    return options.kind in KINDS


def add_parameters(
    parser: argparse.ArgumentParser, kinds: Sequence[Kind], leave_out: Sequence[str] = ()
) -> None:
    """An option for every parameter that one of the kinds has.

    Words are kept as they are until the kind is known: `parameters` reads them.
    """
    for name, owners in _owners(kinds).items():
        if name in leave_out:
            continue
        parameter = owners[0].parameter(name)
        only = "" if len(owners) == len(kinds) else f" ({', '.join(k.name for k in owners)} only)"
        parser.add_argument(
            option(parameter),
            dest=name,
            metavar=parameter.metavar or "|".join(parameter.choices),
            help=parameter.help.replace("%", "%%") + only,
        )


def parameters(options: argparse.Namespace) -> dict[str, Any]:
    """The parameters that were given, read."""
    kind, found = KINDS[options.kind], {}
    own = {p.name for p in kind.parameters}
    for name, owners in _owners(list(KINDS.values())).items():
        word = getattr(options, name, None)
        if word is not None:
            owner = kind if name in own else owners[0]
            found[name] = read(options, owner.parameter(name).read, word)
    return found


def scene_of(options: argparse.Namespace) -> Scene:
    """The scene that the words ask for; a kind goes before a file of the same name."""
    if not is_kind(options):
        if is_table(options.kind):
            way = "solve TABLE --exact ANGLE --json FILE"
            options.parser.error(f"{options.kind} is a table; `{way}` makes an exact scene of it")
        refuse_parameters(options, "is a file, which says it all")
        return load_scene(options.kind)
    given = parameters(options)
    return read(options, lambda words: pile(options.kind, **words), given)


def refuse_parameters(options: argparse.Namespace, why: str, leave_out: Sequence[str] = ()) -> None:
    """A mistake in the usage where a parameter of a kind was given, but for some."""
    for name, owners in _owners(list(KINDS.values())).items():
        if name not in leave_out and getattr(options, name, None) is not None:
            word = option(owners[0].parameter(name))
            options.parser.error(f"{word}: {options.kind} {why}")


def read(options: argparse.Namespace, reader: Callable[[Any], Value], word: Any) -> Value:
    """What a word means; where it means nothing, the usage and the reason, and the end."""
    parser: argparse.ArgumentParser = options.parser
    try:
        return reader(word)
    except InputError as error:
        parser.error(str(error))


def sizes(options: argparse.Namespace) -> range:
    """The sizes A..B that the words ask for, both known to be sizes of the kind."""
    size = KINDS[options.kind].parameter(SIZE)
    first, dots, last = options.sizes.partition("..")
    low = read(options, size.read, first)
    high = read(options, size.read, last) if dots else low
    if low > high:
        options.parser.error(f"{options.sizes!r} is an empty range: give A..B with A <= B")
    return range(low, high + 1)


def option(parameter: Parameter) -> str:
    """A parameter as an option."""
    return "--" + parameter.name.replace("_", "-")


def exact(text: str) -> Surd:
    """An exact number, as a type of an option."""
    return as_option(lambda: surd(text))


def positive(text: str) -> Surd:
    """A positive exact number, as a type of an option."""
    value = exact(text)
    if value.sign() <= 0:
        raise argparse.ArgumentTypeError(f"{text!r} is not a positive number")
    return value


def add_friction(parser: argparse.ArgumentParser, *, required: bool = True) -> None:
    """The coefficient of friction, and where it holds; `rough_of` has the supports."""
    parser.add_argument(
        "--friction",
        type=exact,
        required=required,
        metavar="MU",
        help='coefficient between discs: exact, such as 3/10 or "1/10*sqrt(3)"',
    )
    parser.add_argument("--rough", action="store_true", help="supports have the same friction")


def rough_of(options: argparse.Namespace, scene: Scene) -> tuple[str, ...]:
    """The supports that have friction."""
    if options.rough and not scene.supports:
        options.parser.error("--rough: this scene has no supports but its own discs")
    return scene.supports if options.rough else ()


def add_contacts(parser: argparse.ArgumentParser, what: str) -> None:
    """Contacts by their printed names; `contacts_of` has them."""
    parser.add_argument(
        "--contact",
        action="append",
        default=[],
        metavar="NAME",
        help=f"{what} this contact, named as in all output, such as '(6,2)-floor'; may be repeated",
    )


def contacts_of(options: argparse.Namespace, scene: Scene) -> list[Contact]:
    """The contacts that were named."""
    return [read(options, partial(named_contact, scene), name) for name in options.contact]


def number(text: str) -> float:
    """A float from an exact number or a decimal, as a type of an option."""
    value = float(exact(text))
    if not isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is beyond the range of floats")
    return value


def add_file(parser: argparse.ArgumentParser, name: str, help: str, ending: str = "") -> None:
    """An option that names a file, one with this ending where the format has one."""

    def named(text: str) -> str:
        if not text:
            raise argparse.ArgumentTypeError("the name is empty, expected one of a file")
        if ending:
            as_option(lambda: check_ending(text, ending))
        return text

    mark_file(parser.add_argument(name, type=named, metavar="FILE", help=help))


def mark_file(action: argparse.Action) -> None:
    """Say that the word is the name of a file, to what completes it in a shell (shtab)."""
    vars(action)["complete"] = {"bash": "_shtab_compgen_files", "zsh": "_files", "tcsh": "f"}


def as_option(action: Callable[[], Value]) -> Value:
    """What an action returns; what it finds wrong is a mistake in the usage."""
    try:
        return action()
    except InputError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def add_digits(parser: argparse.ArgumentParser) -> None:
    """How many digits decimals have."""
    parser.add_argument(
        "--digits",
        type=whole_number(1, 100_000),
        default=6,
        metavar="D",
        help="digits of decimals (default: 6)",
    )


def whole_number(least: int, most: int, what: str = "whole number") -> Callable[[str], int]:
    """A number of things within these bounds, as a type of an option."""

    def read_number(text: str) -> int:
        digits = text.isascii() and text.isdecimal() and len(text) <= len(str(most))
        if not digits or not least <= int(text) <= most:
            raise argparse.ArgumentTypeError(f"{text!r} is not a {what} from {least} to {most}")
        return int(text)

    return read_number


def _owners(kinds: Sequence[Kind]) -> dict[str, list[Kind]]:
    """The kinds that have a parameter, for the name of every parameter."""
    found: dict[str, list[Kind]] = {}
    for kind in kinds:
        for p in kind.parameters:
            found.setdefault(p.name, []).append(kind)
    return found


def joined(words: Sequence[str]) -> list[str]:
    """`--push -1/2` as `--push=-1/2`: argparse takes a word like -1/2 for an option.

    >>> joined(["solve", "nt30", "--push", "-1/2", "--whole"])
    ['solve', 'nt30', '--push=-1/2', '--whole']
    """
    numbers = {option(p) for kind in KINDS.values() for p in kind.parameters if not p.choices}
    numbers |= {"--" + name for name in (*SIDES, *_OTHER_NUMBERS, "contact")}
    done: list[str] = []
    for word in words:
        negative = word.startswith("-") and word[1:2] not in ("-", "")
        if done and done[-1] in numbers and negative:
            done[-1] = f"{done[-1]}={word}"
        else:
            done.append(word)
    return done
