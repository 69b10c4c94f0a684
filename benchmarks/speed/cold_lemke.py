"""Cold exact Lemke, no floating point to help: seconds from scene to verified solution.

    python -m benchmarks.speed.cold_lemke

prints a table with the paper's own time, where it gives one, and the bound that is wanted.
"""

from __future__ import annotations

from benchmarks.speed.measure import machine, measured

CASES = [
    ("nt30", 6, 0.15, ""),
    ("tss", 13, 1.5, ""),
    ("nt60", 20, 1.5, ""),
    ("nt30", 10, 1.5, ""),
    ("tbs", 22, 0.4, "more than 3 days"),
    ("tbs", 40, 8.0, ""),
]


def main() -> None:
    """Print the table."""
    print(f"Cold exact Lemke, whole verified solution ({machine()})\n")
    print("| pile | median s | least - most | wanted below | pivots | peak MB | the paper |")
    print("|---|---|---|---|---|---|---|")
    for kind, layers, wanted, paper in CASES:
        m = measured("whole_solution", 5, kind=kind, layers=layers, method="lemke")
        print(
            f"| {kind.upper()} {layers} | {m.median:.3f} | {m.least:.3f} - {m.most:.3f} | {wanted} "
            f"| {m.said['pivots']} | {m.megabytes:.0f} | {paper} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
