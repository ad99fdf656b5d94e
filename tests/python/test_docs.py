"""Examples in docstrings and pages give the results that they show."""

import dataclasses
import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import flapwing
import flapwing.analysis
import flapwing.plot
import pytest

REPOSITORY = Path(__file__).parents[2]


MODULES = [module.name for module in pkgutil.walk_packages(flapwing.__path__, "flapwing.")]


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    module = importlib.import_module(name)
    failed, _ = doctest.testmod(module, extraglobs={"flapwing": flapwing}, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert failed == 0


def test_public_functions_say_what_they_take_give_and_raise():
    for module in [flapwing, flapwing.analysis, flapwing.fitting, flapwing.plot]:
        for name in module.__all__:
            thing = getattr(module, name)
            assert name == "__version__" or thing.__doc__, name
            if callable(thing) and not isinstance(thing, type) and name not in ("presets", "label"):
                for heading in ["Parameters\n", "Returns\n", "Raises\n"]:
                    assert heading in thing.__doc__, (name, heading)


def test_every_attribute_of_a_result_is_documented():
    for module in [flapwing, flapwing.analysis, flapwing.fitting]:
        for name in module.__all__:
            thing = getattr(module, name)
            for field in dataclasses.fields(thing) if dataclasses.is_dataclass(thing) else ():
                assert re.search(rf"^    (\w+, )*{field.name}(, \w+)* : ", thing.__doc__, re.MULTILINE), (
                    name,
                    field.name,
                )


@pytest.mark.parametrize(
    ("page", "least"), [("docs/python.md", 6), ("docs/live.md", 1), ("docs/fit.md", 6), ("README.md", 2)]
)
def test_python_in_the_pages_runs(page, least, tmp_path, monkeypatch):
    pytest.importorskip("matplotlib").use("Agg")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").mkdir()
    for example in (REPOSITORY / "examples").glob("*.toml"):
        (tmp_path / "examples" / example.name).write_bytes(example.read_bytes())
    if page == "README.md":
        # Made by the page's first command.
        flapwing.sweep("examples/ozaki_large.toml", out="ozaki_large.csv")
    text = (REPOSITORY / page).read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert len(blocks) >= least
    names = {}
    for block in blocks:
        exec(compile(block, page, "exec"), names)
    if page == "README.md":
        assert (tmp_path / "lift.png").stat().st_size > 5000
