"""
An LCP: where a membrane lies on the floor
==========================================

A membrane under its weight, held at height 16 along the rim of a square above a flat floor: z is
its height, w the force of the floor. Which points touch is proved, without the digits of the exact
solution.
"""

import numpy as np
from matplotlib.figure import Figure
from scipy.sparse import csr_array, eye_array, kron

from lcp_piles import prove_lcp

n, height, weight = 24, 16, 1
line = 2 * eye_array(n, dtype=int) - eye_array(n, k=1, dtype=int) - eye_array(n, k=-1, dtype=int)
M = csr_array(kron(line, eye_array(n, dtype=int)) + kron(eye_array(n, dtype=int), line))
rim = M @ np.ones(n * n, dtype=int)  # how many neighbours of each point are on the rim
proof = prove_lcp(M, (weight - height * rim).tolist())
z = proof.z.middle.reshape(n, n)
touches = ~proof.support.reshape(n, n)

# %%
# Inside the white line the membrane lies on the floor.
ax = Figure(figsize=(5.6, 4.6), layout="constrained").add_subplot()
image = ax.imshow(z, cmap="viridis", origin="lower")
ax.contour(touches, levels=[0.5], colors="white", linewidths=1.5)
ax.get_figure().colorbar(image, label="height above the floor")
ax.set(xlabel="column of the grid", ylabel="row of the grid")
ax.set_title(f"{touches.sum()} of {n * n} points on the floor, proved")
picture = ax
