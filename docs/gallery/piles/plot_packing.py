"""
A packing of your own, in floats
================================

Discs of any sizes, as a simulation leaves them: the forces of exactly these floats, proved within
rigorous bounds.
"""

from lcp_piles import packing, prove_packing
from lcp_piles.pictures import draw_packing

heap = packing(
    [(0.52, 0.419), (1.463, 0.528), (2.502, 0.508), (0.794, 1.244), (2.018, 1.359)],
    [0.42, 0.53, 0.51, 0.45, 0.47],
    weights=1.0,
    supports={"floor": 0.0, "left": 0.1, "right": 3.013},
    tolerance=0.05,
    stiffness=1e3,
)
proof = prove_packing(heap)
picture = draw_packing(proof)

# %%
# What the floor bears, and the largest radius of a bound.
on_floor = float(proof.forces.middle[heap.support == 0].sum())
print(proof.proved, on_floor, proof.forces.radius.max())
