"""All methods by name: what `solve` and the command line offer and benchmarks compare.

A new method is a module with its `Method`, and a line here.
"""

from __future__ import annotations

from . import fire, float_lemke, gauss_seidel, lemke_road, newton, proved
from .method import Method
from .z import z_method

METHODS: dict[str, Method] = {
    method.name: method
    for method in (
        proved.PROVED,
        lemke_road.LEMKE,
        z_method.Z,
        newton.NEWTON,
        fire.FIRE,
        gauss_seidel.GAUSS_SEIDEL,
        float_lemke.LEMKE_FLOAT64,
        float_lemke.LEMKE_FLOAT32,
        z_method.Z_FLOAT64,
        z_method.Z_FLOAT32,
    )
}
"""The methods of `solve` by their names."""
