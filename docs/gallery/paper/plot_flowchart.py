"""
The paper's Z algorithm, run on a pile
======================================

The flowchart of the algorithm with what it did at every box for TSS, and every iteration: what
pulls is removed, what overlaps is returned, and where a system has no solution contacts are put
back.
"""

from lcp_piles import tss, z_algorithm
from lcp_piles.paper.figures_flowchart import flowchart_plate

picture = flowchart_plate("tss", 6).picture

# %%
# Where it ends, its forces are those of the linear complementarity problem.
found = z_algorithm(tss(6, floor_compliance="-1/2")).solution.forces
print(len(found), "forces")
