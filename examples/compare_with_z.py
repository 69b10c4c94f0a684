"""Lemke's method against the Z algorithm of the paper, on the same piles."""

from lcp_piles import compare

comparisons = compare("tss", range(2, 9))

if __name__ == "__main__":
    for c in comparisons:
        print(f"{c.layers} layers: {c.pivots} pivots, {c.iterations} systems of Z, equal {c.equal}")
