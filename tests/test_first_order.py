"""The first order in tau, against the derivative of the full nonlinear equations and by hand."""

from dataclasses import replace

import numpy as np
import pytest
import sympy
from helpers import piles
from hypothesis import assume, given, settings

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    NotSolvedError,
    Scene,
    SolveError,
    deform,
    first_order,
    nt30,
    nt60,
    solve,
    surd,
    tbs,
    tss,
)
from lcp_piles.deformation import check
from lcp_piles.deformation.base import base_of
from lcp_piles.deformation.problem import Term, start_of, term_of
from lcp_piles.numbers.vectors import ExactVector, exact_vector
from lcp_piles.solution.stability import Stability

HALF = surd("1/2")


def by_differentiation(solution):
    """f1 in the order of the contacts, by differentiating the exact geometry at tau = 0.

    Forces of closed contacts are -((|X + tau D| - |X|)/tau + o)/c, and balance(u, tau) = 0 defines
    u(tau), so u' = -balance_u^-1 balance_tau and f' = f_u u' + f_tau.
    """
    scene = solution.scene
    tau = sympy.Symbol("tau")
    names, place, at_zero = [], {}, {tau: 0}
    for disc in scene.discs:
        here = []
        for axis, held in enumerate(disc.held):
            if held is None:
                x = sympy.Symbol(f"u{len(names)}")
                names.append(x)
                at_zero[x] = solution.displacement(disc.id)[axis]
            else:
                x = held.sympy()
            here.append(x)
        place[disc.id] = here
    forces, unbalanced = [], {d.id: [p.sympy() for p in d.load] for d in scene.discs}
    for contact, state in zip(scene.contacts, solution.states, strict=True):
        if state != "closed":
            forces.append(sympy.Integer(0))
            continue
        n = [x.sympy() for x in contact.normal]
        o, c = contact.gap.sympy(), sympy.Rational(contact.compliance)
        if isinstance(contact.b, str):
            direction = n
            stretch = sum(x * y for x, y in zip(n, place[contact.a], strict=True))
        else:
            X = [
                x.sympy() - y.sympy()
                for x, y in zip(
                    scene.disc(contact.a).position, scene.disc(contact.b).position, strict=True
                )
            ]
            D = [x - y for x, y in zip(place[contact.a], place[contact.b], strict=True)]
            rest = sympy.sqrt(sum(x * x for x in X))
            now = sympy.sqrt(sum((x + tau * d) ** 2 for x, d in zip(X, D, strict=True)))
            direction = [(x + tau * d) / now for x, d in zip(X, D, strict=True)]
            # (now - rest) / tau, without the division
            stretch = sum(2 * x * d + tau * d * d for x, d in zip(X, D, strict=True)) / (now + rest)
        force = -(stretch + o) / c
        forces.append(force)
        for axis, e in enumerate(direction):
            unbalanced[contact.a][axis] += e * force
            if not isinstance(contact.b, str):
                unbalanced[contact.b][axis] -= e * force
    balance = sympy.Matrix(
        [
            unbalanced[d.id][axis]
            for d in scene.discs
            for axis, held in enumerate(d.held)
            if held is None
        ]
    )

    def exactly(matrix):
        return matrix.subs(at_zero).applyfunc(sympy.radsimp)

    assert exactly(balance).applyfunc(sympy.simplify) == sympy.zeros(len(names), 1)
    motion = -exactly(balance.jacobian(names)).LUsolve(exactly(balance.diff(tau)))
    f = sympy.Matrix(forces)
    return [sympy.simplify(x) for x in exactly(f.jacobian(names)) * motion + exactly(f.diff(tau))]


def bowl(compliance=1, gap=0):
    """A disc in a bowl of two held discs that are bigger than it, one nearer to the vertical."""
    free, fixed = (None, None), (surd(0), surd(0))
    none = (surd(0), surd(0))
    one, two = (surd("3/5"), surd("4/5")), (surd("-5/13"), surd("12/13"))
    discs = (
        Disc((1,), (surd(0), surd(0)), (surd("1/3"), surd(-1)), free),
        Disc((2,), tuple(-3 * x for x in one), none, fixed),
        Disc((3,), tuple(-surd("7/2") * x for x in two), none, fixed),
    )
    contacts = (
        Contact((1,), (2,), one, compliance=surd(compliance).rational(), gap=surd(gap)),
        Contact((1,), (3,), two),
    )
    return Scene(discs, contacts)


def tripod():
    """A sphere on three held ones: the smallest tetrahedral pile."""
    root = surd("sqrt(6)")
    normals = [
        (surd(0), surd("1/3*sqrt(3)"), root / 3),
        (HALF, surd("-1/6*sqrt(3)"), root / 3),
        (-HALF, surd("-1/6*sqrt(3)"), root / 3),
    ]
    zero = (surd(0),) * 3
    discs = [Disc((0,), zero, (surd(0), surd(0), surd(-1)), (None,) * 3)]
    contacts = []
    for k, n in enumerate(normals, 1):
        discs.append(Disc((k,), tuple(-2 * x for x in n), zero, zero))
        contacts.append(Contact((0,), (k,), n))
    return Scene(tuple(discs), tuple(contacts))


SMALL = {
    "tbs 1": lambda: tbs(1),
    "tbs 2": lambda: tbs(2),
    "nt60 2": lambda: nt60(2),
    "nt60 2, corner stones resting": lambda: nt60(2, corner_stones="resting"),
    "nt30 2": lambda: nt30(2),
    "nt60 2, pushed, soft floor": lambda: nt60(2, "7/3", "5/2", "resting"),
    "nt30 2, published floor": lambda: nt30(2, floor_compliance="-1/2"),
    "bowl": bowl,
    "bowl with a soft contact and a gap": lambda: bowl("3/2", "-1/7"),
    "tripod": tripod,
}


@pytest.mark.parametrize("name", SMALL)
def test_f1_is_the_derivative_of_the_nonlinear_forces(name):
    solution = solve(SMALL[name]())
    found = first_order(solution)
    assert found.status == "found"
    assert not found.selected
    expected = by_differentiation(solution)
    assert [sympy.simplify(x.sympy() - y) for x, y in zip(found.forces, expected, strict=True)] == [
        0
    ] * len(expected)


def test_two_layers_by_hand():
    """NT60 2: 2 f sin a = 1 and f = overlap/tau; sin a sinks with the apex, so f1 = 1/18."""
    found = first_order(solve(nt60(2)))
    assert [str(x) for x in found.forces] == ["1/18", "1/18"]
    assert found.range == (None, ())
    assert str(found.forces_at("1/100")[0]) == "1/1800 + 1/3*sqrt(3)"
    assert found.force((1, 1), (2, 1), "1/100") == sympy.Rational(1, 1800) + sympy.sqrt(3) / 3


@pytest.mark.parametrize(
    ("scene", "largest"),
    [(nt60(2), 1 / 18), (nt30(6), 38.2799607673), (nt60(5), 1.0933624173)],
)
def test_largest_terms_that_were_known_beforehand(scene, largest):
    assert np.abs(first_order(solve(scene)).force_array).max() == pytest.approx(largest, rel=1e-10)


@pytest.mark.parametrize("scene", [nt30(4), nt30(7), tss(3), tbs(3)], ids=str)
def test_half_and_whole_agree(scene):
    half, whole = first_order(solve(scene)), first_order(solve(scene, whole=True))
    assert list(half.forces) == list(whole.forces)
    assert list(half.displacements) == list(whole.displacements)
    assert list(half.gaps) == list(whole.gaps)
    assert half.range == whole.range


def test_a_file_gives_the_same(tmp_path):
    from lcp_piles import load, save

    solution = solve(nt30(3, push=2))
    save(solution, tmp_path / "pile.json")
    found, again = first_order(solution), first_order(load(tmp_path / "pile.json"))
    assert list(found.forces) == list(again.forces)
    assert found.range == again.range


def altered(vector, k):
    numbers = list(vector)
    numbers[k] += surd("1/1000000007")
    return exact_vector(numbers)


def test_the_check_sees_every_altered_number():
    solution = solve(nt30(4))
    found, base = first_order(solution), base_of(solution)
    start = start_of(base, base.displacements, base.gaps)
    term = Term(found.forces, found.displacements, found.gaps, base.free, base.partition)
    assert check.faults(base, start, term) == []
    for name in ("displacements", "gaps", "longer"):
        for k in range(len(getattr(start, name))):
            bad = replace(start, **{name: altered(getattr(start, name), k)})
            assert check.faults(base, bad, term), (name, k)
    dimension = solution.scene.dimension
    for k, disc in enumerate(solution.scene.discs):
        for axis, held in enumerate(disc.held):
            if held is None and base.discs[k]:
                load = altered(start.load, k * dimension + axis)
                assert check.faults(base, replace(start, load=load), term), (disc, axis)
    for name in ("displacements", "gaps", "forces"):
        for k in range(len(getattr(term, name))):
            bad = replace(term, **{name: altered(getattr(term, name), k)})
            assert check.faults(base, start, bad), (name, k)


@pytest.mark.parametrize("scene", [nt30(8), tss(3)], ids=str)
def test_mechanisms_that_a_solution_miscounts_do_no_harm(scene):
    solution = solve(scene)
    misled = first_order(replace(solution, stability=Stability(0, 0, "stable")))
    found = first_order(solution)
    assert list(misled.forces) == list(found.forces)
    assert list(misled.start) == list(found.start)
    assert misled.stability == found.stability == solution.stability
    assert misled.selected


def test_what_is_refused():
    with pytest.raises(InputError, match="newton"):
        first_order(solve(nt30(3), "newton"))
    with pytest.raises(NotSolvedError, match="unstable"):
        first_order(solve(nt60(3).without([(3, 1)])))
    with pytest.raises(InputError, match="geometric"):
        first_order(solve(replace(nt30(3), geometric=False)))
    # A rigid disc on a rigid floor between two rigid slopes: any share of the load will do.
    free, fixed = (None, None), (surd(0), surd(0))
    up = (surd(0), surd(1))
    one, two = (surd("3/5"), surd("4/5")), (surd("-3/5"), surd("4/5"))
    discs = [Disc((0,), fixed, (surd(0), surd(-1)), free)]
    contacts = [Contact((0,), "floor", up, compliance=surd(0).rational())]
    for k, n in ((1, one), (2, two)):
        discs.append(Disc((k,), tuple(-2 * x for x in n), fixed, fixed))
        contacts.append(Contact((0,), (k,), n, compliance=surd(0).rational()))
    with pytest.raises(SolveError, match="rigid contacts"):
        first_order(solve(Scene(tuple(discs), tuple(contacts))))


def test_a_saddle_of_one_antisymmetric_motion_keeps_its_symmetry():
    found = first_order(solve(tss(3)))
    assert found.selected
    assert found.loose == ()


def test_balance_along_free_motions_selects_displacements_or_shows_that_there_are_none():
    """NT30 8 has a free symmetric motion and takes its place along it; TSS 4 would overlap."""
    solution = solve(nt30(8))
    found = first_order(solution)
    assert found.status == "found"
    assert found.selected
    assert list(found.start) != list(solution.displacements.plain())
    assert min(found.start_gaps.signs()) == 0
    none = first_order(solve(tss(4)))
    assert none.status == "none"
    assert [(c.a, c.b) for c in none.overlapping] == [((1, 1), (3, 2))]
    assert none.start_gaps[solve(tss(4)).contact_index((1, 1), (3, 2))] == surd("-13/9")


def test_a_gap_that_balance_closes_exactly_is_not_decided():
    """A disc on top of a held one, beside a wall that it touches there: it may roll off the wall.

    The rigid pile may have the disc at any x >= 0, so the wall is open. Balance at order tau is
    that of f0 x / 2 along the free motion, so x = 0, where the gap to the wall is zero.
    """
    none = (surd(0), surd(0))
    discs = (
        Disc(1, (surd(0), surd(2)), (surd(0), surd(-1)), (None, None)),
        Disc(2, none, none, none),
    )
    contacts = [Contact(1, 2, (surd(0), surd(1))), Contact(1, "wall", (surd(1), surd(0)))]
    solution = solve(Scene(discs, tuple(contacts), supports=("wall",)))
    assert solution.states == ("closed", "open")
    with pytest.raises(SolveError, match="closes the gap of contact 1-wall"):
        first_order(solution)
    base = base_of(solution)
    start = start_of(base, exact_vector([0, -1, 0, 0]), exact_vector([0, 0]))
    (fault,) = check.faults(base, start, term_of(base, start))
    assert fault.startswith("contact 1-wall")
    away = replace(contacts[1], gap=surd(1))
    found = first_order(solve(Scene(discs, (contacts[0], away), supports=("wall",))))
    assert found.start[0] == 0
    assert found.start_gaps[1] == 1


@pytest.mark.parametrize("push", ["1e100", "1e200", "1e400"])
def test_numbers_beyond_floats_have_their_range(push):
    """Far out forces are linear in the push, f1 is quadratic: the range goes with 1 / push."""
    found = first_order(solve(nt30(3, push=push)))
    limit, changing = found.range
    assert changing
    near = first_order(solve(nt30(3, push="1e30"))).range
    assert changing == near[1]
    assert abs(limit * surd(push) / (near[0] * surd("1e30")) - 1) < surd("1e-9")


def test_osculatory_contacts_close_or_open():
    """NT60 3: two osculatory contacts hold a mechanism; the first order decides about them."""
    solution = solve(nt60(3))
    found = first_order(solution)
    ties = [k for k, state in enumerate(solution.states) if state == "osculatory"]
    assert len(ties) == 2
    for k in ties:
        assert (found.forces[k] > 0) != (found.gaps[k] > 0)


def test_no_gauge_and_no_mirror_are_needed_for_the_answer():
    """Another scene with the same contacts in another order, seen as a custom scene."""
    scene = nt30(3)
    shuffled = replace(scene, contacts=scene.contacts[::-1])
    assert list(first_order(solve(shuffled)).forces) == list(first_order(solve(scene)).forces)[::-1]


@pytest.mark.parametrize(
    "scene", [nt60(3), nt60(3, corner_stones="resting"), nt60(3, 0), nt30(8), tss(3)], ids=str
)
def test_a_pile_moved_aside_is_the_same_pile(scene):
    """It is not its own mirror image: odd motions, osculatory contacts and u0 are of the whole."""
    moved = replace(
        scene,
        discs=tuple(replace(d, position=(d.position[0] + 1, *d.position[1:])) for d in scene.discs),
    )
    found, other = first_order(solve(scene)), first_order(solve(moved))
    assert len(other.rest.closed) == len(scene.contacts) > len(found.rest.closed)
    for name in ("start", "start_gaps", "forces", "displacements", "gaps"):
        assert list(getattr(other, name)) == list(getattr(found, name)), name
    assert other.stability == found.stability
    assert other.range == found.range


@pytest.mark.parametrize("layers", [3, 7])
def test_gaps_beside_osculatory_contacts_are_those_of_the_nonlinear_pile(layers):
    """NT60 with resting corner stones has osculatory and open contacts: g1 by a difference."""
    solution = solve(nt60(layers, corner_stones="resting"))
    assert solution.count("open")
    assert solution.count("osculatory")
    found, tau = first_order(solution), 1e-6
    pile = deform(found, tau)
    changes = (np.maximum(pile.gaps, 0) - found.start_gaps.array()) / tau
    assert changes == pytest.approx(found.gaps.array(), abs=1e-3)


def between_two(walls, aside=1):
    """A disc B on a disc A that leans on a held one; B is touched from both sides without force.

    By hand: A carries 2 on the floor and 1 on the held disc, so it moves by (-1, -2), and B by
    (-1, -3). At order tau A moves on by -|2|^2 / 4 = -1 because it turns about the held disc, and
    balance of B at order tau^2 asks for the same of B.
    """
    none, up, right, left = (0, 0), (0, 1), (1, 0), (-1, 0)
    discs = [
        Disc("A", (0, 0), (-1, -1), (None, None)),
        Disc("B", (0, 2), (0, -1), (None, None)),
        Disc("H", (-2, 0), none, none),
    ]
    contacts = [Contact("A", "floor", up), Contact("A", "H", right), Contact("B", "A", up)]
    sides = (("left", right, aside, -20), ("right", left, -aside, 20))
    for name, normal, gap, x in sides:
        contacts.append(Contact("B", name, normal, gap=gap))
        if not walls:
            discs.append(Disc(name, (x, 2), none, none))
    supports = ("floor", "left", "right") if walls else ("floor",)
    return Scene(discs, contacts, supports=supports)


def test_walls_without_force_hold_what_balance_would_move():
    """Planes have no second order: both walls still just touch at order tau, and B stays."""
    solution = solve(between_two(walls=True))
    assert solution.states[3:] == ("osculatory", "osculatory")
    found = first_order(solution)
    assert [str(x) for x in found.forces] == ["1", "0", "0", "0", "0"]
    assert [str(x) for x in found.gaps] == ["0"] * 5
    assert found.loose == ()
    assert found.displacement_array[:2].tolist() == [[-1, -1], [0, -1]]


def test_a_wall_that_just_touches_takes_what_turns():
    """B held at 0 above A at -1: their contact turns by 1/2, and its force of 1 leans on a wall."""
    solution = solve(between_two(walls=True, aside=0))
    assert solution.states[3:] == ("osculatory", "osculatory")
    found = first_order(solution)
    assert found.start_gaps[3] == found.start_gaps[4] == 0
    assert [str(x) for x in found.forces] == ["1", "1/2", "0", "0", "1/2"]


def test_the_check_sees_a_wall_that_would_pull():
    """Every identity holds with B held by the left wall, which pulls, instead of the right one."""
    solution = solve(between_two(walls=True, aside=0))
    found, base = first_order(solution), base_of(solution)
    start = start_of(base, base.displacements, base.gaps)
    good = Term(found.forces, found.displacements, found.gaps, base.free, base.partition)
    assert [str(x) for x in found.gaps] == ["0", "0", "0", "1/2", "0"]
    assert check.faults(base, start, good) == []
    forces, gaps = exact_vector([1, "1/2", 0, "-1/2", 0]), exact_vector([0, 0, 0, 0, "-1/2"])
    pulled = check.faults(base, start, replace(good, forces=forces, gaps=gaps))
    assert [fault.partition(":")[0] for fault in pulled] == ["contact B-left", "contact B-right"]


def test_u1_stays_open_where_balance_would_close_what_opened():
    """Discs 20 away on both sides: their gaps open to 9/40, less than the 1 that B would move."""
    solution = solve(between_two(walls=False))
    assert solution.states[3:] == ("osculatory", "osculatory")
    found, tau = first_order(solution), 1e-6
    assert [str(x) for x in found.forces] == ["1", "0", "0", "0", "0"]
    assert found.loose == (3, 4)
    assert found.gaps[3] + found.gaps[4] == surd("9/20")
    assert min(found.gaps.signs()) == 0
    pile = deform(found, tau)
    assert pile.converged
    assert pile.forces == pytest.approx(found.rigid.force_array + tau * found.force_array, abs=1e-9)


def test_types_are_plain():
    found = first_order(solve(nt60(3)))
    assert all(isinstance(v, ExactVector) for v in (found.forces, found.gaps, found.displacements))
    assert "FirstOrder" in repr(found)
    assert "overlap" in repr(first_order(solve(tss(4))))


def with_a_rattler(normal=("1", "0")):
    """NT60 2 and a disc without weight that hangs a gap of 1 off the apex: it may go anywhere."""
    pile = nt60(2)
    x, y = pile.disc((1, 1)).position
    n = tuple(surd(part) for part in normal)
    rattler = Disc("rattler", (x + 2 * n[0], y + 2 * n[1]), (0, 0), (None, None))
    touch = Contact("rattler", (1, 1), n, gap=1)
    return Scene((*pile.discs, rattler), (*pile.contacts, touch))


def test_a_neutral_motion_stays_undetermined_and_is_named():
    """Forces do not mind; how the gap to the rattler changes nothing decides."""
    found = first_order(solve(with_a_rattler()))
    assert found.status == "found"
    assert found.selected
    assert [str(x) for x in found.forces] == ["1/18", "1/18", "0"]
    assert found.loose == (2,)
    assert found.range == (None, ())


def test_gaps_that_nothing_decides_do_not_end_the_range():
    """The apex sinks towards a disc below it that may go anywhere."""
    found = first_order(solve(with_a_rattler(("0", "-1"))))
    assert found.loose == (2,)
    assert found.gaps[2] < 0
    assert found.range == (None, ())


def test_contacts_that_may_pull_do_not_end_the_range():
    scene = nt30(3)
    solution = solve(scene)
    (_, changing), closed = first_order(solution).range, np.array(solution.states) == "closed"
    assert solution.state(changing[0].a, changing[0].b) == "closed"
    held = [replace(c, bilateral=bool(x)) for c, x in zip(scene.contacts, closed, strict=True)]
    found = first_order(solve(replace(scene, contacts=tuple(held))))
    assert not any(c.bilateral for c in found.range[1])


def test_the_second_order_selects_u1_along_free_motions():
    """NT30 8: the nonlinear u is u0 + tau u1 up to tau^2, along the free motion too."""
    found = first_order(solve(nt30(8)))
    assert found.loose == ()
    off = []
    for tau in (1e-5, 1e-6):
        u = deform(found, tau).displacements
        line = found.start.array().reshape(-1, 2) + tau * found.displacement_array
        off.append(np.abs(u - line).max())
    assert 90 < off[0] / off[1] < 110


@settings(max_examples=25, deadline=None)
@given(piles(rigid=False))
def test_the_nonlinear_pile_agrees_to_second_order(scene):
    """Any small pile, push and floor: the error of the first order is far below tau f1."""
    solution = solve(scene)
    assume(solution.status == "solved")
    found = first_order(solution)
    tau = 1e-6
    assume(found.status == "found")
    limit, _ = found.range
    assume(limit is None or float(limit) > 100 * tau)
    pile = deform(found, tau)
    assert pile.converged
    off = np.abs(pile.forces - solution.force_array - tau * found.force_array).max()
    assert off < 1e-2 * tau * max(1.0, np.abs(found.force_array).max()) + 1e-12
