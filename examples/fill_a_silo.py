"""A silo: smooth walls carry nothing, bumpy ones in the end all that is filled in."""

from lcp_piles import Scene, silo, solve


def base_load(scene: Scene) -> float:
    """What the floor bears, in weights of a disc."""
    solution = solve(scene)
    forces = zip(scene.contacts, solution.force_array, strict=True)
    return sum(force for contact, force in forces if contact.b == "floor")


heights = (5, 10, 20, 40)
smooth = [base_load(silo(4, height, walls="smooth")) for height in heights]
bumpy = [base_load(silo(4, height, walls="bumpy")) for height in heights]

if __name__ == "__main__":
    for height, one, other in zip(heights, smooth, bumpy, strict=True):
        print(f"{height:3d} rows: {one:.6g} w on the floor, {other:.6g} w with bumpy walls")
