"""What is left of self-stress in wide disorder: the bottom row between two held corner stones.

    python -m benchmarks.disorder.base_chain

counts, over samples at amplitude 10,000 w tau, how many self-stresses a pile has where all contacts
of the bottom row carry a force, and how many where not.
"""

from __future__ import annotations

from collections import Counter

from lcp_piles import Uniform, pile, pile_family, proved_sample

SAMPLES = 600
AMPLITUDE = 10_000


def counts(kind: str, layers: int, samples: int = SAMPLES) -> Counter[tuple[bool, int]]:
    """How many samples have (the bottom row closed or not, so many self-stresses)."""
    family = pile_family(pile(kind, layers=layers))
    discs = {disc.id: disc.position[1] for disc in family.scene.discs}
    lowest = min(discs.values())
    row = [k for k, c in enumerate(family.contacts) if discs[c.a] == discs.get(c.b) == lowest]
    found: Counter[tuple[bool, int]] = Counter()
    for k in range(samples):
        sample = proved_sample(family, Uniform(AMPLITUDE), seed=7, k=k)
        stresses = int(sample.closed.sum()) - family.freedoms + sample.mechanisms
        found[bool(sample.closed[row].all()), stresses] += 1
    return found


def main() -> None:
    """Print the table."""
    print("| pile | bottom row | self-stresses | samples |\n|---|---|---|---|")
    for kind, layers in (("nt30", 6), ("nt60", 8)):
        for (closed, stresses), number in sorted(counts(kind, layers).items()):
            state = "closed" if closed else "open"
            print(f"| {kind.upper()} {layers} | {state} | {stresses} | {number} |")


if __name__ == "__main__":
    main()
