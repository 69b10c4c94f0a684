"""Any linear complementarity problem w = M z + q, z >= 0, w >= 0, z . w = 0, exactly."""

from lcp_piles import lemke

M = [[2, 1], [1, 2]]
q = ["-5", "-6"]
result = lemke(M, q)

if __name__ == "__main__":
    z = ", ".join(map(str, result.z))
    print(f"{result.status} in {result.pivots} pivots: z = ({z})")
