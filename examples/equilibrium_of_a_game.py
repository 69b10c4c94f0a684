"""A Nash equilibrium of a game of two players: rock, paper, scissors, paper winning twice."""

from lcp_piles import nash

A = [[0, -2, 1], [2, 0, -1], [-1, 1, 0]]
B = [[-payoff for payoff in row] for row in A]
game = nash(A, B)

if __name__ == "__main__":
    shares = ", ".join(map(str, game.x))
    print(f"rock, paper and scissors with probabilities {shares}; payoffs {game.payoffs}")
