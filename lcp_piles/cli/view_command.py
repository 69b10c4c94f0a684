"""`lcp-piles view`: a force network to look into, as one file for a browser."""

from __future__ import annotations

import argparse
from typing import Any

from ..friction.force_bounds import InadmissibleError
from ..interactive.view import view
from ..push.push_path import push_path
from ..scenes.kinds import KINDS
from ..solve import solve
from .friction_bounds import bounds_with_bar
from .options import add_file, add_friction, add_scene, parameters, rough_of
from .output import keep, opening, steps
from .report import summary
from .status import ERROR, SOLVED, UNSTABLE

EXAMPLE = "view nt30 --layers 6 --push-path --out nt30.html"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "view",
        help="a force network to look into, as one file for a browser",
        description="Solve one scene exactly and write a page that shows the exact force, gap and "
        "state of every contact, and the displacement of every disc, by mouse, keys or touch. It "
        "is one file and needs no network. Exit status: 0 solved, 1 error, 2 usage, 3 the scene "
        "cannot stand.",
    )
    add_scene(parser)
    parser.add_argument(
        "--push-path",
        action="store_true",
        help="with a slider over the push of the corner stones, from the given push on",
    )
    add_friction(parser, required=False)
    add_file(parser, "--out", "the page to write (default: view.html)", ".html")
    parser.set_defaults(out="view.html")
    return parser


def run(options: argparse.Namespace) -> int:
    """Solve, follow the path and find the bounds if asked, write the page."""
    kind = KINDS.get(options.kind)
    if options.push_path and (kind is None or kind.push is None):
        able = ", ".join(kind.name for kind in KINDS.values() if kind.push)
        options.parser.error(f"--push-path: only {able} have corner stones that can be pushed")
    if options.rough and options.friction is None:
        options.parser.error("--rough says where --friction holds: give that too")
    scene, narrate = opening(options)
    solution = solve(scene, progress=narrate)
    if solution.status != "solved":
        print(summary(solution))
        return UNSTABLE if solution.status == "unstable" else ERROR
    path = bounds = None
    if options.push_path and kind is not None and kind.push is not None:
        given = parameters(options)
        start = given.pop(kind.push.parameter, 0)
        with narrate.bar("piece") as bar:
            path = push_path(kind.name, **given, start=start, progress=steps(bar))
        narrate(f"{len(path.rearrangements)} rearrangements")
    if options.friction is not None:
        try:
            bounds = bounds_with_bar(narrate, scene, options.friction, rough_of(options, scene))
        except InadmissibleError as error:
            print(f"no network: {error}")
            return UNSTABLE
    with narrate.bar("piece of the page") as bar:
        page = view(solution, push=path, bounds=bounds, progress=steps(bar))
    keep(narrate, page.html, options.out)
    return SOLVED
