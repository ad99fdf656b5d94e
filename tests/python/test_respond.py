"""Responses, trajectories, resonances, and what there is to be set."""

import csv
import math

import flapwing
import numpy as np
import pytest

SOFT = {"hinge_stiffness": "0.7486 uN*m/rad", "drive_voltage_pp": "160 V"}


def test_rows_are_those_of_the_command(flap, tmp_path):
    options = [f"--set={name}={value}" for name, value in SOFT.items()]
    out = tmp_path / "response.csv"
    span = ["--from", "122 Hz", "--to", "130 Hz", "--step", "1 Hz", "--tolerance", "0.5", "--unstable"]
    ended = flap("respond", "jafferis2016", *options, *span, "--out", out)
    table = flapwing.respond(
        "jafferis2016", start="122 Hz", stop=130, step="1 Hz", tolerance=0.5, unstable=True, threads=1, **SOFT
    )
    (verdict,) = table.verdicts
    assert verdict.text == str(verdict) == ended.stdout.strip()
    (band,) = verdict.bands
    bistable = table["drive_frequency"][(table["bistable"] == 1) & (table["branch"] == "up")]
    assert [band.start, band.stop] == [bistable.min(), bistable.max()] and band.stroke_difference_deg > 10
    assert "bistable from 124" in ended.stdout
    assert table.meta["parameter"] == "drive_frequency"
    assert set(table["branch"]) == {"up", "down", "unstable"}
    with open(out, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == table.columns
    assert [row["branch"] for row in rows] == table["branch"].tolist()
    read = flapwing.read(out)
    assert read.columns == table.columns and read.meta["parameter"] == "drive_frequency"
    assert read.axes == table.axes
    for name in ["drive_frequency", "stroke_pp_deg", "floquet_max"]:
        np.testing.assert_array_equal(read[name], table[name])
        np.testing.assert_array_equal([float(row[name] or "nan") for row in rows], table[name])


def test_edges_are_those_of_the_command(flap):
    options = [f"--set={name}={value}" for name, value in SOFT.items()]
    span = ["--from", "120 Hz", "--to", "130 Hz", "--step", "1 Hz"]
    edge = ["--edge", "drive_voltage_pp", "--edge-from", "70 V", "--edge-to", "180 V", "--edge-step", "20 V"]
    ended = flap("respond", "jafferis2016", *options, *span, *edge, "--format", "csv")
    table = flapwing.edges(
        "jafferis2016", edge_start=70, edge_stop="180 V", edge_step=20, start=120, stop=130, step="1 Hz", **SOFT
    )
    rows = list(csv.DictReader(ended.stdout.splitlines()))
    assert list(rows[0]) == table.columns
    assert [row["mark"] for row in rows] == table["mark"].tolist()
    for name in ["edge", "drive_voltage_pp", "drive_frequency", "stroke_pp_deg", "floquet_max"]:
        np.testing.assert_array_equal([float(row[name]) for row in rows], table[name])
    assert table.meta["parameter"] == "drive_frequency" and table.meta["second_parameter"] == "drive_voltage_pp"
    assert table.meta["edges"] == [
        line for line in flap("respond", "jafferis2016", *options, *span, *edge).stdout.splitlines() if " from " in line
    ]
    with pytest.raises(ValueError, match="`drive_voltage_pp` is 160 V, and its range is 200 V to 300 V"):
        flapwing.edges("jafferis2016", edge_start=200, edge_stop=300, start=120, stop=130, step=1, **SOFT)


def test_designs_of_a_grid_have_a_curve_each():
    grid = {
        "preset": "ozaki2018-large",
        "axes": {"drive_voltage_pp": [40, 60, 80], "drive_frequency": {"from": 100, "to": 120, "step": 10}},
    }
    table = flapwing.respond(grid, tolerance=10)
    assert table["curve"].tolist() == [0] * 6 + [1] * 6 + [2] * 6
    assert len(table.verdicts) == 3
    other = flapwing.respond(grid, "drive_voltage_pp")
    assert len(other.verdicts) == 3 and other.meta["parameter"] == "drive_voltage_pp"
    # A verdict has the number of its design, because excluded designs have no verdicts.
    some = flapwing.respond({**grid, "where": {"others": "drive_voltage_pp != 60"}}, tolerance=10)
    assert [verdict.curve for verdict in some.verdicts] == [0, 2] == sorted(set(some["curve"].tolist()))
    assert [verdict.text for verdict in some.verdicts] == [table.verdicts[i].text for i in (0, 2)]


@pytest.mark.parametrize(
    ("arguments", "keywords", "says"),
    [
        ((), {}, "the values of `drive_frequency` are not given"),
        ((), {"start": 100, "stop": 120}, "start, stop and step are required together"),
        ((), {"start": 100, "stop": 90, "step": 1}, "cannot rise from 100 to 90 in steps of 1"),
        (("lift_sign",), {"start": 1, "stop": 2, "step": 1}, "is a choice"),
        (("drive_frequenc",), {}, "did you mean `drive_frequency`?"),
        ((), {"start": 100, "stop": 110, "step": 1, "drive_frequency": 3}, "is set here and followed"),
        ((), {"start": 100, "stop": 110, "step": 1, "tolerance": 0}, "`tolerance` must be more than zero, not 0.0 Hz"),
        ((), {"start": 100, "stop": 110, "step": 0}, "`step` must be more than zero, not 0.0 Hz"),
    ],
)
def test_what_cannot_be_followed(arguments, keywords, says):
    with pytest.raises((ValueError, TypeError)) as caught:
        flapwing.respond("ozaki2018-large", *arguments, **keywords)
    assert says in str(caught.value)


def test_the_design_cannot_be_followed():
    designs = {"preset": ["jafferis2016", "jafferis2016-improved"]}
    with pytest.raises(ValueError, match="`preset` is a choice and cannot rise and fall"):
        flapwing.respond(designs, "preset", start=1, stop=2, step=1)
    with pytest.raises(ValueError, match="`preset` is a choice, so bands have no edge along it"):
        flapwing.edges(
            designs, "drive_frequency", "preset", start=120, stop=130, step=1, edge_start=1, edge_stop=2, edge_step=1
        )


def test_trajectories():
    settled = flapwing.trajectory("jafferis2016", cycles=2, samples=50)
    assert len(settled) == 101
    np.testing.assert_allclose(settled["stroke_deg"][0], settled["stroke_deg"][50], atol=1e-3)
    at_rest = flapwing.trajectory("jafferis2016", cycles=1, samples=10, from_rest=True, drive_frequency="100 Hz")
    assert at_rest["stroke_deg"][0] == 0 and at_rest["time_s"][-1] == pytest.approx(0.01)
    with pytest.raises(ValueError, match="too many"):
        flapwing.trajectory("jafferis2016", cycles=10_000, samples=10_000)
    with pytest.raises(ValueError, match="`cycles` must be from 1"):
        flapwing.trajectory("jafferis2016", cycles=0)
    with pytest.raises(ValueError, match="did you mean `drive_frequency`"):
        flapwing.trajectory("jafferis2016", drive_frequenc=3)


def test_resonances(flap):
    found = flapwing.resonance("ozaki2018-large")
    printed = {
        row["resonance"]: row
        for row in csv.DictReader(flap("test", "resonance", "ozaki2018-large", "--format", "csv").stdout.splitlines())
    }

    def hertz(*names):
        return [float(printed[name]["frequency_hz"]) for name in names]

    (peak,), fit = found.driven, found.impulse_fit
    assert [peak.frequency_hz] == hertz("driven_1")
    assert list(found.linear_hz.items()) == list(zip(["mode_1", "mode_2"], hertz("mode_1", "mode_2"), strict=True))
    assert found.stroke_spectrum_hz == hertz("stroke_spectrum_1")
    assert found.pitch_spectrum_hz == hertz("pitch_spectrum_1", "pitch_spectrum_2")
    for name in ["frequency_hz", "decay_1_s", "relative_rms"]:
        assert getattr(fit, name) == float(printed["impulse_fit"][name]), name
    assert fit.frequency_hz == pytest.approx(107.9, abs=0.1)
    row = flapwing.run("ozaki2018-large", drive_frequency=peak.frequency_hz)
    for name in ["stroke_pp_deg", "pitch_pp_deg"]:
        assert getattr(peak, name) == pytest.approx(row[name], rel=1e-4), name
    assert math.isnan(found.larger_at_hz) and found.gaps == []
    assert flapwing.resonance("ozaki2018-large", start=115, stop=130).larger_at_hz == 115


def test_resonances_count_gaps():
    found = flapwing.resonance("ozaki2018-large", max_cycles=3)
    (gap,) = found.gaps
    # The search begins at half the lowest natural frequency, and ends at 1.5 times the highest.
    ends = (0.5 * found.linear_hz["mode_1"], 1.5 * found.linear_hz["mode_2"])
    assert (gap.start_hz, gap.stop_hz) == pytest.approx(ends, rel=1e-9)
    assert gap.status == "unsettled" and found.driven == []


def test_parameters_and_measures():
    table = flapwing.params("ozaki2018-large")
    frequency = table["drive_frequency"]
    assert (frequency.unit, frequency.symbol, frequency.allowed) == ("Hz", "f", "more than zero")
    assert table["lift_sign"].value == "corrected" and table["lift_sign"].options == ("corrected", "printed")
    unset = flapwing.params("direct-drive")["drive_frequency"]
    assert math.isnan(unset.value) and not unset.is_number and frequency.is_number and not table["lift_sign"].is_number
    searched = {"params": {"drive_frequency": "resonance"}, "resonance": {"from": 100, "to": 120}}
    found = flapwing.params({"preset": "ozaki2018-large", **searched, "axes": {"drive_voltage_pp": [60, 80]}})
    assert math.isnan(found["drive_frequency"].value) and found["drive_voltage_pp"].value == 60.0
    lift = flapwing.measures("bimorph")["lift_mean_mn"]
    assert (lift.name, lift.unit) == ("lift_mean_mn", "mN") and lift.doc
    rate = flapwing.states("bimorph")["pitch_rate"]
    assert (rate.unit, rate.column) == ("rad/s", "pitch_rate_rad_s")
    assert set(flapwing.measures("bimorph")) == set(flapwing.measures("jafferis2016"))
    for function in [flapwing.params, flapwing.measures]:
        with pytest.raises(ValueError, match="did you mean `ozaki2018-large`"):
            function("ozaki2018-larg")
