"""`verify` finds every claim of a solution that is not so, on piles and on scenes of one's own.

What a claim should be is known here from closed forms (the small scenes), from the issue's rule
that any alteration is one too many, or from dense linear algebra in floating point.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from flint import fmpz
from helpers import float_matrix
from random_scenes import random_scene

from lcp_piles import (
    METHODS,
    Contact,
    Disc,
    InputError,
    LcpPilesError,
    Scene,
    Unstable,
    VerificationError,
    contact_system,
    nt30,
    nt60,
    solve,
    surd,
    tbs,
    tss,
    verify,
)
from lcp_piles.numbers.vectors import exact_vector
from lcp_piles.solution.claims import _sliding
from lcp_piles.solution.finish import collapsed, finished
from lcp_piles.solution.stability import Stability

FREE = (None, None)
DOWN = (0, -1)


def disc(id: int, x: object, y: object, load: tuple = DOWN, held: tuple = FREE) -> Disc:
    return Disc((id,), (x, y), load, held)


def hanging() -> Scene:
    """A disc that hangs from a held one by a contact held closed, force -1, and may swing."""
    discs = (disc(1, 0, 0), disc(2, 0, 2, held=(0, 0)))
    return Scene(discs, (Contact((1,), (2,), (0, -1), bilateral=True),))


def balanced(load: int = -1) -> Scene:
    """A disc upright on a held one: a saddle; without a load nothing is lost by moving."""
    discs = (disc(1, 0, 2, (0, load)), disc(2, 0, 0, held=(0, 0)))
    return Scene(discs, (Contact((1,), (2,), (0, 1), gap=0),))


def upright() -> Scene:
    """As `balanced`, but the held disc is the first of the scene."""
    scene = balanced()
    return replace(scene, discs=scene.discs[::-1])


def wedged() -> Scene:
    """A disc that two held ones carry, and beside it one that may slide along a floor.

    The motion moves no disc of a loaded contact between discs, so nothing is lost by it.
    """
    discs = (
        disc(1, -1, 0, held=(0, 0)),
        disc(2, 0, "sqrt(3)"),
        disc(3, 1, 0, held=(0, 0)),
        disc(4, 9, 1),
    )
    contacts = (
        Contact((2,), (1,), ("1/2", "1/2*sqrt(3)")),
        Contact((2,), (3,), ("-1/2", "1/2*sqrt(3)")),
        Contact((4,), "floor", (0, 1)),
    )
    return Scene(discs, contacts)


def aside() -> Scene:
    """The same with a contact between discs that do not touch: no force is lost by sliding it."""
    scene = wedged()
    discs = (*scene.discs[:3], disc(4, 9, 0))
    return replace(
        scene, discs=discs, contacts=(*scene.contacts, Contact((4,), (3,), (1, 0), gap=6))
    )


def resting() -> Scene:
    """A disc on a floor that it may slide along: neutral."""
    return Scene((disc(1, 0, 1),), (Contact((1,), "floor", (0, 1)),))


def between(*walls: Contact) -> Scene:
    floor = resting()
    names = ("floor", *(str(wall.b) for wall in walls))
    return replace(floor, contacts=(*floor.contacts, *walls), supports=names)


def stopped() -> Scene:
    """The same between two walls at a distance: their gaps are two of many."""
    walls = (Contact((1,), "left", (1, 0), gap=1), Contact((1,), "right", (-1, 0), gap=2))
    return replace(
        resting(), contacts=(*resting().contacts, *walls), supports=("floor", "left", "right")
    )


def clamped() -> Scene:
    """The same between rigid walls without a distance: any pressure between them will do."""
    walls = [Contact((1,), name, (x, 0), 0) for name, x in (("left", 1), ("right", -1))]
    return replace(
        resting(), contacts=(*resting().contacts, *walls), supports=("floor", "left", "right")
    )


def leaning() -> Scene:
    """A disc that touches a wall on either side without force, and can leave neither."""
    return between(Contact((1,), "left", (1, 0)), Contact((1,), "right", (-1, 0)))


def guarded() -> Scene:
    """The same with a rigid wall on the left, and one more on the right that it does not reach.

    With the far wall the left one could be loaded, without it nothing holds against it.
    """
    return between(
        Contact((1,), "left", (1, 0), 0),
        Contact((1,), "right", (-1, 0)),
        Contact((1,), "far", (-1, 0), 0, gap=1),
    )


def standing() -> Scene:
    """A disc upright on the first one of the scene, which is free: they stand on a floor."""
    discs = (disc(1, 0, 1), disc(2, 0, 3))
    contacts = (Contact((2,), (1,), (0, 1)), Contact((1,), "floor", (0, 1)))
    return Scene(discs, contacts, supports=("floor",))


SCENES = {
    "nt30": nt30(6),
    "nt30 pushed": nt30(4, push=7),
    "nt30 with mechanisms": nt30(7),
    "nt60 with ties": nt60(3),
    "rigid floor": nt60(4, floor_compliance=0),
    "the paper's floor": nt30(4, floor_compliance="-1/2"),
    "tss": tss(4),
    "tbs": tbs(3),
    "own": nt60(5).without([(1, 1)]),
    "hanging": hanging(),
    "balanced": balanced(),
    "upright": upright(),
    "wedged": wedged(),
    "aside": aside(),
    "resting": resting(),
    "stopped": stopped(),
    "clamped": clamped(),
    "leaning": leaning(),
    "standing": standing(),
}
EVERY = pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())


def faults(scene, solution, **changes) -> str:
    return " | ".join(verify(scene, replace(solution, **changes), shown=1000).faults)


@EVERY
def test_an_honest_solution_has_no_fault(scene) -> None:
    for whole in (False, True):
        assert verify(scene, solve(scene, whole=whole)).ok


@EVERY
def test_every_number_and_the_verdict_of_stability_are_found(scene) -> None:
    solution = solve(scene)
    true = solution.stability
    for count in (-7, true.mechanisms - 1, true.mechanisms + 1):
        text = faults(scene, solution, stability=replace(true, mechanisms=count))
        assert f"mechanisms is {count}, but it is {true.mechanisms}" in text
    for count in (-1, true.free + 1):
        text = faults(scene, solution, stability=replace(true, free=count))
        assert f"free is {count}, but it is {true.free}" in text
    for verdict in {"stable", "saddle", "neutral", "undecided"} - {true.verdict}:
        text = faults(scene, solution, stability=replace(true, verdict=verdict))
        assert f"the verdict is {verdict}, but it is {true.verdict}" in text
    assert "nothing is said of stability" in faults(scene, solution, stability=None)


@EVERY
def test_every_flipped_gap_unique_is_found_by_its_contact(scene) -> None:
    solution = solve(scene)
    for k, (contact, unique) in enumerate(zip(scene.contacts, solution.gap_unique, strict=True)):
        flipped = list(solution.gap_unique)
        flipped[k] = not unique
        check = verify(scene, replace(solution, gap_unique=tuple(flipped)))
        assert check.faults == (
            f"contact {contact.a}-{contact.b}: gap_unique is {not unique}, but it is {unique}",
        )
    assert "gap_unique has 0 entries" in faults(scene, solution, gap_unique=())


@EVERY
def test_every_other_forces_unique_is_found(scene) -> None:
    solution = solve(scene)
    for claim in {True, False, None} - {solution.forces_unique}:
        text = faults(scene, solution, forces_unique=claim)
        assert f"forces_unique is {claim}, but it is {solution.forces_unique}" in text


@EVERY
def test_every_other_state_is_found_by_its_contact(scene) -> None:
    solution = solve(scene)
    for k, contact in enumerate(scene.contacts):
        for state in {"closed", "open", "osculatory"} - {solution.states[k]}:
            states = (*solution.states[:k], state, *solution.states[k + 1 :])
            assert f"contact {contact.a}-{contact.b}: called {state}, but" in faults(
                scene, solution, states=states
            )


@EVERY
@pytest.mark.parametrize("whole", [False, True], ids=["half", "whole"])
def test_every_altered_size_or_name_of_the_record_is_found(scene, whole) -> None:
    solution = solve(scene, whole=whole)
    record = solution.record

    def altered(**changes) -> str:
        return faults(scene, solution, record=replace(record, **changes))

    for name in ("dof", "contacts", "whole_dof", "whole_contacts"):
        size = getattr(record, name)
        for wrong in (size + 1, -size - 1):
            assert f"{name} is {wrong}, but it is {size}" in altered(**{name: wrong})
    assert "the arithmetic is called float64, but the numbers are exact" in altered(
        arithmetic="float64"
    )
    assert "the part is called odd" in altered(part="odd")
    other = altered(part="whole" if record.part == "even" else "even")
    assert "but it is" in other or "which this scene is not solved on" in other


def test_a_half_is_not_claimed_where_there_is_none() -> None:
    scene = nt60(4).without([(1, 1), (2, 1)])
    solution = solve(scene)
    record = replace(solution.record, part="even")
    assert "the part is called even, which this scene is not solved on" in faults(
        scene, solution, record=record
    )


def test_another_solution_is_one_too_and_an_extreme_one_is_named_by_its_states() -> None:
    """Slid along the floor to 1/2 it has other gaps and the same claims; at the wall it touches.

    The states are those of the whole set of solutions, so at the wall they are not read off.
    """
    scene = stopped()
    solution = solve(scene)
    assert solution.states == ("closed", "open", "open")
    assert solution.gap_unique == (True, False, False)
    for x, there in (("1/2", True), ("-1", False), ("2", False)):
        x = surd(x)
        gaps = exact_vector([surd(0), 1 + x, 2 - x])
        moved = replace(solution, displacements=exact_vector([x, surd(-1)]), gaps=gaps)
        named = tuple(
            "closed" if not k else "open" if g else "osculatory" for k, g in enumerate(gaps)
        )
        moved = replace(moved, states=named)
        assert verify(scene, moved).ok is there
        if not there:
            assert "called osculatory, but it is open in another solution" in faults(scene, moved)
    beyond = replace(
        solution,
        displacements=exact_vector([surd(3), surd(-1)]),
        gaps=exact_vector([surd(0), surd(4), surd(-1)]),
    )
    assert "the gap is negative" in faults(scene, beyond)


def test_a_contact_that_another_solution_loads_is_not_osculatory() -> None:
    """Between rigid walls without a distance no pressure is a solution, but not all of them."""
    scene = clamped()
    solution = solve(scene)
    assert solution.states == ("closed", "closed", "closed")
    assert solution.forces_unique is False
    forces = exact_vector([surd(1), surd(0), surd(0)])
    idle = replace(solution, forces=forces, states=("closed", "osculatory", "osculatory"))
    text = faults(scene, idle)
    assert text.count("called osculatory, but it is closed in another solution") == 2
    pressed = replace(solution, forces=exact_vector([surd(1), surd(5), surd(5)]))
    assert verify(scene, pressed).ok


def test_a_clamp_that_another_solution_loads_is_not_osculatory() -> None:
    """Between rigid contacts held closed any pull or pressure will do."""
    walls = [Contact((1,), name, (x, 0), 0, bilateral=True) for name, x in (("l", 1), ("r", -1))]
    scene = between(*walls)
    for method in ("proved", "lemke"):
        solution = solve(scene, method)
        assert solution.states == ("closed",) * 3
        assert solution.forces_unique is False
        assert verify(scene, solution).ok
    for pressure in (5, -5):
        forces = exact_vector([surd(1), surd(pressure), surd(pressure)])
        assert verify(scene, replace(solution, forces=forces)).ok
    forces = exact_vector([surd(1), surd(0), surd(0)])
    idle = replace(solution, forces=forces, states=("closed", "osculatory", "osculatory"))
    text = faults(scene, idle)
    assert text.count("called osculatory, but it is closed in another solution") == 2


@pytest.mark.parametrize(
    ("scene", "stability", "unique"),
    [
        (balanced(), Stability(1, 1, "saddle"), (True,)),
        (balanced(0), Stability(2, 2, "neutral"), (False,)),
        (upright(), Stability(1, 1, "saddle"), (True,)),
        (wedged(), Stability(1, 1, "neutral"), (True, True, True)),
        (aside(), Stability(1, 1, "neutral"), (True, True, True, False)),
        (resting(), Stability(1, 1, "neutral"), (True,)),
        (stopped(), Stability(1, 1, "neutral"), (True, False, False)),
        (leaning(), Stability(1, 0, "stable"), (True, True, True)),
        (guarded(), Stability(1, 0, "stable"), (True,) * 4),
        (clamped(), Stability(0, 0, "stable"), (True, True, True)),
        (hanging(), Stability(1, 1, "undecided"), (True,)),
    ],
    ids=[
        "balanced",
        "weightless",
        "upright",
        "wedged",
        "aside",
        "resting",
        "stopped",
        "leaning",
        "guarded",
        "clamped",
        "hanging",
    ],
)
def test_small_scenes_whose_stability_is_plain(scene, stability, unique) -> None:
    for method in ("proved", "lemke"):
        solution = solve(scene, method)
        assert (solution.stability, solution.gap_unique) == (stability, unique)
        assert verify(scene, solution).ok


def test_a_bilateral_contact_without_force_holds_a_neutral_motion() -> None:
    """It is in no tension, so nothing is lost or gained at second order: not undecided."""
    scene = replace(hanging(), discs=(disc(1, 0, 0, (0, 0)), hanging().discs[1]))
    solution = solve(scene)
    assert list(solution.forces) == [0]
    assert solution.stability == Stability(1, 1, "neutral")
    assert verify(scene, solution).ok


def test_a_bilateral_contact_may_have_no_gap_and_no_other_state() -> None:
    scene = hanging()
    solution = solve(scene)
    assert solution.states == ("closed",)
    apart = replace(
        solution,
        forces=exact_vector([surd(0)]),
        gaps=exact_vector([surd(2)]),
        displacements=exact_vector([surd(0), surd(-2), surd(0), surd(0)]),
    )
    text = faults(scene, replace(apart, states=("open",)))
    assert "held closed, but it has a gap" in text


@pytest.mark.parametrize("scene", [nt30(7), nt30(9), tss(4), tss(7), nt60(3)])
def test_mechanisms_are_those_of_a_dense_rank(scene) -> None:
    """Counted in floating point on the whole pile."""
    solution = solve(scene)
    B, _, _ = float_matrix(scene)
    loaded = np.array(solution.states) == "closed"
    touching = np.array(solution.states) != "open"
    nullity = [B.shape[1] - np.linalg.matrix_rank(B[mask]) for mask in (loaded, touching)]
    assert [solution.stability.mechanisms, solution.stability.free] == nullity
    assert verify(scene, solution).ok


def test_random_scenes_claim_what_is_so() -> None:
    """Rigid contacts among them; 287, 804 and 1423 have bilateral ones in a self-stress."""
    solved = 0
    for seed in [*range(60), 287, 804, 1423]:
        scene = random_scene(seed)
        try:
            solution = solve(scene)
        except LcpPilesError:
            continue
        solved += solution.status == "solved"
        assert verify(scene, solution).ok, seed
    assert solved > 10


def test_sizes_that_do_not_fit_are_refused() -> None:
    scene = nt60(3)
    solution = solve(scene)
    for name in ("displacements", "forces", "gaps"):
        for cut in (slice(1, None), slice(0, 0)):
            shorter = exact_vector(list(getattr(solution, name))[cut])
            with pytest.raises(InputError, match="the sizes of u, f and g"):
                verify(scene, replace(solution, **{name: shorter}))
        longer = exact_vector([*getattr(solution, name), surd(0)])
        with pytest.raises(InputError, match="the sizes of u, f and g"):
            verify(scene, replace(solution, **{name: longer}))
    for states in ((), solution.states[1:], (*solution.states, "open")):
        with pytest.raises(InputError, match="the number of states"):
            verify(scene, replace(solution, states=states))


def test_floating_point_may_not_claim_what_it_cannot_prove() -> None:
    scene = nt30(4)
    solution, exact = solve(scene, "newton"), solve(scene)
    honest = verify(scene, solution)
    assert (honest.exact, honest.ok, honest.faults) == (False, False, ())
    assert 0 < honest.residual < 1e-10
    assert "a verdict of stability" in faults(scene, solution, stability=exact.stability)
    assert "unique forces" in faults(scene, solution, forces_unique=True)
    assert "unique forces or gaps" in faults(scene, solution, gap_unique=exact.gap_unique)
    assert "the arithmetic is called exact, but the numbers are floating-point numbers" in faults(
        scene, solution, record=replace(solution.record, arithmetic="exact")
    )
    mixed = verify(scene, replace(solution, forces=exact.forces))
    assert not mixed.exact


def test_the_record_of_an_unstable_scene_is_checked_too() -> None:
    scene = nt60(4).without([(4, 1)])
    solution = solve(scene)
    assert verify(scene, solution).ok
    assert "dof is 3, but" in faults(scene, solution, record=replace(solution.record, dof=3))
    record = replace(solution.record, arithmetic="float32")
    assert "the arithmetic is called float32" in faults(scene, solution, record=record)


def test_a_collapse_of_another_size_is_refused() -> None:
    scene = nt60(4).without([(4, 1)])
    solution = solve(scene)
    motion = list(solution.collapse)
    for other in (motion[1:], [*motion, surd(0)], []):
        with pytest.raises(InputError, match="the size of the collapse"):
            verify(scene, replace(solution, collapse=exact_vector(other)))


def test_a_collapse_may_not_pull_a_contact_apart_that_is_held_closed() -> None:
    scene = hanging()
    record = solve(scene).record
    falls = Unstable(scene, record, exact_vector([surd(0), surd(-1), surd(0), surd(0)]))
    assert verify(scene, falls).faults == (
        "contact (1,)-(2,): the collapse would have to close it further",
    )


def test_a_gap_of_what_is_held_closed_is_a_residual() -> None:
    """The disc lowered by 2 without a load: balance and Hooke's law hold, but the contact gapes."""
    scene = replace(hanging(), discs=(disc(1, 0, 0, (0, 0)), hanging().discs[1]))
    floats = solve(scene, "newton")
    apart = replace(floats, displacements=np.array([0.0, -2.0, 0.0, 0.0]), gaps=np.array([2.0]))
    assert verify(scene, apart).residual == 2.0


def test_a_wrong_state_or_motion_is_never_returned() -> None:
    system = contact_system(nt30(3))
    record = solve(nt30(3)).record
    state = METHODS["lemke"].run(system).state
    wrong = replace(state, displacements=exact_vector([x + 1 for x in state.displacements]))
    with pytest.raises(VerificationError, match=r"fails its own check: .*Hooke's law fails"):
        finished(system, wrong, record)
    with pytest.raises(VerificationError, match="the load does no work on the collapse"):
        collapsed(system, [fmpz(0)] * system.dof, record)


@pytest.mark.parametrize("method", ["proved", "newton"])
def test_the_first_disc_of_a_scene_may_carry_another(method) -> None:
    """Forces 1 and 2; the upper disc sinks by 1 + 2, the lower one by 2."""
    scene = standing()
    solution = solve(scene, method)
    assert solution.force_array == pytest.approx([1, 2], rel=1e-12)
    assert solution.displacement_array.ravel() == pytest.approx([0, -2, 0, -3], abs=1e-12)
    check = verify(scene, solution)
    assert check.exact == (method == "proved")
    assert check.residual < 1e-12
    assert not check.faults


def test_a_residual_counts_initial_gaps() -> None:
    """The disc of weight 1 sinks by 1, and stays between the walls at 1 and 2."""
    check = verify(stopped(), solve(stopped(), "newton"))
    assert check.residual < 1e-12


@pytest.mark.parametrize("shown", [1, 3])
def test_no_more_faults_are_shown_than_wanted(shown) -> None:
    scene = nt60(4)
    solution = solve(scene)
    flipped = tuple(not unique for unique in solution.gap_unique)
    none = exact_vector([0] * len(scene.contacts))
    for wrong in (replace(solution, gap_unique=flipped), replace(solution, forces=none)):
        assert len(verify(scene, wrong, shown=shown).faults) == shown


def test_an_answer_that_is_none_is_no_answer() -> None:
    scene = nt60(4).without([(4, 1)])
    check = verify(scene, solve(scene, "newton"))
    assert check.faults == ("the scene is unresolved: nothing is claimed",)
    assert (check.exact, check.ok) == (False, False)


def test_a_solution_that_is_exact_in_part_is_not_exact() -> None:
    scene = nt60(3)
    solution = solve(scene)
    for name in ("displacement", "force", "gap"):
        floats = getattr(solution, f"{name}_array").ravel()
        mixed = replace(solution, **{f"{name}s": floats})
        check = verify(scene, mixed)
        assert not check.exact
        assert check.residual < 1e-12
        assert "floating-point numbers" in check.faults[0]


def test_discs_that_slide_by_less_than_floats_show() -> None:
    system = contact_system(standing(), "whole")
    assert system.dof == 4
    for x, slides in ((2**60, False), (2**60 + 1, True)):
        motion = [fmpz(v) for v in (2**60, 0, x, 0)]
        assert _sliding(system, [motion]).tolist() == [slides, False]
