"""The reference of every public name has numpydoc's form, and names what the code has."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass
from functools import cached_property
from typing import Any

import pytest
from numpydoc.docscrape import ClassDoc
from numpydoc.validate import validate

import lcp_piles

ASKED = {
    "GL03",  # two blank lines in a row
    "GL06",  # a section that numpydoc does not know
    "GL07",  # sections in another order
    "GL08",  # no docstring
    "SS03",  # a summary that does not end with a period
    "PR01",  # a parameter that is not documented
    "PR02",  # a parameter that is not there
    "PR03",  # parameters in another order
    "PR04",  # a parameter without a type
    "PR07",  # a parameter without a description
    "RT01",  # a return value that is not documented
    "RT03",  # a return value without a description
    "YD01",  # the same of a generator
}
"""The checks of numpydoc that are made of all; "EX01", an example, is asked of public names."""

PUBLIC = [getattr(lcp_piles, name) for name in sorted(lcp_piles.__all__)]
FUNCTIONS = [found for found in PUBLIC if inspect.isfunction(found)]
CLASSES = [found for found in PUBLIC if inspect.isclass(found)]


def faults(function: Callable[..., Any], *codes: str) -> list[str]:
    """What is wrong with the docstring of a function or method."""
    errors = validate(f"{function.__module__}.{function.__qualname__}")["errors"]
    return [f"{code} {text}" for code, text in errors if code in ASKED.union(codes)]


def class_faults(kind: type) -> Iterator[str]:
    """What is wrong with the docstring of a class, and with those of its own methods."""
    documented = ClassDoc(kind, config={"show_class_members": False})
    attributes = {entry.name for entry in documented["Attributes"] if entry.type and entry.desc}
    if is_dataclass(kind):
        for field in fields(kind):
            if not field.name.startswith("_") and field.name not in attributes:
                yield f"the attribute {field.name} is not documented"
    elif "__init__" in vars(kind):
        named = [entry.name for entry in documented["Parameters"] if entry.type and entry.desc]
        expected = list(inspect.signature(kind).parameters)
        if named != expected:
            yield f"the parameters {named} are not {expected}"
    if not any(line.startswith(">>>") for line in documented["Examples"]):
        yield "without an example"
    for name, member in vars(kind).items():
        if name.startswith("_"):
            continue
        if inspect.isfunction(member):
            asked = len(inspect.signature(member).parameters) > 1
            wrong = faults(member)
            yield from (f"{name}: {fault}" for fault in wrong if asked or "GL08" in fault)
        elif isinstance(member, property | cached_property) and not inspect.getdoc(member):
            yield f"{name}: without a docstring"


def test_there_is_much_to_look_at() -> None:
    assert len(FUNCTIONS) > 80
    assert len(CLASSES) > 30
    assert len(FUNCTIONS) + len(CLASSES) + 6 == len(PUBLIC)  # six are values


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda function: function.__name__)
def test_functions(function: Callable[..., Any]) -> None:
    assert faults(function, "EX01") == []


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: kind.__name__)
def test_classes(kind: type) -> None:
    assert list(class_faults(kind)) == []


def documented_badly(scene: object, mu: int) -> int:
    """Forget a parameter.

    Parameters
    ----------
    scene : Scene
        A scene.
    nu : int
        What the function does not have.
    """
    return mu


@dataclass
class DocumentedBadly:
    """Some attributes.

    Attributes
    ----------
    known : int
        It is documented.
    untyped
        It is not.
    """

    known: int
    untyped: int
    forgotten: int

    def method(self, argument: int) -> int:
        """Without a section."""
        return argument


class MadeBadly:
    """An __init__ whose argument is not documented.

    Examples
    --------
    >>> MadeBadly(1) is None
    False
    """

    def __init__(self, argument: int) -> None:
        self.argument = argument

    @property
    def nameless(self) -> int:
        return self.argument


def test_what_is_missing_is_found() -> None:
    """The checks themselves: faults that were put in, and no others, are found."""
    assert {fault[:4] for fault in faults(documented_badly, "EX01")} == {
        "PR01",
        "PR02",
        "RT01",
        "EX01",
    }
    assert list(class_faults(DocumentedBadly)) == [
        "the attribute untyped is not documented",
        "the attribute forgotten is not documented",
        "without an example",
        "method: PR01 Parameters {'argument'} not documented",
        "method: RT01 No Returns section found",
    ]
    assert list(class_faults(MadeBadly)) == [
        "the parameters [] are not ['argument']",
        "nameless: without a docstring",
    ]
