"""The package as such: its version, its stub, its README."""

import ast
import importlib.metadata
import inspect
import operator
import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import flapwing
import pytest
from flapwing import _flapwing

REPOSITORY = Path(__file__).parents[2]
WHEEL = REPOSITORY / "crates" / "flap-py"


def test_version_is_that_of_the_workspace():
    manifest = (REPOSITORY / "Cargo.toml").read_text(encoding="utf-8")
    package = manifest.split("[workspace.package]")[1]
    version = re.search(r'^version = "(.*)"$', package, re.MULTILINE).group(1)
    assert flapwing.__version__ == version
    assert importlib.metadata.version("flapwing") == version


def test_one_wheel_serves_every_python_since_the_one_it_claims():
    claimed = importlib.metadata.metadata("flapwing")["Requires-Python"]
    assert claimed == ">=3.11"
    name = Path(os.environ["FLAPWING_WHEEL"]).name
    assert re.fullmatch(r"flapwing-[0-9.]+-cp311-abi3-\w+\.whl", name), name
    with zipfile.ZipFile(os.environ["FLAPWING_WHEEL"]) as wheel:
        native = [file for file in wheel.namelist() if file.endswith((".so", ".pyd", ".dylib"))]
    assert len(native) == 1 and "abi3" in native[0]


@pytest.mark.skipif(sys.platform != "linux", reason="about Linux")
def test_the_wheel_needs_nothing_but_the_system():
    command = [sys.executable, "-m", "auditwheel", "show", os.environ["FLAPWING_WHEEL"]]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    told = " ".join(told.split())
    assert re.search(r'is consistent with the following platform tag: "manylinux_', told), told
    # Only what every Linux has.
    assert set(re.findall(r"(\S+)\.so\.\d", told)) <= {"libc", "libm", "libgcc_s", "libpthread", "libdl"}, told


def documented(body, prefix=""):
    """Functions, classes and methods with docstrings in the stub, by their dotted names."""
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            name = prefix + node.name
            if ast.get_docstring(node):
                yield name, ast.get_docstring(node)
            if isinstance(node, ast.ClassDef):
                yield from documented(node.body, name + ".")


def test_stub_repeats_the_docstrings():
    stub = ast.parse((WHEEL / "python/flapwing/_flapwing.pyi").read_text(encoding="utf-8"))
    found = dict(documented(stub.body))
    assert {"presets", "Exclusions", "Grid", "Grid.axes", "Diagnostic", "GridError"} <= set(found)
    for name, doc in found.items():
        assert doc == inspect.getdoc(operator.attrgetter(name)(_flapwing)), name


def test_readme_examples_run():
    readme = (WHEEL / "README.md").read_text(encoding="utf-8")
    examples = re.findall(r"^```python\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
    assert examples
    names = {}
    for example in examples:
        exec(compile(example, "README.md", "exec"), names)
    assert names["row"]["status"] == "periodic"
    assert names["lifts"] == sorted(names["lifts"])
