"""All fields: a new one is a file beside this, and a line here."""

from __future__ import annotations

from typing import Any

from . import (
    base_load,
    base_pressure,
    continuum,
    coordination,
    depressions,
    fabric,
    letters,
    stress,
    support_forces,
)
from .field import Field

FIELDS: dict[str, Field[Any]] = {
    module.FIELD.name: module.FIELD
    for module in (
        stress,
        base_pressure,
        base_load,
        support_forces,
        letters,
        depressions,
        continuum,
        fabric,
        coordination,
    )
}
"""The fields by their names, in the order in which they are listed."""
