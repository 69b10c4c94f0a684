"""Exact numbers from text, by a grammar of its own: nothing is ever evaluated.

A number is a sum of terms, each an integer, fraction or decimal, a square root, or their product,
over an integer if need be: "7/3", "-.25", "2.5e3", "2 - 1/2*sqrt(3)", "sqrt(12)/4". Text may come
from a file that means harm, so its length, its exponents and the number of its terms are bounded,
and no pattern goes back over what it has read.
"""

from __future__ import annotations

import re
from fractions import Fraction

from flint import fmpq, fmpz

from ..errors import InputError
from .roots import square_part
from .surds import Surd, summed

_MOST_CHARACTERS = 200_000
_MOST_TERMS = 64
_LARGEST_EXPONENT, _EXPONENT_CHARACTERS = 10_000, 8
_EXPECTED = 'an exact number such as "-7/3", "0.25" or "2 - 1/2*sqrt(3)"'
_TERM = re.compile(
    r"\s*(?:(?P<sign>[+-])\s*)?"
    r"(?:(?:(?P<whole>\d+)(?:\.(?P<part>\d+))?|\.(?P<bare>\d+))(?:[eE](?P<exponent>[+-]?\d+))?"
    r"(?:/(?P<den>\d+))?(?:\*sqrt\((?P<times>\d{1,9})\))?"
    r"|sqrt\((?P<root>\d{1,9})\))(?:/(?P<over>\d+))?\s*",
    re.ASCII,
)


def parsed(text: str) -> Surd:
    """The number that the text writes; `InputError` where it writes none."""
    if len(text) > _MOST_CHARACTERS:
        raise InputError("the number", text, f"at most {_MOST_CHARACTERS} characters")
    total: dict[int, fmpq] = {}
    position = terms = 0
    while position < len(text) or not terms:
        match = _TERM.match(text, position)
        if match is None or (terms and not match["sign"]):
            raise InputError("the number", text, _EXPECTED)
        position, terms = match.end(), terms + 1
        if terms > _MOST_TERMS:
            raise InputError("the number", text, f"a sum of at most {_MOST_TERMS} terms")
        root = int(match["times"] or match["root"] or 1)
        den = fmpz(match["den"] or "1") * fmpz(match["over"] or "1")
        if root == 0 or den == 0:
            raise InputError("the number", text, _EXPECTED)
        outside, inside = square_part(root)
        value = _decimal(match, text) * outside / den
        total[inside] = total.get(inside, fmpq(0)) + (-value if match["sign"] == "-" else value)
    return summed((r, Fraction(int(x.p), int(x.q))) for r, x in total.items())


def _decimal(match: re.Match[str], text: str) -> fmpq:
    """The decimal of a term, one where the term is a bare root."""
    behind = match["part"] or match["bare"] or ""
    exponent = match["exponent"] or "0"
    if len(exponent) > _EXPONENT_CHARACTERS or abs(int(exponent)) > _LARGEST_EXPONENT:
        raise InputError("the number", text, f"an exponent of at most {_LARGEST_EXPONENT} in size")
    digits = fmpz((match["whole"] or "") + behind or "1")
    power = int(exponent) - len(behind)
    return fmpq(digits * fmpz(10) ** power) if power > 0 else fmpq(digits, fmpz(10) ** -power)
