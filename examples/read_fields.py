"""What is read off a solution: stress, pressure on the base, fabric, and every other field."""

from lcp_piles import FIELDS, base_pressure, dip, fabric, nt30, solve, stress

pile = solve(nt30(6))
tensor = stress(pile).of((1, 1))  # pi sigma of the apex, exact
hollow = dip(base_pressure(pile))  # the depression under the apex
shares = fabric(pile).pile  # xx, xy, yy of the fabric tensor

if __name__ == "__main__":
    print(f"stress of the apex, times pi: {[[str(x) for x in row] for row in tensor]}")
    print(f"depth of the dip: {hollow.depth} w, {hollow.width} radii wide")
    print(f"fabric: {[str(x) for x in shares]}")
    for field in FIELDS.values():
        rows = field.table(field.compute(pile)).rows
        print(f"{field.name}: {len(rows)} rows; {field.title}")
