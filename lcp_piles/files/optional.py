"""Libraries that only some things need."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..errors import MissingExtraError


def needed(library: str, extra: str) -> Any:
    """The library; `MissingExtraError`, which says how to install it, where it is not there."""
    try:
        return import_module(library)
    except ImportError as error:
        raise MissingExtraError(library, extra) from error
