"""
Speed against accuracy
======================

Recorded rows of the comparison: time and error of every method on NT30 with 20 layers. On the
shaded line there is no error.
"""

from pathlib import Path

import matplotlib.pyplot as plt

import benchmarks.comparison
from benchmarks.comparison import csv_rows
from benchmarks.comparison.chart_of_precision import precision_chart
from benchmarks.comparison.table import of, points

rows = csv_rows.read(Path(benchmarks.comparison.__file__).parent / "results" / "methods.csv")
found = points(rows)
picture = precision_chart(found, ["nt30 20"])
plt.close(picture)

# %%
# The exact method by default, and how long it took.
(proved,) = of(found, "nt30 20", "proved")
print(proved.error, proved.seconds)
