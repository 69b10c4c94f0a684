"""What a release says of itself: one version everywhere."""

from __future__ import annotations

import re
from pathlib import Path

import lcp_piles

ROOT = Path(__file__).parents[1]


def test_the_version_is_one() -> None:
    version = re.escape(lcp_piles.__version__)
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.search(rf"^version: {version}$", citation, re.MULTILINE)
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (\S+?),? ", changes, re.MULTILINE)[0] == lcp_piles.__version__
