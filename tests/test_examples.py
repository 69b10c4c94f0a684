"""Every example runs, and one number of each is the one expected.

Expected numbers are the paper's, closed forms, worked out by hand, or those of another method:
which of these, stands beside each.
"""

from __future__ import annotations

import pkgutil
from fractions import Fraction
from importlib import import_module

import pytest

import examples
from lcp_piles import Uniform, drawn, nt30, push_path, solve, surd, tbs

EXAMPLES = sorted(module.name for module in pkgutil.iter_modules(examples.__path__))


def solve_a_pile(example) -> None:
    """Cold Lemke, and the force at the same push on a path that started from no push."""
    other = solve(nt30(6, push=20), "lemke")
    assert example.force == other.force((6, 2), "floor")
    assert example.force == push_path("nt30", 6, until=20).force((6, 2), "floor", 20).sympy()


def own_scene(example) -> None:
    """The upper ball is carried by two at 60 degrees; the lower one bears itself and half of it."""
    solution = example.solution
    assert solution.forces[solution.contact_index("ball", "floor")] == surd("3/2")
    assert solution.forces[solution.contact_index("other", "stone")] == surd("1/3*sqrt(3)")


def own_lcp(example) -> None:
    """w = 0 where z > 0: 2 a + b = 5, a + 2 b = 6."""
    assert tuple(example.result.z) == (Fraction(4, 3), Fraction(7, 3))


def equilibrium_of_a_game(example) -> None:
    """By hand, the mix x with A^T x = 0: each of the other's strategies earns as much."""
    assert example.game.x == (Fraction(1, 4), Fraction(1, 4), Fraction(1, 2))
    assert example.game.payoffs == (0, 0)


def own_quadratic_program(example) -> None:
    """Both rows are tight: x = (t, 4/5 - 2 t, 1/5 + t), and along this line the risk is least."""
    x = example.result.x
    t = x[0]
    assert x == (t, Fraction(4, 5) - 2 * t, Fraction(1, 5) + t)
    slope = t / 10 - 2 * (x[1] / 25 + x[2] / 50) + x[1] / 50 + x[2] / 5
    assert slope == 0 or (t == 0 and slope > 0)


def mixed_problem(example) -> None:
    """By hand: (p - 1) + 2 max(0, p - 4) = 6 at p = 5."""
    assert example.result.z == (4, 2, 5)


def parametric_problem(example) -> None:
    """By hand: f_i = k_i max(0, t - s_i)."""
    assert example.path.breakpoints == (1, 4)
    assert example.path.z(5) == (4, 2)


def push_the_corner_stones(example) -> None:
    """The last entry of the paper's Table 1, -q = 266/3 sqrt(3)."""
    assert example.last == surd("266/3*sqrt(3)")


def prove_without_digits(example) -> None:
    """As many contacts carry a force as in the exact solution."""
    assert example.proof.proved
    assert example.carrying == solve(example.tbs(40)).count("closed")


def compare_with_z(example) -> None:
    """Both methods find the same exact forces at every size."""
    assert [c.forces_equal for c in example.comparisons] == [True] * 7


def read_fields(example) -> None:
    """The trace of a fabric tensor is 1; the apex presses with half its weight on either side."""
    xx, _, yy = example.shares
    assert xx + yy == 1
    assert example.tensor[1][1] == surd("-1/2*sqrt(3)")


def cross_check(example) -> None:
    """Newton's method in floating point agrees to its rounding."""
    assert example.check.largest_difference < 1e-12
    assert example.check.differing == ()


def save_and_load(example) -> None:
    """Exact numbers survive a file."""
    assert list(example.again.forces) == list(example.pile.forces)
    assert example.check.ok


def write_a_certificate(example) -> None:
    """TSS with 3 layers has one mechanism, and is a saddle (notes/formulation.md, section 10)."""
    assert "with forces at rest: 1\n" in example.proved
    assert example.proved.endswith("the equilibrium is saddle\n")


def export_to_paraview(example) -> None:
    """The floor carries all discs but the two held ones, which are touched from the side only."""
    assert abs(example.on_floor["force"].sum() - (51 - 2)) < 1e-12
    assert len(example.sizes) == 5


def check_a_simulation(example) -> None:
    """A simulation of these discs is off by 0.013 w, of which the first order explains all but
    6.7e-5 (tests/test_cli.py has both from the nonlinear pile)."""
    assert (example.rigid.verdict, example.soft.verdict) == ("differ", "agree")
    assert round(example.rigid.largest, 3) == 0.013
    assert round(example.soft.largest, 7) == 6.68e-05


def many_samples(example) -> None:
    """The same samples, solved exactly one by one."""
    found = example.main().statistics
    scenes = [drawn(tbs(6), Uniform(5), seed=1, k=k) for k in range(example.SAMPLES)]
    counts = [solve(scene, whole=True).count("closed") for scene in scenes]
    assert found.numbers["contacts with force"].value * example.SAMPLES == pytest.approx(
        sum(counts)
    )


def packing_in_floats(example) -> None:
    """The floor carries all five discs but for what rounding leaves."""
    assert example.proof.proved
    on_floor = example.heap.support == 0
    assert abs(example.proof.forces.middle[on_floor].sum() - 5) < 1e-12
    assert example.near.force_change < 1e-4


def finite_stiffness(example) -> None:
    """By hand (notes/stiffness.md, 1): 1/sqrt(3) + tau/18."""
    assert abs(float(example.force) - (3**-0.5 + 1e-3 / 18)) < 1e-15
    assert abs(float(example.force) - example.full.forces[0]) < 1e-7


def fill_a_silo(example) -> None:
    """Rows of 4 and 3 discs in turns all press on the floor; bumpy walls take all but a part."""
    assert example.smooth == pytest.approx([18, 35, 70, 140], rel=1e-12)
    assert example.bumpy[3] == pytest.approx(example.bumpy[2], rel=1e-3)


def load_a_slab(example) -> None:
    """By hand: each chain bears 1/2 over the cosine of 30 degrees, in every contact of it."""
    forces = [force for force in example.chains.forces if force]
    assert forces == [surd("1/3*sqrt(3)")] * (2 * example.height)
    assert -example.first.after[0] == example.first.after[-1] > example.first.before[-1]


def pile_of_spheres(example) -> None:
    """All weight ends on the base; the load in its middle is known from an independent solution."""
    assert sum(example.loads.values(), surd(0)) == 1 + 4 + 9
    assert example.loads[4, 2, 2] == surd("135/124")


@pytest.mark.parametrize("name", EXAMPLES)
def test_example(name: str) -> None:
    globals()[name](import_module(f"examples.{name}"))
