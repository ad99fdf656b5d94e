"""The modules of the package: none use each other in a circle, imports for type checkers included."""

import ast
import graphlib
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[2] / "crates/flap-py/python/flapwing"


def modules(folder):
    """The files of a package by the names of their modules; of the native part, its stub."""
    files = [*folder.rglob("*.py"), *folder.rglob("*.pyi")]
    names = {file: (folder.name, *file.relative_to(folder).with_suffix("").parts) for file in files}
    return {".".join(name[:-1] if name[-1] == "__init__" else name): file for file, name in names.items()}


def uses(module, file, known):
    """The modules that a file imports, anywhere in its code."""
    package = module.split(".") if file.name == "__init__.py" else module.split(".")[:-1]
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else []
            base = ".".join([*above, *([node.module] if node.module else [])])
            members = [f"{base}.{alias.name}" for alias in node.names]
            found = [member if member in known else base for member in members]
        else:
            continue
        yield from (name for name in found if name in known and name != module)


def order(folder):
    """The modules of a package, each after those that it uses."""
    known = modules(folder)
    return list(
        graphlib.TopologicalSorter({name: set(uses(name, file, known)) for name, file in known.items()}).static_order()
    )


def test_modules_are_in_no_circle():
    names = order(PACKAGE)
    assert names.index("flapwing._mistakes") < names.index("flapwing._table") < names.index("flapwing._arguments")
    assert (
        names.index("flapwing.fitting._solution")
        < names.index("flapwing.fitting._report")
        < names.index("flapwing.fitting._result")
    )


def test_a_circle_of_type_checkers_imports_is_found(tmp_path):
    folder = tmp_path / "wings"
    folder.mkdir()
    (folder / "__init__.py").write_text("from . import _a\n")
    (folder / "_a.py").write_text("from ._b import B\n")
    (folder / "_b.py").write_text("from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from . import _a\nB = 1\n")
    with pytest.raises(graphlib.CycleError, match="wings._b"):
        order(folder)
