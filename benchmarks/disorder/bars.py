"""How fast samples of disorder are, beside PIQP, which proves nothing, on the same samples.

    python -m benchmarks.disorder.bars [--samples COUNT] [--ensemble]

prints processor time a sample, in turns so that both see the same machine; PIQP needs the extra
`peers`. With `--ensemble` 10,000 samples are made by two processes first.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from statistics import mean, median
from time import perf_counter, process_time
from typing import Any

import numpy as np
from scipy.sparse import csc_matrix, diags

from benchmarks.speed.measure import machine
from lcp_piles import PileFamily, Sample, Uniform, ensemble, pile, pile_family, proved_sample
from lcp_piles.disorder.gap_grid import drawn_steps, step_floats
from lcp_piles.ensembles.pool import own_pool
from lcp_piles.linear.threads import one_thread
from lcp_piles.numbers.vectors import FloatArray

CASES = (("nt30", 10), ("nt60", 16), ("tss", 13), ("tbs", 20), ("nt30", 20))
AMPLITUDES = ("1", "10", "100", "1000")
_LOADED = 1e-6  # of the largest force: what is called closed of PIQP's


def peer(family: PileFamily) -> Callable[[FloatArray], FloatArray] | None:
    """PIQP through qpsolvers: forces from initial gaps; None where it is not installed."""
    try:
        import qpsolvers
    except ImportError:
        return None
    springs = family.springs
    if springs is None or "piqp" not in qpsolvers.available_solvers:
        return None
    P = csc_matrix(diags(springs.C))
    A = csc_matrix(springs.energy.matrix.transposed)
    b, lower = -springs.energy.p, np.zeros(len(springs.C))

    def solve(o: FloatArray) -> FloatArray:
        problem = qpsolvers.Problem(P, o, A=A, b=b, lb=lower)
        found = qpsolvers.solve_problem(problem, solver="piqp")
        forces: FloatArray = found.x
        return forces

    return solve


def timed(action: Callable[..., Any], *given: Any) -> tuple[float, Any]:
    """Processor milliseconds, and what came out."""
    start = process_time()
    found = action(*given)
    return 1e3 * (process_time() - start), found


@one_thread()
def row(kind: str, layers: int, amplitude: str, samples: int) -> str:
    """A row of the table."""
    family, disorder = pile_family(pile(kind, layers=layers)), Uniform(amplitude)
    other = peer(family)
    ours, theirs, exact, same = [], [], 0, 0
    for k in range(samples):
        ms, sample = timed(proved_sample, family, disorder, 0, k)
        ours.append(ms)
        exact += sample.road == "exact"
        if other is not None and family.springs is not None:
            steps = drawn_steps(family.scene, family.grid, disorder, 0, k)
            o = family.springs.gap + step_floats(family.grid, steps, disorder.amplitude)
            ms, forces = timed(other, o)
            theirs.append(ms)
            same += _same(sample, forces)
    told = f"{median(ours):.2f} | {mean(ours):.2f} | {exact}"
    if theirs:
        ratio = median(ours) / median(theirs)
        told += f" | {median(theirs):.2f} | {mean(theirs):.2f} | {ratio:.2f} | {samples - same}"
    return f"| {kind.upper()} {layers} | {amplitude} | {told} |"


def _same(sample: Sample, forces: FloatArray | None) -> bool:
    if forces is None:
        return False
    return bool(((forces > _LOADED * forces.max()) == sample.closed).all())


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=200)
    parser.add_argument("--ensemble", action="store_true")
    options = parser.parse_args()
    print(f"Samples of disorder ({machine()}); milliseconds of processor time\n")
    if options.ensemble:
        for amplitude in ("1", "100"):
            start = perf_counter()
            with own_pool(2) as pool:
                ensemble(pile("nt30", layers=10), Uniform(amplitude), 10_000, executor=pool)
            print(
                f"10,000 samples of NT30 10 at amplitude {amplitude}, two processes, with "
                f"statistics: {perf_counter() - start:.1f} s\n",
                flush=True,
            )
    print("| pile | amplitude | ours | mean | exact road | PIQP | mean | ratio | other sets |")
    print("|---|---|---|---|---|---|---|---|---|")
    for kind, layers in CASES:
        for amplitude in AMPLITUDES:
            print(row(kind, layers, amplitude, options.samples), flush=True)


if __name__ == "__main__":
    main()
