"""The one family of errors that lcp_piles raises on purpose."""

from __future__ import annotations

from typing import Any


def _again(kind: type[LcpPilesError], args: tuple[Any, ...]) -> LcpPilesError:
    return kind.__new__(kind, *args)


class LcpPilesError(Exception):
    """Base of every error of this package: catch it and nothing of ours escapes."""

    def __reduce__(self) -> tuple[Any, ...]:
        # As it is, not made again: `__init__` of a subclass takes other arguments than the message.
        return _again, (type(self), self.args), self.__dict__


class InputError(LcpPilesError, ValueError):
    """A value that was handed in is not what is needed: the message names all three."""

    def __init__(self, what: str, value: object, expected: str, remedy: str = "") -> None:
        try:
            shown = repr(value)
        except ValueError:  # Python refuses to print integers of thousands of digits
            shown = "a number of thousands of digits"
        if len(shown) > 80:
            shown = shown[:60] + "... (" + str(len(shown)) + " characters)"
        text = f"{what} is {shown}, expected {expected}"
        super().__init__(f"{text}; {remedy}" if remedy else text)


class NotSolvedError(InputError, AttributeError):
    """Forces, or what follows from them, were asked of a solution that has none.

    An `AttributeError` too, so that `hasattr` and `getattr` with a default work as everywhere.
    """


class FileFormatError(InputError):
    """A result file that cannot be read; the message names the field at fault."""


class SolveError(LcpPilesError):
    """A computation that could not be carried to its end, and why."""


class VerificationError(LcpPilesError):
    """A result that its own check refutes: a fault of the program, never of the input."""
