"""Give a solution to other programs: ParaView, spreadsheets, LAMMPS and OVITO, numpy."""

from pathlib import Path
from tempfile import TemporaryDirectory

from lcp_piles import export, nt30, solve, table

pile = solve(nt30(6))
with TemporaryDirectory() as folder:
    for name in ("pile.vtp", "pile.csv", "pile.discs.csv", "pile.lammpstrj", "pile.local"):
        export(pile, Path(folder) / name)
    sizes = {file.name: file.stat().st_size for file in sorted(Path(folder).iterdir())}
contacts = table(pile)  # columns by name: contacts["force"], contacts["state"], ...
on_floor = contacts[contacts["b"] == "floor"]

if __name__ == "__main__":
    # In ParaView: open pile.vtp, filter Tube with "Vary Radius: By Scalar", scalar `force`.
    print("\n".join(f"{name}: {size} bytes" for name, size in sizes.items()))
    print(f"the floor carries {on_floor['force'].sum():.6f} w")
