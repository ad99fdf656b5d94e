"""Pictures of fits."""

import flapwing
import numpy as np
import pytest
from figures import message
from flapwing import plot

PRESET = "ozaki2018-large"


@pytest.fixture(scope="module")
def found():
    points = {
        "drive_frequency": np.tile(np.linspace(95.0, 120.0, 8), 2),
        "drive_voltage_pp": np.repeat([60.0, 80.0], 8),
    }
    rows = flapwing.evaluate(PRESET, points, measures=["stroke_pp_deg", "lift_mean_mn"])
    draw = np.random.default_rng(1)
    data = {name: rows[name] * draw.normal(1.0, 0.02, 16) for name in ("stroke_pp_deg", "lift_mean_mn")}
    return flapwing.fit(PRESET, {**points, **data}, ["hinge_stiffness", "wing_length"], sigma="2 %", starts=1)


def axes(figure):
    return [ax for part in figure.subfigs for ax in part.axes]


def test_all_parts_are_drawn(found):
    figure = plot.fit(found)
    parts = axes(figure)
    # Two measures, two profiles, one map.
    assert len(parts) == 5
    stroke = parts[0]
    assert stroke.get_xlabel() == "Drive frequency (Hz)" and stroke.get_ylabel() == "Stroke, peak to peak (°)"
    assert [text.get_text() for text in stroke.get_legend().get_texts()] == [
        "60 V",
        "80 V",
        "model with its 95 % band",
    ]
    assert len(stroke.containers) == 2 and len(stroke.collections) >= 2
    assert parts[2].get_xlabel() == "Hinge stiffness (µN·m/rad)"
    low, high = (one.get_xdata()[0] for one in parts[2].lines[-2:])
    assert [low, high] == pytest.approx(
        [1e6 * found.estimates["hinge_stiffness"].low, 1e6 * found.estimates["hinge_stiffness"].high]
    )
    assert parts[4].texts[1].get_text() == f"{found.correlations[0, 1]:+.2f}".replace("-", "−")
    assert [label.get_text() for label in parts[4].get_yticklabels()] == ["Hinge stiffness", "Wing length"]


def test_profiles_have_enough_points_and_are_explained(found):
    figure = plot.fit(found, "profiles")
    figure.canvas.draw()
    (part,) = figure.subfigs
    (told,) = part.legends
    assert [text.get_text() for text in told.get_texts()] == [
        "profile",
        "estimate",
        "95 % limit",
        "ends of the interval",
    ]
    for ax in part.axes:
        assert len(ax.lines[0].get_xdata()) >= 7
        rise = ax.lines[0].get_ydata()
        lowest = int(np.argmin(rise))
        assert rise[lowest] == 0 and (np.diff(rise[lowest:]) > 0).all() and (np.diff(rise[: lowest + 1]) < 0).all()
        boxes = [text.get_window_extent() for text in ax.get_xticklabels() if text.get_text()]
        assert all(left.x1 < right.x0 for left, right in zip(boxes, boxes[1:]))


@pytest.mark.parametrize(("show", "count"), [("data", 2), ("profiles", 2), ("correlations", 1)])
def test_one_part_can_be_drawn(found, show, count):
    assert len(axes(plot.fit(found, show))) == count


def test_mistakes_are_told(found):
    assert (
        message(ValueError, plot.fit, found, "bands")
        == "`show` is 'bands'\nit must be one of data, profiles, correlations"
    )
    assert message(TypeError, plot.fit, 3) == "`result` is int\nit must be the result of flapwing.fit"
