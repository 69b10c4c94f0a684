"""How sphinx-gallery finds the picture of a script: under the name `picture`."""

from __future__ import annotations

from typing import Any

from sphinx_gallery.scrapers import figure_rst

from lcp_piles.pictures import save


def shown(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """The picture, where the block of code has made it, saved and in RST.

    Axes and figures of the package are no figures of pyplot, which sphinx-gallery would look for.
    """
    _, code, _ = block
    if "\npicture = " not in f"\n{code}":
        return ""
    path = next(block_vars["image_path_iterator"])
    save(block_vars["example_globals"]["picture"], path, dpi=100)
    return figure_rst([path], gallery_conf["src_dir"])
