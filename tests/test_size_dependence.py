"""Forces on disc (2, 1) against the size of the pile, as the paper plots them."""

from lcp_piles import Unresolved, contact_by_letter, nt30, size_dependence, solve


def by_letter(kind, layers, **parameters):
    found = {}
    for record in size_dependence(kind, (2, 1), "adef", layers, **parameters):
        assert (record.disc, record.status) == ((2, 1), "solved")
        found.setdefault(record.layers, {})[record.letter] = record.force
    return found


def test_tss_f_is_one_minus_e_at_every_size():
    for forces in by_letter("tss", range(4, 14)).values():
        assert forces["f"] == 1 - forces["e"]


def test_tbs_has_the_same_relation_for_it_is_the_balance_of_the_disc():
    for forces in by_letter("tbs", range(2, 12)).values():
        assert forces["f"] == 1 - forces["e"]
        assert forces["f"] == forces["d"] - forces["a"]


def test_tss_depends_on_the_parity_of_the_number_of_layers():
    """The paper: "a strong dependence on the parity of N"; even piles stand on e alone."""
    found = by_letter("tss", range(6, 14))
    for layers, forces in found.items():
        assert (forces["e"] == 1) == (layers % 2 == 0)


def test_records_are_those_of_the_solved_pile():
    parameters = {"push": "10", "floor_compliance": 0}
    records = list(size_dependence("nt30", (2, 2), ["e", "b"], [3, 4], **parameters))
    assert [(r.layers, r.letter) for r in records] == [(3, "e"), (3, "b"), (4, "e"), (4, "b")]
    for record in records:
        pile = solve(nt30(record.layers, **parameters))
        assert record.contact == contact_by_letter(pile.scene, (2, 2), record.letter)
        assert record.force.sympy() == pile.force(*record.contact)
        assert record.state == pile.state(*record.contact)


def test_absent_contacts_have_no_force():
    (absent,) = size_dependence("tss", (2, 1), "e", [3])
    assert absent.status == "solved"
    assert (absent.contact, absent.force, absent.state) == (None, None, None)


def test_piles_that_are_not_solved_have_no_force(monkeypatch):
    def give_up(scene, method):
        return Unresolved(scene, solve(scene, method).record)

    monkeypatch.setattr("lcp_piles.paper.size_dependence.solve", give_up)
    (unsolved,) = size_dependence("nt60", (2, 1), "e", [3])
    assert (unsolved.status, unsolved.contact) == ("unresolved", ((2, 1), (3, 1)))
    assert (unsolved.force, unsolved.state) == (None, None)
