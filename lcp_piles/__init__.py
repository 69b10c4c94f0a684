"""Exact static forces in granular piles of frictionless discs.

The way of the data, each stage a plain value: a scene (`nt30`, `nt60`, `tss`, `tbs`, or a `Scene`
of your own), its contact system, the linear complementarity problem of that, a solution. `solve`
goes all the way; `lemke` solves any exact LCP.

>>> from lcp_piles import nt60, solve
>>> solve(nt60(3)).force((3, 2), "floor")
3/2
"""

from .contact_lcp import contact_lcp
from .crosscheck import cross_check
from .errors import FileFormatError, InputError, LcpPilesError, SolveError
from .exact import Surd, decimal, floats_exactly, surd
from .intervals import prove_contacts
from .lcp import LCP, lcp
from .lemke import lemke
from .piles import nt30, nt60, pile, tbs, tss
from .push import push_path
from .read_result import load
from .scene import Contact, Disc, Scene
from .solution import Solution
from .solve import solve
from .sparse_exact import ExactSolver
from .system import contact_system
from .verify import verify

__version__ = "0.1.0"

__all__ = [
    "LCP",
    "Contact",
    "Disc",
    "ExactSolver",
    "FileFormatError",
    "InputError",
    "LcpPilesError",
    "Scene",
    "Solution",
    "SolveError",
    "Surd",
    "contact_lcp",
    "contact_system",
    "cross_check",
    "decimal",
    "floats_exactly",
    "lcp",
    "lemke",
    "load",
    "nt30",
    "nt60",
    "pile",
    "prove_contacts",
    "push_path",
    "solve",
    "surd",
    "tbs",
    "tss",
    "verify",
]
