"""What is measured of an answer, by us: its error against the exact solution, and its claim.

The reference is `lcp_piles.solve`, kept in a file for each scene: forces and gaps rounded to
floats, the states, and a hash of the exact forces, which an exact method has to reproduce.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from hashlib import sha256
from math import log10
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.comparison.methods import Method
from benchmarks.comparison.problem import Answer
from benchmarks.comparison.scenes import build
from lcp_piles import Scene, solve
from lcp_piles.numbers.vectors import ExactVector, FloatArray, content

_SLACK = 100
THRESHOLDS = tuple(10.0**-k for k in range(3, 15))
_NAMES = ("open", "osculatory", "closed")


@dataclass(frozen=True, eq=False)
class Reference:
    """The exact solution: floats of it, states (0 open, 1 osculatory, 2 closed) and a hash."""

    forces: FloatArray
    gaps: FloatArray
    states: Any
    dof: int
    contacts: int
    mechanisms: int
    hash: str


def reference(name: str, folder: Path) -> Reference:
    """The reference of a scene, solved once and then read from the folder."""
    path = folder / (name.replace(" ", "_") + ".npz")
    if not path.exists():
        folder.mkdir(parents=True, exist_ok=True)
        solution = solve(build(name))
        assert isinstance(solution.forces, ExactVector)
        assert solution.stability is not None
        np.savez(
            path,
            forces=solution.force_array,
            gaps=solution.gap_array,
            states=np.array([_NAMES.index(s) for s in solution.states]),
            sizes=[solution.record.dof, solution.record.contacts, solution.stability.mechanisms],
            hash=exact_hash(solution.forces),
        )
    with np.load(path) as kept:
        dof, contacts, mechanisms = map(int, kept["sizes"])
        return Reference(
            kept["forces"],
            kept["gaps"],
            kept["states"],
            dof,
            contacts,
            mechanisms,
            str(kept["hash"]),
        )


def exact_hash(forces: ExactVector) -> str:
    """A hash that two exact vectors of one scene share exactly if they are equal."""
    present = {r: column for r, column in forces.numerators.items() if r == 1 or any(column)}
    common = reduce(lambda g, column: content(column, g), present.values(), forces.denominator)
    digest = sha256(hex(int(forces.denominator // common)).encode())
    for r, column in sorted(present.items()):
        digest.update(f";{r}:".encode())
        for x in column:
            digest.update(hex(int(x // common)).encode() + b",")
    return digest.hexdigest()[:32]


def verdict(
    method: Method, setting: Any, scene: Scene, answer: Answer, truth: Reference
) -> dict[str, Any]:
    """All that is said about one answer, as entries of a row."""
    f = answer.forces
    largest = float(truth.forces.max())
    error = float(np.abs(f - truth.forces).max())
    balance = unbalanced(scene, f) / largest
    wrong, wrong_loaded = zip(*(_wrong(answer, truth, t) for t in THRESHOLDS), strict=True)
    equal = exact_hash(answer.exact) == truth.hash if answer.exact is not None else None
    relative = 0.0 if equal else error / largest
    return {
        "error": error if not equal else 0.0,
        "relative": relative,
        "digits": "all" if equal else round(-log10(max(relative, 1e-16)), 1),
        "balance": balance,
        "wrong": " ".join("-" if w is None else str(w) for w in wrong),
        "wrong_loaded": " ".join(map(str, wrong_loaded)),
        "claimed": answer.claimed,
        "claim_true": _claim_true(method, setting, answer, truth, balance, equal),
    }


def _claim_true(
    method: Method,
    setting: Any,
    answer: Answer,
    truth: Reference,
    balance: float,
    equal: bool | None,
) -> bool | str:
    """Whether a claim of success holds; empty where none was made or it is about another pile.

    An exact method claims the exact forces. A proof claims its bounds and its contact set. A
    tolerance is claimed of the residual: unbalanced forces, negative forces and negative gaps over
    the largest of their kind, and the duality gap f . g over f . f, have to be within a
    hundred times of it, since every method has a scale of its own.
    """
    if not answer.claimed:
        return ""
    if method.group == "exact":
        return bool(equal)
    if answer.radius is not None:
        off = np.abs(answer.forces - truth.forces)
        within = off <= answer.radius + 4 * np.spacing(truth.forces)
        return bool(within.all()) and answer.facts["loaded"] == int((truth.states == 2).sum())
    if method.tolerance is None:
        return ""
    f, largest = answer.forces, float(truth.forces.max())
    residual = max(balance, -float(f.min()) / largest)
    if answer.gaps is not None:
        g = answer.gaps
        reach = max(float(np.abs(g).max()), largest)
        residual = max(residual, -float(g.min()) / reach, abs(float(f @ g)) / float(f @ f))
    return bool(residual <= _SLACK * method.tolerance(setting))


def _wrong(answer: Answer, truth: Reference, threshold: float) -> tuple[int | None, int]:
    """Contacts named wrongly at a relative threshold: of three states, and of loaded or not.

    The three need gaps. Closed is a force above the threshold times the largest force, open a gap
    above it times the largest gap (or force, in these units), osculatory what is neither.
    """
    closed = answer.forces > threshold * np.abs(answer.forces).max()
    loaded = int((closed != (truth.states == 2)).sum())
    if answer.gaps is None:
        return None, loaded
    reach = max(float(np.abs(answer.gaps).max()), float(np.abs(answer.forces).max()))
    named = np.where(closed, 2, np.where(answer.gaps > threshold * reach, 0, 1))
    return int((named != truth.states).sum()), loaded


def unbalanced(scene: Scene, forces: FloatArray) -> float:
    """The largest unbalanced force (w) on a disc, along axes in which it is free."""
    a, b = scene.ends
    table, which = scene.normals
    normals = np.array([[float(x) for x in n] for n in table])[which]
    total = np.array([[float(x) for x in disc.load] for disc in scene.discs])
    np.add.at(total, a, forces[:, None] * normals)
    inner = b >= 0
    np.add.at(total, b[inner], -(forces[:, None] * normals)[inner])
    free = np.array([[h is None for h in disc.held] for disc in scene.discs])
    return float(np.abs(total[free]).max(initial=0))
