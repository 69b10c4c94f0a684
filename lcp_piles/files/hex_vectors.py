"""Exact vectors in JSON, short and quick: hexadecimal integers over one common denominator.

    {"denominator": "6", "1": "0 -1f a", "3": "0 0 2"}

is the vector with entries 0, -31/6 and 10/6 + 2/6 sqrt(3). Text in base 16 is written and read in
time that grows as its length, which that in base 10 is not.
"""

from __future__ import annotations

from collections.abc import Iterable

from flint import fmpz

from ..errors import FileFormatError
from ..numbers.roots import square_part
from ..numbers.vectors import ExactVector
from .json_fields import Entry, field

_DENOMINATOR = "denominator"
_DIGITS = "0123456789abcdef"
_MOST_ROOTS = 64
_LONGEST_ROOT = 9  # digits, as in the text of exact numbers


def hexadecimal(numbers: Iterable[int | fmpz]) -> str:
    """Integers as text.

    >>> hexadecimal([-31, 0, 10])
    '-1f 0 a'
    """
    return " ".join(fmpz(x).str(16) for x in numbers)


def vector_entry(vector: ExactVector) -> Entry:
    """A vector: its denominator, and the numerators that go with every root.

    >>> from lcp_piles.numbers.vectors import exact_vector
    >>> vector_entry(exact_vector(["1/2", "sqrt(3)"]))
    {'denominator': '2', '1': '1 0', '3': '0 2'}
    """
    plain = vector.plain()
    columns = {r: column for r, column in sorted(plain.numerators.items()) if any(column)}
    entry: Entry = {_DENOMINATOR: hexadecimal([plain.denominator])}
    shown = columns or {1: plain.numerators[1]}  # a length can be read off any vector
    return entry | {str(r): hexadecimal(column) for r, column in shown.items()}


def length_of(entry: Entry, where: str) -> int:
    """How many entries a vector has, before they are read."""
    texts = [field(entry, r, str, where) for r in entry if r != _DENOMINATOR]
    lengths = {text.count(" ") + 1 if text else 0 for text in texts}
    if len(lengths) != 1 or len(entry) > _MOST_ROOTS:
        expected = f"as many numbers for each of at most {_MOST_ROOTS} roots"
        raise FileFormatError(where, sorted(lengths), expected)
    return lengths.pop()


def read_vector(entry: Entry, length: int, where: str) -> ExactVector:
    """The vector of so many entries. Raises `FileFormatError`."""
    if length_of(entry, where) != length:
        raise FileFormatError(where, length_of(entry, where), f"{length} numbers")
    (den,) = _integers([field(entry, _DENOMINATOR, str, where)], f"{where}.{_DENOMINATOR}")
    if den <= 0:
        raise FileFormatError(f"{where}.{_DENOMINATOR}", entry[_DENOMINATOR], "above zero")
    numerators = {1: [fmpz(0)] * length}
    for r in entry:
        if r != _DENOMINATOR:
            words = entry[r].split(" ") if length else []
            numerators[_root(r, where)] = _integers(words, f"{where}.{r}")
    return ExactVector(numerators, den)


def _root(text: str, where: str) -> int:
    short = text.isascii() and text.isdecimal() and len(text) <= _LONGEST_ROOT
    r = int(text) if short else 0
    if str(r) != text or r == 0 or square_part(r)[0] != 1:
        raise FileFormatError(where, text, "a root of a square-free number")
    return r


def _integers(words: list[str], where: str) -> list[fmpz]:
    found = []
    for word in words:
        digits = word.removeprefix("-")
        if not digits or digits.strip(_DIGITS):  # nothing else that Python takes for a number
            raise FileFormatError(where, word[:40], "hexadecimal numbers such as -1f")
        found.append(fmpz(int(word, 16)))
    return found
