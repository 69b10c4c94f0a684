"""Problems with known answers, for tests, benchmarks and whoever tries a solver of his own."""

from .lcp_problems import (
    LCPCase,
    degenerate,
    fathi,
    gilbert,
    grain,
    kostreva,
    murty,
    newton_min_definite,
)
from .quadratic_problems import (
    QuadraticCase,
    hock_schittkowski_21,
    hock_schittkowski_35,
    hock_schittkowski_76,
    hock_schittkowski_118,
)
from .scene_problems import (
    APEX_LIMIT,
    LAST_BREAKPOINT,
    SceneCase,
    beside,
    grain_scene,
    near_breakpoint,
    random_collapse,
    random_scene,
    side_load,
    stiff_every_other,
)

__all__ = [
    "APEX_LIMIT",
    "LAST_BREAKPOINT",
    "LCPCase",
    "QuadraticCase",
    "SceneCase",
    "beside",
    "degenerate",
    "fathi",
    "gilbert",
    "grain",
    "grain_scene",
    "hock_schittkowski_21",
    "hock_schittkowski_35",
    "hock_schittkowski_76",
    "hock_schittkowski_118",
    "kostreva",
    "murty",
    "near_breakpoint",
    "newton_min_definite",
    "random_collapse",
    "random_scene",
    "side_load",
    "stiff_every_other",
]
