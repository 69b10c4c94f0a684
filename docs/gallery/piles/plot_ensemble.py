"""
Disorder: the distribution of forces
====================================

Random initial gaps in TBS, every sample proved: the distribution of the forces over their mean.
"""

from concurrent.futures import ThreadPoolExecutor

from lcp_piles import Uniform, ensemble, tbs
from lcp_piles.pictures.ensemble_pictures import draw_force_density

with ThreadPoolExecutor(1) as pool:
    found = ensemble(tbs(6), Uniform(5), 100, seed=1, executor=pool)
picture = draw_force_density(found)

# %%
# How many contacts carry a force in a sample, on average.
closed = found.statistics.numbers["contacts with force"].value
print(float(closed))
