"""A scene of your own: plain numbers, discs and the contacts they may make."""

from lcp_piles import Contact, Disc, Scene, solve

# A ball in the corner of a floor and a wall, with another one leaning on it.
discs = [
    Disc("ball", position=(0, 0), load=(0, -1), held=(None, None)),
    Disc("other", position=("1", "sqrt(3)"), load=(0, -1), held=(None, None)),
    Disc("stone", position=(2, 0), load=(0, 0), held=(0, 0)),
]
contacts = [
    Contact("ball", "floor", normal=(0, 1)),
    Contact("ball", "wall", normal=(1, 0)),
    Contact("other", "ball", normal=("1/2", "1/2*sqrt(3)")),
    Contact("other", "stone", normal=("-1/2", "1/2*sqrt(3)"), gap="0.1"),
    Contact("stone", "ball", normal=(1, 0)),
]
solution = solve(Scene(discs, contacts, supports=("floor", "wall")))

if __name__ == "__main__":
    for contact, force, state in zip(contacts, solution.forces, solution.states, strict=True):
        print(f"{contact.a} - {contact.b}: {force} w, {state}")
