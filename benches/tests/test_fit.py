"""Tests of the benchmarks of fits, with small numbers of experiments."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

FIT = Path(__file__).parents[2] / "benches/fit"


def run(name, *arguments):
    """Return the output of a benchmark. Warnings are errors."""
    command = [sys.executable, "-W", "error", FIT / f"{name}.py", *arguments]
    ended = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, timeout=300)
    assert ended.returncode == 0, ended.stderr
    return ended.stdout


def test_intervals_of_fits_cover_the_truth():
    told = run("coverage", "--experiments", 2)
    inside = re.findall(r"in its 95 % interval in (\d) of 2", told)
    assert len(inside) == 3 and sum(map(int, inside)) >= 4
    assert "added_inertia_stroke named as one that cannot be told in 2 of 2" in told


def test_exact_derivatives_take_less_work_than_differences():
    told = run("cost")
    work = {name: (float(rhs), float(cost)) for name, rhs, cost in re.findall(
        r"^(exact|central|forward) \w+.*? +([\d.e+]+) +[\d.]+ +\d+ +([\d.]+)$", told, re.MULTILINE
    )}  # fmt: skip
    assert 4.0 * work["exact"][0] < work["central"][0] and 2.0 * work["exact"][0] < work["forward"][0]
    assert work["exact"][1] == pytest.approx(work["central"][1], rel=1e-3)


def test_planned_readings_are_fewer_than_those_at_random():
    told = run("next", "--trials", 5)
    assert int(re.search(r"in (\d) of 5 trials", told)[1]) >= 3


def test_bands_cover_readings_that_are_held_out():
    told = run("discrepancy", "--seeds", 1)
    covered = [float(share) for share in re.findall(r"([\d.]+) % of the readings held out in their bands", told)]
    # Each share has 90 readings.
    assert len(covered) == 4 and min(covered) > 88
