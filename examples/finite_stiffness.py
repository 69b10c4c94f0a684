"""What a simulation of soft discs should find, exactly to first order and in full."""

from lcp_piles import deform, first_order, nt60, solve

TAU = "1/1000"
rigid = solve(nt60(2))
soft = first_order(rigid)
force = soft.force((1, 1), (2, 1), TAU)
full = deform(soft, 1e-3)

if __name__ == "__main__":
    print(f"rigid {rigid.force((1, 1), (2, 1))}, to first order {force}")
    print(f"the whole nonlinear pile: {full.forces[0]:.12f}")
