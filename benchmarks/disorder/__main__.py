"""What random initial gaps do to the four piles: ensembles over all amplitudes, and figures.

python -m benchmarks.disorder [--samples COUNT] [--figures]
"""

from __future__ import annotations

import argparse
from pathlib import Path

from benchmarks.disorder.figures import draw_all
from benchmarks.disorder.study import SAMPLES, run

FIGURES = Path(__file__).parents[2] / "notes" / "figures"


def main() -> None:
    """Make the ensembles that are missing, and draw the figures of the notes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=SAMPLES)
    parser.add_argument("--figures", action="store_true", help="only draw")
    options = parser.parse_args()
    if not options.figures:
        run(options.samples)
    draw_all(FIGURES)


if __name__ == "__main__":
    main()
