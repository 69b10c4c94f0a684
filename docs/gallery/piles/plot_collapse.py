"""
A pile that does not stand
==========================

NT60 with four layers and without one of its corner stones: no forces balance, and the arrows are
the motion by which it gives way, which proves that.
"""

from lcp_piles import nt60, solve
from lcp_piles.pictures import draw_network

found = solve(nt60(4).without([(4, 1)]))
picture = draw_network(found)

# %%
# What the weights of all discs work along that motion: it is positive.
motions = iter(found.collapse)
work = sum(float(next(motions)) * float(f) for disc in found.scene.discs for f in disc.load)
print(found.status, work)
