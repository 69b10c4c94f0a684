"""The documentation: `python -m sphinx -W -b html docs docs/_build/html`."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path
from typing import Any

os.environ.update(MPLBACKEND="Agg", COLUMNS="88", NO_COLOR="1")
HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE / "gallery")]

from made_at_build import make  # noqa: E402

import lcp_piles  # noqa: E402

project = "lcp_piles"
copyright = "the authors of lcp_piles"
version = release = lcp_piles.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "numpydoc", "sphinx_gallery.gen_gallery"]
exclude_patterns = ["_build", "_made", "gallery", "paper"]
myst_enable_extensions = ["deflist"]
myst_heading_anchors = 3
# The notes are read as plain files too, where no header asks for a level.
suppress_warnings = ["myst.header"]

default_role = "code"
autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
autodoc_default_options = {"members": True}
python_maximum_signature_line_length = 80
numpydoc_show_class_members = False

sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "auto_gallery",
    "subsection_order": ["gallery/paper", "gallery/piles", "gallery/problems"],
    "image_scrapers": ("shown.shown",),
    "within_subsection_order": "ExampleTitleSortKey",
    "ignore_pattern": r"shown\.py",
    "download_all_examples": False,
    "min_reported_time": 1e9,
    "show_memory": False,
    "write_computation_times": False,
}

html_theme = "furo"
html_title = f"lcp_piles {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
pygments_style = "friendly"


PLACES = {
    "formulation": "explanation/formulation",
    "stability": "explanation/floats",
    "result-format": "reference/result_format",
    "tables": "reference/tables",
    "certificates": "reference/certificates",
}
"""Pages of notes that are not at `notes/` here as well."""


def link_notes(text: str) -> str:
    """A text in which names of notes are links to their pages."""

    def link(match: re.Match[str]) -> str:
        return f"[{match[0]}](/{PLACES.get(match[2], f'notes/{match[2]}')}.md)"

    names = "|".join(note.stem for note in (HERE.parent / "notes").glob("*.md"))
    return re.sub(rf"(?<!\[)`(notes/)?({names})\.md`", link, text)


def link_in_place(app: object, *arguments: object) -> None:
    """The text of a page or an included file, with links."""
    text = arguments[-1]
    assert isinstance(text, list)
    text[0] = link_notes(text[0])


def setup(app: Any) -> None:
    """Make what the pages show but nobody writes: pictures of commands, and the help of each."""
    make(HERE / "_made", [*HERE.glob("*.md"), *HERE.glob("how-to/*.md")])
    app.parallel = max(app.parallel, min(2, os.cpu_count() or 1))  # as with `-j 2`
    app.connect("source-read", link_in_place)
    app.connect("include-read", link_in_place)
