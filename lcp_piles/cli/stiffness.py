"""What a simulation of finite stiffness should find, beside the rigid limit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..deformation.correction import FirstOrder
from ..deformation.first_order import first_order
from ..deformation.nonlinear import deform
from ..errors import LcpPilesError
from ..fields.base_pressure import base_pressure
from ..numbers.exact import Surd, decimal
from ..scenes.names import contact_name, end_name
from ..solution.solution import Solved
from .report import VERDICTS

Lines = list[tuple[str, str]]


def stiffness_lines(solution: Solved, tau: Surd, digits: int) -> Lines:
    """Facts about the pile at this tau (radii a disc weight), as pairs of a name and a text."""
    lines = [("stiffness", f"at tau = {tau} disc radii a disc weight:")]
    found = first_order(solution)
    if found.status == "none":
        some = ", ".join(contact_name((c.a, c.b)) for c in found.overlapping[:3])
        more = ", ..." if len(found.overlapping) > 3 else ""
        return [
            *lines,
            ("first order", "none: no equilibrium keeps this network, however small tau is"),
            ("", f"({some}{more} would have to overlap); a simulation slides off"),
        ]
    lines += _changes(solution, found, tau, digits)
    lines.append(("valid", _range(found, tau, digits)))
    lines.append(("nonlinear", _nonlinear(solution, found, tau)))
    lines.append(("for small tau", VERDICTS[found.stability.verdict]))
    return lines


def _changes(solution: Solved, found: FirstOrder, tau: Surd, digits: int) -> Lines:
    """Rigid value, first-order value and difference where they are asked for most."""

    def three(rigid: Surd, soft: Surd) -> str:
        change = decimal(soft - rigid, 3)
        sign = "" if change.startswith("-") else "+"
        values = f"{decimal(rigid, digits)} w rigid, {decimal(soft, digits)} w to first order"
        return f"{values} ({sign}{change})"

    contacts = solution.scene.contacts
    stiff, soft = found.forces_at(0), found.forces_at(tau)
    lines = []
    for name, k in (
        ("largest force", int(np.argmax(solution.force_array))),
        ("largest change", int(np.argmax(np.abs(found.force_array)))),
    ):
        contact = contacts[k]
        values = three(stiff[k], soft[k])
        lines.append((name, f"{contact_name((contact.a, contact.b))}: {values}"))
    before, after = base_pressure(solution), base_pressure(replace(solution, forces=soft))
    nearest = min((abs(p.x) for p in before), default=None)
    for rigid, other in zip(before, after, strict=True):
        a, b = rigid.normal, other.normal
        if abs(rigid.x) == nearest and isinstance(a, Surd) and isinstance(b, Surd):
            values = three(a, b)
            lines.append(("under the apex", f"{end_name(rigid.disc)}: {values}"))
    return lines


def _range(found: FirstOrder, tau: Surd, digits: int) -> str:
    limit, changing = found.range
    if limit is None:
        return "to first order no contact changes at any tau"
    some = ", ".join(contact_name((c.a, c.b)) for c in changing[:3])
    more = ", ..." if len(changing) > 3 else ""
    text = f"to first order no contact changes below tau = {decimal(limit, digits)} ({some}{more})"
    return text if tau < limit else f"no longer: {text}"


def _nonlinear(solution: Solved, found: FirstOrder, tau: Surd) -> str:
    """How far the whole nonlinear pile is from both, in floating point."""
    try:
        pile = deform(found, float(tau))
    except LcpPilesError as error:
        return f"not computed: {error}"
    if not pile.converged:
        return "no equilibrium found at this tau"
    rigid = solution.force_array
    off = np.abs(pile.forces - rigid - float(tau) * found.force_array).max(initial=0.0)
    limit = np.abs(pile.forces - rigid).max(initial=0.0)
    return (
        f"the full geometry is off the rigid limit by at most {limit:.3g} w, off the first order "
        f"by {off:.3g} w"
    )
