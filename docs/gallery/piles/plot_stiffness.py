"""
Finite stiffness: the first order, and the whole nonlinear pile
===============================================================

One disc on two held ones, NT60 with two layers: its force beyond the rigid limit against the
compliance, exactly to first order, and with the geometry of overlapping discs.
"""

import numpy as np
from matplotlib.figure import Figure

from lcp_piles import deform, first_order, nt60, solve

soft = first_order(solve(nt60(2)))
rate = soft.force((1, 1), (2, 1), 1) - soft.force((1, 1), (2, 1), 0)
compliances = np.geomspace(1e-4, 0.1, 7)
first = compliances * float(rate)
full = [deform(soft, tau).forces[0] - 1 / np.sqrt(3) for tau in compliances]
ax = Figure(figsize=(6, 4), layout="constrained").add_subplot()
ax.loglog(compliances, full, "ks", markersize=4, label="nonlinear pile")
ax.loglog(compliances, first, "-", color="#0072b2", label=f"first order, ${rate}\\,\\tau$")
ax.loglog(compliances, abs(full - first), "--", color="#d55e00", label="their difference")
ax.set(xlabel="compliance $\\tau$  ($R/w$)", ylabel="force less its rigid limit  ($w$)")
ax.set_title("NT60, $N = 2$")
ax.legend(frameon=False)
picture = ax
