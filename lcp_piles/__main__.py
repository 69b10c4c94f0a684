"""`python -m lcp_piles` is the command `lcp-piles`."""

import sys

from .cli.parser import main

sys.exit(main())
