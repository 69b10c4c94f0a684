"""
TBS: pressure and shear on a bumpy floor
========================================

What the lowest row of TBS puts on the held discs below it, and what the row above puts straight
down. There is no dip, and no shear at the axis.
"""

from lcp_piles import base_pressure, solve, tbs
from lcp_piles.paper.figures_fields import tbs_pressure_plate

picture = tbs_pressure_plate(17).picture

# %%
# The shear in the middle of the base is exactly zero.
(shear,) = (place.shear for place in base_pressure(solve(tbs(17))) if not place.x)
print(shear)
