"""Packings in floats against their bounds: the proof of each as it is, and exact ones near it.

    python -m benchmarks.speed.packings

Discs of unlike radii near the points of a lattice, in a box; every case in a process of its own.
The proof is timed from centres and radii, the search for contacts included.
"""

from __future__ import annotations

from benchmarks.speed.measure import machine, measured

PROVED = [(10, 10, None), (20, 25, 0.1), (40, 50, 0.5), (70, 70, None)]
NEAR = [(10, 10, 1e-6, None), (10, 10, 1e-9, 1.0), (10, 10, 1e-12, None)]


def main() -> None:
    """Print the tables."""
    print(f"Packings ({machine()})\n")
    print("| proof | contacts | loaded | median s | CPU s | wanted | radius / largest | unproved |")
    print("|---|---|---|---|---|---|---|---|")
    for columns, rows, wanted in PROVED:
        m = measured("packing_proof", 5, columns=columns, rows=rows)
        said = m.said
        found = f"{said['radius']:.1e} | {said['unproved']} |"
        print(f"| {said['discs']} discs | {said['contacts']} | {said['loaded']} |", end=" ")
        print(f"{m.median:.3f} | {m.cpu:.3f} | {wanted or ''} | {found}", flush=True)
    print("\n| exact, near by | median s | CPU s | wanted | bits of a force | change | differing |")
    print("|---|---|---|---|---|---|---|")
    for columns, rows, angle, wanted in NEAR:
        m = measured("near_packing", 3, columns=columns, rows=rows, angle=angle)
        said = m.said
        found = f"{said['bits']} | {said['change']:.1e} | {said['differing']} |"
        print(f"| {said['discs']} discs, {angle:g} | {m.median:.3f} | {m.cpu:.3f} |", end=" ")
        print(f"{wanted or ''} | {found}", flush=True)


if __name__ == "__main__":
    main()
