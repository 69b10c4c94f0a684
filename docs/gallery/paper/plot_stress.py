"""
Stress: principal axes
======================

The principal axes of the stress on every disc of NT30, on both floors. The bar is the scale.
"""

from lcp_piles import nt30, solve, stress
from lcp_piles.paper.figures_fields import stress_plate

picture = stress_plate("nt30", 6).picture

# %%
# The apex rests on two discs at 60 degrees, whatever is below: its stress is exact.
apex = stress(solve(nt30(6))).of((1, 1))
print([[str(x) for x in row] for row in apex])
