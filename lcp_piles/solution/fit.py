"""Whether displacements fit a scene at all, before loads are asked about.

Only rigid contacts can say no: B u + o >= 0 for all of them, and zero where they are held closed.
Without elastic contacts and loads that is the whole problem, so the LCP of what is left of the
system decides it, by some displacements or by a stress (`mechanics.contradiction`).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from flint import fmpz

from ..errors import VerificationError
from ..linear.rearrangement import rows_of
from ..mechanics.contact_lcp import contact_lcp
from ..mechanics.contradiction import contradiction
from ..mechanics.system import ContactSystem
from ..numbers.vectors import ExactVector
from ..pivoting.lemke import lemke


def check_fit(system: ContactSystem) -> None:
    """Raise `ContradictionError` where no displacements fit the rigid contacts of a system."""
    rigid = np.flatnonzero(system.rigid)
    gap = system.gap.take(rigid, np.ones(len(rigid), dtype=np.int64))
    if not any(gap.signs()):
        return  # no displacements at all do
    place = np.full(system.contacts + 1, -1, dtype=np.int64)
    place[rigid] = np.arange(len(rigid))
    parts = system.reduction
    hard = replace(
        system,
        reduction=replace(
            parts,
            contact=place[parts.contact],
            representative=parts.representative[rigid],
            weight=parts.weight[rigid],
        ),
        B=rows_of(system.B, rigid),
        compliance=tuple(system.compliance[k] for k in rigid.tolist()),
        gap=gap,
        load=ExactVector({1: [fmpz(0)] * system.dof}, fmpz(1)),
        bilateral=system.bilateral[rigid],
        factor_of=system.factor_of[rigid],
    )
    reduced = contact_lcp(hard)
    wrong = [int(sign < 0) for sign in reduced.problem.q.signs()]
    result = lemke(reduced.problem, d=wrong)
    if result.z_vector is not None:
        return
    if result.certificate is None:
        raise VerificationError("a ray of a definite problem gave no certificate")
    raise contradiction(hard, reduced.stress(result.certificate))
