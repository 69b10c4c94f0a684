"""
Spheres: a pyramid
==================

Spheres in a square pyramid: the forces between them, and what every place of the base bears.
"""

from lcp_piles import base_load, pyramid, solve
from lcp_piles.pictures import draw_solid

pile = solve(pyramid(3))
picture = draw_solid(pile)

# %%
# The load on the middle of the base, exactly.
loads = {place.disc: place.load for place in base_load(pile)}
middle = loads[4, 2, 2]
print(middle)
