"""Solve a pile of the paper, and ask for forces, states and stability."""

from lcp_piles import nt30, solve

pile = solve(nt30(6, push="20"))  # both corner stones pushed in by 20 w tau

force = pile.force((6, 2), "floor")  # exact, a sympy number
largest = pile.force_array.max()  # all forces as numpy floats, in the order of scene.contacts

if __name__ == "__main__":
    print(f"force of disc (6,2) on the floor: {force}")
    print(f"largest force: {largest:.6g} w")
    print(f"contacts: {pile.count('closed')} closed, {pile.count('open')} open")
    print(f"stability: {pile.stability.verdict}")
