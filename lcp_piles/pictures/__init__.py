"""Pictures of piles, force networks, fields and paths.

The functions that draw, by name; importing this loads matplotlib, which nothing else does. `save`
writes the picture that any of them returns.
"""

from .check_picture import draw_check
from .field_pictures import draw_field, draw_profile, draw_stress_axes
from .friction_pictures import draw_bounds, draw_friction
from .packing_picture import draw_packing
from .plotting import HAIRLINE, draw_network, draw_scene, save
from .push_plot import draw_apex_pressure
from .solid_pictures import draw_base_map, draw_solid

__all__ = [
    "HAIRLINE",
    "draw_apex_pressure",
    "draw_base_map",
    "draw_bounds",
    "draw_check",
    "draw_field",
    "draw_friction",
    "draw_network",
    "draw_packing",
    "draw_profile",
    "draw_scene",
    "draw_solid",
    "draw_stress_axes",
    "save",
]
