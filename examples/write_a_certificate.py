"""A proof in a file, for someone who has not got this package: `check_certificate.py` is enough."""

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from lcp_piles import certificate, save_certificate, solve, tss
from lcp_piles.certificates import check_certificate

entry = certificate(solve(tss(3)))
with TemporaryDirectory() as folder:
    file = Path(folder) / "tss.json"
    save_certificate(entry, file)
    # Isolated (-I): the checker is a file of its own, and sees nothing of the package.
    words = [sys.executable, "-I", check_certificate.__file__, file]
    proved = subprocess.run(words, capture_output=True, text=True, check=True).stdout

if __name__ == "__main__":
    print(proved)
