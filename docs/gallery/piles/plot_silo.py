"""
A silo: what the walls carry
============================

Between smooth walls the floor bears all that is filled in. Bumpy walls bear a part, and in the end
all that is added.
"""

from matplotlib.figure import Figure

from lcp_piles import silo, solve
from lcp_piles.pictures import draw_network, draw_profile


def base_load(solution):
    """What the floor bears, in weights of a disc."""
    forces = zip(solution.scene.contacts, solution.force_array, strict=True)
    return sum(force for contact, force in forces if contact.b == "floor")


heights = (2, 4, 6, 8, 12, 16, 20)
loads = {
    f"{walls} walls": [base_load(solve(silo(4, height, walls=walls))) for height in heights]
    for walls in ("smooth", "bumpy")
}
figure = Figure(figsize=(8, 4.5), layout="constrained")
left, right = figure.subplots(1, 2, width_ratios=(1, 2))
draw_network(solve(silo(4, 10, walls="bumpy")), left)
draw_profile(heights, loads, right, xlabel="rows", ylabel="load on the floor  ($w$)")
right.set_xticks(heights)
picture = figure
