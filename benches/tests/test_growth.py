"""Tests of benches/growth: sweeps of increasing numbers of points, with times, memory and a picture."""

import json
import os
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

GROWTH = Path(__file__).parents[2] / "benches/growth"


@pytest.fixture(autouse=True)
def paths(monkeypatch):
    monkeypatch.syspath_prepend(GROWTH)


@pytest.fixture
def small(monkeypatch):
    """Reduce the numbers of points of the sweeps, so that the tests are fast."""
    from scaling import command

    monkeypatch.setattr(command, "FEWEST", 6)
    monkeypatch.setattr(command, "REPEATED", 6)
    return command


def test_sweeps_are_measured_and_drawn(small, flap, tmp_path, capsys):
    results, picture = tmp_path / "results" / "growth.json", tmp_path / "growth.svg"
    sizes = ["--most", "6", "--most-loose", "6e3", "--rounds", "2"]
    small.main([*sizes, "--flap", os.environ["FLAP"], "--json", str(results), "--picture", str(picture)])
    printed = capsys.readouterr().out
    runs = json.loads(results.read_text(encoding="utf-8"))["runs"]
    ways = ["1 thread", "2 threads", "2 shards"]
    grids = [(6, 1e-6), (6, 1e-3), (60, 1e-3), (600, 1e-3), (6000, 1e-3)]
    assert [(run["points"], run["rtol"], run["way"]) for run in runs] == [
        (points, rtol, way) for points, rtol in grids for way in ways
    ]
    for run in runs:
        rounds = 2 if run["points"] == 6 else 1
        assert run["rows"] == run["points"]
        assert run["bytes"] > 50 * run["rows"]
        for name in ["wall_s", "cpu_s", "merge_s", "peak_mib"]:
            assert len(run[name]) == rounds
        assert all(value > 0.0 for name in ["wall_s", "cpu_s"] for value in run[name])
        assert all((value > 0.0) == (run["way"] == "2 shards") for value in run["merge_s"])
        # Short sweeps may end between two looks at their memory.
        least = 1.0 if run["points"] == 6000 else 0.0
        assert all(least <= value < 1000.0 for value in run["peak_mib"])
    # The rows are gone.
    assert list(results.parent.iterdir()) == [results]

    texts = [element.text for element in ElementTree.parse(picture).iter() if element.text]
    assert {*ways, "rtol 1e-6", "rtol 1e-3"} <= set(texts)
    assert picture.stat().st_size < 60_000

    again = tmp_path / "again.svg"
    small.main(["--draw", str(results), "--picture", str(again)])
    assert capsys.readouterr().out == printed
    assert again.read_bytes() == picture.read_bytes()


def test_a_grid_has_as_many_points_as_asked_for(flap, tmp_path):
    from scaling.sweep import grid

    path = tmp_path / "grid.toml"
    for points in (6, 1000, 10**7):
        path.write_text(grid(points, 1e-3), encoding="utf-8")
        assert f"{points:,}".replace(",", "") in flap("check", path).stdout.replace(",", "").split()


def test_the_peak_of_memory_is_seen():
    from scaling.process import together

    script = "import time; kept = b'x' * {}; time.sleep(0.2)"
    least, more = (together([[sys.executable, "-c", script.format(size)]]) for size in (1, 10**8))
    assert least.wall_s > 0.2
    assert 80.0 < more.peak_mib - least.peak_mib < 120.0


def test_a_sweep_that_fails_ends_with_its_message(small, tmp_path):
    broken = tmp_path / "broken"
    broken.write_text("#!/bin/sh\necho 'error: the disk is full' >&2\nexit 1\n", encoding="utf-8")
    broken.chmod(0o755)
    with pytest.raises(SystemExit, match="^6 points, 1 thread: error: the disk is full$"):
        small.main(["--most", "6", "--flap", str(broken), "--json", str(tmp_path / "growth.json")])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--most", "1.5"], "1.5 is no whole number of 1 or more"),
        (["--threads", "1,many"], "many is no whole number of 1 or more"),
        (["--most", "10", "--most-loose", "10"], "are below 1000: there is nothing to measure"),
        (["--draw", "/no/such/file"], "there is no file /no/such/file"),
    ],
)
def test_mistakes_are_named(arguments, message, capsys):
    from scaling import command

    with pytest.raises(SystemExit) as ended:
        command.main(arguments)
    assert ended.value.code == 2
    assert message in capsys.readouterr().err
