"""
Pushing the corner stones: the force under the apex
===================================================

The force on the floor under the apex of NT30 against the push of both corner stones. Between the
rearrangements of the network it is exactly linear.
"""

from lcp_piles import push_path
from lcp_piles.paper.figures_push import apex_pressure_plate, under_apex

picture = apex_pressure_plate(6).picture

# %%
# From the last but one rearrangement on the force stays as it is.
pushes, forces = under_apex(push_path("nt30", 6, floor_compliance="-1/2"))
last = forces[-1]
print(last)
