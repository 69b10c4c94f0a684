"""A mixed LCP: a free variable, the pressure, goes with an equation in place of a contact's pair.

Two springs of stiffness 1 and 2 carry a plate under the load 6 against stops at distances 1 and 4:
the forces are f_i = max(0, k_i (p - s_i)) with p, the plate's displacement, free.
"""

from lcp_piles import mixed_lcp

#    f_1    f_2   p
M = [
    [1, 0, -1],  # w_1 = f_1 / k_1 - p + s_1
    [0, "1/2", -1],
    [1, 1, 0],  # 0 = f_1 + f_2 - 6
]
result = mixed_lcp(M, [1, 4, -6], free=[2])

if __name__ == "__main__":
    *forces, displacement = result.z
    print(f"forces {', '.join(map(str, forces))}; displacement {displacement}")
