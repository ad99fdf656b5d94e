"""Tests of the harness of benches/peers. The equations agree with flap, and a missing peer does not stop the
comparison."""

import csv
import dataclasses
import json
import os
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

REPOSITORY = Path(__file__).parents[2]
PEERS = REPOSITORY / "benches/peers"


@pytest.fixture(autouse=True)
def paths(monkeypatch):
    monkeypatch.syspath_prepend(PEERS)
    monkeypatch.syspath_prepend(PEERS / "python")


def known(rows):
    """Return the rows of the reference for the example: id, force, frequency, and measures."""
    with (REPOSITORY / "tests/data/own_equations.csv").open(newline="", encoding="utf-8") as file:
        return [[float(cell) for cell in row] for row in list(csv.reader(file))[1 : 1 + rows]]


def test_the_equations_are_those_of_the_example():
    import measures
    import scipy_rk45

    for _, force, frequency, *expected in known(2):
        at = measures.times(frequency, per_period=2048)
        found = measures.measures(scipy_rk45.motion(force, frequency, 1e-7, at).y.T[np.newaxis])
        np.testing.assert_allclose(found[0], expected, rtol=2e-6)


@pytest.mark.parametrize("newton", ["true", "false"])
def test_settled_motions_are_those_of_flap(newton, tmp_path, flap, monkeypatch, capsys):
    import orbit
    import settled_flap
    import settled_scipy

    points = [(135.0, 110.0), (190.0, 125.0)]
    phases = settled_scipy.PERIOD * np.arange(2048) / 2048
    samples = np.stack([settled_scipy.settle(*point, 1e-7, phases)[0] for point in points])
    expected = orbit.measures(samples, [frequency for _, frequency in points])

    given, out = tmp_path / "points.csv", tmp_path / "out.csv"
    lines = "".join(f"{number},{volts!r},{hertz!r}\n" for number, (volts, hertz) in enumerate(points))
    given.write_text("id,drive_voltage_pp,drive_frequency\n" + lines, encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["settled_flap.py", os.environ["FLAP"], newton, str(given), "1e-7", str(out)])
    settled_flap.main()
    with out.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    found = [[float(row[column]) for column in orbit.COLUMNS] for row in rows]
    np.testing.assert_allclose(found, expected, rtol=5e-6)
    told = json.loads(capsys.readouterr().out)
    assert told["cpu_s"] > 0.0 and told["rhs_per_point"] > 100.0 and told["periods_per_point"] > 3.0


def test_a_motion_that_does_not_settle_has_no_measures(monkeypatch):
    import orbit
    import settled_scipy

    monkeypatch.setattr(settled_scipy, "MOST_PERIODS", 2)
    samples, _, periods = settled_scipy.settle(190.0, 125.0, 1e-3)
    assert periods == 2
    assert np.isnan(orbit.measures(samples[np.newaxis], [125.0])).all()


@pytest.mark.parametrize("work", ["integration", "settled", "responses"])
@pytest.mark.parametrize("count", [1, 2, 7, 16, 250])
def test_a_grid_has_as_many_points_as_asked_for(count, work):
    from harness import points
    from harness.roster import WORKS

    work = WORKS[work]
    grid = points.grid(count, work)
    assert len({(point.amplitude, point.frequency) for point in grid}) == len({point.id for point in grid}) == count
    assert all(work.amplitude.low <= point.amplitude <= work.amplitude.high for point in grid)
    assert all(work.frequency.low <= point.frequency <= work.frequency.high for point in grid)


#: A peer whose results are the true results times a factor.
FAKE = """\
import csv, json, sys
points, rtol, out = sys.argv[1:]
with open(points) as file, open(out, "w") as table:
    print("id,max_x,max_psi,lift", file=table)
    for row in csv.DictReader(file):
        print(row["id"], 1e-4 * {factor}, {factor}, 1e-3 * {factor}, sep=",", file=table)
print(json.dumps({{"cpu_s": {seconds}, "rhs_per_point": None}}))
"""
REFERENCE = """\
import csv, sys
points, out = sys.argv[1:]
with open(points) as file, open(out, "w") as table:
    print("id,max_x,max_psi,lift,sampled_max_x,sampled_max_psi,sampled_lift", file=table)
    for row in csv.DictReader(file):
        print(row["id"], 1e-4, 1.0, 1e-3, 1e-4, 1.0, 1e-3, sep=",", file=table)
"""


class Script:
    """A builder of a program in Python."""

    def __init__(self, text):
        self.text = text

    def build(self):
        return [sys.executable, "-c", self.text]


class Missing:
    """A builder of a program that cannot be built."""

    def build(self):
        from harness.build import Unavailable

        raise Unavailable("there is no compiler", "install one")


@pytest.fixture
def run(monkeypatch, tmp_path, capsys):
    """Return a function that runs the harness with given peers. The first peer is the base."""
    from harness import command
    from harness.peer import Peer
    from harness.roster import WORKS

    monkeypatch.setattr(command, "WORK", tmp_path)
    monkeypatch.setattr(command.os, "sched_setaffinity", lambda *_: None, raising=False)

    def run(*arguments, reference=None, **builders):
        peers = tuple(Peer(name, f"peer {name}", builder) for name, builder in builders.items())
        work = dataclasses.replace(
            WORKS["integration"], base=peers[0], peers=peers, reference=reference or Script(REFERENCE)
        )
        monkeypatch.setitem(WORKS, "integration", work)
        out = tmp_path / "out.json"
        command.main([*arguments, "--json", str(out)])
        return SimpleNamespace(printed=capsys.readouterr().out, **json.loads(out.read_text(encoding="utf-8")))

    return run


def test_peers_are_compared_with_the_base_and_the_reference(run):
    base = Script(FAKE.format(factor=1.000001, seconds=0.5))
    fast = Script(FAKE.format(factor=1.000002, seconds=0.05))
    wrong = Script(FAKE.format(factor=1.01, seconds=0.01))
    ended = run("--points", "10", "--rounds", "3", base=base, fast=fast, wrong=wrong)
    peers = {peer["name"]: peer for peer in ended.peers}
    assert peers["fast"]["points_per_cpu_second"] == {
        "median": 200.0,
        "min": 200.0,
        "max": 200.0,
        "rounds": [200.0] * 3,
    }
    assert peers["fast"]["ratio_to_base"]["median"] == pytest.approx(10.0)
    assert peers["fast"]["deviation"] == {
        "median": pytest.approx(2e-6),
        "largest": pytest.approx(2e-6),
        "missing": 0,
    }
    assert [name for name, peer in peers.items() if peer["remarks"]] == ["wrong"]
    assert re.search(r"^wrong .* OUT OF LINE: 10,?000 times the base's error$", ended.printed, re.MULTILINE)
    assert ended.skipped == []


def test_peers_that_are_missing_or_fail_are_named(run):
    base = Script(FAKE.format(factor=1.0, seconds=1.0))
    ended = run(
        "--points", "4", "--rounds", "2", base=base, absent=Missing(), broken=Script("raise SystemExit('lost')")
    )
    assert [peer["name"] for peer in ended.peers] == ["base"]
    assert "Skipped: absent: there is no compiler. What helps: install one." in ended.printed
    assert "Skipped: broken: it ended with 1 and said: lost." in ended.printed


def test_nothing_is_known_without_a_reference_and_no_ratio_without_the_base(run):
    peer = Script(FAKE.format(factor=1.0, seconds=1.0))
    ended = run("--points", "4", "--rounds", "1", base=Missing(), peer=peer, reference=Missing())
    assert [found["deviation"] for found in ended.peers] == [None]
    assert [found["ratio_to_base"] for found in ended.peers] == [None]
    assert [found["name"] for found in ended.skipped] == ["base", "reference"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--points", "0"], "--points is 0, but must be 1 or more"),
        (["--rtol", "1"], "--rtol is 1, but must be from 1e-10"),
        (["--only", "bost"], "--only bost is none of the peers: boost, flap"),
        (["--only", "("], "--only: ( is no regular expression: missing )"),
        (["--work", "settled", "--rtol", "1e-5"], "--rtol is 1e-05, but must be from 1e-10, where the reference ends"),
        (["--work", "settled", "--only", "cyrk"], "--only cyrk is none of the peers: boost, flap, flap_marching"),
        (["--work", "walk"], "invalid choice: 'walk'"),
        (["--core", "99999"], "--core 99999 cannot be used; allowed: "),
        (["--json", "/no/such/folder/out.json"], "there is no folder /no/such/folder"),
    ],
)
def test_mistakes_are_named(arguments, message, capsys):
    from harness import command

    with pytest.raises(SystemExit) as ended:
        command.main(arguments)
    assert ended.value.code == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "heading"),
    [
        ("integration", "The test problem `integration`"),
        ("settled", "The test problems `settled` and `responses`"),
        ("responses", "The test problems `settled` and `responses`"),
    ],
)
def test_every_peer_is_described(name, heading):
    from harness.roster import WORKS

    page = (PEERS / "README.md").read_text(encoding="utf-8")
    section = page.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    described = re.findall(r"^\| `(\w+)` \|.*\| (\w+) \|$", section, re.MULTILINE)
    assert described == [(peer.name, "adaptive" if peer.adaptive else "fixed") for peer in WORKS[name].peers]
