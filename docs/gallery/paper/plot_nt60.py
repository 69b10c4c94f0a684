"""
NT60: horizontal contacts
=========================

The paper finds all horizontal contacts of NT60 absent above the base row, the solution of Hong. On
its floor that is so for nine layers, below; on a floor as soft as the discs it is not, above.
"""

from lcp_piles import nt60, solve
from lcp_piles.paper.figures_networks import hong_remark, network_plate

picture = network_plate("nt60", 9, remark=hong_remark).picture

# %%
# How many horizontal contacts above the base row carry a force, on the paper's floor.
pile = solve(nt60(9, floor_compliance="-1/2"))
pressed = [
    (c.a, c.b)
    for c, force in zip(pile.scene.contacts, pile.forces, strict=True)
    if force and c.b != "floor" and c.a[0] == c.b[0] < 9
]
print(pressed)
