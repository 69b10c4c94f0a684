"""The one family of errors that lcp_piles raises on purpose."""

from __future__ import annotations

from fractions import Fraction
from reprlib import Repr
from typing import Any

_LONGEST = 80


class _Brief(Repr):
    """Short, with exact numbers as people write them: `reprlib` asks for the name of the type."""

    def repr_Surd(self, number: object, level: int) -> str:
        return str(number)

    repr_Fraction = repr_fmpz = repr_fmpq = repr_Surd


_BRIEF = _Brief()
_BRIEF.maxstring = _BRIEF.maxother = 10 * _LONGEST  # what is longer is cut below
_BRIEF.maxlist = _BRIEF.maxtuple = _BRIEF.maxset = _BRIEF.maxdict = 20


class LcpPilesError(Exception):
    """Base of every error of this package: catch it and nothing of ours escapes.

    Examples
    --------
    >>> from lcp_piles import LcpPilesError, nt60
    >>> try:
    ...     nt60(1)
    ... except LcpPilesError as error:
    ...     print(error)
    layers of nt60 is 1, expected a number from 2 to 2000
    """

    def __reduce__(self) -> tuple[Any, ...]:
        # As it is, not made again: `__init__` of a subclass takes other arguments than the message.
        return _again, (type(self), self.args), self.__dict__


class InputError(LcpPilesError, ValueError):
    """A value that was handed in is not what is needed: the message names all three.

    The value itself is not kept, so the error crosses to another process whatever the value was.

    Parameters
    ----------
    what : str
        What the value is for.
    value : object
        The value, shown in at most about a line.
    expected : str
        What is needed.
    remedy : str, optional
        What to do.

    Attributes
    ----------
    expected : str
        What is needed, as in the message.
    remedy : str
        What to do, the last part of the message; may be empty.

    Examples
    --------
    >>> InputError("tau", 0, "a positive number").args[0]
    'tau is 0, expected a positive number'
    """

    expected: str
    remedy: str

    def __init__(self, what: str, value: object, expected: str, remedy: str = "") -> None:
        self.expected, self.remedy = expected, remedy
        text = f"{what} is {_shown(value)}, expected {expected}"
        super().__init__(f"{text}; {remedy}" if remedy else text)


class NotConvexError(InputError):
    """A quadratic form that falls below zero, with a direction that proves it.

    Parameters
    ----------
    what : str
        What the matrix is for.
    value : object
        The matrix, shown in at most about a line.
    direction : tuple of Fraction
        The witness.

    Attributes
    ----------
    direction : tuple of Fraction
        A d with d . P d < 0.

    Examples
    --------
    >>> from lcp_piles import NotConvexError, quadratic_program
    >>> try:
    ...     quadratic_program([[1, 2], [2, 1]], [0, 0])
    ... except NotConvexError as error:
    ...     d, e = error.direction
    >>> d * d + 4 * d * e + e * e < 0
    True
    """

    direction: tuple[Fraction, ...]

    def __init__(self, what: str, value: object, direction: tuple[Fraction, ...]) -> None:
        self.direction = direction
        super().__init__(
            what, value, "a positive semidefinite matrix", "`direction` of this error is a witness"
        )


class NotSolvedError(InputError, AttributeError):
    """Forces, or what follows from them, were asked of a solution that has none.

    An `AttributeError` too, so that `hasattr` and `getattr` with a default work as everywhere.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> hasattr(solve(nt60(2).without([(2, 2)])), "forces")
    False
    """


class FileFormatError(InputError):
    """A file that cannot be read; the message names the field, or the line, at fault.

    Examples
    --------
    >>> from lcp_piles.files.scene_file import scene_of_text
    >>> try:
    ...     scene_of_text('{"format": "lcp-piles/2"}')
    ... except FileFormatError as error:
    ...     print(error)
    scene is None, expected an object
    """


class MissingExtraError(LcpPilesError, ImportError):
    """A library that is not installed, and the extra that installs it.

    Parameters
    ----------
    library : str
        The library.
    extra : str
        The extra of this package that brings it.

    Examples
    --------
    >>> str(MissingExtraError("pandas", "tables"))
    'pandas is not installed: pip install "lcp-piles[tables]" does that'
    """

    def __init__(self, library: str, extra: str) -> None:
        super().__init__(f'{library} is not installed: pip install "lcp-piles[{extra}]" does that')


class SolveError(LcpPilesError):
    """A computation that could not be carried to its end, and why.

    Examples
    --------
    >>> from lcp_piles import nt60, prove_contacts
    >>> try:
    ...     prove_contacts(nt60(3, floor_compliance=0))
    ... except SolveError as error:
    ...     print(error)
    bounds without digits need elastic contacts: use solve
    """


class VerificationError(LcpPilesError):
    """A result that its own check refutes: a fault of the program, never of the input.

    Examples
    --------
    >>> issubclass(VerificationError, LcpPilesError), issubclass(VerificationError, InputError)
    (True, False)
    """


def _again(kind: type[LcpPilesError], args: tuple[Any, ...]) -> LcpPilesError:
    return kind.__new__(kind, *args)


def _shown(value: object) -> str:
    """The value in at most about a line, whatever it is."""
    try:
        shown = _BRIEF.repr(value)
    except (ValueError, RecursionError):  # Python prints no integers of thousands of digits
        shown = f"a {type(value).__name__} too long to print"
    if len(shown) > _LONGEST:
        length = len(value) if isinstance(value, str) else len(shown)
        shown = f"{shown[: _LONGEST - 20]}... ({length} characters)"
    return shown
