"""
Spheres: a tetrahedron
======================

Five layers of spheres on a triangle of held ones: every place of the base bears the same.
"""

from lcp_piles import base_load, solve, tetrahedron
from lcp_piles.pictures import draw_solid

pile = solve(tetrahedron(5))
picture = draw_solid(pile)

# %%
# The loads on the base, exactly.
loads = {place.load for place in base_load(pile)}
print(loads)
