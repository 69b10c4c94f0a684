"""First loading: friction with elastic tangential springs, as a linear programme with choices.

Loads grow once, from nothing, on springs without a past. With the normal n of a contact from b to
a, the tangent t, and the motions of disc a seen from b,

    gap    g = n . (u_a - u_b) + o + c f_n,
    slide  s = t . (u_a - u_b) + turn_a + turn_b        (the clockwise turns times R),

a closed contact (g = 0) has f_t = -s / c_t as long as |f_t| <= mu f_n, and slips at that limit. In
f_n = x+ + x-, f_t = mu (x+ - x-) all of that reads

    balance,    s + c_t f_t = slip- - slip+,    x+, x-, g, slip+, slip- >= 0,

and each contact is in a state, which leaves it some of its columns:

    open      g, slip+, slip-       stick     x+, x-
    slip+     x+, slip+             slip-     x-, slip-
    closed    x                     of a smooth contact, whose other state, open, leaves it g

What a choice of states admits, or that it admits nothing, is a matter of a linear programme and its
certificate. Free motions are differences of two columns.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Exact, Surd, rational
from ..numbers.vectors import ExactVector, combination
from ..programs.constraints import Constraints, SparseSurds, constraints
from ..scenes.scene import Contact, Scene
from .equations import FrictionProblem, balance, contact_actions, friction_problem

State = Literal["stick", "open", "slip+", "slip-", "closed"]
Entry = tuple[int, int, Surd]


@dataclass(frozen=True, eq=False)
class LoadingProblem:
    """The programme: columns of `forces`, then gaps and slips, then motions.

    `choices[k]` are the columns that each state leaves contact k. Row i of `forces` moves by
    column `motions[i]` less the next one. `ratio` is the tangential stiffness over the normal one.
    """

    forces: FrictionProblem
    ratio: Fraction
    constraints: Constraints
    choices: list[Mapping[State, tuple[int, ...]]]
    motions: list[int]

    def columns(self, states: Sequence[State | None]) -> list[int]:
        """The columns that states leave; None stands for a contact in whichever state."""
        left: set[int] = set()
        for state, choice in zip(states, self.choices, strict=True):
            left.update(*(choice.values() if state is None else (choice[state],)))
        return [*sorted(left), *(j + side for j in self.motions for side in (0, 1))]

    def displacements(self, x: ExactVector) -> ExactVector:
        """Displacements (x, y) and clockwise turn of every disc, flat; nothing for what is held."""
        place = dict(zip(self.forces.rows, self.motions, strict=True))
        discs = range(len(self.forces.scene.discs))
        at = [place.get((d, axis)) for d in discs for axis in range(3)]
        signs = [0 if j is None else 1 for j in at]
        plain = x.plain()
        up, down = (plain.take([(j or 0) + side for j in at], signs) for side in (0, 1))
        return combination([(ONE, up), (-ONE, down)])


def loading_problem(
    scene: Scene, mu: Exact, rough: Sequence[str] = (), ratio: Exact = 1
) -> LoadingProblem:
    """The first loading of a plane scene whose contacts all have a compliance.

    Takes `mu` and `rough` as `friction_problem`. Discs turn freely unless all their motions are
    held; supports and held discs do not turn.
    """
    matrix, right, *_ = balance(scene, mu, rough)
    problem = friction_problem(scene, mu, rough)
    stiff = rational(ratio, "the ratio of the stiffnesses")
    if stiff <= 0:
        raise InputError("the ratio of the stiffnesses", ratio, "a positive rational number")
    for contact in scene.contacts:
        if contact.compliance <= 0:
            raise InputError(
                contact.name,
                f"a contact of compliance {contact.compliance}",
                "a positive compliance: rigid contacts leave forces open",
            )
    row, column = matrix.shape
    entries = list(zip(matrix.rows, matrix.columns, matrix.values, strict=True))
    choices: list[Mapping[State, tuple[int, ...]]] = []
    couplings: list[tuple[int, int, Surd]] = []  # (row, row of the balance, how they couple)
    for k, actions in enumerate(contact_actions(scene, problem.rows)):
        contact = scene.contacts[k]
        plus, minus, gap = problem.plus[k], problem.minus[k], column
        couplings += [(row, i, normal) for i, normal, _ in actions]
        entries += [(row, j, ONE * contact.compliance) for j in {plus, minus}]
        entries.append((row, gap, -ONE))
        right.append(-contact.gap - prescribed(scene, contact, contact.normal))
        row, column = row + 1, column + 1
        if plus == minus:
            choices.append({"closed": (plus,), "open": (gap,)})
            continue
        up, down = column, column + 1
        choices.append(
            {
                "stick": (plus, minus),
                "open": (gap, up, down),
                "slip+": (plus, up),
                "slip-": (minus, down),
            }
        )
        soft = problem.mu * (contact.compliance / stiff)
        couplings += [(row, i, tangential) for i, _, tangential in actions]
        entries += [(row, plus, soft), (row, minus, -soft), (row, up, ONE), (row, down, -ONE)]
        right.append(-prescribed(scene, contact, tangent(contact)))
        row, column = row + 1, column + 2
    motions = list(range(column, column + 2 * len(problem.rows), 2))
    for i, moved, value in couplings:
        if value:
            entries += [(i, motions[moved], value), (i, motions[moved] + 1, -value)]
    columns = column + 2 * len(problem.rows)
    matrix = SparseSurds(
        (row, columns),
        [i for i, _, _ in entries],
        [j for _, j, _ in entries],
        [value for _, _, value in entries],
    )
    return LoadingProblem(problem, stiff, constraints(matrix, right, columns), choices, motions)


def tangent(contact: Contact) -> tuple[Surd, Surd]:
    """The direction t in which a tangential force on disc a counts."""
    n_x, n_y = contact.normal
    return -n_y, n_x


def prescribed(scene: Scene, contact: Contact, direction: Sequence[Surd]) -> Surd:
    """How prescribed displacements move disc a of a contact, seen from b, along a direction."""
    total = ZERO
    for end, sign in ((contact.a, 1), (contact.b, -1)):
        if end not in scene.supports:
            for component, held in zip(direction, scene.disc(end).held, strict=True):
                if held:
                    total += sign * component * held
    return total
