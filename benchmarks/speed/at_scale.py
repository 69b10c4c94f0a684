"""Exact at scale: the proved default, the proof without digits and the push against their bounds.

    python -m benchmarks.speed.at_scale [--quick]

Every case in a process of its own, imports apart; the fitted exponent of the exact time in the
degrees of freedom comes last. The quick set leaves out what takes more than ten seconds.
"""

from __future__ import annotations

import sys
from math import log

from benchmarks.speed.measure import Measurement, machine, measured

SOLVED = [
    ("tbs", 22, 0.05, None),
    ("tbs", 60, 0.4, None),
    ("tbs", 100, 1.2, 400),
    ("tbs", 200, 18, 1500),
    ("tbs", 300, 90, 5000),
    ("tss", 60, 10, None),
    ("nt30", 40, 2, None),
    ("nt30", 80, 10, None),
    ("nt60", 80, 2, None),
    ("nt60", 100, 10, None),
]
PROVED = [("tbs", 60), ("tbs", 100), ("tbs", 200), ("nt30", 20), ("nt30", 40)]
PUSHED = [("nt30", 6, 0.15), ("nt30", 20, 15), ("nt30", 40, 180)]
LONG = 10


def main(quick: bool) -> None:
    """Print the tables."""
    print(f"Exact at scale ({machine()})\n")
    print("| exact, proved, states and stability | median s | wanted | peak MB | wanted | note |")
    print("|---|---|---|---|---|---|")
    exact: dict[int, Measurement] = {}
    for kind, layers, seconds, megabytes in SOLVED:
        if quick and seconds > LONG:
            continue
        m = measured("whole_solution", _repeats(seconds), kind=kind, layers=layers)
        if kind == "tbs" and layers >= 60:
            exact[layers] = m
        note = f"{m.said['mechanisms']} mechanisms, {m.said['pivots']} pivots of repair"
        limits = f"{m.median:.3f} | {seconds} | {m.megabytes:.0f} | {megabytes or ''}"
        print(f"| {kind.upper()} {layers} | {limits} | {note} |", flush=True)

    print("\n| proof without digits | median s | float solve | ratio | exact / float |")
    print("|---|---|---|---|---|")
    for kind, layers in PROVED:
        if quick and layers > 100:
            continue
        proof = measured("contact_proof", 5, kind=kind, layers=layers)
        newton = measured("newton_solve", 5, kind=kind, layers=layers)
        ratio = proof.median / newton.median
        whole = f"{exact[layers].median / newton.median:.2f}" if layers in exact else ""
        row = f"{proof.median:.3f} | {newton.median:.3f} | {ratio:.2f} | {whole}"
        print(f"| {kind.upper()} {layers} | {row} |", flush=True)

    print("\n| push, all breakpoints | s | wanted | breakpoints | peak MB |")
    print("|---|---|---|---|---|")
    for kind, layers, seconds in PUSHED:
        if quick and seconds > LONG:
            continue
        m = measured("all_breakpoints", 5 if seconds < 1 else 1, kind=kind, layers=layers)
        row = f"{m.median:.3f} | {seconds} | {m.said['breakpoints']} | {m.megabytes:.0f}"
        print(f"| {kind.upper()} {layers} | {row} |", flush=True)

    sizes = sorted(exact)
    if len(sizes) > 1:
        first, last = exact[sizes[0]], exact[sizes[-1]]
        exponent = log(last.median / first.median) / log(last.said["dof"] / first.said["dof"])
        print(f"\nTBS {sizes[0]} to {sizes[-1]}: exact time grows as n^{exponent:.2f}")


def _repeats(seconds: float) -> int:
    return 5 if seconds < 3 else 3 if seconds < 15 else 1


if __name__ == "__main__":
    main("--quick" in sys.argv[1:])
