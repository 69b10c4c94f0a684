"""Problems on which the Z iteration is known to cycle, with their published solutions."""

from __future__ import annotations

from fractions import Fraction

from lcp_piles import Contact, Disc, Scene, surd

# A symmetric positive definite LCP. From z_1 basic the sets are {1}, {2}, {1, 2, 3}, {1}.
DEFINITE_M = [[5, -4, 3], [-4, 6, -3], [3, -3, 2]]
DEFINITE_Q = [1, -7, 3]
DEFINITE_Z = (Fraction(11, 7), Fraction(31, 14), Fraction(0))

# Ben Gharbia and Gilbert (2012): a P-matrix of order 3; the solution is z = 0.
GILBERT_M = [[1, 0, 2], [2, 1, 0], [0, 2, 1]]
GILBERT_Q = [1, 1, 1]

# One grain between two springs and three walls: f_i = max(0, c_i . u - q_i). From all contacts
# closed the closed sets are {1, 3}, and then {}, {2, 3}, {1, 3} for ever; in the solution only
# f_3 = 13/21 is not zero.
GRAIN_C = [(0, 4), (4, -2), (2, -4)]
GRAIN_Q = [14, -1, -13]
GRAIN_F = (Fraction(0), Fraction(0), Fraction(13, 21))


def grain_lcp() -> tuple[list[list[int]], list[int]]:
    """The grain as an LCP in the forces: u = -sum c_i f_i, so w = (C C^T + I) f + q."""
    rows = [
        [sum(x * y for x, y in zip(a, b, strict=True)) + (i == j) for j, b in enumerate(GRAIN_C)]
        for i, a in enumerate(GRAIN_C)
    ]
    return rows, GRAIN_Q


def grain_scene() -> Scene:
    """The same as a disc: with unit normals -c/|c| the compliance is 1/|c|^2, the gap q/|c|.

    Contacts 0 and 1 are the springs, 2 to 4 the walls; a wall's force is |c_i| f_i.
    """
    disc = Disc((1,), (surd(0), surd(0)), (surd(0), surd(0)), (None, None))
    springs = [
        Contact((1,), name, normal, bilateral=True)
        for name, normal in (("spring x", (surd(1), surd(0))), ("spring y", (surd(0), surd(1))))
    ]
    walls = []
    for i, (c, q) in enumerate(zip(GRAIN_C, GRAIN_Q, strict=True)):
        square = sum(x * x for x in c)
        inverse = surd(f"sqrt({square})") / square
        normal = tuple(-inverse * x for x in c)
        walls.append(Contact((1,), f"wall {i + 1}", normal, Fraction(1, square), inverse * q))
    contacts = (*springs, *walls)
    return Scene((disc,), contacts, tuple(contact.b for contact in contacts))
