"""What each command of the command line runs and prints; `cli` parses."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from time import perf_counter
from typing import Any

from ..errors import LcpPilesError
from ..scenes.piles import pile

SOLVED, ERROR, USAGE, UNSTABLE = 0, 1, 2, 3


def run_solve(options: argparse.Namespace) -> int:
    """`lcp-piles solve`: the summary, and what files were asked for."""
    from ..crosscheck import cross_check
    from ..solve import solve
    from .report import describe, summary

    scene = pile(options.kind, options.layers, **_parameters(options))
    narrate = Narrator()
    narrate(describe(scene))
    solution = solve(scene, options.method, whole=options.whole, progress=narrate)
    narrate(f"{solution.status} in {solution.record.seconds:.3g} s")
    check = None
    if solution.status == "solved" and solution.exact and scene.definite:
        try:
            check = cross_check(solution)
        except LcpPilesError as error:
            narrate(f"no floating-point check: {error}")
    if options.json == "-":
        from ..files.write_result import dumps

        sys.stdout.write(dumps(solution))
    elif options.json:
        from ..files.write_result import save

        save(solution, options.json)
        narrate(f"wrote {options.json}")
    text = summary(solution, digits=options.digits, check=check)
    print(text, file=sys.stderr if options.json == "-" else sys.stdout)
    if options.plot:
        from ..pictures import plotting

        plotting.save(plotting.draw_network(solution), options.plot)
        narrate(f"drew {options.plot}")
    return {"solved": SOLVED, "unstable": UNSTABLE}.get(solution.status, ERROR)


class Narrator:
    """Lines on standard error, with the time since the start on work that takes a while."""

    def __init__(self) -> None:
        self._start = self._last = perf_counter()

    def __call__(self, text: str) -> None:
        """Say one line."""
        passed = perf_counter() - self._start
        stamp = f"[{passed:6.1f} s] " if passed > 2 else ""
        print(stamp + text, file=sys.stderr, flush=True)

    def rarely(self, text: str) -> None:
        """Say one line, if the last one was two seconds ago."""
        if perf_counter() - self._last > 2:
            self._last = perf_counter()
            self(text)


class Bar:
    """A progress bar on standard error: one line drawn over, or one a step if it is no screen."""

    def __init__(self, total: int) -> None:
        self._total, self._done = total, 0
        self._start = perf_counter()

    def begin(self, name: str) -> None:
        """Say that the next piece of work, called so, begins."""
        self._draw(name)
        self._done += 1

    def end(self) -> None:
        """Say that all is done."""
        self._draw("done")
        print(file=sys.stderr)

    def _draw(self, name: str) -> None:
        filled = 30 * self._done // max(self._total, 1)
        bar = "#" * filled + "." * (30 - filled)
        passed = perf_counter() - self._start
        over = "\r" if sys.stderr.isatty() else "\n" if self._done else ""
        line = f"[{bar}] {self._done}/{self._total} {passed:5.0f} s  {name:<20}"
        print(over + line, end="", file=sys.stderr, flush=True)


def run_prove(options: argparse.Namespace) -> int:
    """`lcp-piles prove`: the contact set proved without digits, and bounds of the forces."""
    import numpy as np

    from ..methods.bounds import prove_contacts
    from .report import describe, place

    scene = pile(options.kind, options.layers, **_parameters(options))
    narrate = Narrator()
    narrate(describe(scene))
    proof = prove_contacts(scene)
    contacts, forces = scene.contacts, proof.forces
    lines = [
        ("scene", describe(scene)),
        ("contact set", "proved" if proof.proved else "not proved"),
        ("contacts", f"{int(proof.loaded.sum())} carry a force, {int((~proof.loaded).sum())} none"),
    ]
    if proof.zero.any():
        count = int(proof.zero.sum())
        lines.append(("", f"of these {count} touch without force: they hold mechanisms"))
    for k in proof.unproved:
        c = contacts[k]
        near = f"force {abs(forces.middle[k]):.3g} w, gap {abs(proof.gaps.middle[k]):.3g} w tau"
        lines.append(("unproved", f"{place((c.a, c.b))}: {near}, too close to zero to tell"))
    k = int(np.argmax(forces.middle))
    largest = f"{forces.middle[k]:.{max(options.digits, 1)}g} w, within {forces.radius[k]:.1e}"
    lines.append(("largest force", f"{place((contacts[k].a, contacts[k].b))}: {largest}"))
    lines.append(
        (
            "bounds",
            f"every force within {forces.radius.max():.1e} w, "
            f"every gap within {proof.gaps.radius.max():.1e} w tau",
        )
    )
    lines.append(("time", f"{proof.seconds:.3g} s"))
    print("\n".join(f"{name:<13}  {text}" for name, text in lines))
    return SOLVED if proof.proved else ERROR


def run_compare(options: argparse.Namespace) -> int:
    """`lcp-piles compare`: one line a size, the contacts that differ below it."""
    from ..paper.compare import compare
    from .report import place

    header = ("N", "contacts", "sets", "pivots", "iterations", "put back", "singular")
    print("  ".join([*(f"{name:>10}" for name in header), "   Lemke s", "       Z s"]))
    failed = False
    for layers in options.layers:
        (c,) = compare(options.kind, [layers], **_parameters(options))
        failed |= c.equal is None
        verdict = {True: "equal", False: "differ", None: c.z_status}[c.equal]
        row = (c.layers, c.contacts, verdict, c.pivots, c.iterations, c.reintroductions, c.singular)
        times = f"{c.lemke_seconds:>10.3g}  {c.z_seconds:>10.3g}"
        print("  ".join([*(f"{value!s:>10}" for value in row), times]), flush=True)
        for d in c.differences:
            print(f"{'':>12}{place((d.a, d.b))} ({d.state}): {d.reason}")
        if c.forces_equal is False:
            print(f"{'':>12}the forces differ")
    return ERROR if failed else SOLVED


def run_push(options: argparse.Namespace) -> int:
    """`lcp-piles push`: the rearrangements in the order of the path."""
    from ..files.write_result import write_text
    from ..numbers.exact import decimal
    from ..push.push_path import promise, push_path, to_json
    from .report import describe, number, place

    narrate = Narrator()
    parameters = _parameters(options)
    path = push_path(
        options.kind,
        options.layers,
        until=options.until,
        progress=narrate.rarely,
        **parameters,
    )
    narrate(f"{len(path.rearrangements)} rearrangements")
    text = [describe(path.scene)]
    width = len(str(len(path.rearrangements)))
    for k, r in enumerate(path.rearrangements, 1):
        text.append(f"{k:>{width}}  push {number(r.push, options.digits)}")
        for what, contacts in (("opens", r.opens), ("closes", r.closes)):
            if contacts:
                names = ", ".join(place((c.a, c.b)) for c in contacts)
                text.append(f"{'':>{width}}  {what} {names}")
    text.append(f"end: {_END[path.end]}")
    last = path.path.segments[-1].first * path.unit + path.start
    text.append(f"the last piece starts at push {decimal(last, options.digits)}")
    text.append(f"promise: {promise(path.scene)}")
    content = json.dumps(to_json(path), indent=1) + "\n"
    if options.json == "-":
        sys.stdout.write(content)
    elif options.json:
        write_text(options.json, content)
        narrate(f"wrote {options.json}")
    print("\n".join(text), file=sys.stderr if options.json == "-" else sys.stdout)
    if options.plot:
        from ..pictures import plotting
        from ..pictures.push_plot import draw_apex_pressure

        plotting.save(draw_apex_pressure(path), options.plot)
        narrate(f"drew {options.plot}")
    return {"turned": ERROR, "unstable": UNSTABLE}.get(path.end, SOLVED)


def run_reproduce(options: argparse.Namespace) -> int:
    """`lcp-piles reproduce`: the figures of the paper, a file each with its numbers."""
    from ..paper.reproduce import NAMES, reproduce

    bar = Bar(len(options.only or NAMES))
    files = reproduce(Path(options.out), options.only, progress=bar.begin)
    bar.end()
    print("\n".join(str(file) for file in files))
    return SOLVED


_END = {
    "asymptotic": "no further change however large the push",
    "reached": "the push asked for",
    "turned": "the path of this indefinite scene turns back here",
    "unstable": "no forces balance the loads beyond",
}


def _parameters(options: argparse.Namespace) -> dict[str, Any]:
    """The scene's parameters that were given; the rest keep the builder's defaults."""
    names = ("push", "floor_compliance", "corner_stones")
    given = {name: getattr(options, name, None) for name in names}
    return {name: value for name, value in given.items() if value is not None}
