"""
A game: best responses and the equilibrium
==========================================

A game of two players in which one gains what the other loses: the best response of each to the mix
of the other, and the equilibrium, found exactly, where they meet.
"""

from matplotlib.figure import Figure

from lcp_piles import nash

A, B = [[2, -1], [-1, 1]], [[-2, 1], [1, -1]]
game = nash(A, B)
p, q = float(game.x[0]), float(game.y[0])
ax = Figure(figsize=(4.6, 4.8), layout="constrained").add_subplot()
ax.plot([0, 0, 1, 1], [0, q, q, 1], color="#0072b2", label="best of the first player")
ax.plot([0, p, p, 1], [1, 1, 0, 0], "--", color="#d55e00", label="best of the second player")
ax.plot(p, q, "ko", markersize=9, fillstyle="none", label="equilibrium")
ax.set(xlabel="first player's share of strategy 1", ylabel="second player's share of strategy 1")
ax.get_figure().legend(loc="outside upper center", frameon=False)
picture = ax
print(game.x, game.y, game.payoffs)
