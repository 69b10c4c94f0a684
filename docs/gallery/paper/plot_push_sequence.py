"""
Pushing the corner stones: the sequence
=======================================

NT30 at some of the pushes of the paper's Table 1, and far beyond the last: the network, the force
on the floor, and the principal axes of the stress, on the paper's floor.
"""

from lcp_piles import push_path
from lcp_piles.paper.figures_push import push_sequence_plate

picture = push_sequence_plate(6, (4, 12, 19)).picture

# %%
# The push of the fourth rearrangement, exactly.
fourth = push_path("nt30", 6, floor_compliance="-1/2").rearrangements[3].push
print(fourth)
