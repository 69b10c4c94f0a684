"""Many disordered piles at once, in processes: random initial gaps, a field of each."""

from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from fractions import Fraction
from random import Random

from lcp_piles import coordination, solve, surd, tbs

SAMPLES = 8


def mean_coordination(seed: int) -> Fraction:
    """The mean coordination number of TBS whose gaps are off by up to 5 w tau."""
    random = Random(seed)
    scene = tbs(6)
    contacts = [
        replace(contact, gap=surd(Fraction(random.randint(-500, 500), 100)))
        for contact in scene.contacts
    ]
    return coordination(solve(replace(scene, contacts=tuple(contacts)))).mean


def main() -> list[Fraction]:
    """The samples, each in one of two processes."""
    with ProcessPoolExecutor(2) as pool:
        return list(pool.map(mean_coordination, range(SAMPLES)))


if __name__ == "__main__":
    means = main()
    print(f"mean coordination of {SAMPLES} samples: {float(sum(means) / SAMPLES):.4f}")
