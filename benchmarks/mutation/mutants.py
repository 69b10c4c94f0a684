"""The mutants of a module: its functions with one thing changed, by mutmut's operators and others.

mutmut (3.8) and libcst are imported here only when mutants are made.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from textwrap import dedent
from typing import Any


@dataclass(frozen=True)
class Mutant:
    """One function of a file with one change; `name` is its qualified name, `source` all of it."""

    file: str
    name: str
    line: int
    old: str
    new: str
    source: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line} {self.name}: {self.old!r} -> {self.new!r}"


def mutants(file: str) -> list[Mutant]:
    """All mutants of the functions and methods of a file; what a `raise` says stays as it is."""
    import libcst as cst
    from libcst.metadata import MetadataWrapper, PositionProvider

    wrapper = MetadataWrapper(cst.parse_module(Path(file).read_text()))
    module, places = wrapper.module, wrapper.resolve(PositionProvider)
    operators = list(_operators(cst))

    def inside(node: Any) -> Iterator[Any]:
        yield node
        if not isinstance(node, cst.Annotation | cst.Raise):
            for child in node.children:
                yield from inside(child)

    def changed(function: Any, name: str) -> Iterator[Mutant]:
        for node in inside(function.with_changes(decorators=[])):
            for kind, operator in operators:
                for new in operator(node) if isinstance(node, kind) else ():
                    whole = function.with_changes(decorators=[], leading_lines=[])
                    source = dedent(module.code_for_node(whole.deep_replace(node, new)))
                    texts = [module.code_for_node(part).strip() for part in (node, new)]
                    if texts[0] != texts[1] and _compiles(source):
                        yield Mutant(file, name, places[node].start.line, *texts, source)

    def functions(body: Any, prefix: str) -> Iterator[Mutant]:
        for node in body:
            if isinstance(node, cst.FunctionDef):
                yield from changed(node, prefix + node.name.value)
            elif isinstance(node, cst.ClassDef):
                yield from functions(node.body.body, f"{prefix}{node.name.value}.")

    found = {(mutant.name, mutant.source): mutant for mutant in functions(module.body, "")}
    return list(found.values())


def _compiles(source: str) -> bool:
    try:
        compile(source, "a mutant", "exec")
    except SyntaxError:
        return False
    return True


def _operators(cst: Any) -> Iterator[tuple[Any, Any]]:
    """Pairs of a kind of node and what makes changed ones of it."""
    from mutmut.mutation import mutators

    def word(node: Any) -> Iterator[Any]:  # what code reads, not the text of messages
        text = node.evaluated_value if isinstance(node, cst.SimpleString) else ""
        if isinstance(text, str) and text and not any(c.isspace() for c in text):
            yield next(iter(mutators.operator_string(node)))

    def test(node: Any) -> Iterator[Any]:
        yield from (node.with_changes(test=cst.Name(value)) for value in ("True", "False"))

    def nothing(node: Any) -> Iterator[Any]:
        statement = node.body[0]
        docstring = isinstance(statement, cst.Expr) and isinstance(
            statement.value, cst.SimpleString
        )
        if isinstance(statement, cst.Expr | cst.AugAssign | cst.Raise) and not docstring:
            yield node.with_changes(body=[cst.Pass()])

    def no_value(node: Any) -> Iterator[Any]:
        if node.value is not None:
            yield node.with_changes(value=cst.Name("None"))

    for kind, operator in mutators.mutation_operators:
        if operator is not mutators.operator_string:
            yield kind, operator
    yield cst.SimpleString, word
    yield cst.If, test
    yield cst.SimpleStatementLine, nothing
    yield cst.Return, no_value
