"""Which number the least friction is: a root of a polynomial that a basis gives, and the proof.

Just below the least friction, the first phase of the simplex method ends with all but one of the
columns n +- mu t that a basis needs, on which the Farkas vector y vanishes. At the threshold alpha
they hold the loads: alpha is a root of the determinant of them and b. By Cramer's rule the network
x of a basis that is feasible above, and y, are polynomials in mu over a determinant (`pencil`).
Substituting alpha proves the claim, in the field of alpha and the roots of the normals:

* x(alpha) >= 0: the pile stands at alpha, and with more friction all the more;
* y(alpha) has y . b = 0 and, for one sign of y, y . (n +- alpha t) <= 0 for every contact. A
  network at a smaller mu would be one at alpha too, so y . A x = 0 leaves it only contacts with
  y . n = 0 = y . t (elsewhere |f_t| <= mu f_n < alpha f_n makes a term negative);
* on these contacts alone there is no network, not even at the upper end: a Farkas vector says so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from flint import fmpq_poly, fmpz, fmpz_poly

from ..numbers.roots import root_product
from ..numbers.vectors import ExactVector
from ..programs.linear_program import minimise
from ..programs.roots import Column
from .algebraic import AlgebraicNumber, sign_at
from .equations import FrictionProblem, friction_problem
from .pencil import Pencil, Polynomials, determinant, pencil_of, solution


def threshold(
    problem: FrictionProblem,
    above: Sequence[int],
    below: Sequence[int],
    lower: Fraction,
    upper: Fraction,
) -> AlgebraicNumber | None:
    """The least friction between two ends, proved; None where it is not recognised.

    `problem` is the one at the upper end, where the basis `above` is feasible; `below` are the
    columns that the first phase ends with at the lower end, from `above` on.
    """
    pencil = pencil_of(problem)
    if pencil is None or len(below) != pencil.rows - 1:
        return None
    basis = _completed(pencil, below, above, upper)
    if basis is None:
        return None
    through = determinant(pencil, below)
    whole = fmpz_poly([int(c) for c in (through * through.denom()).coeffs()])
    for factor, _ in whole.factor()[1]:
        number = _root(factor, lower, upper)
        if (
            number is not None
            and _stands(pencil, above, number)
            and _slides_below(problem, pencil, basis, number)
        ):
            return number
    return None


def _completed(
    pencil: Pencil, below: Sequence[int], above: Sequence[int], upper: Fraction
) -> list[int] | None:
    """The columns below with one more, the last, that makes them independent."""
    idle = range(len(pencil.normals), len(pencil.normals) + pencil.rows)
    for j in [*above, *idle]:
        if j not in below:
            basis = [*below, j]
            columns = [pencil.column(k, upper.numerator, upper.denominator) for k in basis]
            if pencil.matrix(columns).det() != 0:
                return basis
    return None


def _root(factor: fmpz_poly, lower: Fraction, upper: Fraction) -> AlgebraicNumber | None:
    """The only root of a factor between the ends, if it has just one there."""
    if factor.degree() < 1:
        return None
    import sympy

    coefficients = tuple(int(c) for c in factor.coeffs())
    polynomial = sympy.Poly(list(coefficients[::-1]), sympy.Symbol("m"))
    ends = (sympy.Rational(x.numerator, x.denominator) for x in (lower, upper))
    if polynomial.count_roots(*ends) != 1:
        return None
    return AlgebraicNumber(coefficients, lower, upper)


def _stands(pencil: Pencil, above: Sequence[int], number: AlgebraicNumber) -> bool:
    """Whether the network of a basis is admissible at the number."""
    p = fmpq_poly(list(number.polynomial))
    det, x = solution(pencil, above, pencil.loads)
    # Where the matrix is singular at the number itself, what all of them have in common cancels.
    divisor, *values = _divided([{1: det}, *x], p)
    sign = sign_at(number, divisor)
    signs = [sign * sign_at(number, value) for value in values]
    idle = [s for j, s in zip(above, signs, strict=True) if j >= len(pencil.normals)]
    return sign != 0 and min(signs) >= 0 and not any(idle)


def _slides_below(
    problem: FrictionProblem, pencil: Pencil, basis: Sequence[int], number: AlgebraicNumber
) -> bool:
    """Whether no network is admissible below the number: y is the last row of the inverse."""
    p = fmpq_poly(list(number.polynomial))
    y = _divided(solution(pencil, basis, ((pencil.rows - 1, 1, 1),), transposed=True)[1], p)
    if sign_at(number, _along(pencil.loads, y)):
        return False
    untouched, found = [], set()
    for k, plus in enumerate(problem.plus):
        normal = _along(pencil.normals[plus], y)
        tangent = _along(pencil.tangents[plus], y)
        ends = {sign_at(number, _moved(normal, tangent, side)) for side in (1, -1)}
        found |= ends
        if ends == {0} and sign_at(number, tangent) == 0:
            untouched.append(problem.scene.contacts[k])
    if {-1, 1} <= found:
        return False
    rest = replace(problem.scene, contacts=tuple(untouched))
    left = friction_problem(rest, problem.mu, tuple(problem.rough)).constraints
    nothing = ExactVector({1: [fmpz(0)] * len(left.columns)}, fmpz(1))
    return minimise(left, nothing).status == "infeasible"


def _divided(numbers: Sequence[Polynomials], p: fmpq_poly) -> list[Polynomials]:
    """The numbers without the powers of a polynomial that all of them have."""
    found = list(numbers)
    while any(q.degree() >= 0 for number in found for q in number.values()):
        parts = [{r: divmod(q, p) for r, q in number.items()} for number in found]
        if any(rest.degree() >= 0 for number in parts for _, rest in number.values()):
            break
        found = [{r: whole for r, (whole, _) in number.items()} for number in parts]
    return found


def _along(column: Column, row: Sequence[Polynomials]) -> dict[int, fmpq_poly]:
    """The product of a column with a row of polynomials."""
    total: dict[int, fmpq_poly] = {}
    for i, q, a in column:
        for s, p in row[i].items():
            g, r = root_product(q, s)
            total[r] = total.get(r, fmpq_poly(0)) + p * (a * g)
    return total


def _moved(normal: Polynomials, tangent: Polynomials, side: int) -> dict[int, fmpq_poly]:
    """The first plus side times mu times the second."""
    mu = fmpq_poly([0, side])
    total = dict(normal)
    for r, p in tangent.items():
        total[r] = total.get(r, fmpq_poly(0)) + p * mu
    return total
