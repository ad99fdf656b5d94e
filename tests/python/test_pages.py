"""Every page of the manual runs, and prints what it shows."""

import os
from pathlib import Path

import pytest
from pages import Page, pages, shows


@pytest.mark.parametrize("name", pages())
def test_the_page_runs(name, tmp_path, monkeypatch):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("Agg")
    monkeypatch.chdir(tmp_path)
    Page(name, tmp_path, Path(os.environ["FLAP"])).run()
    pyplot.close("all")


def test_printed_lines_are_compared():
    printed = "a 1\nb 2  \nc 3\n"
    assert shows(printed, "a 1\nb 2\n") and shows(printed, "a 1\n...\nc 3\n") and shows(printed, "...\nb 2\n")
    assert not shows(printed, "a 1\nc 3\n") and not shows(printed, "b\n") and not shows(printed, "1\n")
