"""The package as such: its version, its stub, its README."""

import ast
import importlib.metadata
import inspect
import re
from pathlib import Path

import flapwing

REPOSITORY = Path(__file__).parents[2]
WHEEL = REPOSITORY / "crates" / "flap-py"


def test_version_is_that_of_the_workspace():
    manifest = (REPOSITORY / "Cargo.toml").read_text(encoding="utf-8")
    package = manifest.split("[workspace.package]")[1]
    version = re.search(r'^version = "(.*)"$', package, re.MULTILINE).group(1)
    assert flapwing.__version__ == version
    assert importlib.metadata.version("flapwing") == version


def test_stub_repeats_the_docstrings():
    stub = ast.parse((WHEEL / "python/flapwing/_flapwing.pyi").read_text(encoding="utf-8"))
    functions = [node for node in stub.body if isinstance(node, ast.FunctionDef)]
    assert {function.name for function in functions} == {"presets", "run"}
    for function in functions:
        assert ast.get_docstring(function) == inspect.getdoc(getattr(flapwing, function.name))


def test_readme_examples_run():
    readme = (WHEEL / "README.md").read_text(encoding="utf-8")
    examples = re.findall(r"^```python\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
    assert len(examples) == 2
    names = {}
    for example in examples:
        exec(compile(example, "README.md", "exec"), names)
    assert names["row"]["status"] == "periodic"
    assert names["lifts"] == sorted(names["lifts"])
