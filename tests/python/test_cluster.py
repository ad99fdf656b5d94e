"""Sweeps on the workers of a Dask cluster."""

import os
import signal
import threading

import flapwing
import numpy as np
import pytest
from compare import is_same
from grids import GRID, LONG

distributed = pytest.importorskip("distributed")

#: Rows with derivatives: by derived parameters too, of a formula, and with points that have none.
SLOPES = """\
preset = "ozaki2018-large"

[axes]
drive_voltage_pp = [60, 100]
lift_sign = ["corrected", "printed"]
drive_frequency = { from = "95 Hz", to = "115 Hz", n = 5 }

[derived]
air_density = "preset.air_density * (drive_voltage_pp / preset.drive_voltage_pp)^0.1"

[measure]
lift_per_stroke = "lift_mean_mn / stroke_pp_deg"

[gradient]
of = ["lift_mean_mn", "stroke_lag_deg", "lift_per_stroke"]
with_respect_to = ["hinge_stiffness", "hinge_damping", "drive_frequency", "drive_voltage_pp"]

[output]
columns = ["lift_mean_mn", "stroke_lag_deg", "lift_per_stroke"]
"""


@pytest.fixture(scope="module")
def client():
    """Two worker processes on this machine."""
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0", host="127.0.0.1"
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def test_rows_are_those_of_one_machine(client):
    whole, local = flapwing.sweep(GRID, client=client), flapwing.sweep(GRID)
    assert whole.columns == local.columns and whole.meta == local.meta
    for column in local.columns:
        np.testing.assert_array_equal(whole[column], local[column], strict=True)


def test_a_killed_worker_changes_nothing(client, tmp_path):
    killed = []

    def kill(done, points):
        # Once the first rows are here, one worker dies with rows in its hands.
        if done > 0 and not killed:
            victim = next(iter(client.run(os.getpid).values()))
            killed.append(victim)
            os.kill(victim, signal.SIGKILL)

    out = tmp_path / "cluster.csv"
    table = flapwing.sweep(LONG, client=client, out=out, progress=kill)
    assert killed and len(table) == 8000
    flapwing.sweep(LONG, out=tmp_path / "local.csv")
    assert out.read_bytes() == (tmp_path / "local.csv").read_bytes()
    # Another process took its place.
    client.wait_for_workers(2)
    assert killed[0] not in client.run(os.getpid).values()


def test_an_interrupted_run_goes_on(client, tmp_path):
    class Enough(Exception):
        pass

    def stop(done, points):
        if done > 1000:
            raise Enough

    out = tmp_path / "rows.parquet"
    with pytest.raises(Enough):
        flapwing.sweep(LONG, client=client, out=out, progress=stop)
    flapwing.sweep(LONG, client=client, out=out)
    flapwing.sweep(LONG, out=tmp_path / "local.parquet")
    assert out.read_bytes() == (tmp_path / "local.parquet").read_bytes()


def test_two_sweeps_share_a_cluster(client):
    tables = []
    threads = [threading.Thread(target=lambda: tables.append(flapwing.sweep(GRID, client=client))) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [len(table) for table in tables] == [24, 24]


def test_files_of_the_grid_are_found(client, tmp_path):
    (tmp_path / "points.csv").write_text("drive_frequency\n100\n105\n")
    path = tmp_path / "grid.toml"
    path.write_text('preset = "ozaki2018-large"\n[sample]\nmethod = "file"\npath = "points.csv"\n')
    assert flapwing.sweep(path, client=client)["drive_frequency"].tolist() == [100, 105]


def test_what_a_worker_says_arrives(client, tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("drive_frequency\n100\n105\n")
    path = tmp_path / "grid.toml"
    path.write_text('preset = "ozaki2018-large"\n[sample]\nmethod = "file"\npath = "points.csv"\n')
    grid = flapwing.Grid(path)
    points.write_text("drive_frequency\n100\n106\n")
    with pytest.raises(RuntimeError, match="rows of a worker do not belong to this run: the file of points differs"):
        flapwing.sweep(grid, client=client)
    points.unlink()
    with pytest.raises(flapwing.GridError, match="points.csv") as caught:
        flapwing.sweep(grid, client=client)
    assert caught.value.diagnostics[0].line == 4


def test_a_batch_has_the_rows_of_one_machine(client, tmp_path, monkeypatch):
    rng = np.random.default_rng(1)
    grid = {
        "preset": "ozaki2018-large",
        "axes": {"drive_frequency": [100, 110]},
        "where": {"long": "wing_length > 0.029"},
    }
    columns = {
        "wing_length": rng.uniform(0.028, 0.032, 60),
        "drive_voltage_pp": [f"{volts} V" for volts in range(50, 110)],
        "lift_sign": ["corrected", "printed"] * 30,
        "air_density": np.where(np.arange(60) % 20 == 7, -1.0, 1.2),
    }
    told = []
    options = {"measures": ["lift_mean_mn"], "rtol": 1e-5}
    far = flapwing.evaluate(grid, columns, client=client, progress=lambda *done: told.append(done), **options)
    near = flapwing.evaluate(grid, columns, **options)
    assert far.columns == near.columns and far.units == near.units and told[-1] == (120, 120)
    for name in near:
        np.testing.assert_array_equal(far[name], near[name])
    assert far.counts == near.counts and far.counts["invalid"] > 0
    assert far.meta == near.meta
    assert [{k: v.tolist() for k, v in dim.items()} for dim in far.axes] == [
        {k: v.tolist() for k, v in dim.items()} for dim in near.axes
    ]
    with pytest.raises(ValueError, match="did you mean `drive_frequency`"):
        flapwing.evaluate("ozaki2018-large", {"drive_frequenc": [100.0]}, client=client)
    path = tmp_path / "grid.toml"
    path.write_text('preset = "ozaki2018-large"\n[sample]\nmethod = "file"\npath = "points.csv"\n')
    (tmp_path / "points.csv").write_text("drive_frequency\n100\n105\n")
    monkeypatch.chdir(tmp_path)
    rows = flapwing.evaluate("grid.toml", {"wing_length": [0.03, 0.031]}, client=client)
    assert rows["drive_frequency"].tolist() == [100, 105] * 2
    with pytest.raises(ValueError, match="columns differ in length"):
        flapwing.evaluate("ozaki2018-large", {"drive_frequency": [100.0], "wing_length": [0.03, 0.031]}, client=client)


def test_derivatives_have_the_bytes_of_one_machine(client, flap, tmp_path):
    grid = tmp_path / "slopes.toml"
    grid.write_text(SLOPES, encoding="utf-8")
    table = flapwing.sweep(grid, client=client, out=tmp_path / "cluster.csv")
    flap("sweep", grid, "--out", tmp_path / "command.csv")
    assert (tmp_path / "cluster.csv").read_bytes() == (tmp_path / "command.csv").read_bytes()
    flapwing.sweep(grid, client=client, out=tmp_path / "cluster.parquet")
    flapwing.sweep(grid, out=tmp_path / "local.parquet")
    assert (tmp_path / "cluster.parquet").read_bytes() == (tmp_path / "local.parquet").read_bytes()
    # The damping is zero in the preset: derivatives by a share of it are nan, with their reason.
    assert table.gradient.shape == (20, 3, 4)
    assert np.isfinite(table.gradient[:, :, [0, 2, 3]]).all() and np.isnan(table.gradient[:, :, 1]).all()
    assert (table["gradient_gap"] == "zero").all()
    np.testing.assert_array_equal(flapwing.read(tmp_path / "cluster.parquet").gradient, table.gradient)


@pytest.mark.parametrize("axes", [{}, {"drive_voltage_pp": [60, 80]}])
def test_derivatives_of_a_batch_are_those_of_one_machine(client, axes):
    grid = {"preset": "ozaki2018-large", "axes": axes}
    columns = {
        "drive_frequency": np.linspace(96.0, 118.0, 40),
        "hinge_stiffness": np.linspace(8e-5, 1e-4, 40),
        "air_density": np.where(np.arange(40) % 13 == 7, -1.0, 1.2),
    }
    options = {"measures": ["lift_mean_mn", "stroke_pp_deg"], "gradient": ["hinge_stiffness", "drive_frequency"]}
    far, near = (
        flapwing.evaluate(grid, columns, client=there, return_states=True, **options) for there in (client, None)
    )
    assert far.counts["invalid"] == 3 * len(axes.get("drive_voltage_pp", [0]))
    assert far.meta == near.meta and far.units == near.units and far.columns == near.columns
    assert far.gradient.shape == (len(near), 2, 2) and np.isfinite(far.gradient).sum() > 0.9 * far.gradient.size
    np.testing.assert_array_equal(far.gradient, near.gradient)
    again, here = (
        flapwing.evaluate(grid, columns, client=there, initial_state=near, **options) for there in (client, None)
    )
    np.testing.assert_array_equal(again.gradient, here.gradient)
    with pytest.raises(ValueError, match="`lift_sign` is a choice, so there is no derivative with respect to it"):
        flapwing.evaluate(grid, columns, gradient=["lift_sign"], client=client)


def test_single_points_are_those_of_one_machine(client, tmp_path, monkeypatch):
    record = tmp_path / "wave.csv"
    record.write_text("time_s,wave\n0,0\n0.0025,1\n0.005,0\n0.0075,-1\n0.01,0\n")
    monkeypatch.chdir(tmp_path)
    time = np.linspace(0.0, 0.01, 21)
    grid = {"preset": "ozaki2018-large", "axes": {"drive_frequency": [100, 105, 110]}}
    motion = flapwing.trajectory("ozaki2018-large", cycles=1, samples=4)
    calls = [
        lambda **there: flapwing.run("ozaki2018-large", drive_voltage_pp="80 V", rtol=1e-5, **there),
        lambda **there: flapwing.run(grid, point=1, initial_state=motion[-1:], **there),
        lambda **there: flapwing.run("ozaki2018-large", waveform="wave.csv", **there),
        lambda **there: flapwing.run("ozaki2018-large", waveform=(time, np.sin(2 * np.pi * time / 0.01)), **there),
        lambda **there: flapwing.resonance("ozaki2018-large", start="100 Hz", stop="120 Hz", **there),
    ]
    for call in calls:
        told = []
        far = call(client=client, progress=lambda *done: told.append(done))
        assert is_same(far, call()) and told == [(1, 1)]
    far, near = (
        flapwing.trajectory(grid, point=-1, samples=50, drive_voltage_pp="80 V", client=there)
        for there in (client, None)
    )
    assert far.columns == near.columns and far.units == near.units and far.docs == near.docs and far.meta == near.meta
    for name in near:
        np.testing.assert_array_equal(far[name], near[name], strict=True)


def test_responses_are_those_of_one_machine(client):
    grid = {"preset": "jafferis2016", "axes": {"hinge_stiffness": ["0.7486 uN*m/rad", "1 uN*m/rad", "1.5 uN*m/rad"]}}
    told = []
    options = {
        "start": "122 Hz",
        "stop": "128 Hz",
        "step": "1 Hz",
        "unstable": True,
        "return_states": True,
        "drive_voltage_pp": "160 V",
    }
    far = flapwing.respond(grid, client=client, progress=lambda *done: told.append(done), **options)
    near = flapwing.respond(grid, **options)
    assert told[-1] == (3, 3) and [done for done, _ in told] == [1, 2, 3]
    assert far.meta == near.meta and len(far.verdicts) == 3
    assert far.columns == near.columns and far.units == near.units and set(far["branch"]) == {"up", "down", "unstable"}
    for name in near:
        np.testing.assert_array_equal(far[name], near[name], strict=True)


def test_mistakes_in_single_calls_are_those_of_one_machine(client):
    for call in (
        lambda there: flapwing.run("ozaki2018-large", drive_frequenc=3, client=there),
        lambda there: flapwing.run({"preset": "ozaki2018-large", "axes": {"drive_frequency": [1, 2]}}, client=there),
        lambda there: flapwing.trajectory("ozaki2018-large", cycles=0, client=there),
        lambda there: flapwing.resonance("ozaki2018-larg", client=there),
        lambda there: flapwing.respond("ozaki2018-large", start=1, client=there),
    ):
        messages = []
        for there in (client, None):
            with pytest.raises(ValueError) as caught:
                call(there)
            messages.append(str(caught.value))
        assert messages[0] == messages[1]
    for function in (flapwing.run, flapwing.trajectory, flapwing.resonance):
        with pytest.raises(TypeError, match="`client` is str\nit must be an executor"):
            function("ozaki2018-large", client="here")
        with pytest.raises(TypeError, match="`progress` is str\nit must be True, False"):
            function("ozaki2018-large", progress="yes")


def test_workers_of_another_build_are_refused(client, monkeypatch):
    from flapwing import _workers

    monkeypatch.setattr(_workers._flapwing, "identity", lambda: {"build": "0", "arithmetic": "0"})
    with pytest.raises(
        RuntimeError, match="a worker's build of flapwing is .*, but here it is 0\ninstall the same build"
    ):
        flapwing.run("ozaki2018-large", client=client)
