"""Farkas vectors as floating point proposes them: where the idle columns needed have least sum.

The multipliers of that programme, solved for exactly from the basis in which it ends, prove that
A x = b, x >= 0 has no point wherever they are right, whether or not the point of the basis is.
"""

from __future__ import annotations

from flint import fmpz

from ..linear.sparse_exact import SingularError
from ..numbers.vectors import ExactVector
from .certificates import inner
from .constraints import StandardForm
from .proposal import Proposer
from .roots import dot, sign
from .simplex import multipliers_of


def least_violation(problem: StandardForm) -> tuple[list[int], ExactVector | None] | None:
    """A basis of the problem, and a Farkas vector if its multipliers are one; None without basis.

    Idle columns of both signs stand in the programme; the basis of the problem has no signs.
    """
    m, n = problem.rows, len(problem.columns)
    idle = [((i, 1, s * a),) for s in (1, -1) for i, a in enumerate(problem.idle)]
    wide = StandardForm([*problem.columns, *idle], problem.b)
    price = ExactVector({1: [fmpz(0)] * n + [fmpz(1)] * (2 * m)}, fmpz(1))
    basis = Proposer(wide).propose(price).basis
    if basis is None:
        return None
    unsigned = sorted({k if k < n else n + (k - n) % m for k in basis})
    try:
        y = multipliers_of(wide, basis, price)
    except SingularError:
        return unsigned, None
    proves = all(sign(dot(column, y.numerators)) <= 0 for column in problem.columns)
    return unsigned, y if proves and sign(inner(problem.b, y)[0]) > 0 else None
