"""The Z algorithm: published cycles, and every iteration done again by dense linear algebra."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from helpers import (
    equilibrium_faults,
    float_matrix,
    image_contacts,
    nullity,
)
from random_scenes import ROOT, custom, random_scene, truth

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    nt60,
    pile,
    solve,
    surd,
    tbs,
    tss,
    verify,
    z_algorithm,
)
from lcp_piles.methods.z.z_algorithm import ZResult
from lcp_piles.problems import grain_scene


def sets(trace: tuple) -> list[tuple[int, ...]]:
    return [step.Z for step in trace]


def test_grain_scene_cycles_as_published() -> None:
    scene = grain_scene().scene
    result = z_algorithm(scene)
    walls = (2, 3, 4)
    closed = [tuple(k - 1 for k in walls if k not in Z) for Z in sets(result.trace)]
    assert closed == [(1, 2, 3), (1, 3), (), (2, 3), (1, 3)]
    assert (result.status, len(result.cycle), result.solution.status) == ("cycle", 3, "unresolved")


def test_lemke_solves_the_grain_scene() -> None:
    case = grain_scene()
    scene = case.scene
    solution = solve(scene, "lemke")
    assert equilibrium_faults(scene, solution) == []
    assert tuple(solution.forces) == case.forces
    assert solution.forces[4] == surd("13/21*sqrt(20)")  # |c_3| f_3
    # u = -sum c_i f_i, and each spring pulls with the displacement along it.
    assert list(solution.displacements) == [surd("-26/21"), surd("52/21")]
    started = z_algorithm(scene, start=[2, 3])
    assert (started.status, len(started.trace)) == ("solved", 1)
    assert list(started.solution.forces) == list(solution.forces)


PILES = [
    pytest.param(pile(kind, N, **parameters), id=f"{kind}-{N}-{'-'.join(parameters.values())}")
    for kind, N, parameters in [
        ("nt60", 3, {}),
        ("nt60", 8, {}),
        ("nt60", 5, {"corner_stones": "resting"}),
        ("nt30", 5, {}),
        ("nt30", 6, {"push": "20"}),
        ("nt30", 4, {"push": "59/3*sqrt(3)", "floor_compliance": "0"}),
        ("nt30", 8, {}),
        ("tss", 9, {}),
        ("tss", 13, {}),
        ("tss", 6, {"push": "10", "floor_compliance": "2/7"}),
        ("tbs", 7, {}),
    ]
]


@pytest.mark.parametrize("scene", PILES)
def test_forces_are_those_of_lemke(scene: Scene) -> None:
    result = z_algorithm(scene)
    exact = solve(scene, "lemke")
    assert result.status == "solved"
    assert equilibrium_faults(scene, result.solution) == []
    assert list(result.solution.forces) == list(exact.forces)
    assert result.solution.states == exact.states
    record = result.solution.record
    assert (record.method, record.arithmetic) == ("z", "exact")
    assert record.pivots == len(result.trace)
    assert not result.trace[-1].removed
    assert not result.trace[-1].returned


class Dense:
    """The linear step on the whole pile in numpy: the least-norm solution of all equations."""

    def __init__(self, scene: Scene) -> None:
        self.B, self.o, self.p = float_matrix(scene)
        self.C = np.array([float(contact.compliance) for contact in scene.contacts])

    def solve(self, Z: set[int]) -> tuple[np.ndarray, np.ndarray, int] | None:
        """Forces, distances B u + o and nullity with the contacts of Z absent."""
        n = self.B.shape[1]
        closed = np.array([k not in Z for k in range(len(self.o))])
        B = self.B[closed]
        A = np.block([[np.zeros((n, n)), B.T], [B, np.diag(self.C[closed])]])
        right = np.concatenate([-self.p, -self.o[closed]])
        x = np.linalg.lstsq(A, right, rcond=1e-11)[0]
        if np.abs(A @ x - right).max() > 1e-6:
            return None
        forces = np.zeros(len(self.o))
        forces[closed] = x[n:]
        return forces, self.B @ x[:n] + self.o, nullity(B)


def both(numbers: tuple[int, ...], image: list[int]) -> set[int]:
    return set(numbers) | {image[k] for k in numbers}


@pytest.mark.parametrize("scene", PILES)
def test_every_iteration_again_in_dense_linear_algebra(scene: Scene) -> None:
    """On the whole pile: what is solvable, what leaves, returns and is put back, and the rank."""
    result = z_algorithm(scene)
    dense, image = Dense(scene), image_contacts(scene)
    Z: set[int] = set()
    distances = dense.o
    for step in result.trace:
        for k in step.reintroduced:
            assert dense.solve(Z) is None
            assert abs(distances[k]) <= min(abs(distances[j]) for j in Z) + 1e-9
            Z -= both((k,), image)
        assert both(step.Z, image) == Z
        forces, distances, free = dense.solve(Z)
        assert step.nullity <= free  # the half has the symmetric motions only
        assert step.singular <= (free > 0)
        removed, returned = both(step.removed, image), both(step.returned, image)
        assert all(forces[k] < 0 for k in removed)
        assert all(forces[k] > -1e-9 for k in range(len(forces)) if k not in removed | Z)
        assert all(distances[k] < 1e-9 for k in returned)
        assert all(distances[k] > 0 for k in Z - returned)
        Z = (Z | removed) - returned


def test_piles_that_need_each_step_of_the_algorithm() -> None:
    """So that the test above has met them: contacts put back, returned, and singular systems."""
    traces = [step for scene in PILES for step in z_algorithm(scene.values[0]).trace]
    assert any(step.reintroduced for step in traces)
    assert any(step.returned for step in traces)
    assert any(step.singular and (step.removed or step.returned) for step in traces)


@pytest.mark.parametrize("scene", PILES)
@pytest.mark.parametrize("arithmetic", ["float64", "float32"])
def test_floating_point_shares_the_iteration(scene: Scene, arithmetic: str) -> None:
    exact = z_algorithm(scene)
    result = z_algorithm(scene, arithmetic=arithmetic)
    assert result.status == "solved"
    if arithmetic == "float64":  # float32 cannot tell small forces from none
        assert sets(result.trace) == sets(exact.trace)
        assert [s.nullity for s in result.trace] == [s.nullity for s in exact.trace]
        # Contacts at the same distance go back in either order.
        put_back = [[set(s.reintroduced) for s in r.trace] for r in (result, exact)]
        assert put_back[0] == put_back[1]
    largest = exact.solution.force_array.max()
    error = np.abs(result.solution.force_array - exact.solution.force_array).max() / largest
    residual = verify(scene, result.solution).residual
    bound = 1e-11 if arithmetic == "float64" else 3e-3
    assert error < bound
    assert residual < bound * np.abs(exact.solution.displacement_array).max()
    assert result.solution.record.arithmetic == arithmetic
    assert not result.solution.exact


def test_whole_pile_is_the_half_with_its_image() -> None:
    scene = nt60(6)
    half, whole = z_algorithm(scene), z_algorithm(scene, whole=True)
    assert list(half.solution.forces) == list(whole.solution.forces)
    image = image_contacts(scene)
    assert [both(Z, image) for Z in sets(half.trace)] == [set(Z) for Z in sets(whole.trace)]


def test_start_from_the_solution_and_from_anything() -> None:
    scene = pile("nt30", 6)
    exact = solve(scene, "lemke")
    opened = [k for k, state in enumerate(exact.states) if state != "closed"]
    result = z_algorithm(scene, start=opened)
    assert (result.status, len(result.trace)) == ("solved", 1)
    assert list(result.solution.forces) == list(exact.forces)
    # All contacts removed: nothing stands, and contacts go back from the undisplaced lattice.
    result = z_algorithm(scene, start=range(len(scene.contacts)))
    assert result.trace[0].reintroduced
    assert result.status == "solved"
    assert list(result.solution.forces) == list(exact.forces)


def test_paper_floor() -> None:
    scene = pile("nt30", 6, floor_compliance="-1/2", push="50")
    result = z_algorithm(scene)
    assert result.status == "solved"
    assert equilibrium_faults(scene, result.solution) == []
    assert result.solution.stability.verdict == "undecided"


@pytest.mark.parametrize("arithmetic", ["exact", "float64"])
def test_pile_on_which_it_cycles(arithmetic: str) -> None:
    """A contact that pulls leaves, nothing holds the rest, and the same contact goes back."""
    scene = tss(6, push=95)
    result = z_algorithm(scene, arithmetic=arithmetic)
    assert (result.status, len(result.cycle), result.solution.status) == ("cycle", 1, "unresolved")
    (Z,) = result.cycle
    last = result.trace[-1]
    assert last.Z == result.trace[-2].Z == Z
    assert set(last.reintroduced) >= set(last.removed)
    assert solve(scene, "lemke").status == "solved"
    # The set is no solution: with these contacts absent some of the others pull, said by numpy.
    forces, _, _ = Dense(scene).solve(both(Z, image_contacts(scene)))
    assert all(forces[k] < -1e-3 for k in last.removed)


def test_limit() -> None:
    scene = pile("nt30", 6)
    result = z_algorithm(scene, limit=3)
    assert (result.status, len(result.trace), result.solution.status) == ("limit", 3, "unresolved")
    assert z_algorithm(scene, limit=0).trace == ()


@pytest.mark.parametrize("arithmetic", ["exact", "float64", "float32"])
def test_pile_that_falls_with_all_contacts_closed(arithmetic: str) -> None:
    scene = tbs(3).without((i, j) for i in (4, 5) for j in range(1, i + 1))  # nothing below
    result = z_algorithm(scene, arithmetic=arithmetic)
    assert (result.status, result.trace) == ("unstable", ())
    if arithmetic == "exact":
        assert result.solution.status == "unstable"
        assert verify(scene, result.solution).ok
    else:
        assert result.solution.status == "unresolved"


def test_pile_that_falls_only_because_contacts_open_never_loops() -> None:
    scene = nt60(5).without([(3, 1)])
    assert solve(scene, "lemke").status == "unstable"
    result = z_algorithm(scene)
    assert (result.status, result.solution.status) == ("cycle", "unresolved")


@pytest.mark.parametrize(
    "arguments",
    [
        {"start": [9999]},
        {"start": [-1]},
        {"start": ["a"]},
        {"arithmetic": "float16"},
        {"limit": -1},
        {"limit": 2.5},
        {"limit": True},
    ],
)
def test_refuses(arguments: dict) -> None:
    with pytest.raises(InputError):
        z_algorithm(nt60(3), **arguments)


def test_any_contact_may_be_removed_at_first() -> None:
    """The last set is that of the solution, wherever the iteration started."""
    scene = nt60(3)
    last = len(scene.contacts) - 1
    for k in (0, last):
        result = z_algorithm(scene, start=[k], whole=True)
        first = result.trace[0]
        assert {*first.Z, *first.reintroduced} == {k}
        assert result.status == "solved"
    with pytest.raises(InputError, match=f"from 0 to {last}"):
        z_algorithm(scene, start=[last + 1])


def test_a_limit_of_no_system_ends_at_once() -> None:
    result = z_algorithm(nt60(3), limit=0)
    assert (result.status, result.trace, result.Z) == ("limit", (), ())


def test_refuses_to_remove_what_is_held_closed() -> None:
    with pytest.raises(InputError, match="held closed"):
        z_algorithm(grain_scene().scene, start=[0])


def test_result_counts_from_the_trace() -> None:
    result: ZResult = z_algorithm(pile("nt30", 6))
    assert result.reintroductions == sum(len(s.reintroduced) for s in result.trace) > 0
    assert result.Z == result.trace[-1].Z
    assert result.singular == 0
    for before, after in pairwise(result.trace):
        following = {*before.Z, *before.removed} - {*before.returned}
        assert {*after.Z, *after.reintroduced} == following
    fallen = z_algorithm(nt60(3).without([(3, 1), (3, 3)]))
    for ended in (result, fallen):
        assert ended.solution.record.pivots == len(ended.trace)


@pytest.mark.parametrize("whole", [False, True])
@pytest.mark.parametrize("arithmetic", ["exact", "float64", "float32"])
def test_dependent_rigid_contacts_carry_the_least_sum_of_squares(arithmetic, whole):
    """A disc of weight 1 on a floor, F, between two slopes, S: F + sqrt(3) S = 1.

    The least F^2 + 2 S^2 is at F = 2/5, S = sqrt(3)/5.
    """
    normals = {"floor": (0, 1), "left": ("1/2", ROOT / 2), "right": ("-1/2", ROOT / 2)}
    contacts = [Contact(1, name, normal, 0) for name, normal in normals.items()]
    scene = custom([Disc(1, (0, 0), (0, -1), (None, None))], contacts)
    result = z_algorithm(scene, arithmetic=arithmetic, whole=whole)
    step = result.trace[0]
    assert (step.singular, step.Z, result.status) == (True, (), "solved")
    assert result.solution.record.part == ("whole" if whole else "even")
    slope = ROOT / 5
    assert [float(f) for f in result.solution.forces] == pytest.approx(
        [0.4, float(slope), float(slope)]
    )
    if arithmetic == "exact":
        assert list(result.solution.forces) == [surd("2/5"), slope, slope]


def test_exact_and_floating_point_walk_the_same_way_on_rigid_scenes():
    walked = 0
    for seed in range(40):
        scene = random_scene(seed)
        if truth(scene) == "solved":
            for whole in (False, True):
                runs = [z_algorithm(scene, arithmetic=a, whole=whole) for a in ("exact", "float64")]
                one, other = ([(s.Z, s.rank, s.nullity) for s in run.trace] for run in runs)
                assert one == other
                walked += len(one) > 1
    assert walked > 5
