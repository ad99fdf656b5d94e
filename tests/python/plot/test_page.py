"""The part of docs/plots.md that is about Python."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from figures import message
from flapwing import plot

REPOSITORY = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def page():
    """The part of docs/plots.md that is about Python."""
    text = (REPOSITORY / "docs" / "plots.md").read_text(encoding="utf-8")
    return text.split("\n## In Python\n")[1].split("\n## ")[0]


def test_the_examples_of_the_page_run(page, tmp_path, monkeypatch):
    (tmp_path / "examples").symlink_to(REPOSITORY / "examples")
    monkeypatch.chdir(tmp_path)
    saved = []

    def save(animation, path):
        animation._draw_was_started = True
        saved.append(path)

    monkeypatch.setattr(plot.WingPath, "save", save)
    names = {}
    for example in re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        exec(compile(example, "docs/plots.md", "exec"), names)
    assert saved == ["cycle.gif"] and Path("lift.png").is_file()
    with pytest.warns(UserWarning) as told:
        plot.heatmap(names["large"], "efficiency_gf_per_w")
    assert [f"UserWarning: {each.message}\n" in page for each in told] == [True]
    text = message(ValueError, plot.heatmap, names["large"], "efficiency_gf_per_w", drive_voltage_pp="75 V")
    assert f"ValueError: {text}\n" in page


def test_pictures_of_the_page_are_there_and_small(page):
    shown = set(re.findall(r"\]\((pictures/py-.*?)\)", page))
    files = {f"pictures/{path.name}": path for path in (REPOSITORY / "docs" / "pictures").glob("py-*")}
    assert shown == set(files)
    sizes = [path.stat().st_size for path in files.values()]
    assert max(sizes) < 80_000 and sum(sizes) < 500_000
    scripts = (REPOSITORY / "examples" / "python" / f"{name}.py" for name in ("pictures", "four_panels"))
    script = "".join(path.read_text(encoding="utf-8") for path in scripts)
    for name in files:
        function = name.split("py-")[1].split(".")[0].replace("-", "_")
        assert f"def {function}(" in script


def test_the_pictures_of_the_page_are_made(tmp_path):
    """By the scripts that make them, all of them and no others."""
    for script, out in (("pictures", tmp_path), ("four_panels", tmp_path / "py-four-panels.png")):
        command = [sys.executable, "-W", "error", REPOSITORY / f"examples/python/{script}.py", out]
        subprocess.run(command, check=True, capture_output=True, text=True)
    kept = {picture.name for picture in (REPOSITORY / "docs/pictures").glob("py-*")}
    assert {picture.name for picture in tmp_path.iterdir()} == kept
