"""Contact systems, LCPs and paths go to other processes, and are shown in one line."""

import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction

import numpy as np
import pytest

from lcp_piles import contact_lcp, contact_system, lcp, lemke, nt30, push_path, tss
from lcp_piles.mechanics.held_set import held_set
from lcp_piles.mechanics.motions import CollapseError
from lcp_piles.push.continuation import continuation

PATH = push_path("nt30", 4)
SYSTEM = contact_system(tss(6))
ALL = np.ones(SYSTEM.contacts, dtype=bool)


def pivots(system):
    """Run in another process: a system goes there, an LCP and its result come back."""
    reduced = contact_lcp(system)
    result = lemke(reduced.problem)
    return reduced, result, reduced.state(result.z_vector)


def force_far_out(path):
    return path.force((1, 1), (2, 2), 100), path.path.segments[0].linear_force(0)


@pytest.mark.parametrize("way", ["fork", "spawn", "forkserver"])
def test_values_travel_between_processes(way):
    with ProcessPoolExecutor(1, multiprocessing.get_context(way)) as pool:
        reduced, result, state = pool.submit(pivots, SYSTEM).result()
        there = pool.submit(force_far_out, PATH).result()
    here = lemke(contact_lcp(SYSTEM).problem)
    assert list(result.z) == list(here.z)
    assert list(reduced.problem.q) == list(contact_lcp(SYSTEM).problem.q)
    assert reduced.problem.column(1) == contact_lcp(SYSTEM).problem.column(1)
    assert list(reduced.state(here.z_vector).forces) == list(state.forces)
    assert there == force_far_out(PATH)


def test_what_was_solved_already_travels_too():
    """Factors of a matrix cannot be sent; what holds them is sent without."""
    held = held_set(SYSTEM, ALL, progress=lambda text: None)
    state = held.state(SYSTEM.gap, SYSTEM.load)
    again = pickle.loads(pickle.dumps(held))
    assert list(again.state(SYSTEM.gap, SYSTEM.load).forces) == list(state.forces)
    assert again.progress is None
    path = pickle.loads(pickle.dumps(PATH))
    assert path.rearrangements == PATH.rearrangements
    problem = pickle.loads(pickle.dumps(lcp([[2, 1], [1, Fraction(2, 3)]], [-5, -6])))
    assert [[2, 1], [1, Fraction(2, 3)]] == problem.M
    error = pickle.loads(pickle.dumps(CollapseError([1, 2])))
    assert error.motion == [1, 2]


SMALL = contact_system(tss(3))  # sizes by hand: see `test_system`
CLOSED = np.ones(5, dtype=bool)
LINES = {
    "<ContactSystem even, 4 freedoms, 5 contacts>": SMALL,
    "<HeldSet 5 of <ContactSystem even, 4 freedoms, 5 contacts> closed, 0 motions>": held_set(
        SMALL, CLOSED
    ),
    "<Motions 4 of <ContactSystem even, 4 freedoms, 5 contacts>, 0 closed>": held_set(
        SMALL, ~CLOSED
    ).free,
    "<LCP of 5 variables>": contact_lcp(SMALL).problem,
    "<State of 4 freedoms, 5 contacts>": contact_lcp(SMALL).start,
    "<PushPath NT30, layers 2, pushed: 2 pieces, asymptotic>": push_path("nt30", 2),
    "<Path 1 piece to t = 0.1, reached>": continuation(nt30(2), nt30(2, push="1"), until="1/10"),
    "<Segment from t = 0 to 0.166667, 3 loaded>": push_path("nt30", 2).segment(0),
}


@pytest.mark.parametrize("line", LINES)
def test_every_value_is_shown_in_one_line(line):
    assert repr(LINES[line]) == line


def test_a_reduced_scene_names_its_size():
    assert repr(contact_lcp(SMALL)).startswith("<ContactLCP of 5 variables, <HeldSet 5 of ")
