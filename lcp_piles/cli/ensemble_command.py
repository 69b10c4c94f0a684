"""`lcp-piles ensemble`: thousands of disordered piles, proved, and their statistics."""

from __future__ import annotations

import argparse
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from ..disorder.distributions import DISTRIBUTIONS
from ..ensembles.ensemble import Ensemble, ensemble, read_ensemble
from ..ensembles.pool import own_pool
from ..ensembles.report import report_json, rows
from ..files.safe_write import make_folder
from .options import add_file, add_scene, exact, read, refuse_parameters, whole_number
from .output import Narrator, draw, opening, write
from .report import aligned, describe
from .status import ERROR, SOLVED

EXAMPLE = "ensemble nt30 --layers 6 --amplitude 10 --samples 1000 --out samples --plot ."
"""What `--help` shows."""
_COUNT = whole_number(1, 10**12)


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "ensemble",
        help="random initial gaps: thousands of proved samples in a folder, and statistics",
        description="Draw random exact initial gaps, prove the forces of every sample, keep them "
        "in a folder and print statistics with 95 per cent confidence bands. A run that was "
        "stopped goes on where it ended. `ensemble FOLDER --report` reads a folder. Exit status: "
        "0 done, 1 error (also where samples failed), 2 usage.",
    )
    add_scene(parser)
    parser.add_argument(
        "--amplitude", type=exact, metavar="A", help="size of the gaps in w tau: exact, such as 10"
    )
    parser.add_argument("--samples", type=_COUNT, metavar="COUNT", help="how many samples")
    parser.add_argument(
        "--distribution",
        choices=list(DISTRIBUTIONS),
        default="uniform",
        help="uniform in [-A, A]; normal of deviation A, cut off at 3 A; or radii: discs of "
        "r + dr, dr uniform in [-A, A], gaps -(dr_a + dr_b) (default: uniform)",
    )
    parser.add_argument(
        "--seed",
        type=whole_number(0, 10**39),
        default=0,
        metavar="SEED",
        help="of the random numbers (default: 0)",
    )
    parser.add_argument("--out", metavar="FOLDER", help="keep the samples here")
    parser.add_argument(
        "--workers", type=_COUNT, metavar="COUNT", help="processes (default: one a processor)"
    )
    parser.add_argument(
        "--report", action="store_true", help="the scene is the folder of an ensemble: read it"
    )
    add_file(parser, "--json", "write the statistics (- is standard output)", ".json")
    parser.add_argument("--parquet", metavar="FILE", help="write the samples as a Parquet table")
    parser.add_argument("--plot", metavar="FOLDER", help="draw the statistics (PNG files)")
    return parser


def run(options: argparse.Namespace) -> int:
    """Make the samples, or read them; print the statistics, write what was asked for."""
    if options.report:
        found, narrate = _reported(options)
    else:
        found, narrate = _made(options)
    scene = found.manifest.scene
    content = report_json(found) if options.json else ""
    text = aligned([("scene", describe(scene)), *rows(found)])
    write(narrate, text, content, options.json)
    if options.parquet:
        from ..ensembles.parquet import write_parquet

        write_parquet(found, options.parquet)
        narrate(f"wrote {options.parquet}")
    if options.plot:
        _draw(options.plot, found, narrate)
    return ERROR if found.failed else SOLVED


def _reported(options: argparse.Namespace) -> tuple[Ensemble, Narrator]:
    for name in ("amplitude", "samples", "out", "workers"):
        if getattr(options, name) is not None:
            options.parser.error(f"--{name}: a report only reads what is there")
    refuse_parameters(options, "is a folder, which says it all")
    return read_ensemble(options.kind), Narrator(options.quiet)


def _made(options: argparse.Namespace) -> tuple[Ensemble, Narrator]:
    for name in ("amplitude", "samples"):
        if getattr(options, name) is None:
            options.parser.error(f"--{name} is needed, but with --report")
    if options.parquet and not options.out:
        options.parser.error("--parquet: give --out too, the folder that the samples are kept in")
    if Path(options.kind).is_dir():
        options.parser.error(f"{options.kind} is a folder: --report reads one")
    disorder = read(options, DISTRIBUTIONS[options.distribution], options.amplitude)
    scene, narrate = opening(options)
    pool = own_pool(options.workers) if options.workers else nullcontext()
    with pool as executor:
        found = ensemble(
            scene,
            disorder,
            options.samples,
            seed=options.seed,
            executor=executor,
            out=options.out,
            progress=not options.quiet,
        )
    return found, narrate


def _draw(place: str, found: Ensemble, narrate: Narrator) -> None:
    from ..pictures.ensemble_pictures import pictures_of

    folder = make_folder(place)
    for name, picture in pictures_of(found):
        draw(narrate, picture, str(folder / f"{name}.png"))
