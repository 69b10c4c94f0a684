"""Spheres in a square pyramid: what every place under it bears, exactly, and its picture."""

from lcp_piles import base_load, pyramid, solve

pile = solve(pyramid(3))
loads = {place.disc: place.load for place in base_load(pile)}

if __name__ == "__main__":
    from lcp_piles.pictures import draw_solid, save

    for (_, i, j), load in loads.items():
        print(f"row {i}, column {j}: {load} = {float(load):.4f} w")
    save(draw_solid(pile), "pyramid.png")
