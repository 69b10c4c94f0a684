"""The command line: parses and prints, nothing else."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from time import perf_counter

from . import __version__
from .errors import InputError, LcpPilesError
from .exact import Surd, surd
from .piles import BUILDERS, pile
from .scene import Scene

SOLVED, ERROR, USAGE, UNSTABLE = 0, 1, 2, 3
_NUMBERS = ("--push", "--floor-compliance", "--until")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit status: 0 solved, 1 error, 2 usage, 3 unstable."""
    parser = _parser()
    options = parser.parse_args(_join_numbers(sys.argv[1:] if arguments is None else arguments))
    try:
        return int(options.run(options))
    except LcpPilesError as error:
        print(f"lcp-piles: {error}", file=sys.stderr)
        return ERROR
    except BrokenPipeError:
        return ERROR
    except KeyboardInterrupt:
        print("lcp-piles: interrupted", file=sys.stderr)
        return ERROR
    except MemoryError:
        print("lcp-piles: out of memory: try fewer layers", file=sys.stderr)
        return ERROR


def _solve(options: argparse.Namespace) -> int:
    from .crosscheck import cross_check
    from .report import describe, summary
    from .solve import solve

    scene = _scene(options)
    narrate = Narrator()
    narrate(describe(scene))
    solution = solve(scene, options.method, whole=options.whole, progress=narrate)
    narrate(f"{solution.status} in {solution.record.seconds:.3g} s")
    check = None
    if solution.status == "solved" and solution.exact and scene.definite:
        try:
            check = cross_check(solution)
        except LcpPilesError as error:
            narrate(f"no floating-point check: {error}")
    if options.json == "-":
        from .write_result import dumps

        sys.stdout.write(dumps(solution))
    elif options.json:
        solution.save(options.json)
        narrate(f"wrote {options.json}")
    text = summary(solution, digits=options.digits, check=check)
    print(text, file=sys.stderr if options.json == "-" else sys.stdout)
    if options.plot:
        from . import plotting

        plotting.save(plotting.draw_network(solution), options.plot)
        narrate(f"drew {options.plot}")
    return {"solved": SOLVED, "unstable": UNSTABLE}.get(solution.status, ERROR)


class Narrator:
    """Lines on standard error, with the time since the start on work that takes a while."""

    def __init__(self) -> None:
        self._start = perf_counter()

    def __call__(self, text: str) -> None:
        """Say one line."""
        passed = perf_counter() - self._start
        stamp = f"[{passed:6.1f} s] " if passed > 2 else ""
        print(stamp + text, file=sys.stderr, flush=True)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="lcp-piles",
        description="Exact static forces in granular piles of frictionless discs.",
    )
    parser.add_argument("--version", action="version", version=f"lcp-piles {__version__}")
    commands = parser.add_subparsers(title="commands", required=True, metavar="COMMAND")

    solve = commands.add_parser(
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
    solve.add_argument(
        "--digits", type=_digits, default=6, metavar="D", help="decimals shown (default: 6)"
    )
    solve.set_defaults(run=_solve)
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
    parser.add_argument(
        "--floor-compliance",
        type=_exact,
        metavar="C",
        help="in tau; 0 is rigid, default 1; -1/2 is the paper's published floor",
    )
    parser.add_argument(
        "--corner-stones",
        choices=("held", "resting"),
        help="held at their lattice points (default), or resting on the floor",
    )


def _scene(options: argparse.Namespace) -> Scene:
    return pile(options.kind, options.layers, **_parameters(options))


def _parameters(options: argparse.Namespace) -> dict[str, Surd | str]:
    """The scene's parameters that were given; the rest keep the builder's defaults."""
    names = ("push", "floor_compliance", "corner_stones")
    given = {name: getattr(options, name, None) for name in names}
    return {name: value for name, value in given.items() if value is not None}


def _methods() -> tuple[str, ...]:
    from .solve import METHODS

    return METHODS


def _exact(text: str) -> Surd:
    try:
        return surd(text)
    except InputError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


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
