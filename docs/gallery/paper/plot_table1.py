"""
Table 1: where the network rearranges
=====================================

The pushes at which the contact network of NT30 with six layers changes, on three floors, beside the
23 values that the paper prints. Only the paper's floor has all of them, to the last digit.
"""

from matplotlib.figure import Figure

from lcp_piles import push_path, surd
from lcp_piles.paper.figures_table1 import printed

floors = {"0": "rigid floor", "1": "as soft as the discs", "-1/2": "the paper's floor"}
pushes = {
    floor: [r.push for r in push_path("nt30", 6, floor_compliance=floor).rearrangements]
    for floor in floors
}
paper = [surd(entry) * surd("sqrt(3)") for entry in printed()]
ax = Figure(figsize=(7, 3), layout="constrained").add_subplot()
rows = [*pushes.values(), paper]
ax.eventplot([[float(q) for q in row] for row in rows], linelengths=0.7, linewidths=0.8)
labels = [f"{name}: {floor} $\\tau$" for floor, name in floors.items()]
ax.set_yticks(range(4), [*labels, "printed in the paper"])
ax.set(xscale="log", xlabel="push $-q$  ($w\\tau$)", title="NT30, $N = 6$: rearrangements")
picture = ax

# %%
# How many of the exact pushes on each floor are printed in the table.
equal = {floor: len(set(found) & set(paper)) for floor, found in pushes.items()}
print(equal)
