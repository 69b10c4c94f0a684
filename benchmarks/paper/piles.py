"""Tables on the piles as they stand: networks, the Z algorithm, and how results depend on N."""

from __future__ import annotations

from dataclasses import replace

from benchmarks.paper.tables import FLOORS, digits, horizontal, show, table
from lcp_piles import (
    Scene,
    Solution,
    base_pressure,
    depressions,
    dip,
    letter_force,
    nt60,
    pile,
    solve,
    tbs,
    tss,
    z_algorithm,
)
from lcp_piles.numbers.exact import ZERO
from lcp_piles.paper.figures_networks import as_z_leaves


@table
def nt60_horizontals() -> None:
    """Horizontal contacts above the base row that are closed (+ osculatory), NT60."""
    header = ["N", *(f"c = {c}" for c in FLOORS), "c = 1, stones resting", "base row fixed"]

    def count(scene: Scene, layers: int) -> str:
        closed, osculatory = horizontal(solve(scene), layers)
        return f"{closed} + {osculatory}" if osculatory else str(closed)

    def row(N: int) -> list[object]:
        scenes = [nt60(N, floor_compliance=c) for c in FLOORS]
        scenes += [nt60(N, corner_stones="resting"), fixed_base(nt60(N), N)]
        return [N, *(count(scene, N) for scene in scenes)]

    show(header, (row(N) for N in (*range(2, 13), 16, 20)))


def fixed_base(scene: Scene, layers: int) -> Scene:
    """The scene with every disc of the base row fixed, as on a rigid and rough floor."""
    discs = tuple(replace(d, held=(ZERO, ZERO)) if d.id[0] == layers else d for d in scene.discs)
    return Scene(discs, tuple(c for c in scene.contacts if c.a[0] < layers))


@table
def tss_osculatory() -> None:
    """Contacts of TSS without force: absent from the last Z, and kept in it (one of each pair)."""
    header = ["c", "N", "without force", "in Z", "kept by Z", "their state", "gap unique"]

    def row(c: str, N: int) -> list[object]:
        scene = tss(N, floor_compliance=c)
        by_z, solution = as_z_leaves(scene), solve(scene)
        kept = [k for k, state in enumerate(by_z.states) if state == "osculatory"]
        names = [f"{scene.contacts[k].a}-{scene.contacts[k].b}".replace(" ", "") for k in kept]
        return [
            c,
            N,
            by_z.count("open") + len(kept),
            by_z.count("open"),
            names[0] if names else "-",
            ", ".join({solution.states[k] for k in kept}) or "-",
            "no" if kept and not any(solution.gap_unique[k] for k in kept) else "-",
        ]

    show(header, (row(c, N) for c in ("1", "-1/2") for N in range(3, 14)))


@table
def z_runs() -> None:
    """The Z algorithm at the paper's sizes: how it ends and what it needs."""
    sizes = [("tbs", "", range(2, 23))]
    sizes += [
        (kind, c, sizes)
        for c in FLOORS
        for kind, sizes in (("tss", range(3, 14)), ("nt60", range(2, 10)), ("nt30", range(2, 7)))
    ]
    header = ["pile", "c", "N", "solved", "iterations", "put back", "singular", "N with returns"]

    def row(kind: str, c: str, layers: range) -> list[object]:
        floor = {"floor_compliance": c} if c else {}
        runs = {N: z_algorithm(pile(kind, N, **floor)) for N in layers}
        steps = [len(run.trace) for run in runs.values()]
        returns = [N for N, run in runs.items() if any(step.returned for step in run.trace)]
        return [
            kind.upper(),
            c or "-",
            f"{layers[0]}..{layers[-1]}",
            sum(run.status == "solved" for run in runs.values()),
            f"{min(steps)}..{max(steps)}",
            sum(run.reintroductions for run in runs.values()),
            sum(run.singular for run in runs.values()),
            " ".join(map(str, returns)) or "-",
        ]

    show(header, (row(*size) for size in sizes))


@table
def tbs_saturation() -> None:
    """Disc (2,1) of TBS, contact e of the apex, and which vertical contacts are open."""
    header = ["N", "a", "d", "e", "f", "e of (1,1)", "open verticals", "open contacts", "verdict"]

    def row(N: int) -> list[object]:
        solution = solve(tbs(N))
        forces = [letter_force(solution, (2, 1), letter) for letter in "adef"]
        verticals = [
            c.a
            for c, state in zip(solution.scene.contacts, solution.states, strict=True)
            if not isinstance(c.b, str) and c.b[0] == c.a[0] + 2 and state == "open"
        ]
        rows = sorted({i for i, _ in verticals})
        where = f"{len(verticals)}, rows {rows[0]}..{rows[-1]}" if rows else "0"
        apex = letter_force(solution, (1, 1), "e")
        return [
            N,
            *map(digits, forces),
            digits(apex),
            where,
            solution.count("open"),
            solution.stability.verdict,
        ]

    show(
        header, (row(N) for N in (5, 10, 15, 20, 22, 30, 40, 50, 60, 61, 70, 80, 93, 94, 100, 120))
    )


@table
def tss_parity() -> None:
    """Disc (2,1) of TSS for even and odd N."""
    header = ["N", *(f"{letter}, c = {c}" for c in ("1", "-1/2") for letter in "ade")]

    def row(N: int) -> list[object]:
        fields: list[object] = [N]
        for c in ("1", "-1/2"):
            solution = solve(tss(N, floor_compliance=c))
            fields += [digits(letter_force(solution, (2, 1), letter)) for letter in "ade"]
        return fields

    show(header, (row(N) for N in (6, 7, 10, 11, 14, 15, 20, 21, 26, 27, 30, 31, 40, 41, 50, 51)))


@table
def tilted_dips() -> None:
    """Sizes at which the base pressure of a tilted pile has a local minimum."""

    def row(kind: str, c: str, sizes: range) -> list[object]:
        floor = {"floor_compliance": c} if c else {}
        under, beside = [], []
        for N in sizes:
            profile = base_pressure(solve(pile(kind, N, **floor)))
            if dip(profile):
                under.append(N)
            elif depressions(profile):
                beside.append(N)
        sizes_done = f"{sizes[0]}..{sizes[-1]}"
        return [kind.upper(), c or "-", sizes_done, under or "none", beside or "none"]

    cases = [("tbs", "", range(2, 41)), *(("tss", c, range(3, 31)) for c in FLOORS)]
    show(["pile", "c", "N", "under the apex", "elsewhere only"], (row(*case) for case in cases))


@table
def nt30_sizes() -> None:
    """NT30 without a push: force under the apex, highest force, dip, and the network.

    The paper's floor up to N = 21: its larger piles take minutes.
    """
    header = ["N", "apex", "highest, at x", "dip", "rim to rim", "horizontals closed / open"]
    header += ["open in all", "mechanisms", "verdict", "dip, c = 0", "dip, c = -1/2"]

    def depth(solution: Solution) -> str:
        found = dip(base_pressure(solution))
        return digits(found.depth if found else None, 4)

    def row(N: int) -> list[object]:
        solution = solve(pile("nt30", N))
        profile = base_pressure(solution)
        found = dip(profile)
        top = max(profile, key=lambda p: p.normal)
        closed, _ = horizontal(solution, N + 1)
        level = sum(not isinstance(c.b, str) and c.a[0] == c.b[0] for c in solution.scene.contacts)
        floors = FLOORS[1:] if N <= 21 else FLOORS[1:2]
        others = [depth(solve(pile("nt30", N, floor_compliance=c))) for c in floors]
        return [
            N,
            digits(profile[len(profile) // 2].normal),
            f"{digits(top.normal)}, {abs(top.x)}",
            depth(solution),
            found.width if found else "-",
            f"{closed} / {level - closed}",
            solution.count("open"),
            solution.stability.mechanisms,
            solution.stability.verdict,
            *others,
            *[""] * (2 - len(others)),
        ]

    show(header, (row(N) for N in (*range(2, 17), 18, 19, 20, 21, 24, 25, 26, 30, 31, 40)))
