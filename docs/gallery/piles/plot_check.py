"""
Checking a simulation
=====================

The forces of a simulation of soft discs held against the exact ones: contacts in the colour of the
difference, as wide as its size.
"""

from lcp_piles import check, deform, first_order, nt30, solve
from lcp_piles.pictures import draw_check

pile = solve(nt30(6, push="20"))
soft = first_order(pile)
at_rest = deform(soft, 1e-3)  # in place of a simulation
theirs = {(c.a, c.b): f for c, f in zip(pile.scene.contacts, at_rest.forces, strict=True)}
found = check(pile, theirs, tolerance=1e-4)
picture = draw_check(found)

# %%
# The largest difference is that of the compliance: the largest first-order term times 1/1000.
expected = max(abs(float(rate)) for rate in soft.forces) * 1e-3
print(found.verdict, found.largest, expected)
