"""`python -m lcp_piles` is the command `lcp-piles`."""

import sys

from .cli import main

sys.exit(main())
