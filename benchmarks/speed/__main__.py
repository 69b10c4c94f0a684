"""All tables of `notes/speed.md`: cold Lemke, then exact at scale.

python -m benchmarks.speed [--quick]
"""

from __future__ import annotations

import sys

from benchmarks.speed import at_scale, cold_lemke

if __name__ == "__main__":
    cold_lemke.main()
    print()
    at_scale.main("--quick" in sys.argv[1:])
