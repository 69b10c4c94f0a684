"""
Friction: the interval of every force
=====================================

With friction balance leaves forces free. The pale line of each contact is as wide as its largest
force under Coulomb's law, the black one as its least; a red one has no largest force.
"""

from lcp_piles import contact_bounds, nt60
from lcp_piles.pictures import draw_bounds

bounds = contact_bounds(nt60(4), "1/4")
picture = draw_bounds(bounds)

# %%
# Both ends are exact, and proved by a linear programme and its dual. A thrust between the held
# corner stones can be as large as one likes.
contacts = bounds.scene.contacts
unbounded = [(c.a, c.b) for c, most in zip(contacts, bounds.largest, strict=True) if most is None]
print(unbounded)
