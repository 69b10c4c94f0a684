"""
NT30: the force network, on two floors
======================================

Six layers between held corner stones. Lines are as wide as the forces; dashed contacts are open.
Above a floor as soft as the discs, below the paper's.
"""

from lcp_piles.paper.figures_networks import network_plate
from lcp_piles.scenes.nt30 import nt30
from lcp_piles.solve import solve

picture = network_plate("nt30", 6).picture

# %%
# On the paper's floor the paper finds the contacts downwards missing that are outermost: one on
# each side.
pile = solve(nt30(6, floor_compliance="-1/2"))
missing = [
    (c.a, c.b)
    for c, state in zip(pile.scene.contacts, pile.states, strict=True)
    if state == "open" and c.normal[1]
]
print(missing)
