"""Keep a solution as a file; loading it checks again what it claims."""

from pathlib import Path
from tempfile import TemporaryDirectory

from lcp_piles import load, nt60, save, solve, verify

pile = solve(nt60(4, push="1/2"))
with TemporaryDirectory() as folder:
    file = Path(folder) / "nt60.json"
    save(pile, file)
    size = file.stat().st_size
    again = load(file)
check = verify(again.scene, again)

if __name__ == "__main__":
    print(f"{size} bytes; forces equal: {list(again.forces) == list(pile.forces)}; {check.ok}")
