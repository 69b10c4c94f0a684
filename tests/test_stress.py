"""Stress against the paper's formula taken literally, the virial theorem and closed forms."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import sympy

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    Solution,
    nt30,
    nt60,
    solve,
    stress,
    surd,
    tbs,
    tss,
)
from lcp_piles.fields.stress import Stress
from lcp_piles.numbers.exact import ONE, ZERO
from lcp_piles.numbers.vectors import exact_vector

SCENES = {
    "tbs": tbs(5),
    "tss": tss(6),
    "nt60-rigid": nt60(5, floor_compliance=0),
    "nt60-resting": nt60(4, corner_stones="resting"),
    "nt30": nt30(5),
    "nt30-rational-push": nt30(4, push="20"),
    "nt30-paper-floor": nt30(4, floor_compliance="-1/2"),
    "nt30-truncated": nt30(4).without([(1, 1)]),
}


@pytest.fixture(params=SCENES, scope="module")
def solution(request) -> Solution:
    solved = solve(SCENES[request.param])
    assert solved.status == "solved"
    return solved


def contact_force(solution: Solution, k: int) -> tuple:
    """The force on disc a of contact k."""
    return tuple(n * solution.forces[k] for n in solution.scene.contacts[k].normal)


def contact_point(scene: Scene, contact: Contact) -> tuple:
    """Half way between two discs, at the foot of a disc on a support."""
    centre = scene.disc(contact.a).position
    if isinstance(contact.b, str):
        return tuple(p - n for p, n in zip(centre, contact.normal, strict=True))
    other = scene.disc(contact.b).position
    return tuple((p + q) / 2 for p, q in zip(centre, other, strict=True))


def test_it_is_the_paper_s_sum_of_force_times_contact_point(solution):
    scene = solution.scene
    found = stress(solution)
    for disc in scene.discs:
        sum_ = [[ZERO, ZERO], [ZERO, ZERO]]
        for k, contact in enumerate(scene.contacts):
            if disc.id not in (contact.a, contact.b):
                continue
            sign = 1 if contact.a == disc.id else -1
            force = [sign * x for x in contact_force(solution, k)]
            point = contact_point(scene, contact)
            for i in (0, 1):
                for j in (0, 1):
                    sum_[i][j] += force[i] * (point[j] - disc.position[j])
        assert sum_[0][1] == sum_[1][0]  # torque-free
        assert found.of(disc.id) == (tuple(sum_[0]), tuple(sum_[1]))


def test_trace_is_minus_the_sum_of_the_forces(solution):
    found = stress(solution)
    for disc in solution.scene.discs:
        forces = [
            solution.forces[k]
            for k, contact in enumerate(solution.scene.contacts)
            if disc.id in (contact.a, contact.b)
        ]
        (xx, _), (_, yy) = found.of(disc.id)
        assert xx + yy == -sum(forces, ZERO)


def test_total_is_the_virial_of_the_external_forces(solution):
    """Contact forces between discs cancel: what is left are weights, floors and holders."""
    scene = solution.scene
    found = stress(solution)
    total = [[ZERO, ZERO], [ZERO, ZERO]]
    virial = [[ZERO, ZERO], [ZERO, ZERO]]

    def act(force, point):
        for i in (0, 1):
            for j in (0, 1):
                virial[i][j] += force[i] * point[j]

    holder = {disc.id: [-p for p in disc.load] for disc in scene.discs}
    for k, contact in enumerate(scene.contacts):
        force = contact_force(solution, k)
        holder[contact.a] = [h - f for h, f in zip(holder[contact.a], force, strict=True)]
        if isinstance(contact.b, str):
            act(force, contact_point(scene, contact))
        else:
            holder[contact.b] = [h + f for h, f in zip(holder[contact.b], force, strict=True)]
    for disc in scene.discs:
        act(disc.load, disc.position)
        act(holder[disc.id], disc.position)
        for axis in (0, 1):  # the external force of a holder acts on held axes only
            assert disc.held[axis] is not None or holder[disc.id][axis] == 0
        tensor = found.of(disc.id)
        for i in (0, 1):
            for j in (0, 1):
                total[i][j] += tensor[i][j]
    assert total == virial


def test_principal_values_and_axes_are_the_eigenpairs(solution):
    found = stress(solution)
    values = np.linalg.eigvalsh(found.array)
    np.testing.assert_allclose(found.principal, values, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.pressure, -values.mean(axis=1), rtol=0, atol=1e-12)
    axis = np.radians(found.angle)
    direction = np.stack([np.cos(axis), np.sin(axis)], axis=1)
    known = ~np.isnan(axis)
    assert known.any()
    turned = np.einsum("kij,kj->ki", found.array, direction)[known]
    expected = found.principal[known, :1] * direction[known]
    np.testing.assert_allclose(turned, expected, rtol=0, atol=1e-12)


def test_floating_point_solutions_agree(solution):
    as_float = replace(solution, forces=solution.force_array)
    found, exact = stress(as_float), stress(solution)
    np.testing.assert_allclose(found.array, exact.array, rtol=0, atol=1e-12)
    disc = solution.scene.discs[0].id
    assert isinstance(found.of(disc)[0][0], float)


def test_disc_between_two_corner_stones():
    """TSS with two rows: the top disc rests at 30 degrees with force w on either side."""
    found = stress(solve(tss(2)))
    assert found.of((1, 1)) == ((surd("-3/2"), ZERO), (ZERO, surd("-1/2")))
    assert found.sympy((1, 1)) == sympy.diag(-3, -1) / (2 * sympy.pi)
    assert found.angle[0] == 0
    np.testing.assert_allclose(found.principal[0], [-1.5 / np.pi, -0.5 / np.pi])
    # Each stone carries one contact along (sqrt(3)/2, 1/2).
    assert found.of((2, 1)) == (
        (surd("-3/4"), surd("-1/4*sqrt(3)")),
        (surd("-1/4*sqrt(3)"), surd("-1/4")),
    )
    np.testing.assert_allclose(found.angle[1:], [30, -30])


def test_mirror_images_have_mirrored_stress(solution):
    scene, found = solution.scene, stress(solution)
    at = {disc.position: disc.id for disc in scene.discs}
    for disc in scene.discs:
        x, y = disc.position
        (xx, xy), (_, yy) = found.of(disc.id)
        assert found.of(at[(-x, y)]) == ((xx, -xy), (-xy, yy))


def test_isotropic_stress_has_no_axis():
    found = Stress(tss(2), exact_vector(["-1/3", 0, "-1/3", 0, 0, 0, -1, 0, "-1/3"]))
    assert np.isnan(found.angle).tolist() == [True, True, False]


def test_refuses_what_has_no_forces_or_is_not_plane():
    collapsed = solve(nt60(3).without([(3, 1)]))
    assert collapsed.status == "unstable"
    with pytest.raises(InputError, match="no forces"):
        stress(collapsed)
    up = (ZERO, ZERO, ONE)
    sphere = Disc((1,), up, (ZERO, ZERO, -ONE), (ZERO, ZERO, None))
    scene = Scene((sphere,), (Contact((1,), "floor", up, Fraction(1)),))
    with pytest.raises(InputError, match="dimension"):
        stress(solve(scene))
