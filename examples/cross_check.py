"""Hold an exact solution against floating point that shares no code with the pivots."""

from lcp_piles import cross_check, solve, tbs

check = cross_check(solve(tbs(10)))

if __name__ == "__main__":
    print(f"largest difference of a force: {check.largest_difference:.1e} w")
    for contact, exact, floating in check.differing:
        print(f"{contact.a}-{contact.b}: {exact} exactly, {floating} in floating point")
