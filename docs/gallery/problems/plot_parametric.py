"""
A parametric LCP: springs that touch one by one
===============================================

A plate is pressed down by t on springs of stiffness 1, 2 and 4 at distances 1, 4 and 5: the
solution is linear between exact breakpoints, for all t from 0 on.
"""

import numpy as np
from matplotlib.figure import Figure

from lcp_piles import parametric_lcp

M = [[1, 0, 0], [0, "1/2", 0], [0, 0, "1/4"]]  # gap = force / stiffness + distance - t
path = parametric_lcp(M, [1, 4, 5], [-1, -1, -1])
places = [0, *path.breakpoints, 8]
forces = np.array([[float(z) for z in path.z(t)] for t in places])
ax = Figure(figsize=(6, 3.8), layout="constrained").add_subplot()
looks = (("black", "-", "o"), ("#0072b2", "--", "s"), ("#d55e00", "-.", "^"))
for k, (colour, style, mark) in enumerate(looks):
    ax.plot(list(map(float, places)), forces[:, k], color=colour, linestyle=style, marker=mark)
ax.set(xlabel="displacement $t$ of the plate", ylabel="force of the spring")
ax.legend([f"spring {k}" for k in (1, 2, 3)], frameon=False)
picture = ax
print(path.breakpoints)
