"""The checker of certificates with one check spoiled: some certificate must tell the difference.

These are the mutants that say most; `python -m benchmarks.mutation.checker` makes all of them.
"""

from __future__ import annotations

import pytest

from benchmarks.mutation.checker import TEXT, is_told_apart

MUTANTS = {
    "signs of the first bits": ("if abs(total) > len(terms):", "if True:"),
    "square roots that add up": ("root if x > 0 else -root for root", "root for root"),
    "roots that multiply wrongly": ("x * y * g", "x * y"),
    "any normal": (
        'need(sum((n * n for n in c.normal), -ONE).sign() == 0, "a normal has length one")',
        "pass",
    ),
    "contacts that pull": ("x >= 0 <= y and x * y == 0", "y >= 0 and x * y == 0"),
    "contacts that overlap": ("x >= 0 <= y and x * y == 0", "x >= 0 and x * y == 0"),
    "forces at a gap": ("x >= 0 <= y and x * y == 0", "x >= 0 <= y"),
    "discs that are held elsewhere": ("need(not any(x.sign() for x in off)", "need(True"),
    "forces that do not balance": ("need(not any(p.sign() for p in total.values())", "need(True"),
    "roots of other numbers": ("all(x * x % m == q % m for q, x in roots.items())", "True"),
    "too few motions": (
        "len(found) == size == rank + len(basis)",
        "len(found) == rank + len(basis)",
    ),
    "motions that open contacts": ("need(not any(x.sign() for x in rates)", "need(True"),
    "loads against the motion": (
        'need(rate(s.load, v).sign() > 0, "the load',
        'need(True, "the load',
    ),
    "clamps that open": ("x == 0 if tied else x >= 0 for x", "x >= 0 for x"),
    "any y with q . y < 0": ("need(all(x <= 0 for x in signs.values())", "need(True"),
    "friction in space": ("not turning or (axes == 2 and", "not turning or (True and"),
    "one half of a path": ("need(not any(a * y or x * b for", "need(not any(a * y for"),
    "the other half of a path": ("need(not any(a * y or x * b for", "need(not any(x * b for"),
    "rolling taken for sliding": ("v[x.a, i] != v[x.b, i]", "v[x.a, i] == v[x.b, i]"),
    "a bound that nothing attains": ("need(attained.sign() == 0", "need(True"),
    "a motion that bounds nothing": ("need(min(rest, default=0) >= 0", "need(True"),
    "fields that nobody reads": (
        "need(all(entry.keys() <= entry.used",
        "need(True or all(entry.keys()",
    ),
    "names that stand twice": ("need(len(self) == len(pairs)", "need(True"),
}


def test_the_checker_itself_is_not() -> None:
    assert not is_told_apart(TEXT)


@pytest.mark.parametrize("name", MUTANTS)
def test_a_spoiled_check_is_noticed(name: str) -> None:
    old, new = MUTANTS[name]
    assert TEXT.count(old) == 1
    assert is_told_apart(TEXT.replace(old, new))
