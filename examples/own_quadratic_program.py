"""A convex quadratic programme: the least risk of a portfolio that earns at least 11/100.

Exact shares, and the exact price of what is asked for: its multipliers.
"""

from lcp_piles import quadratic_program

covariance = [["1/10", 0, 0], [0, "1/25", "1/50"], [0, "1/50", "1/5"]]
gain = ["1/20", "1/10", "3/20"]
result = quadratic_program(
    covariance,
    [0, 0, 0],
    [[1, 1, 1]],  # the shares add up
    [1],
    G=[[f"-{g}" for g in gain]],  # G x <= h: the gain is at least
    h=["-11/100"],
    lower=[0, 0, 0],  # nothing is sold short
)

if __name__ == "__main__":
    shares = ", ".join(map(str, result.x))
    print(f"{result.status}: shares {shares}; a unit of gain costs {result.z[0]} in risk")
