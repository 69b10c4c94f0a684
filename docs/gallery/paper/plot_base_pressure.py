"""
The force on the floor, and the dip
===================================

NT30 with five and six layers, on a floor as soft as the discs and on the paper's. The paper finds a
plateau, with a shallow minimum under the apex for six layers.
"""

from lcp_piles import base_pressure, dip, nt30, solve
from lcp_piles.paper.figures_fields import pressure_plate

picture = pressure_plate("nt30", (6, 5)).picture

# %%
# The depth of that minimum on the paper's floor, exactly, and the sum of all forces on the floor.
profile = base_pressure(solve(nt30(6, floor_compliance="-1/2")))
depth = dip(profile).depth
total = sum(float(place.normal) for place in profile)
print(depth, total)
