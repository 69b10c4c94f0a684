"""
TSS: contacts that are absent, and contacts that touch without a force
======================================================================

A tilted pile on a smooth floor as soft as the discs, on the paper's floor, and on that as the
paper's Z algorithm ends. The osculatory contacts of the last panel are the ones that the paper
shows; the optimal partition finds them open, moved apart by a free motion.
"""

from lcp_piles import letter_force, solve, tss
from lcp_piles.paper.figures_networks import network_plate

picture = network_plate("tss", 10, by_z=True).picture

# %%
# The forces on disc (2,1) depend on the parity of the number of layers: for even numbers contact e
# carries the whole weight of the disc, and what d brings in goes on in a.
pile = solve(tss(10, floor_compliance="-1/2"))
a, d, e = (letter_force(pile, (2, 1), letter) for letter in "ade")
print(a, d, e)
