"""The exact road without floating point: Lemke's method from a cold start.

`lemke` pivots the LCP of a contact system; here its end is read, a solution or a ray.
"""

from __future__ import annotations

from time import perf_counter

from ..mechanics.contact_lcp import ContactLCP, contact_lcp
from ..mechanics.motions import CollapseError, resisted_by_none, work_sign
from ..mechanics.system import ContactSystem
from ..pivoting.lemke import LemkeResult, lemke
from ..solution.fit import check_fit
from .method import Method, Outcome, Progress


def run_lemke(system: ContactSystem, progress: Progress | None = None) -> Outcome:
    """Lemke's method on all contacts of a system."""
    try:
        reduced = contact_lcp(system)
    except CollapseError as error:
        return free_fall(error)
    last = [perf_counter()]

    def tick(pivots: int) -> None:
        if progress and perf_counter() - last[0] > 1:
            last[0] = perf_counter()
            progress(f"{pivots} pivots")

    result = lemke(reduced.problem, progress=tick)
    if result.z_vector is None:
        return ended_on_ray(reduced, result)
    state = reduced.state(result.z_vector)
    return Outcome(result.pivots, "exact Lemke pivots, verified", state)


def free_fall(error: CollapseError) -> Outcome:
    """The outcome where a load moves the pile although every contact is held closed."""
    return Outcome(0, "a free motion is loaded", motion=error.motion)


def ended_on_ray(reduced: ContactLCP, result: LemkeResult) -> Outcome:
    """The outcome where Lemke's method found no solution: a collapse, if that is proved.

    Raises `ContradictionError` where no displacements fit the rigid contacts, which for a definite
    problem is the only other reason.
    """
    system = reduced.base.system
    if result.certificate is not None:
        motion = reduced.motion(result.certificate)
        if work_sign(system.load, motion) > 0 and resisted_by_none(system, motion):
            return Outcome(result.pivots, "Farkas certificate", motion=motion)
    check_fit(system)
    proof = "none: an indefinite problem, and Lemke's method ended on a ray"
    return Outcome(result.pivots, proof)


LEMKE = Method("lemke", "Lemke's method from a cold start, no floating point", "exact", run_lemke)
