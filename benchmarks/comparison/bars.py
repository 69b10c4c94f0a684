"""The bars that were set before, each with the ratio that the rows give."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from benchmarks.comparison.scenes import layers
from benchmarks.comparison.table import Clock, Point, best, fastest, of


@dataclass(frozen=True)
class Bar:
    """One bar on one scene: the measured ratio, what is asked, and whether it is met."""

    what: str
    scene: str
    against: str
    ratio: float
    asked: str
    met: bool


def bars(found: list[Point], clock: Clock) -> list[Bar]:
    """All bars that the rows can judge."""
    made: list[Bar] = []

    def at_most(
        what: str, method: str, scenes: list[str], most: float, groups: tuple[str, ...]
    ) -> None:
        for scene in scenes:
            peer = best(found, scene, 1e-9, groups, clock)
            _add(made, what, scene, fastest(of(found, scene, method), 1e-9, clock), peer, clock,
                 f"at most {most:g}", lambda r: r <= most)  # fmt: skip

    peers = ("peer",)
    proofs = ["tbs 60", "tbs 100", "tbs 200", "nt30 20", "nt30 40"]
    at_most("proof without digits over the fastest peer at 1e-9", "contacts", proofs, 3, peers)
    at_most("every digit over the fastest peer at 1e-9", "proved", ["tbs 60", "tbs 100"], 8, peers)
    at_most(
        "every digit of forces and gaps, unchecked, over the fastest peer at 1e-9",
        "float start",
        ["tbs 60", "tbs 100"],
        8,
        peers,
    )
    large = sorted({p.scene for p in found if p.part_contacts >= 2500})
    at_most("Newton over the fastest peer at 1e-9", "newton", large, 1, (*peers, "md"))
    for scene in sorted({p.scene for p in found if p.dof >= 1000}):
        dense = fastest(of(found, scene, "FLINT dense"), 0, clock)
        for method, what in (("proved", ""), ("float start", " of forces and gaps, unchecked")):
            exact = fastest(of(found, scene, method), 0, clock)
            _add(made, f"dense FLINT (unchecked) over every digit{what}", scene, dense, exact,
                 clock, "at least 30", lambda r: r >= 30)  # fmt: skip
    piles = {p.scene for p in found if p.scene.startswith("nt30") and layers(p.scene) >= 6}
    for scene in sorted(piles):
        exact = fastest(of(found, scene, "proved"), 0, clock)
        dynamics = fastest(of(found, scene, "lammps, tau to 0"), 1e-6, clock)
        _add(made, "LAMMPS at 1e-6 over every digit", scene, dynamics, exact, clock, "above 1",
             lambda r: r > 1)  # fmt: skip
    small = sorted({p.scene for p in found if 40 <= p.part_contacts <= 130})
    for other in ("Fractions", "gmpy2"):
        for scene in small:
            table = fastest(of(found, scene, other), 0, clock)
            for method, what in (("lemke", "verified"), ("lemke alone", "unchecked as well")):
                cold = fastest(of(found, scene, method), 0, clock)
                _add(made, f"tableau of {other} over cold Lemke, {what}", scene, table, cold, clock,
                     "at least 10 at 100 contacts", lambda r: r >= 10)  # fmt: skip
    return made


def _add(
    made: list[Bar],
    what: str,
    scene: str,
    top: Point | None,
    bottom: Point | None,
    clock: Clock,
    asked: str,
    met: Callable[[float], bool],
) -> None:
    if top is None or bottom is None:
        return
    ratio = getattr(top, clock) / max(getattr(bottom, clock), 1e-6)
    names = ", ".join(f"{p.method} {getattr(p, clock):.3g} s" for p in (top, bottom))
    made.append(Bar(what, scene, names, ratio, asked, met(ratio)))
