"""The distributions of initial gaps, by name."""

from __future__ import annotations

from collections.abc import Callable

from ..errors import InputError
from ..numbers.exact import Exact
from .draws import Disorder, Normal, Radii, Uniform

DISTRIBUTIONS: dict[str, Callable[[Exact], Disorder]] = {
    "uniform": Uniform,
    "normal": Normal,
    "radii": Radii,
}


def name_of(disorder: Disorder) -> str:
    """The name of the distribution of a disorder.

    >>> name_of(Radii(3))
    'radii'
    """
    for name, distribution in DISTRIBUTIONS.items():
        if type(disorder) is distribution:
            return name
    raise InputError("the disorder", disorder, "one of " + ", ".join(DISTRIBUTIONS))
