"""The notebook for beginners runs, and its stored outputs are the outputs of its code."""

import re
from pathlib import Path

import nbformat
import pytest
from notebooks import executed, stripped, written

REPOSITORY = Path(__file__).parents[2]
NOTEBOOK = REPOSITORY / "docs/start/first-notebook.ipynb"
RESTORE = "to store the outputs again: python tests/python/notebooks.py docs/start/first-notebook.ipynb"


@pytest.fixture(scope="module")
def stored():
    return nbformat.read(NOTEBOOK, as_version=4)


@pytest.fixture(scope="module")
def again():
    return executed(NOTEBOOK)


def outputs(notebook):
    """The outputs of each code cell: texts, and the types of pictures."""
    found = []
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            found.append((cell.source, output.get("text", ""), data.get("text/plain", ""), sorted(data)))
    return found


def test_it_is_stored_without_counters_and_versions(stored):
    text = NOTEBOOK.read_text(encoding="utf-8")
    nbformat.validate(stored)
    assert set(stored.metadata) == {"kernelspec", "language_info"}
    assert written(stripped(nbformat.reads(text, as_version=4))) == text, RESTORE
    assert len(text) < 400_000


def test_its_links_lead_somewhere(stored):
    text = "\n".join(cell.source for cell in stored.cells if cell.cell_type == "markdown")
    targets = re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text)
    assert len(targets) > 10
    for target in targets:
        assert (NOTEBOOK.parent / target).resolve().exists(), target
    for script in re.findall(r"`(\w+\.py)`", text):
        assert (REPOSITORY / "examples/python" / script).exists(), script


def test_its_stored_outputs_are_those_of_the_code(stored, again):
    assert outputs(again) == outputs(stored), RESTORE


def test_it_shows_pictures_and_statuses(again):
    shown, pictures = "", 0
    for cell in again.cells:
        results = cell.get("outputs", [])
        for output in results:
            assert output.output_type != "error" and output.get("name") != "stderr", output
            shown += output.get("text", "") + output.get("data", {}).get("text/plain", "")
        pictured = any("image/png" in output.get("data", {}) for output in results)
        assert pictured == cell.source.splitlines()[-1].startswith("plot."), cell.source
        pictures += pictured
    assert pictures == 3
    for said in [
        "ozaki2018-large",
        "'unsettled'",
        "did you mean `drive_frequency`?",
        "`V` is a voltage",
        "interrupted",
        "the same as the sweep in memory: True",
    ]:
        assert said in shown
