"""Ctrl-C: whatever is computed ends within a second, inside a point too."""

import os
import signal
import subprocess
import sys
import textwrap
import time

import flapwing
import pytest

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals")

PRESET = "ozaki2018-small"

#: Settings with which no point ends.
ENDLESS = {"max_cycles": 10**9, "newton": False, "settle_tol": 1e-300}

#: A grid with a point that does not end.
GRID = {"preset": PRESET, "axes": {"drive_frequency": [90, 100]}, "solver": ENDLESS}

#: An axis with as many values as an array can have.
LONG = {"air_density": {"from": 1.0, "to": 2.0, "n": 100_000_000}}

#: Stroke and pitch over time.
MOTION = {"time_s": [0.0, 0.1, 0.2, 0.3], "stroke_rad": [0.0, 0.1, 0.2, 0.1], "pitch_rad": [0.0, 0.1, 0.0, 0.2]}

#: A vehicle that can fly.
ROBOT = flapwing.Vehicle(
    {
        "preset": "jafferis2016",
        "params": {
            "drive_voltage_pp": 140.0,
            "body_inertia_roll": 1.5e-9,
            "body_inertia_pitch": 1.5e-9,
            "body_inertia_yaw": 0.5e-9,
        },
    },
    [
        flapwing.Wing("left", position=["0 mm", "2 mm", "0 mm"]),
        flapwing.Wing("right", position=["0 mm", "2 mm", "0 mm"], mirrored=True),
    ],
    about=["0 mm", "0 mm", "-3 mm"],
    total_mass="69 mg",
)

#: Readings of a stroke.
READINGS = {"drive_frequency": [90.0, 95.0, 100.0] * 20, "stroke_pp_deg": [40.0, 41.0, 42.0] * 20}

#: Long after a second (s), so that busy machines pass.
SOON = 5


@pytest.fixture
def ctrl_c():
    """Ctrl-C after a moment, heeded as in a terminal: a parent may have had the tests ignore it."""
    before = [(one, signal.getsignal(one)) for one in (signal.SIGINT, signal.SIGALRM)]
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    yield
    signal.setitimer(signal.ITIMER_REAL, 0)
    for one, handler in before:
        signal.signal(one, handler)


@pytest.mark.parametrize(
    "work",
    [
        lambda _: flapwing.run(PRESET, **ENDLESS),
        lambda _: flapwing.run(PRESET, drive_frequency=1e-3, max_steps=2**32 - 1, rtol=1e-12),
        lambda _: flapwing.trajectory(PRESET, **ENDLESS),
        lambda _: flapwing.trajectory(PRESET, cycles=5_000_000, samples=1, from_rest=True),
        lambda _: flapwing.forces_along(PRESET, MOTION, samples=5_000_000),
        lambda _: flapwing.fly(ROBOT, seconds=0.1, samples=400_000, averaged=True, drive_frequency=120),
        lambda _: flapwing.Grid({"preset": PRESET, "axes": LONG})[::1],
        lambda _: flapwing.Grid({"preset": PRESET, "axes": LONG}).axes,
        lambda _: flapwing.resonance(PRESET, **ENDLESS),
        lambda _: flapwing.resonance(PRESET, rtol=1e-13, spectrum_window=100),
        lambda _: flapwing.evaluate(PRESET, {"drive_frequency": [100.0]}, **ENDLESS),
        lambda _: flapwing.evaluate(PRESET, {"drive_frequency": [90.0] * 1000}, threads=2, **ENDLESS),
        lambda _: flapwing.respond(PRESET, start=90, stop=100, step=1, **ENDLESS),
        lambda _: flapwing.respond("jafferis2016", start=60, stop=200, step=0.001),
        lambda _: flapwing.fit(PRESET, READINGS, ["hinge_stiffness"], **ENDLESS),
        lambda _: flapwing.fit(PRESET, READINGS, ["hinge_stiffness"], starts=10_000),
        lambda _: flapwing.sweep(GRID),
        lambda folder: flapwing.sweep(GRID, out=folder / "rows.csv"),
        lambda folder: flapwing.sweep(GRID, out=folder / "rows.parquet"),
    ],
)
def test_ctrl_c_ends(work, ctrl_c, tmp_path):
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        work(tmp_path)
    assert time.monotonic() - begun < SOON


def test_ctrl_c_keeps_the_rows_of_a_sweep(tmp_path):
    script = """
    import sys, flapwing
    print("begun", flush=True)
    flapwing.sweep(sys.argv[1], out=sys.argv[2])
    """
    out = tmp_path / "rows.csv"
    axis = "drive_frequency = { from = 100, to = 125, n = 10000000 }"
    grid = f'preset = "ozaki2018-large"\n[axes]\n{axis}\n[solver]\nmax_cycles = 1\n'
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(script), grid, out],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    process.stdout.readline()
    while not out.exists() or out.stat().st_size < 10_000:
        assert process.poll() is None
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert b"KeyboardInterrupt" in errors
    assert process.returncode == -signal.SIGINT
    assert "interrupted" in (tmp_path / "rows.csv.meta.toml").read_text()
