"""Scenes too small to have the usual parts: every method ends in a status, never in a traceback.

Discs that are all held, none that touches, one freedom, no load, one axis or three. What each is
can be read off: the expected status, and the force on the first contact where there is one.
"""

import warnings
from fractions import Fraction

import pytest
from random_scenes import custom

from lcp_piles import Contact, Disc, InputError, SolveError, prove_contacts, solve, surd, verify
from lcp_piles.methods.z.z_algorithm import z_algorithm

DOWN, UP, RIGHT = ("0", "-1"), ("0", "1"), ("1", "0")


def numbers(*texts):
    return tuple(None if text is None else surd(text) for text in texts)


def disc(id, load=DOWN, held=(None, None), position=None):
    position = position or [str(2 * id)] + ["0"] * (len(load) - 1)
    return Disc((id,), numbers(*position), numbers(*load), numbers(*held))


def touch(a, b="floor", normal=UP, c=1, gap="0", bilateral=False):
    end = b if isinstance(b, str) else (b,)
    return Contact((a,), end, numbers(*normal), Fraction(c), surd(gap), bilateral)


FIXED, NONE = ("0", "0"), ("0", "0")
TRIPOD = ("1/2", "1/2", "1/2*sqrt(2)"), ("-1/2", "-1/2", "1/2*sqrt(2)")
SHAPES = {  # discs, contacts, status, force of the first contact
    "held, nothing touches": ([disc(0, held=FIXED)], [], "solved", None),
    "held on the floor": ([disc(0, held=FIXED)], [touch(0)], "solved", 0),
    "held above the floor": ([disc(0, held=FIXED)], [touch(0, gap="2")], "solved", 0),
    "pressed into the floor": ([disc(0, held=("0", "-3"))], [touch(0, c=2)], "solved", "3/2"),
    "pulled from the floor": (
        [disc(0, held=("0", "3"))],
        [touch(0, c=2, bilateral=True)],
        "solved",
        "-3/2",
    ),
    "two held, in touch": (
        [disc(0, held=FIXED), disc(1, held=("-1", "0"))],
        [touch(1, 0, RIGHT)],
        "solved",
        1,
    ),
    "held, on a rigid floor": ([disc(0, held=FIXED)], [touch(0, c=0)], "solved", None),
    "free, nothing touches": ([disc(0)], [], "unstable", None),
    "free, without load": ([disc(0, NONE)], [], "solved", None),
    "free, without load, in touch": ([disc(0, NONE)], [touch(0)], "solved", 0),
    "free, without load, overlapping": ([disc(0, NONE)], [touch(0, gap="-1")], "solved", 0),
    "may slide along the floor": ([disc(0, held=(None, "0"))], [touch(0)], "solved", 0),
    "slides along the floor": (
        [disc(0, RIGHT, held=(None, "0"))],
        [touch(0)],
        "unstable",
        None,
    ),
    "one freedom": ([disc(0, held=("0", None))], [touch(0)], "solved", 1),
    "one freedom, rigid": ([disc(0, held=("0", None))], [touch(0, c=0)], "solved", 1),
    "one freedom, pulled off": ([disc(0, UP, held=("0", None))], [touch(0)], "unstable", None),
    "one freedom, held closed": (
        [disc(0, UP, held=("0", None))],
        [touch(0, bilateral=True)],
        "solved",
        -1,
    ),
    "one freedom, one support of many open": (
        [disc(0, held=("0", None))],
        [touch(0), touch(0, "ceiling", DOWN, gap="5"), touch(0, "shelf", UP, gap="9")],
        "solved",
        1,
    ),
    "a disc that rests beside one that nothing touches": (
        [disc(0), disc(1, NONE)],
        [touch(0)],
        "solved",
        1,
    ),
    "one axis": ([disc(0, ["-1"], [None], ["0"])], [touch(0, normal=["1"])], "solved", 1),
    "one axis, two discs": (
        [disc(0, ["-1"], [None]), disc(1, ["-1"], [None])],
        [touch(0, normal=["1"]), touch(1, 0, ["1"], c="1/2")],
        "solved",
        2,
    ),
    "one axis, held": ([disc(0, ["-1"], ["0"])], [touch(0, normal=["1"])], "solved", 0),
    "one axis, falls": ([disc(0, ["-1"], [None])], [touch(0, normal=["-1"])], "unstable", None),
    "three axes, on the floor": (
        [disc(0, ["0", "0", "-1"], [None] * 3)],
        [touch(0, normal=["0", "0", "1"])],
        "solved",
        1,
    ),
    "three axes, in a groove": (
        [disc(0, ["0", "0", "-1"], [None, "0", None])],
        [touch(0, "left", TRIPOD[0]), touch(0, "right", TRIPOD[1])],
        "solved",
        "1/2*sqrt(2)",
    ),
    "three axes, held": (
        [disc(0, ["0", "0", "-1"], ["0"] * 3)],
        [touch(0, "left", TRIPOD[0])],
        "solved",
        0,
    ),
    "three axes, rolls off": (
        [disc(0, ["0", "0", "-1"], [None] * 3)],
        [touch(0, "left", TRIPOD[0])],
        "unstable",
        None,
    ),
}
FALLING = {"free, nothing touches", "slides along the floor", "three axes, rolls off"}
each_shape = pytest.mark.parametrize("name", SHAPES)


@pytest.fixture(autouse=True)
def no_warnings():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def scene_of(name):
    discs, contacts, status, force = SHAPES[name]
    return custom(discs, contacts), status, None if force is None else surd(force)


@pytest.mark.parametrize("whole", [False, True])
@pytest.mark.parametrize("method", ["proved", "lemke"])
@each_shape
def test_exact_methods(name, method, whole):
    scene, status, force = scene_of(name)
    solution = solve(scene, method, whole=whole)
    assert solution.status == status
    assert verify(scene, solution).ok
    if status == "solved" and force is not None:
        assert solution.forces[0] == force


@each_shape
def test_newton(name):
    scene, status, force = scene_of(name)
    solution = solve(scene, "newton")
    assert solution.status == {"solved": "solved", "unstable": "unresolved"}[status]
    if force is not None:
        assert solution.force_array[0] == pytest.approx(float(force), abs=1e-9)


@pytest.mark.parametrize("arithmetic", ["exact", "float64", "float32"])
@each_shape
def test_the_z_algorithm(name, arithmetic):
    scene, status, force = scene_of(name)
    result = z_algorithm(scene, arithmetic=arithmetic)
    # A contact that holds while bilateral only is removed and put back for ever.
    cycles = name in ("one freedom, pulled off", "one axis, falls")
    assert result.status == ("cycle" if cycles else status)
    if status == "solved" and force is not None:
        assert float(result.solution.forces[0]) == pytest.approx(float(force), abs=1e-3)


@each_shape
def test_proof_without_digits(name):
    scene, status, force = scene_of(name)
    rigid = any(c.compliance == 0 for c in scene.contacts)
    if rigid or name in FALLING:  # it is for elastic contacts that hold the load, and says so
        with pytest.raises(SolveError, match="use solve"):
            prove_contacts(scene)
        return
    proof = prove_contacts(scene)
    # What is exactly zero cannot be told from what is tiny, and is not claimed.
    ties = status == "solved" and "osculatory" in solve(scene).states
    assert proof.proved == (status == "solved" and not ties)
    if status == "solved" and force is not None:
        assert abs(proof.forces.middle[0] - float(force)) <= proof.forces.radius[0] + 1e-15


def test_a_scene_without_discs_is_refused():
    with pytest.raises(InputError, match="number of discs"):
        custom([], [])
