"""A packing in floats, as a DEM code leaves it: its forces proved, and exact ones next to it."""

from lcp_piles import packing, prove_packing, solve_packing

centres = [(0.52, 0.419), (1.463, 0.528), (2.502, 0.508), (0.794, 1.244), (2.018, 1.359)]
radii = [0.42, 0.53, 0.51, 0.45, 0.47]
heap = packing(
    centres,
    radii,
    weights=1.0,
    supports={"floor": 0.0, "left": 0.1, "right": 3.013},
    tolerance=0.05,
    stiffness=1e3,
)
proof = prove_packing(heap)  # of exactly these floats
near = solve_packing(heap, angle=1e-6)  # of rational normals, a millionth away at most

if __name__ == "__main__":
    for k in range(len(heap.a)):
        force, radius = proof.forces.middle[k], proof.forces.radius[k]
        print(f"{heap.contact_name(k):10} {force:12.9f} +- {radius:.0e}")
    print(f"proved: {proof.proved}; the exact forces are within {near.force_change:.0e}")
