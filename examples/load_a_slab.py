"""A load on top of a slab: where its base feels it most, and from which load on in two places."""

from lcp_piles import loaded, point_load, slab, solve

width, height = 7, 3
top = (1, (width + 1) // 2)
load = point_load(slab(width, height), top)
first = load.splits[0]

# Without gravity all of it goes down two straight chains.
chains = solve(loaded(slab(width, height, sides="free", weight=0), top, (0, -1)))

if __name__ == "__main__":
    for split in load.splits:
        places = " ".join(f"{float(x):+g}" for x in split.after)
        print(f"from {float(split.load):.6g} w on the largest response is at x = {places}")
    print({str(force) for force in chains.forces if force})
