"""Pictures of packings: what is drawn where, in lengths of the mean radius."""

import numpy as np
import pytest
from packed import settled, squeezed

from lcp_piles import InputError, from_contacts, nt60, packing, prove_contacts, prove_packing
from lcp_piles.pictures import draw_network, draw_packing
from lcp_piles.solve_packing import solve_packing


def _discs(ax):
    return next(c for c in ax.collections if c.get_label() == "discs")


def _lines(ax, label: str) -> np.ndarray:
    found = [np.array(c.get_segments()) for c in ax.collections if c.get_label() == label]
    return found[0] if found else np.empty((0, 2, 2))


def test_discs_have_their_places_and_radii() -> None:
    p = settled()
    r = p.geometry.radii
    for ax in (draw_packing(prove_packing(p)), draw_network(solve_packing(p, 1e-3).solution)):
        circles = _discs(ax)
        assert circles.get_widths() / 2 == pytest.approx(r / r.mean())
        assert np.allclose(circles.get_offsets(), p.geometry.centres / r.mean())
        low, high = ax.get_ylim()
        assert low < 0
        assert high > (p.geometry.centres[:, 1] + r).max() / r.mean()


def test_forces_run_between_centres_and_to_walls() -> None:
    p = settled()
    proof = prove_packing(p)
    lines = _lines(draw_packing(proof), "closed")
    assert len(lines) == proof.loaded.sum()
    mean = p.geometry.radii.mean()
    for (start, end), k in zip(lines * mean, np.flatnonzero(proof.loaded).tolist(), strict=True):
        assert np.allclose(start, p.geometry.centres[p.a[k]])
        if p.b[k] >= 0:
            assert np.allclose(end, p.geometry.centres[p.b[k]])
        else:
            assert min(abs(end[0]), abs(end[0] - 9), abs(end[1])) < 1e-9


def test_contacts_across_the_period_stand_at_both_ends() -> None:
    proof = prove_packing(squeezed(0, 0.95))
    ax = draw_packing(proof)
    across = (proof.scene.geometry.image != 0).sum()
    assert len(_lines(ax, "closed")) + len(_lines(ax, "open")) == len(proof.loaded) + across
    assert across > 0


def test_what_is_not_told_and_what_falls_is_seen() -> None:
    tie = packing([(0, 1), (2, 1)], 1, supports={"floor": 0})
    assert len(_lines(draw_packing(prove_packing(tie)), "unproved")) == 1
    ax = draw_packing(prove_packing(packing([(0, 1)], 1)))
    assert ax.get_title() == "packing, 1 disc: no forces"
    assert [c.get_label() for c in ax.collections] == ["discs", "collapse"]


def test_what_cannot_be_drawn_is_refused() -> None:
    bare = from_contacts([0], ["floor"], [(0, 1)])
    sphere = packing([(0, 0, 1)], 1, supports={"floor": 0})
    for proof in (prove_packing(bare), prove_contacts(nt60(3)), prove_packing(sphere)):
        with pytest.raises(InputError):
            draw_packing(proof)
