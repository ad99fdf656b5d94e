"""Type checkers accept the code in pages and examples, refuse mistakes in it, and Python's floor is the one claimed."""

import ast
import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import flapwing
import pytest
from pages import pages, python_blocks

pytest.importorskip("matplotlib")

REPOSITORY = Path(__file__).parents[2]
PACKAGE = Path(flapwing.__file__).parent
NOTEBOOK = "docs/start/first-notebook.ipynb"


def checked(files, folder):
    """The lines of mypy on these files, with the options of a strict user."""
    command = [sys.executable, "-m", "mypy", "--config-file", REPOSITORY / "tests/python/user.ini", *files]
    environment = {**os.environ, "MYPY_CACHE_DIR": os.environ.get("MYPY_CACHE_DIR", str(folder / "cache"))}
    ended = subprocess.run(
        list(map(str, command)), capture_output=True, text=True, check=False, env=environment, cwd=folder
    )
    assert not ended.stderr, ended.stderr
    return ended.stdout.splitlines()


def test_pages_and_examples_are_accepted(tmp_path):
    folders = ("examples/python", "examples/learn", "benches/fit")
    files = [file for folder in folders for file in sorted((REPOSITORY / folder).glob("*.py"))]
    for page in pages():
        if blocks := python_blocks(page):
            files.append(tmp_path / (re.sub(r"\W", "_", page.removesuffix(".md")) + ".py"))
            files[-1].write_text("\n".join(blocks), encoding="utf-8")
    cells = json.loads((REPOSITORY / NOTEBOOK).read_text(encoding="utf-8"))["cells"]
    files.append(tmp_path / "notebook.py")
    files[-1].write_text("\n".join("".join(c["source"]) for c in cells if c["cell_type"] == "code"), encoding="utf-8")
    told = checked(files, tmp_path)
    assert told[-1] == f"Success: no issues found in {len(files)} source files", "\n".join(told)


MISTAKES = """\
import flapwing
from flapwing import plot

flapwing.run("ozaki2018-large", max_cycles="many")
flapwing.run(3)
flapwing.evaluate("ozaki2018-large", {"drive_frequency": [100.0]}, measures=[1])
flapwing.sweep("grid.toml", progress=3)
flapwing.trajectory("ozaki2018-large", initial_state=[0.0])
table = flapwing.read("rows.csv")
table["lift_mean_mn"].to_pandas()
table[["lift_mean_mn"]].argmax()
plot.response(table, ["lift_mean_mn", "power_mean_mw"])
flapwing.run("ozaki2018-large").lift_mean_mn
"""


def test_mistakes_are_refused(tmp_path):
    path = tmp_path / "mistakes.py"
    path.write_text(MISTAKES, encoding="utf-8")
    lines = {int(line.split(":")[1]) for line in checked([path], tmp_path) if ": error:" in line}
    assert lines == {4, 5, 6, 7, 8, 10, 11, 12, 13}


DRAWN = """\
import flapwing
import numpy as np
import pandas
from flapwing import analysis, fitting, plot

rows = flapwing.read("rows.csv")
plot.force_panels(rows, x="drive_offset").savefig("panels.png")
plot.control_matrix(rows, inputs=["drive_offset"]).figure.savefig("map.png")
plot.control_matrix(np.zeros((6, 1)), inputs=["drive_offset"]).set_title("map")
plot.response_panels(rows, ["lift_mean_mn"]).savefig("panels.png")
np.isnan(flapwing.run("ozaki2018-large").residual)
flapwing.resonance("ozaki2018-large").driven[0].frequency_hz.hex()
flapwing.measures("bimorph")["lift_mean_mn"].unit.upper()
estimates: dict[str, fitting.Estimate] = flapwing.fit("ozaki2018-large", rows, ["hinge_stiffness"]).estimates
analysis.rank_correlations(rows)[0].correlation.hex()
flapwing.run("ozaki2018-large", initial_state=rows[-1:], progress=True)
flapwing.run("ozaki2018-large", initial_state={"pitch_rad": 0.1, "stroke_rad": "10 deg"})
flapwing.trajectory("ozaki2018-large", initial_state=pandas.DataFrame({"pitch_rad": [0.1]}))
"""


def test_results_have_their_types(tmp_path):
    path = tmp_path / "drawn.py"
    path.write_text(DRAWN, encoding="utf-8")
    told = checked([path], tmp_path)
    assert told[-1].startswith("Success"), "\n".join(told)


def floor():
    project = tomllib.loads((REPOSITORY / "crates/flap-py/pyproject.toml").read_text(encoding="utf-8"))["project"]
    return project, tuple(map(int, project["requires-python"].removeprefix(">=").split(".")))


def test_sources_are_in_the_syntax_of_the_oldest_python():
    for path in PACKAGE.rglob("*.py"):
        ast.parse(path.read_text(encoding="utf-8"), feature_version=floor()[1])


def test_tests_run_on_the_oldest_python_where_it_is_there():
    # scripts/test-python.sh prefers it.
    assert sys.version_info[:2] >= floor()[1]


def test_optional_packages_are_imported_only_where_they_are_used():
    """The package itself needs NumPy alone: others are imported by the functions that convert to them."""
    code = (
        "import sys\n"
        "for name in ['pandas', 'polars', 'pyarrow', 'scipy', 'xarray', 'matplotlib', 'tqdm', 'distributed', 'moocore']:\n"
        "    sys.modules[name] = None\n"
        "import flapwing, flapwing.analysis, flapwing.fitting\n"
        "table = flapwing.evaluate('ozaki2018-large', {'drive_frequency': [100.0, 105.0]})\n"
        "table[['lift_mean_mn']][table['status'] == 'periodic']\n"
        "flapwing.sweep({'preset': 'ozaki2018-large', 'axes': {'drive_frequency': range(100, 102)}})\n"
    )
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)
