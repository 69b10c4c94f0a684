"""The forces that balance under Coulomb's law, as the points of a linear programme.

At a contact with the unit normal n from b to a and the tangent t = (-n_y, n_x), disc a feels
f_n n + f_t t and disc b the opposite. With |f_t| <= mu f_n written as

    f_n = x+ + x-,    f_t = mu (x+ - x-),    x+, x- >= 0,

balance of forces and torques is A x = b, x >= 0. The torque of a contact on either disc is -R f_t.
A smooth contact has one column, f_n = x; so has every contact at mu = 0, where torques are nothing.
Held axes and supports take what comes; a disc turns freely unless all its motions are held. No
compliance and no gap enters: these are all networks that are statically admissible.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from flint import fmpz

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Exact, Surd, surd
from ..numbers.vectors import ExactVector, combination
from ..programs.constraints import Constraints, SparseSurds, constraints
from ..scenes.scene import Scene


@dataclass(frozen=True, eq=False)
class Network:
    """Forces on all contacts of a scene, in w: along the normal, and along the tangent.

    `tangential[k]` acts on disc a along t = (-n_y, n_x).
    """

    normal: ExactVector
    tangential: ExactVector


@dataclass(frozen=True, eq=False)
class FrictionProblem:
    """The constraints A x = b, x >= 0 of a scene with friction mu, and what the columns are.

    Contact k has the columns `plus[k]` and `minus[k]`, the same where it is smooth. `rows` names
    the equations: (disc number, axis), axis 2 being the rotation.
    """

    scene: Scene
    mu: Surd
    rough: frozenset[str]
    constraints: Constraints
    plus: list[int]
    minus: list[int]
    rows: list[tuple[int, int]]

    def network(self, x: ExactVector) -> Network:
        """The forces of a point (or the changes along a ray)."""
        plain = x.plain()
        signs = [int(p != m) for p, m in zip(self.plus, self.minus, strict=True)]
        ones = [1] * len(signs)
        up, down = plain.take(self.plus, ones), plain.take(self.minus, signs)
        one = surd(1)
        normal = combination([(one, up), (one, down)])
        if not self.mu:
            nothing = ExactVector({1: [fmpz(0)] * len(signs)}, fmpz(1))
            return Network(normal, nothing)
        shear = [(self.mu, plain.take(self.plus, signs)), (-self.mu, down)]
        return Network(normal, combination(shear))

    def motion(self, y: ExactVector) -> ExactVector:
        """A Farkas vector as a motion: displacements (x, y) and clockwise turn of every disc, flat.

        Along a contact's t the surface of disc a then moves by t . u_a + turn_a, that of disc b by
        t . u_b - turn_b.
        """
        place = {row: i for i, row in enumerate(self.rows)}
        flat = [place.get((d, axis)) for d in range(len(self.scene.discs)) for axis in range(3)]
        signs = [0 if i is None else -1 for i in flat]
        return y.plain().take([i or 0 for i in flat], signs)


def friction_problem(scene: Scene, mu: Exact, rough: Sequence[str] = ()) -> FrictionProblem:
    """The linear programme of all admissible networks of a plane scene.

    `mu` is the exact coefficient of friction between discs, and between discs and the supports
    named in `rough`; other supports are smooth. Raises `InputError` for a scene that is not plane,
    a negative mu, and contacts held closed, to which Coulomb's law does not apply.

    >>> from lcp_piles import tbs
    >>> problem = friction_problem(tbs(1), "1/5*sqrt(3)")
    >>> len(problem.rows), len(problem.constraints.columns)
    (3, 6)
    """
    matrix, loads, plus, minus, rows = balance(scene, mu, rough)
    read = constraints(matrix, loads, matrix.shape[1])
    return FrictionProblem(scene, surd(mu), frozenset(rough), read, plus, minus, rows)


class Balance(NamedTuple):
    """The equations A x = b before they are read, and what their columns and rows are."""

    matrix: SparseSurds
    loads: list[Surd]
    plus: list[int]
    minus: list[int]
    rows: list[tuple[int, int]]


def balance(scene: Scene, mu: Exact, rough: Sequence[str]) -> Balance:
    """The equations of `friction_problem`."""
    friction = surd(mu)
    if friction < 0:
        raise InputError("the friction mu", str(friction), "a number of at least 0")
    if scene.dimension != 2:
        raise InputError("the number of axes", scene.dimension, "2: friction is for plane scenes")
    for contact in scene.contacts:
        if contact.bilateral:
            raise InputError(
                contact.name,
                "held closed",
                "a contact that can open: Coulomb's law says nothing about one that pulls",
            )
    rows = _equations(scene, turning=bool(friction))
    sticky = _rough_contacts(scene, friction, rough)
    entries: list[tuple[int, int, Surd]] = []
    plus, minus = [], []
    known: dict[tuple[Surd, Surd, int], Surd] = {}
    count = 0
    for k, actions in enumerate(contact_actions(scene, rows)):
        plus.append(count)
        minus.append(count + sticky[k])
        for side in _SIDES[sticky[k]]:
            for i, normal, tangential in actions:
                key = normal, tangential, side
                if key not in known:
                    known[key] = normal + friction * side * tangential
                if known[key]:
                    entries.append((i, count, known[key]))
            count += 1
    loads = [-scene.discs[d].load[axis] if axis < 2 else ZERO for d, axis in rows]
    matrix = SparseSurds(
        (len(rows), count),
        [row for row, _, _ in entries],
        [column for _, column, _ in entries],
        [value for _, _, value in entries],
    )
    return Balance(matrix, loads, plus, minus, rows)


_SIDES = {True: (1, -1), False: (0,)}


def contact_actions(
    scene: Scene, rows: Sequence[tuple[int, int]]
) -> list[list[tuple[int, Surd, Surd]]]:
    """What a unit normal and a unit tangential force of each contact add to the equations.

    For every contact (row, normal, tangential); by virtual work, the same numbers are how the
    motion of the row moves disc a of the contact, seen from b, along the normal and the tangent.
    """
    place = {row: i for i, row in enumerate(rows)}
    normals, which = scene.normals
    directions = [((n_x, -n_y), (n_y, n_x), (ZERO, ONE)) for n_x, n_y in normals]
    opposite = [tuple((-n, -t) for n, t in d[:2]) + d[2:] for d in directions]
    a, b = scene.ends
    actions = []
    for disc, other, k in zip(a.tolist(), b.tolist(), which.tolist(), strict=True):
        sides = ((disc, directions[k]), (other, opposite[k]))
        actions.append(
            [
                (place[end, axis], *pair)
                for end, pairs in sides
                for axis, pair in enumerate(pairs)
                if (end, axis) in place
            ]
        )
    return actions


def _equations(scene: Scene, turning: bool) -> list[tuple[int, int]]:
    """The equations (disc, axis) of all free motions."""
    rows: list[tuple[int, int]] = []
    for k, disc in enumerate(scene.discs):
        rows += [(k, axis) for axis, h in enumerate(disc.held) if h is None]
        if turning and not disc.fixed:
            rows.append((k, 2))
    return rows


def _rough_contacts(scene: Scene, mu: Surd, rough: Sequence[str]) -> list[bool]:
    """Which contacts have friction."""
    if isinstance(rough, str):
        raise InputError("rough", rough, "a sequence of names of supports", f'pass ("{rough}",)')
    for name in rough:
        if name not in scene.supports:
            known = ", ".join(scene.supports) or "none, as the scene has no supports"
            raise InputError("the rough support", name, known)
    sticky = [True] + [name in rough for name in scene.supports]
    return [bool(mu) and sticky[k + 1] for k in scene.support_of.tolist()]
