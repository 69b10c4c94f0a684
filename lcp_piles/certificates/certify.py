"""What was found, as a certificate: written to a file, and checked as anyone else would."""

from __future__ import annotations

import os

from ..errors import InputError, VerificationError
from ..files.json_fields import Entry, layout
from ..files.safe_write import write_text
from ..friction.critical_friction import CriticalFriction
from ..push.path import Path
from ..push.push_path import PushPath
from ..solution.solution import Solution, Solved, Unstable
from . import check_certificate as checker
from .entries import FORMAT
from .forces import collapse_certificate, forces_certificate
from .friction import critical_certificate
from .path import path_certificate

Certifiable = Solution | Path | PushPath | CriticalFriction


def certificate(found: Certifiable) -> Entry:
    """The certificate of a result, as plain JSON (notes/certificates.md), checked.

    Certificates of bounds come from `bound_certificate` and `bounds_certificate`, those of
    complementarity problems from `lcp_certificate`.

    Parameters
    ----------
    found : Solved, Unstable, Path, PushPath or CriticalFriction
        The result, exact.

    Returns
    -------
    dict
        What `save_certificate` writes.

    Raises
    ------
    InputError
        Where there is nothing to certify.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> proved(text_of(certificate(solve(nt60(2)))))[-1]
    'the equilibrium is stable'
    """
    return checked(proposed(found))


def proposed(found: Certifiable) -> Entry:
    """The certificate of a result before the checker has seen it."""
    if isinstance(found, Solved):
        return forces_certificate(found)
    if isinstance(found, Unstable):
        return collapse_certificate(found)
    if isinstance(found, PushPath):
        return path_certificate(found.path)
    if isinstance(found, Path):
        return path_certificate(found)
    if isinstance(found, CriticalFriction):
        return critical_certificate(found)
    raise InputError("what to certify", found, "a solution, a path or a critical friction")


def checked(entry: Entry) -> Entry:
    """The certificate, once the checker has passed it."""
    proved(text_of(entry))
    return entry


def proved(text: str) -> list[str]:
    """What the text of a certificate proves, in words; `VerificationError` where it does not."""
    try:
        return checker.check(text.encode())
    except checker.FAULTS as error:
        raise VerificationError(f"the certificate is refused: {error}") from error


def is_certificate(content: Entry) -> bool:
    """Whether the content of a file says that it is a certificate."""
    return content.get("format") == FORMAT


def text_of(entry: Entry) -> str:
    """The text of a certificate."""
    return layout(entry) + "\n"


def save_certificate(entry: Entry, path: str | os.PathLike[str]) -> None:
    """Write a certificate; what stood there is replaced once the new file is whole.

    Parameters
    ----------
    entry : dict
        The certificate.
    path : str or path
        The file (JSON).

    Raises
    ------
    InputError
        Where the path cannot be written.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from lcp_piles import nt60, solve
    >>> with TemporaryDirectory() as folder:
    ...     save_certificate(certificate(solve(nt60(2))), f"{folder}/nt60.json")
    ...     proved(Path(folder, "nt60.json").read_text())[-1]
    'the equilibrium is stable'
    """
    write_text(path, text_of(entry))
