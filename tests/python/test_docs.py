"""Examples in docstrings and pages give the results that they show."""

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import flapwing
import pytest

REPOSITORY = Path(__file__).parents[2]


FITS = [f"_fit.{module.name}" for module in pkgutil.iter_modules([str(Path(flapwing.__file__).parent / "_fit")])]


@pytest.mark.parametrize("name", [*(module.name for module in pkgutil.iter_modules(flapwing.__path__)), *FITS])
def test_docstrings(name):
    if name == "plot":
        pytest.importorskip("matplotlib")
    module = importlib.import_module(f"flapwing.{name}")
    failed, _ = doctest.testmod(module, extraglobs={"flapwing": flapwing}, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert failed == 0


def test_docstrings_have_examples():
    for function in [flapwing.sweep, flapwing.evaluate, flapwing.respond, flapwing.trajectory, flapwing.params]:
        assert ">>> " in function.__doc__


def test_public_functions_say_what_they_take_give_and_raise():
    for name in flapwing.__all__:
        thing = getattr(flapwing, name)
        assert name == "__version__" or thing.__doc__
        if callable(thing) and not isinstance(thing, type) and name != "presets":
            for heading in ["Parameters\n", "Returns\n", "Raises\n"]:
                assert heading in thing.__doc__, (name, heading)


@pytest.mark.parametrize(("page", "least"), [("docs/python.md", 6), ("docs/live.md", 1), ("docs/fit.md", 6), ("README.md", 2)])
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
