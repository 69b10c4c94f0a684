"""The certificate of a complementarity problem: its solution, or why it has none."""

from __future__ import annotations

from fractions import Fraction
from math import lcm

from flint import fmpz

from ..errors import InputError
from ..files.hex_vectors import hexadecimal, vector_entry
from ..files.json_fields import Entry
from ..numbers.vectors import ExactVector, exact_vector
from ..pivoting.lcp import LCP
from ..pivoting.lemke import LemkeResult
from .entries import FORMAT


def lcp_certificate(problem: LCP, result: LemkeResult) -> Entry:
    """That z solves w = M z + q, z, w >= 0, z . w = 0, or that no z >= 0 has M z + q >= 0.

    Parameters
    ----------
    problem : LCP
        The problem.
    result : LemkeResult
        What `lemke` or `solve_lcp` found.

    Returns
    -------
    dict
        What `save_certificate` writes.

    Raises
    ------
    InputError
        Where the result proves neither: a ray alone proves nothing.

    Examples
    --------
    >>> from lcp_piles import lcp, lcp_certificate, solve_lcp
    >>> problem = lcp([[2, 1], [1, 2]], [-5, -6])
    >>> lcp_certificate(problem, solve_lcp(problem))["claim"]
    'lcp'
    """
    found: Entry = {"format": FORMAT, "claim": "lcp", "size": len(problem)}
    rows, columns, values = list[int](), list[int](), list[Fraction]()
    for j in range(len(problem)):
        numbers, den = problem.column(j)
        for i, x in enumerate(numbers):
            if x != 0:
                rows.append(i)
                columns.append(j)
                values.append(Fraction(int(x), int(den)))
    common = lcm(*(x.denominator for x in values))
    integers = [fmpz(int(x * common)) for x in values]
    found |= {"rows": hexadecimal(rows), "columns": hexadecimal(columns)}
    found["M"] = vector_entry(ExactVector({1: integers}, fmpz(common)))
    found["q"] = vector_entry(problem.q)
    if result.z_vector is not None:
        return found | {"z": vector_entry(result.z_vector)}
    if result.certificate is None:
        raise InputError("the result", result, "a solution, or a ray with a certificate")
    return found | {"y": vector_entry(exact_vector(result.certificate))}
