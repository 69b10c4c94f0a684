"""The interactive page of a solution: one HTML file that needs neither network nor library."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from html import escape
from importlib.resources import files
from typing import TYPE_CHECKING

from ..files.safe_write import check_ending, write_text
from ..friction.force_bounds import ContactBounds
from ..push.push_path import PushPath
from ..solution.describe import brief
from ..solution.solution import Solution
from .page_data import page_data

if TYPE_CHECKING:
    import os


@dataclass(frozen=True)
class View:
    """A page for a browser; in a notebook it shows itself in a frame that may only run it.

    Attributes
    ----------
    html : str
        The page as text, one file with all that it needs.

    Examples
    --------
    >>> from lcp_piles import nt60, solve, view
    >>> view(solve(nt60(2))).html[:15]
    '<!doctype html>'
    """

    html: str = field(repr=False)

    def _repr_html_(self) -> str:
        return (
            '<iframe sandbox="allow-scripts" style="width:100%;height:760px;border:0" '
            f'title="force network" srcdoc="{escape(self.html)}"></iframe>'
        )


def view(
    solution: Solution,
    file: str | os.PathLike[str] | None = None,
    *,
    push: PushPath | None = None,
    bounds: ContactBounds | None = None,
    progress: Callable[[str], None] | None = None,
) -> View:
    """The force network to look into: every force, gap, state and displacement at a touch.

    Exact numbers are shown as such; along the path of a large pile only as many of them as the page
    has room for.

    Parameters
    ----------
    solution : Solved
        A solution of a scene of discs.
    file : str or path, optional
        Where to write the page (.html).
    push : PushPath, optional
        A path of the same scene, over which the page has a slider (`push_path`).
    bounds : ContactBounds, optional
        Those of its forces under friction (`contact_bounds`).
    progress : callable, optional
        Called with a line of text for every piece of the path.

    Returns
    -------
    View
        The page; in a notebook it shows itself.

    Raises
    ------
    InputError
        For a scene that is not plane, for what belongs to another scene and for a file that cannot
        be written.
    NotSolvedError
        Where there are no forces.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> "sqrt(3)/3" in view(solve(nt60(2))).html, "1/3*sqrt(3)" in view(solve(nt60(2))).html
    (False, True)
    """
    if file is not None:
        check_ending(file, ".html")
    parts = {
        "TITLE": escape(brief(solution.scene)),
        "DATA": _embedded(page_data(solution, push, bounds, progress)),
        "STYLE": _template("page.css"),
        "SCRIPT": _template("page.js"),
    }
    # One pass, so that what is put in is not looked through again: names are anybody's text.
    page = re.sub(r"__([A-Z]+)__", lambda mark: parts[mark[1]], _template("page.html"))
    if file is not None:
        write_text(file, page)
    return View(page)


def _embedded(data: dict[str, object]) -> str:
    """JSON that no text in it can end: within a script only a `<` begins anything."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def _template(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")
