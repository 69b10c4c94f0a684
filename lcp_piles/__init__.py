"""Exact static forces in granular piles of frictionless discs.

The way of the data, each stage a plain value: a scene (`nt30`, `nt60`, `tss`, `tbs`, or a `Scene`
of your own), its contact system, the linear complementarity problem of that, a solution. `solve`
goes all the way; `lemke` solves any exact LCP.

>>> from lcp_piles import nt60, solve
>>> solve(nt60(3)).force((3, 2), "floor")
3/2
"""

from .crosscheck import cross_check
from .deformation.correction import FirstOrder, NoFirstOrder
from .deformation.first_order import first_order
from .deformation.laws import HERTZ, HOOKE, Law
from .deformation.nonlinear import Deformed, deform
from .errors import FileFormatError, InputError, LcpPilesError, NotSolvedError, SolveError
from .fields.registry import FIELDS
from .files.read_result import load
from .files.write_result import save
from .linear.sparse_exact import ExactSolver
from .mechanics.contact_lcp import contact_lcp
from .mechanics.system import contact_system
from .methods.bounds import prove_contacts
from .numbers.exact import Surd, decimal, floats_exactly, surd
from .pivoting.lcp import LCP, lcp
from .pivoting.lemke import lemke
from .push.push_path import push_path
from .scenes.piles import nt30, nt60, pile, tbs, tss
from .scenes.scene import Contact, Disc, Scene
from .solution.solution import Solution, Solved, Unresolved, Unstable
from .solution.verify import verify
from .solve import solve

__version__ = "0.1.0"

__all__ = [
    "FIELDS",
    "HERTZ",
    "HOOKE",
    "LCP",
    "Contact",
    "Deformed",
    "Disc",
    "ExactSolver",
    "FileFormatError",
    "FirstOrder",
    "InputError",
    "Law",
    "LcpPilesError",
    "NoFirstOrder",
    "NotSolvedError",
    "Scene",
    "Solution",
    "SolveError",
    "Solved",
    "Surd",
    "Unresolved",
    "Unstable",
    "contact_lcp",
    "contact_system",
    "cross_check",
    "decimal",
    "deform",
    "first_order",
    "floats_exactly",
    "lcp",
    "lemke",
    "load",
    "nt30",
    "nt60",
    "pile",
    "prove_contacts",
    "push_path",
    "save",
    "solve",
    "surd",
    "tbs",
    "tss",
    "verify",
]
