"""Exact static forces in granular piles of frictionless discs.

The way of the data, each stage a plain value: a scene (`nt30`, `nt60`, `tss`, `tbs`, or a `Scene`
of your own), its contact system, the linear complementarity problem of that, a solution. `solve`
goes all the way; `lemke` solves any exact LCP.

>>> from lcp_piles import nt60, solve
>>> solve(nt60(3)).force((3, 2), "floor")
3/2
"""

from .bases.mixed_lcp import mixed_lcp
from .bases.prove_lcp import LCPProof, prove_lcp
from .bases.solve_lcp import LCPSolution, solve_lcp
from .certificates.certify import certificate, save_certificate
from .certificates.friction import bound_certificate, bounds_certificate
from .certificates.lcp import lcp_certificate
from .checking.check import check
from .crosscheck import cross_check
from .deformation.correction import FirstOrder, NoFirstOrder
from .deformation.first_order import first_order
from .deformation.laws import HERTZ, HOOKE, Law
from .deformation.nonlinear import Deformed, deform
from .deformation.slide import Slide, slide
from .disorder.draws import Normal, Radii, Uniform
from .disorder.family import PileFamily, pile_family
from .disorder.gap_grid import drawn
from .disorder.proved_sample import Sample, proved_sample
from .ensembles.ensemble import Ensemble, ensemble, read_ensemble
from .errors import (
    FileFormatError,
    InputError,
    LcpPilesError,
    MissingExtraError,
    NotConvexError,
    NotSolvedError,
    SolveError,
    VerificationError,
)
from .fields.base_load import base_load
from .fields.base_pressure import base_pressure
from .fields.continuum import continuum
from .fields.coordination import coordination
from .fields.depressions import depressions, dip, sags
from .fields.fabric import fabric
from .fields.letters import contact_by_letter, letter_force
from .fields.point_load import point_load
from .fields.registry import FIELDS
from .fields.stress import stress
from .fields.support_forces import support_forces
from .files.export import export
from .files.graph import graph
from .files.read_forces import read_forces
from .files.read_packing import read_packing
from .files.read_result import load
from .files.scene_file import load_scene, save_scene
from .files.solution_tables import data_frame, table
from .files.write_result import save
from .friction.critical_friction import critical_friction
from .friction.extremes import extremes
from .friction.first_loading import first_loading
from .friction.force_bounds import contact_bounds, force_bounds
from .friction.indeterminacy import indeterminacy
from .friction.loading_search import all_first_loadings
from .games.equilibrium import Equilibrium
from .games.nash import nash, nash_equilibria
from .interactive.view import View, view
from .linear.sparse_exact import ExactSolver
from .mechanics.contact_lcp import contact_lcp
from .mechanics.contradiction import ContradictionError
from .mechanics.system import contact_system
from .methods.bounds import prove_contacts
from .methods.contact_proof import ContactProof
from .methods.packings.prove import prove_packing
from .methods.registry import METHODS
from .methods.z.z_algorithm import z_algorithm
from .methods.z.z_lcp import z_lcp
from .numbers.exact import Surd, decimal, floats_exactly, surd
from .packings.build import packing
from .packings.from_contacts import from_contacts
from .packings.packing import Packing
from .packings.rational import rational_scene
from .packings.walls import Wall
from .paper.compare import compare
from .paper.size_dependence import size_dependence
from .pivoting.lcp import LCP, lcp
from .pivoting.lemke import lemke
from .pivoting.parametric_lcp import parametric_lcp
from .programs.linear_program import linear_program
from .programs.quadratic_program import quadratic_program
from .push.continuation import continuation
from .push.push_path import push_path
from .scenes.grid import Hold, Support
from .scenes.kinds import KINDS, pile
from .scenes.lattice import lattice
from .scenes.nt30 import nt30
from .scenes.nt60 import nt60
from .scenes.pyramid import pyramid
from .scenes.scene import Contact, Disc, Scene
from .scenes.silo import silo
from .scenes.slab import slab
from .scenes.tbs import tbs
from .scenes.tetrahedron import tetrahedron
from .scenes.tss import tss
from .scenes.variants import bilateral, loaded
from .solution.loose import falling, rattlers
from .solution.solution import Solution, Solved, Unresolved, Unstable
from .solution.verify import verify
from .solve import solve
from .solve_packing import NearSolution, solve_packing

__version__ = "0.1.0"

__all__ = [
    "FIELDS",
    "HERTZ",
    "HOOKE",
    "KINDS",
    "LCP",
    "METHODS",
    "Contact",
    "ContactProof",
    "ContradictionError",
    "Deformed",
    "Disc",
    "Ensemble",
    "Equilibrium",
    "ExactSolver",
    "FileFormatError",
    "FirstOrder",
    "Hold",
    "InputError",
    "LCPProof",
    "LCPSolution",
    "Law",
    "LcpPilesError",
    "MissingExtraError",
    "NearSolution",
    "NoFirstOrder",
    "Normal",
    "NotConvexError",
    "NotSolvedError",
    "Packing",
    "PileFamily",
    "Radii",
    "Sample",
    "Scene",
    "Slide",
    "Solution",
    "SolveError",
    "Solved",
    "Support",
    "Surd",
    "Uniform",
    "Unresolved",
    "Unstable",
    "VerificationError",
    "View",
    "Wall",
    "all_first_loadings",
    "base_load",
    "base_pressure",
    "bilateral",
    "bound_certificate",
    "bounds_certificate",
    "certificate",
    "check",
    "compare",
    "contact_bounds",
    "contact_by_letter",
    "contact_lcp",
    "contact_system",
    "continuation",
    "continuum",
    "coordination",
    "critical_friction",
    "cross_check",
    "data_frame",
    "decimal",
    "deform",
    "depressions",
    "dip",
    "drawn",
    "ensemble",
    "export",
    "extremes",
    "fabric",
    "falling",
    "first_loading",
    "first_order",
    "floats_exactly",
    "force_bounds",
    "from_contacts",
    "graph",
    "indeterminacy",
    "lattice",
    "lcp",
    "lcp_certificate",
    "lemke",
    "letter_force",
    "linear_program",
    "load",
    "load_scene",
    "loaded",
    "mixed_lcp",
    "nash",
    "nash_equilibria",
    "nt30",
    "nt60",
    "packing",
    "parametric_lcp",
    "pile",
    "pile_family",
    "point_load",
    "prove_contacts",
    "prove_lcp",
    "prove_packing",
    "proved_sample",
    "push_path",
    "pyramid",
    "quadratic_program",
    "rational_scene",
    "rattlers",
    "read_ensemble",
    "read_forces",
    "read_packing",
    "sags",
    "save",
    "save_certificate",
    "save_scene",
    "silo",
    "size_dependence",
    "slab",
    "slide",
    "solve",
    "solve_lcp",
    "solve_packing",
    "stress",
    "support_forces",
    "surd",
    "table",
    "tbs",
    "tetrahedron",
    "tss",
    "verify",
    "view",
    "z_algorithm",
    "z_lcp",
]
