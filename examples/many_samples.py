"""Many disordered piles at once, in processes: random initial gaps, and the mean pressure."""

from lcp_piles import Ensemble, Uniform, ensemble, tbs

SAMPLES = 64


def main() -> Ensemble:
    """Samples of TBS whose gaps are off by up to 5 w tau, each proved."""
    return ensemble(tbs(6), Uniform(5), SAMPLES, seed=1)  # out="folder" would keep them


if __name__ == "__main__":
    found = main().statistics
    assert found is not None
    print(f"contacts with force: {found.numbers['contacts with force']}")
    x, pressure = found.observables.base, found.base_pressure
    for place, mean, error in zip(x, pressure.value, pressure.error, strict=True):
        print(f"x = {place:+.0f} R: {mean:.3f} +- {error:.3f} w")
