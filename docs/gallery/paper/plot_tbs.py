"""
TBS: a tilted pile on a bumpy floor
===================================

Fifteen layers on held discs. Contacts are absent on the flanks and nowhere inside, and none of them
is vertical.
"""

from lcp_piles import solve, tbs
from lcp_piles.pictures import draw_network

pile = solve(tbs(15))
picture = draw_network(pile)

# %%
# The open contacts, and those among them that are vertical.
is_open = [c for c, state in zip(pile.scene.contacts, pile.states, strict=True) if state == "open"]
vertical = [c for c in is_open if not c.normal[0]]
print(len(is_open), len(vertical))
