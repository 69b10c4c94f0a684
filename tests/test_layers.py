"""The package's folders stand in one order, and imports go one way along it."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import lcp_piles

PACKAGE = Path(lcp_piles.__file__).parent
LONGEST = 400
IN_ONE_PIECE = {"certificates/check_certificate.py": 450}
"""The checker of certificates, which has to be one file that stands by itself."""

ORDER = (
    {"errors"},
    {"numbers"},
    {"scenes"},
    {"packings"},
    {"linear", "problems"},
    {"pivoting"},
    {"bases"},
    {"programs", "games"},
    {"mechanics"},
    {"solution"},
    {"methods"},
    {"solve"},
    {"crosscheck", "solve_packing", "disorder"},
    {"push", "deformation"},
    {"friction", "checking"},
    {"fields", "files"},
    {"certificates", "ensembles"},
    {"pictures", "interactive"},
    {"paper"},
    {"cli"},
)
"""Each folder or module of the package imports from those before it, none from beside or after."""
RANK = {name: rank for rank, names in enumerate(ORDER) for name in names}
FREE = {"__init__", "__main__"}
"""The front, which gathers the public names of all, and `python -m lcp_piles`."""


def modules() -> list[Path]:
    return sorted(PACKAGE.rglob("*.py"))


def part_of(module: Path) -> str:
    """The folder, or the module, of the package's top level that a file belongs to."""
    return module.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imported_parts(module: Path) -> dict[str, int]:
    """The top-level parts that a file imports, at its head or within functions: name and line."""
    package = ("lcp_piles", *module.relative_to(PACKAGE).parent.parts)
    found: dict[str, int] = {}
    for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            named = [alias.name.split(".") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = list(package[: len(package) - node.level + 1]) if node.level else []
            base += node.module.split(".") if node.module else []
            named = [[*base, alias.name] for alias in node.names]
        else:
            continue
        for path in named:
            if path[0] == "lcp_piles" and len(path) > 1:
                found.setdefault(path[1], node.lineno)
    return found


def against_the_order() -> list[str]:
    """Every import that goes the wrong way, as "file:line imports part"."""
    wrong = []
    for module in modules():
        mine = part_of(module)
        if mine in FREE:
            continue
        for part, line in imported_parts(module).items():
            # The front gathers the public names of all: nothing before it may ask it for one.
            if part not in (mine, "__version__") and RANK.get(part, len(ORDER)) >= RANK[mine]:
                wrong.append(f"{module.relative_to(PACKAGE)}:{line} imports {part}")
    return wrong


def test_every_folder_has_its_place_in_the_order() -> None:
    assert {part_of(module) for module in modules()} - FREE == set(RANK)


def test_imports_go_one_way() -> None:
    assert against_the_order() == []


def test_a_lazy_import_the_wrong_way_is_seen(tmp_path: Path, monkeypatch) -> None:
    """The test itself: imports of every form, in a copy of two folders, are found with lines."""
    for name, text in (
        ("numbers/exact.py", "def f():\n    from ..scenes.scene import Scene\n"),
        ("scenes/scene.py", "import lcp_piles.solve\nfrom ..numbers.exact import surd\n"),
        ("solve.py", "from . import push\nfrom .scenes import scene\n"),
    ):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    monkeypatch.setitem(globals(), "PACKAGE", tmp_path)
    assert against_the_order() == [
        "numbers/exact.py:2 imports scenes",
        "scenes/scene.py:1 imports solve",
        "solve.py:1 imports push",
    ]


@pytest.mark.parametrize("module", modules(), ids=lambda m: str(m.relative_to(PACKAGE)))
def test_no_module_is_too_long(module: Path) -> None:
    most = IN_ONE_PIECE.get(module.relative_to(PACKAGE).as_posix(), LONGEST)
    assert len(module.read_text(encoding="utf-8").splitlines()) <= most


def test_only_pictures_paper_and_cli_draw() -> None:
    """Nothing before `pictures` names matplotlib, and importing the package does not load it."""
    drawing = {"pictures", "paper", "cli"}
    for module in modules():
        if part_of(module) not in drawing:
            for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Import):
                    assert not any(a.name.startswith("matplotlib") for a in node.names), module
                elif isinstance(node, ast.ImportFrom):
                    assert not (node.module or "").startswith("matplotlib"), module
    program = "import sys, lcp_piles; assert 'matplotlib' not in sys.modules"
    subprocess.run([sys.executable, "-c", program], check=True, cwd=PACKAGE.parent)
