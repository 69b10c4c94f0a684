"""Hold the forces of a simulation against ours, and take out what its stiffness explains."""

from lcp_piles import check, deform, first_order, nt30, solve
from lcp_piles.checking.conclusions import conclusions

TAU = "1/1000"  # compliance of the simulated discs: radii a disc weight
pile = solve(nt30(6, push="20"))

# In place of a simulation, whose forces `read_forces` would read from a table or a dump of LAMMPS:
# the pile of such discs at rest, in newtons, with compression negative.
WEIGHT = 0.0123
at_rest = deform(first_order(pile), 1e-3)
theirs = {(c.a, c.b): -WEIGHT * f for c, f in zip(pile.scene.contacts, at_rest.forces, strict=True)}

rigid = check(pile, theirs, weight=WEIGHT, tolerance=1e-4)
soft = check(pile, theirs, weight=WEIGHT, tolerance=1e-4, tau=TAU)

if __name__ == "__main__":
    for found in (rigid, soft):
        print(f"off by {found.largest:.2g} w at most: {found.verdict}")
        print("\n".join(f"  {sentence}" for sentence in conclusions(found)))
