"""Chirps, impulses, waveforms, strokes, states at the beginning, and filmed wings."""

import flapwing
import numpy as np
import pandas
import pytest
from compare import is_same

PRESET = "ozaki2018-small"
ARABAGI = "arabagi2013-75hz"


def same(table, path):
    """Compares a table with a file of the command, bit for bit."""
    read = flapwing.read(path)
    assert read.columns == table.columns
    for name in table:
        np.testing.assert_array_equal(read[name], table[name])


def test_chirps_are_those_of_the_command(flap, tmp_path):
    options = ["--from", "150", "--to", "160", "--rate", "200"]
    flap(
        "test",
        "chirp",
        PRESET,
        *options,
        "--out",
        tmp_path / "rows.csv",
        "--trajectory",
        tmp_path / "motion.csv",
        "--samples",
        "20",
    )
    rows = flapwing.chirp(PRESET, start="0.15 kHz", stop=160, rate="200 Hz/s")
    same(rows, tmp_path / "rows.csv")
    same(flapwing.chirp(PRESET, start=150, stop=160, rate=200, samples=20), tmp_path / "motion.csv")
    assert rows.docs["lift_mean_mn"] and rows.units["frequency_hz"] == "Hz" and rows.meta["model"] == "direct-drive"
    with pytest.raises(ValueError, match="cannot reach 100 Hz"):
        flapwing.chirp(PRESET, start=150, stop=100)
    with pytest.raises(ValueError, match="`V` is a voltage, but `start` is in Hz\nuse "):
        flapwing.chirp(PRESET, start="150 V")


def test_bare_numbers_of_impulses_are_radians():
    by_number = flapwing.resonance(PRESET, impulse=0.2, start=150, stop=250)
    assert by_number == flapwing.resonance(PRESET, impulse="0.2 rad", start=150, stop=250)
    assert by_number != flapwing.resonance(PRESET, impulse="0.2 deg", start=150, stop=250)
    assert flapwing.resonance(PRESET, start=150, stop=250) == flapwing.resonance(
        PRESET, impulse="20 deg", start=150, stop=250
    )
    first = flapwing.impulse(PRESET, amplitude=0.2).meta["stroke_rate_rad_s"]
    assert first == flapwing.impulse(PRESET, amplitude="0.2 rad").meta["stroke_rate_rad_s"]


def test_impulses_beyond_half_a_turn_are_refused():
    for call, name in ((flapwing.impulse, "amplitude"), (flapwing.resonance, "impulse")):
        for value in (20, -20.0, "181 deg"):
            with pytest.raises(
                ValueError,
                match=f'`{name}` is too large: .* is larger than 180 deg\ngive at most 180 deg, such as "20 deg"',
            ):
                call(PRESET, **{name: value})
    for call, name in ((flapwing.impulse, "amplitude"), (flapwing.resonance, "impulse")):
        with pytest.raises(ValueError, match=f"`{name}` must not be zero"):
            call(PRESET, **{name: "0 deg"})
    assert "(20 rad)" in str(pytest.raises(ValueError, flapwing.impulse, PRESET, amplitude=20).value)


def test_durations_that_are_not_positive_name_their_argument():
    with pytest.raises(ValueError, match="`duration` must be more than zero, not 0.0 s"):
        flapwing.impulse(PRESET, duration=0)
    with pytest.raises(ValueError, match="`spectrum_window` must be more than zero, not -1.0 s"):
        flapwing.resonance(PRESET, spectrum_window="-1 s")


def test_impulses_are_those_of_the_command(flap, tmp_path):
    flap("test", "impulse", PRESET, "--amplitude", "10 deg", "--duration", "20 ms", "--trajectory", tmp_path / "a.csv")
    free = flapwing.impulse(PRESET, amplitude="10 deg", duration="20 ms")
    same(free, tmp_path / "a.csv")
    assert free.meta["stroke_rate_rad_s"] == pytest.approx(2 * np.pi * free.meta["mode_hz"] * np.radians(10))
    same(flapwing.impulse(PRESET, amplitude=np.radians(10), duration=0.02), tmp_path / "a.csv")


def wave():
    time = np.linspace(0, 0.005, 41)
    return time, np.sin(2 * np.pi * time / 0.005)


def test_waveforms_are_those_of_the_command(flap, tmp_path):
    time, values = wave()
    frame = pandas.DataFrame({"time_s": time, "wave": values})
    path = tmp_path / "wave.csv"
    frame.to_csv(path, index=False)
    flap("run", PRESET, "--waveform", path, "--trajectory", tmp_path / "motion.csv")
    row = flapwing.run(PRESET, waveform=path)
    for waveform in (frame, {"time_s": time, "wave": values}, (time, values), str(path)):
        same(flapwing.trajectory(PRESET, waveform=waveform), tmp_path / "motion.csv")
        assert is_same(flapwing.run(PRESET, waveform=waveform), row)
    sine = flapwing.run(PRESET, drive_frequency=200)
    assert row["lift_mean_mn"] == pytest.approx(sine["lift_mean_mn"], rel=1e-3)
    # Stretched to another period.
    slower = flapwing.run(PRESET, waveform=(time, values), drive_frequency=190)
    assert slower["lift_mean_mn"] == pytest.approx(flapwing.run(PRESET, drive_frequency=190)["lift_mean_mn"], rel=1e-3)


def test_a_waveform_with_too_few_samples_is_warned_of():
    waveform = ([0.0, 0.001, 0.0011, 0.004, 0.005], [1.0, 1.0, -1.0, -1.0, 1.0])
    for call in (flapwing.run, flapwing.trajectory):
        with pytest.warns(UserWarning, match="waveform: the spline through the samples lies between -10.308") as caught:
            call("jafferis2016", waveform=waveform, drive_voltage_pp=20)
        assert [warning.filename for warning in caught] == [__file__]


def test_a_waveform_is_followed_once(flap, tmp_path):
    time = np.linspace(0, 0.01, 81)
    path = tmp_path / "wave.csv"
    pandas.DataFrame({"time_s": time, "wave": time / 0.01}).to_csv(path, index=False)
    flap("run", PRESET, "--waveform", path, "--once", "--trajectory", tmp_path / "motion.csv")
    same(flapwing.trajectory(PRESET, waveform=path, once=True), tmp_path / "motion.csv")
    with pytest.raises(ValueError, match="first and last value of a periodic record must be equal"):
        flapwing.trajectory(PRESET, waveform=path)
    with pytest.raises(ValueError, match="once requires a waveform or a stroke\ngive one"):
        flapwing.trajectory(PRESET, once=True)


def test_a_stroke_is_prescribed(flap, tmp_path):
    time = np.linspace(0, 0.0125, 61)
    stroke = 12.5 * np.sin(2 * np.pi * time / 0.0125)
    path = tmp_path / "stroke.csv"
    pandas.DataFrame({"time_s": time, "stroke_deg": stroke}).to_csv(path, index=False)
    flap("run", ARABAGI, "--stroke", path, "--trajectory", tmp_path / "motion.csv")
    same(flapwing.trajectory(ARABAGI, stroke=path), tmp_path / "motion.csv")
    assert flapwing.run(ARABAGI, stroke=(time, np.radians(stroke)))["stroke_pp_deg"] == pytest.approx(25, rel=1e-3)
    with pytest.raises(
        ValueError,
        match="stroke of the model bimorph cannot be prescribed\nthis requires a model with the parameter stroke_mode",
    ):
        flapwing.run("jafferis2016", stroke=path)
    with pytest.raises(ValueError, match="waveform and stroke cannot be used together\nkeep one"):
        flapwing.run(ARABAGI, stroke=path, waveform=path)


@pytest.mark.parametrize(
    ("waveform", "says"),
    [
        ({"time_s": [0, 1, 2, 3]}, "there is no column wave"),
        ({"time_s": [0, 1, 2, 3], "wave": [0, 1, 0]}, "time_s has 4 numbers, wave has 3"),
        ({"time_s": [0, 1, 2, 3], "wave": [0, 1, np.nan, 0]}, "`NaN` is not a number"),
        (([0, 1, 2], [0, 1, 0]), "3 samples are too few"),
        (([0, 1, 2],), "`waveform` has 1 arrays\nit must have two"),
    ],
)
def test_what_is_no_waveform_is_refused(waveform, says):
    with pytest.raises(ValueError) as caught:
        flapwing.run(PRESET, waveform=waveform)
    assert says in str(caught.value)


def test_a_motion_goes_on_from_a_state():
    from_rest = flapwing.trajectory(PRESET, cycles=4, samples=50, from_rest=True)
    second = flapwing.trajectory(PRESET, cycles=2, samples=50, initial_state=from_rest[100:101])
    np.testing.assert_allclose(second["stroke_rad"], from_rest["stroke_rad"][100:], atol=1e-5)
    names = list(flapwing.states(PRESET))
    assert names == ["stroke", "pitch", "stroke_rate", "pitch_rate"]
    state = {
        name: float(from_rest[f"{name}_{unit}"][100]) for name, unit in zip(names, ["rad", "rad", "rad_s", "rad_s"])
    }
    same = flapwing.trajectory(PRESET, cycles=2, samples=50, initial_state=state)
    np.testing.assert_array_equal(same["stroke_rad"], second["stroke_rad"])
    one = flapwing.trajectory(PRESET, initial_state={"stroke": "10 deg", "pitch_deg": 20, "pitch_rate": "5 rad/s"})
    assert one["stroke_deg"][0] == pytest.approx(10) and one["pitch_deg"][0] == pytest.approx(20)
    assert one["pitch_rate_rad_s"][0] == 5 and one["stroke_rate_rad_s"][0] == 0


def test_a_state_decides_between_two_orbits():
    bistable = {"hinge_stiffness": "0.7486 uN*m/rad", "drive_voltage_pp": "160 V", "drive_frequency": 126}
    curve = flapwing.respond(
        "jafferis2016", start=124, stop=128, step=1, **{k: v for k, v in bistable.items() if k != "drive_frequency"}
    )
    strokes = curve["stroke_pp_deg"][curve["drive_frequency"] == 126]
    assert strokes.max() > strokes.min() + 20
    up = flapwing.trajectory("jafferis2016", **{**bistable, "drive_frequency": 123})[-1:]
    down = flapwing.trajectory("jafferis2016", **{**bistable, "drive_frequency": 130})[-1:]
    found = [flapwing.run("jafferis2016", initial_state=state, **bistable)["stroke_pp_deg"] for state in (up, down)]
    assert sorted(found) == pytest.approx(sorted([strokes.min(), strokes.max()]), rel=1e-3)


def test_a_row_of_any_kind_is_a_state():
    motion = flapwing.trajectory(PRESET, cycles=1, samples=10)[3:4]
    frame = motion.to_pandas()
    row = {name: float(motion[name][0]) for name in motion}
    forms = [frame, frame.iloc[0], motion.to_polars(), motion.to_arrow(), row, dict(motion)]
    expected = flapwing.trajectory(PRESET, cycles=1, samples=4, initial_state=motion)["stroke_rad"]
    for begin in forms:
        np.testing.assert_array_equal(
            flapwing.trajectory(PRESET, cycles=1, samples=4, initial_state=begin)["stroke_rad"], expected
        )
    rows = flapwing.evaluate(PRESET, {"drive_frequency": [100.0, 105.0]}, return_states=True)
    alone = [
        flapwing.run(PRESET, drive_frequency=105, initial_state=begin) for begin in (rows[1:], rows.to_pandas().iloc[1])
    ]
    batch = flapwing.evaluate(PRESET, {"drive_frequency": [105.0]}, initial_state=rows[1:])
    assert (
        alone[0]["cycles"]
        == alone[1]["cycles"]
        == batch["cycles"][0]
        < flapwing.run(PRESET, drive_frequency=105)["cycles"]
    )
    # What is not known begins at rest, as in batches.
    unknown = {**row, "stroke_rad": np.nan}
    assert flapwing.trajectory(PRESET, cycles=1, samples=4, initial_state=unknown)["stroke_rad"][0] == 0
    infinite = {name: [np.inf if name == "stroke_rad" else value] for name, value in row.items()}
    with pytest.raises(ValueError, match="row 0 of `initial_state` has an infinite component\ngive finite numbers"):
        flapwing.evaluate(PRESET, {"drive_frequency": [105.0]}, initial_state=infinite)
    with pytest.raises(ValueError, match="`initial_state` has 2 rows\nchoose one"):
        flapwing.run(PRESET, initial_state=rows.to_pandas())


@pytest.mark.parametrize(
    ("initial_state", "says"),
    [
        ({"strok": 1}, "`initial_state` has no component `strok`, did you mean `stroke`?\nthe states are stroke_rad, "),
        ({"stroke": "10 V"}, "`V` is a voltage"),
        ({"stroke": 1, "stroke_rad": 1}, "`initial_state` gives stroke_rad twice\nkeep one"),
        ({"stroke": float("nan")}, "values must be finite"),
    ],
)
def test_what_is_no_state_is_refused(initial_state, says):
    with pytest.raises(ValueError) as caught:
        flapwing.run(PRESET, initial_state=initial_state)
    assert says in str(caught.value)


def test_tables_that_are_no_state_are_refused():
    motion = flapwing.trajectory(PRESET, cycles=1, samples=4)
    with pytest.raises(ValueError, match="`initial_state` has 5 rows\nchoose one"):
        flapwing.run(PRESET, initial_state=motion)
    with pytest.raises(ValueError, match="`initial_state` lacks the columns stroke_rad, .*\na trajectory"):
        flapwing.run(PRESET, initial_state=motion[["time_s"]][-1:])
    with pytest.raises(ValueError, match="from_rest and initial_state both set the beginning of the motion\nkeep one"):
        flapwing.trajectory(PRESET, initial_state=motion[-1:], from_rest=True)


def test_motions_have_meanings_and_an_origin():
    motion = flapwing.trajectory(PRESET, cycles=1, samples=4, drive_voltage_pp="50 V")
    assert all(motion.docs.values()) and motion.docs["lift_mn"]
    assert (
        motion.meta["preset"] == PRESET
        and motion.meta["build"]
        and motion.meta["keywords"] == {"drive_voltage_pp": "50 V"}
    )


def test_forces_of_filmed_wings_are_those_of_the_command(flap, tmp_path):
    time, stroke = np.linspace(0, 5, 60), 0.6 * np.sin(np.linspace(0, 2 * np.pi, 60))
    pitch = 0.5 * np.cos(np.linspace(0, 2 * np.pi, 60))
    # The lower edge appears at chord times the sine of the pitch to the right of the leading edge.
    film = pandas.DataFrame(
        {
            "time_ms": time,
            "root_x": 1.0,
            "root_y": 2.0,
            "tip_x": 1 + 9 * np.cos(stroke),
            "tip_y": 2 + 9 * np.sin(stroke),
            "edge_x": 1 + 3 * np.sin(pitch) * np.sin(stroke),
            "edge_y": 2 - 3 * np.sin(pitch) * np.cos(stroke),
        }
    )
    film.to_csv(tmp_path / "film.csv", index=False)
    flap("test", "track", tmp_path / "film.csv", "--chord", "3", "--out", tmp_path / "motion.csv")
    for source in (film, tmp_path / "film.csv", flapwing.read(tmp_path / "film.csv")):
        motion = flapwing.track_wing(source, chord=3)
        same(motion, tmp_path / "motion.csv")
        assert motion.meta["centre"] == pytest.approx((1, 2))
    np.testing.assert_allclose(motion["pitch_deg"], np.degrees(pitch), atol=1e-6)
    assert flapwing.track_wing(film).columns == ["time_s", "stroke_deg"]

    flap("test", "lift", PRESET, tmp_path / "motion.csv", "--trajectory", tmp_path / "forces.csv", "--samples", "100")
    for source in (motion, tmp_path / "motion.csv", dict(motion)):
        same(flapwing.forces_along(PRESET, source, samples=100), tmp_path / "forces.csv")
    with pytest.raises(ValueError, match="image 1: the lower edge is at a distance of"):
        flapwing.track_wing(film, chord=0.1)
    with pytest.raises(ValueError, match="there is no column pitch_rad or pitch_deg; the file has time_s, stroke_deg"):
        flapwing.forces_along(PRESET, flapwing.track_wing(film))


def test_records_of_several_columns_are_no_pairs():
    for call, columns in (
        (lambda given: flapwing.forces_along(PRESET, given), "time_s, stroke_rad and pitch_rad"),
        (flapwing.track_wing, "time_s, root_x, root_y, tip_x and tip_y"),
    ):
        for given in (5, ([0.0, 1.0], [0.0, 1.0])):
            with pytest.raises(TypeError, match=f"\nit must be a path, or columns such as {columns}$"):
                call(given)
    with pytest.raises(TypeError, match="it must be a path, a pair .*, or columns such as time_s and wave$"):
        flapwing.run(PRESET, waveform=5)


def test_forces_have_at_most_five_million_samples():
    motion = {"time_s": [0.0, 1.0, 2.0, 3.0], "stroke_rad": [0.0, 0.1, 0.2, 0.1], "pitch_rad": [0.0, 0.1, 0.0, 0.2]}
    with pytest.raises(ValueError, match="4000000000 samples are too many: at most 5000000 are allowed"):
        flapwing.forces_along(PRESET, motion, samples=4_000_000_000)
    assert len(flapwing.forces_along(PRESET, motion, samples=10)) == 11


def test_times_of_tracked_points_increase():
    film = {"root_x": [0.0] * 4, "root_y": [0.0] * 4, "tip_x": [1.0, 2.0, 3.0, 4.0], "tip_y": [4.0, 3.0, 2.0, 1.0]}
    with pytest.raises(ValueError, match="points: times do not increase: row 3 is at 1 s, row 2 at 2 s"):
        flapwing.track_wing({"time_s": [0.0, 2.0, 1.0, 3.0], **film})
    with pytest.raises(ValueError, match="points: times do not increase: row 2 is at 0 s, row 1 at 0 s"):
        flapwing.track_wing({"time_s": [0.0, 0.0, 1.0, 3.0], **film})
    assert len(flapwing.track_wing({"time_s": [0.0, 1.0, 2.0, 3.0], **film})) == 4
