"""All tables of `notes/speed.md` and of `notes/packings.md`.

python -m benchmarks.speed [--quick]
"""

from __future__ import annotations

import sys

from benchmarks.speed import at_scale, cold_lemke, packings

if __name__ == "__main__":
    cold_lemke.main()
    print()
    at_scale.main("--quick" in sys.argv[1:])
    print()
    packings.main()
