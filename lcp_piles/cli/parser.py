"""The command line: parses and prints, nothing else."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from .. import __version__
from ..errors import InputError, LcpPilesError
from ..numbers.exact import Surd, surd
from ..scenes.piles import BUILDERS
from . import commands

_FLOOR = "in tau; 0 is rigid, default 1; -1/2 is the paper's published floor"
_NUMBERS = ("--push", "--floor-compliance", "--until")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit status: 0 solved, 1 error, 2 usage, 3 unstable."""
    parser = _parser()
    options = parser.parse_args(_join_numbers(sys.argv[1:] if arguments is None else arguments))
    try:
        return int(options.run(options))
    except LcpPilesError as error:
        print(f"lcp-piles: {error}", file=sys.stderr)
        return commands.ERROR
    except BrokenPipeError:
        return commands.ERROR
    except KeyboardInterrupt:
        print("lcp-piles: interrupted", file=sys.stderr)
        return commands.ERROR
    except MemoryError:
        print("lcp-piles: out of memory: try fewer layers", file=sys.stderr)
        return commands.ERROR


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="lcp-piles",
        description="Exact static forces in granular piles of frictionless discs.",
    )
    parser.add_argument("--version", action="version", version=f"lcp-piles {__version__}")
    kinds = parser.add_subparsers(title="commands", required=True, metavar="COMMAND")

    solve = kinds.add_parser(
        "solve",
        help="the force network of one pile",
        description="Solve one pile exactly, check the answer, print what matters. "
        "Exit status: 0 solved, 1 error, 2 usage, 3 the scene cannot stand.",
    )
    _add_scene(solve)
    solve.add_argument("--whole", action="store_true", help="solve the whole pile, not its half")
    solve.add_argument(
        "--method", choices=_methods(), default=_methods()[0], help="default: %(default)s"
    )
    solve.add_argument(
        "--json", metavar="FILE", help="write the result file (- is standard output)"
    )
    solve.add_argument("--plot", metavar="FILE", help="draw the force network (png, pdf, svg)")
    _add_digits(solve)
    solve.set_defaults(run=commands.run_solve)

    prove = kinds.add_parser(
        "prove",
        help="the contact set, proved without exact fractions",
        description="Prove which contacts carry a force, and bound every force rigorously in "
        "floating point: certainty at little more than the price of a floating-point solution. "
        "Exit status: 0 proved, 1 not proved.",
    )
    _add_scene(prove)
    _add_digits(prove)
    prove.set_defaults(run=commands.run_prove)

    compare = kinds.add_parser(
        "compare",
        help="Lemke's method and the paper's Z algorithm, size by size",
        description="Solve piles of one kind exactly by Lemke's method and by the Z algorithm of "
        "the paper, and print where their contact sets differ and what each of them took.",
    )
    compare.add_argument("kind", choices=tuple(BUILDERS), help="which pile")
    compare.add_argument(
        "--layers", type=_range, required=True, metavar="A..B", help="sizes, or one size"
    )
    _add_parameters(compare)
    compare.set_defaults(run=commands.run_compare)

    push = kinds.add_parser(
        "push",
        help="every rearrangement as the corner stones are pushed",
        description="Push both corner stones towards the axis, from no push on, and print every "
        "push at which the contact network changes, exactly.",
    )
    push.add_argument("kind", choices=("nt30", "nt60", "tss"), help="which pile")
    push.add_argument("--layers", type=_layers, required=True, metavar="N", help="rows of discs")
    push.add_argument("--floor-compliance", type=_exact, metavar="C", help=_FLOOR)
    push.add_argument(
        "--until", type=_exact, metavar="X", help="stop at this push; a negative one pulls"
    )
    push.add_argument("--json", metavar="FILE", help="write the path (- is standard output)")
    push.add_argument(
        "--plot", metavar="FILE", help="draw the pressure under the apex against the push"
    )
    _add_digits(push)
    push.set_defaults(run=commands.run_push)

    reproduce = kinds.add_parser(
        "reproduce",
        help="every computed figure and table of the paper",
        description="Draw every computed figure of Oron and Herrmann, each with its numbers.",
    )
    reproduce.add_argument("--out", default="paper", metavar="DIR", help="default: %(default)s")
    reproduce.add_argument(
        "--only", action="append", metavar="NAME", help="one figure; may be repeated"
    )
    reproduce.set_defaults(run=commands.run_reproduce)
    return parser


def _add_scene(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("kind", choices=tuple(BUILDERS), help="which pile")
    parser.add_argument("--layers", type=_layers, required=True, metavar="N", help="rows of discs")
    _add_parameters(parser)


def _add_parameters(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--push",
        type=_exact,
        metavar="X",
        help='both corner stones towards the axis, in w tau: exact, such as 20 or "7/3*sqrt(3)"; '
        "negative pulls",
    )
    parser.add_argument("--floor-compliance", type=_exact, metavar="C", help=_FLOOR)
    parser.add_argument(
        "--corner-stones",
        choices=("held", "resting"),
        help="held at their lattice points (default), or resting on the floor",
    )


def _add_digits(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--digits", type=_digits, default=6, metavar="D", help="digits of decimals (default: 6)"
    )


def _methods() -> tuple[str, ...]:
    from ..methods.registry import METHODS

    return tuple(METHODS)


def _exact(text: str) -> Surd:
    try:
        return surd(text)
    except InputError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def _range(text: str) -> range:
    first, dots, last = text.partition("..")
    sizes = range(_layers(first), _layers(last) + 1 if dots else _layers(first) + 1)
    if not sizes:
        raise argparse.ArgumentTypeError(f"{text!r} is an empty range: give A..B with A <= B")
    return sizes


def _layers(text: str) -> int:
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of at least 1")
    return value


def _digits(text: str) -> int:
    value = int(text) if text.isdecimal() and len(text) < 8 else 0
    if not 1 <= value <= 100_000:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 to 100000")
    return value


def _join_numbers(arguments: Sequence[str]) -> list[str]:
    """`--push -1/2` as `--push=-1/2`: argparse takes a word like -1/2 for an option."""
    joined: list[str] = []
    for word in arguments:
        if (
            joined
            and joined[-1] in _NUMBERS
            and word.startswith("-")
            and word[1:2] not in ("-", "")
        ):
            joined[-1] = f"{joined[-1]}={word}"
        else:
            joined.append(word)
    return joined
