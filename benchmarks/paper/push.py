"""Tables on the pushed and pulled corner stones, on stability and on the paper's floor."""

from __future__ import annotations

from collections import Counter

import numpy as np

from benchmarks.paper.tables import FLOORS, digits, show, table
from lcp_piles import (
    Solution,
    Surd,
    base_pressure,
    contact_system,
    continuum,
    depressions,
    pile,
    push_path,
    solve,
    stress,
)
from lcp_piles.linear.kernel import kernel
from lcp_piles.linear.rearrangement import rows_of
from lcp_piles.numbers.exact import ZERO
from lcp_piles.paper.figures_push import under_apex

SMOOTH = ("nt30", "nt60", "tss")


@table
def rearrangements() -> None:
    """Number of rearrangements and the last push (w tau over sqrt 3), and the last apex force."""
    header = ["N"]
    header += [f"{kind.upper()}, c = {c}" for kind in ("nt30",) for c in FLOORS]
    header += ["NT30 last, c = 1", "NT30 last apex force", "NT60, c = 1", "TSS, c = 1"]

    def row(N: int) -> list[object]:
        paths = [push_path("nt30", N, floor_compliance=c) for c in FLOORS]
        assert all(path.end == "asymptotic" for path in paths)
        last = paths[0].rearrangements[-1].push / paths[0].unit
        apex = {under_apex(path)[1][-1] for path in paths}
        others = [push_path(kind, N) for kind in ("nt60", "tss")]
        return [
            N,
            *(len(path.rearrangements) for path in paths),
            last,
            ", ".join(map(str, apex)),
            *(len(path.rearrangements) for path in others),
        ]

    show(header, (row(N) for N in range(2, 15)))


@table
def asymptotic() -> None:
    """The last network of NT30, and its base profile from the axis out, the same on all floors."""
    header = ["N", "horizontals closed", "others closed", "others open", "forces that grow", "base"]

    def row(N: int) -> list[object]:
        paths = [push_path("nt30", N, floor_compliance=c) for c in FLOORS]
        ends = [path.solution(path.rearrangements[-1].push * 2) for path in paths]
        last = ends[0]
        closed, opened = count(last, "closed"), count(last, "open")
        piece = paths[0].asymptotic
        growing = [c for k, c in enumerate(last.scene.contacts) if piece.linear_force(k)[1]]
        assert all(c.a[0] == N and not isinstance(c.b, str) and c.b[0] == N for c in growing)
        profiles = [[p.normal for p in base_pressure(end)] for end in ends]
        assert profiles[0] == profiles[1] == profiles[2]
        half = profiles[0][len(profiles[0]) // 2 :]
        return [
            N,
            f"{closed[True]} of {closed[True] + opened[True]}",
            closed[False],
            opened[False],
            f"{len(growing)}, all in row N",
            " ".join(map(str, half)),
        ]

    def count(solution: Solution, state: str) -> Counter[bool]:
        """Contacts between discs in a state, by whether they are horizontal."""
        return Counter(
            c.a[0] == c.b[0]
            for c, found in zip(solution.scene.contacts, solution.states, strict=True)
            if found == state and not isinstance(c.b, str)
        )

    show(header, (row(N) for N in (3, 4, 5, 6, 7, 8, 9, 10)))


@table
def push_profile() -> None:
    """NT30 with 6 layers on the paper's floor along Table 1: minima of the profile and the axes."""
    header = ["k", "-q", "apex", "minima at x (depth)", "inner axis", "deviation", "surface axis"]
    path = push_path("nt30", 6, floor_compliance="-1/2")
    pushes: dict[object, Surd] = {0: ZERO}
    pushes |= {k: r.push for k, r in enumerate(path.rearrangements, 1)}
    pushes["2 q_23"] = 2 * path.rearrangements[-1].push

    def row(k: object, push: Surd) -> list[object]:
        solution = path.solution(push)
        profile = base_pressure(solution)
        minima = [
            f"{d.left if d.left >= 0 else -d.left} ({digits(d.depth, 3)})"
            for d in depressions(profile)
            if d.right > 0
        ]
        axes = continuum(stress(solution))
        return [
            k,
            digits(push),
            digits(profile[len(profile) // 2].normal),
            ", ".join(minima) or "none",
            f"{axes.inner_axis.mean:.1f}",
            f"{axes.inner_axis.deviation:.1f}",
            f"{axes.surface_axis.mean:.1f} +- {axes.surface_axis.deviation:.1f}",
        ]

    show(header, (row(k, push) for k, push in pushes.items()))


@table
def pulling() -> None:
    """Rearrangements when the stones are pulled, sizes N = 2..12; and whether any force changes."""
    header = ["pile", "c", "N with rearrangements: pushes over sqrt 3", "N with changing forces"]

    def row(kind: str, c: str) -> list[object]:
        changes, moving = [], []
        for N in range(2, 13):
            path = push_path(kind, N, floor_compliance=c, pull=True)
            pieces = path.path.segments
            if path.rearrangements:
                values = ", ".join(str(r.push / -path.unit) for r in path.rearrangements)
                changes.append(f"{N}: {values}")
            contacts = range(len(path.scene.contacts))
            if any(piece.linear_force(k)[1] for piece in pieces for k in contacts):
                moving.append(str(N))
            assert not any(pieces[-1].linear_force(k)[1] for k in contacts)
        return [kind.upper(), c, "; ".join(changes) or "none", " ".join(moving) or "none"]

    show(header, (row(kind, c) for kind in SMOOTH for c in FLOORS))


@table
def mechanisms() -> None:
    """Mechanisms of the whole pile, symmetric + antisymmetric, and the verdict; c = 1."""
    header = ["N", "TBS", "TSS", "NT60", "NT30", "NT30 pulled by 10"]

    def entry(solution: Solution) -> str:
        stability = solution.stability
        even = contact_system(solution.scene)
        closed = np.array(solution.states)[even.reduction.representative] == "closed"
        symmetric = len(kernel(rows_of(even.B, closed))[0])
        held = f", {stability.mechanisms - stability.free} held" * (
            stability.mechanisms != stability.free
        )
        return f"{symmetric} + {stability.mechanisms - symmetric}{held} {stability.verdict}"

    def row(N: int) -> list[object]:
        scenes = [pile(kind, N) for kind in ("tbs", "tss", "nt60", "nt30")]
        scenes.append(pile("nt30", N, push=-10))
        return [N, *(entry(solve(scene)) for scene in scenes)]

    show(header, (row(N) for N in (*range(2, 17), 20, 25, 30)))


@table
def paper_floor_definite() -> None:
    """Least eigenvalue (float64) of the symmetric M of the whole pile, floor contacts bilateral."""
    header = ["c", "NT30 N = 3", "NT30 N = 6", "NT30 N = 8", "NT60 N = 9", "TSS N = 10"]
    cases = (("nt30", 3), ("nt30", 6), ("nt30", 8), ("nt60", 9), ("tss", 10))

    def least(kind: str, N: int, c: str) -> str:
        system = contact_system(pile(kind, N, floor_compliance=c), "whole")
        B, C, _, _ = system.floats()
        B = B.toarray()
        inverse = np.diag(1 / C)
        M = inverse - inverse @ B @ np.linalg.solve(B.T @ inverse @ B, B.T @ inverse)
        kept = ~system.bilateral
        # In units in which disc-disc contacts have compliance 1.
        scale = np.sqrt(C[kept])
        return f"{np.linalg.eigvalsh(scale[:, None] * M[np.ix_(kept, kept)] * scale)[0]:.1e}"

    show(header, ([c, *(least(k, N, c) for k, N in cases)] for c in ("-1/2", "-13/20", "-1", "-2")))
