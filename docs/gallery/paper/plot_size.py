"""
Forces against the size of the pile
===================================

The forces on disc (2,1) of TBS, by the letters of the paper, against the number of layers. The
paper asks whether they saturate.
"""

import csv

from lcp_piles.paper.figures_fields import size_plate

plate = size_plate("tbs", "adef", [2, 3, 4, 6, 8, 12, 16, 20, 25, 30, 40, 61])
picture = plate.picture

# %%
# They do, one after the other: with 61 layers the contact below the apex is open, and what its
# other contacts carry, a on disc (2,1), follows from its weight alone.
rows = csv.DictReader(plate.texts[".csv"].splitlines())
forces = {row["letter"]: row["force"] for row in rows if row["layers"] == "61"}
print(forces["a"])
