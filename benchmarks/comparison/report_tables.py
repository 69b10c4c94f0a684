"""The tables of the report, each a passage of Markdown from the rows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from benchmarks.comparison.charts import curves, growth, most_exact
from benchmarks.comparison.csv_rows import Row
from benchmarks.comparison.judge import THRESHOLDS
from benchmarks.comparison.methods import METHODS
from benchmarks.comparison.table import BASELINES, Point, best, fastest, geometric_mean, of

_RATIOS = ("newton", "contacts", "float start", "proved")


def table(head: Sequence[str], lines: Iterable[Sequence[object]]) -> str:
    """A Markdown table."""
    rows = [head, ["---"] * len(head), *lines]
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in rows)


def fastest_table(found: list[Point]) -> str:
    """The fastest method on every scene at every error."""
    lines = []
    for scene in scene_names(found):
        line = [scene, next(p.contacts for p in found if p.scene == scene)]
        for level in (1e-3, 1e-6, 1e-9, 0.0):
            p = fastest((p for p in found if p.scene == scene), level)
            line.append(f"{p.method}, {duration(p.seconds)}" if p else "none")
        lines.append(line)
    return "## The fastest at every error\n\n" + table(
        ("scene", "contacts", "1e-3", "1e-6", "1e-9", "exact"), lines
    )


def ratios_table(found: list[Point]) -> str:
    """Ours over the best peer at 1e-9."""
    lines = []
    for scene in scene_names(found):
        line: list[object] = [scene, next(p.part_contacts for p in found if p.scene == scene)]
        for clock in ("seconds", "solver_seconds"):
            peer = best(found, scene, 1e-9, ("peer", "md"), clock)  # type: ignore[arg-type]
            if peer is None:
                line += ["none"] + [""] * len(_RATIOS)
                continue
            line.append(f"{peer.method}, {duration(getattr(peer, clock))}")
            for name in _RATIOS:
                own = fastest(of(found, scene, name), 1e-9, clock)  # type: ignore[arg-type]
                ratio = getattr(own, clock) / max(getattr(peer, clock), 1e-6) if own else None
                line.append(f"{ratio:.2f}" if ratio else "")
        lines.append(line)
    head = ("scene", "contacts solved", "best peer at 1e-9, from the scene", *_RATIOS,
            "best peer, solver only", *_RATIOS)  # fmt: skip
    return (
        "## Ours over the best peer\n\nBelow 1 we are faster. `newton` is floating point, "
        "`contacts` proves the contact set and bounds, `float start` gives every digit of forces "
        "and gaps, `proved` states, stability and verification too.\n\n" + table(head, lines)
    )


def growth_table(found: list[Point]) -> str:
    """Fitted exponents, and how far each method got."""
    lines = []
    kinds = ("tbs", "nt30")
    fitted = {kind: curves(found, kind) for kind in kinds}
    for m in METHODS:
        line: list[object] = [m.name]
        for kind in kinds:
            curve = fitted[kind].get(m.name, [])
            slope = growth(curve)
            last = curve[-1] if curve else None
            line += [
                f"{slope:.2f}" if slope is not None else "",
                f"{last.scene}: {duration(last.seconds)}, {last.megabytes:.0f} MB" if last else "",
            ]
        if any(line[1:]):
            lines.append(line)
    head = ("method", "tbs exponent", "largest within 1e-6", "nt30 exponent", "largest within 1e-6")
    return (
        "## Growth with size\n\nExponents of the time in the degrees of freedom, fitted to the "
        "sizes of 100 freedoms and more. Where dense methods end, the plan ends them; the rows "
        "tell timeouts apart.\n\n" + table(head, lines)
    )


def states_table(found: list[Point]) -> str:
    """Contacts named wrongly, at three thresholds and at the best."""
    chosen = [
        s for s in ("nt30 20", "tss 40", "tbs 100", "nt30 10 discs=1") if s in scene_names(found)
    ]
    chosen = chosen or scene_names(found)[:2]
    picked = [THRESHOLDS.index(t) for t in THRESHOLDS if f"{t:.0e}" in ("1e-03", "1e-06", "1e-09")]
    lines = []
    for m in METHODS:
        line: list[object] = [m.name]
        for scene in chosen:
            p = most_exact(found, scene, m.name)
            if p is None:
                line.append("")
                continue
            at = ", ".join(str(p.wrong_loaded[k]) for k in picked)
            known = [w for w in p.wrong if w is not None]
            line.append(f"{at}; three states {min(known) if known else 'unknown'}")
        if any(line[1:]):
            lines.append(line)
    return (
        "## Contact states\n\nContacts wrongly called loaded or not at thresholds of 1e-3, 1e-6 "
        "and 1e-9 of the largest force, at each method's most exact setting; and, at the best of "
        "twelve thresholds, wrong ones among closed, open and osculatory (a pile with mechanisms "
        "has solutions in which an open contact just touches, so floats cannot tell). Our exact "
        "methods name states by signs, not by a threshold; their numbers here are those of their "
        "rounded forces.\n\n" + table(("method", *chosen), lines)
    )


def claims_table(rows: list[Row], found: list[Point]) -> str:
    """Claims of success, false ones, timeouts, and what failures said."""
    made = Counter(p.method for p in found if p.claimed and p.claim_true is not None)
    false = Counter(p.method for p in found if p.claim_true is False)
    late = Counter(r["method"] for r in rows if r["status"] == "timeout")
    failed: dict[str, list[str]] = {}
    for r in rows:
        if r["status"] == "failed":
            failed.setdefault(r["method"], []).append(r["scene"])
    lines = [
        (
            m.name,
            made[m.name],
            false[m.name],
            late[m.name],
            ", ".join(dict.fromkeys(failed.get(m.name, []))),
        )
        for m in METHODS
        if made[m.name] or late[m.name] or m.name in failed
    ]
    reasons = sorted({(r["method"], r["reason"]) for r in rows if r["status"] == "failed"})
    told = "\n".join(f"* {name}: {reason}" for name, reason in reasons)
    return (
        "## Claims\n\nA claim of success is false where the residual that we compute is more than "
        "a hundred times the tolerance asked for (1e-6 where there is none to ask for), where an "
        "exact method has other forces than the reference, or where a bound does not hold. LAMMPS "
        "claims rest of its own soft pile and is not judged.\n\n"
        + table(("method", "claims", "false", "timeouts", "gave up on"), lines)
        + (f"\n\nWhat those that gave up said:\n\n{told}" if told else "")
    )


def lost_table(found: list[Point]) -> str:
    """Scenes won and lost, ours against all others."""
    lines = []
    for level in (1e-3, 1e-6, 1e-9, 0.0):
        won: list[str] = []
        lost: list[str] = []
        ratios = []
        for scene in scene_names(found):
            ours = fastest((p for p in found if p.scene == scene and p.ours), level)
            other = fastest((p for p in found if p.scene == scene and not p.ours), level)
            if ours is None:
                continue
            if other is None:
                won.append(scene)
                continue
            ratios.append(ours.seconds / other.seconds)
            if ours.seconds <= other.seconds:
                won.append(scene)
            else:
                lost.append(f"{scene} to {other.method} ({ratios[-1]:.1f})")
        mean = f"{geometric_mean(ratios):.2f}" if ratios else ""
        name = "exact" if level == 0 else f"{level:g}"
        share = f"{len(won)} of {len(won) + len(lost)}"
        lines.append((name, share, mean, "; ".join(lost) or "none"))
    return (
        "## Won and lost\n\nThe fastest of ours against the fastest of all others "
        f"(peers, LAMMPS, {', '.join(BASELINES)}), from the scene; in brackets how many times "
        "slower we are.\n\n"
        + table(("error", "scenes won", "geometric mean, ours over theirs", "lost"), lines)
    )


def z_table(rows: list[Row]) -> str:
    """The Z algorithm beside Lemke's method."""
    if not rows:
        return ""
    lines = []
    for study in ("sizes", "gaps", "starts"):
        for kind in ("nt30", "nt60", "tss", "tbs"):
            mine = [r for r in rows if r["study"] == study and r["scene"].startswith(kind)]
            if not mine:
                continue
            ended = Counter(r["z_status"] for r in mine)
            both = [r for r in mine if r["z_seconds"] and r["lemke_seconds"]]
            lemke = Counter(r["lemke_status"] for r in both)
            ratio = [float(r["z_seconds"]) / float(r["lemke_seconds"]) for r in both]

            def most(name: str, chosen: list[Row] = both) -> int:
                return max((int(r[name] or 0) for r in chosen), default=0)

            lines.append(
                (
                    study,
                    kind,
                    len(mine),
                    ", ".join(f"{n} {status}" for status, n in ended.items()),
                    most("z_iterations"),
                    most("reintroductions"),
                    most("singular"),
                    ", ".join(f"{n} {status}" for status, n in lemke.items()),
                    most("lemke_pivots"),
                    f"{geometric_mean(ratio):.2f}" if ratio else "",
                    f"{sum(r['agree'] == 'True' for r in mine)} of {ended['solved']}",
                )
            )
    head = ("study", "pile", "runs", "Z ended", "most systems", "most put back", "most singular",
            "Lemke ended", "most pivots", "time Z / Lemke", "same forces")  # fmt: skip
    return (
        "## Z against Lemke\n\nBoth exact, on the same scenes: growing lattices (`sizes`), nearly "
        "equal discs (`gaps`), and random first sets Z on perfect lattices (`starts`).\n\n"
        + table(head, lines)
    )


def scene_names(found: list[Point]) -> list[str]:
    """The scenes in the order of the rows."""
    return list(dict.fromkeys(p.scene for p in found))


def duration(seconds: float) -> str:
    """A time for people."""
    return f"{1000 * seconds:.3g} ms" if seconds < 1 else f"{seconds:.3g} s"
