"""A parametric LCP: a plate is pressed down by t on two springs, which touch it one by one.

z are the forces of the springs, w their gaps to the plate.
"""

from lcp_piles import parametric_lcp

M = [[1, 0], [0, "1/2"]]  # gap = force / stiffness + distance - t
path = parametric_lcp(M, [1, 4], [-1, -1])

if __name__ == "__main__":
    for piece in path.pieces:
        rates = ", ".join(map(str, piece.rate))
        print(f"from t = {piece.first}: the forces rise by {rates} per unit of t")
