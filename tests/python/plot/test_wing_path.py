"""Animations of a wing."""

import flapwing
import numpy as np
import pytest
from figures import message
from flapwing import plot
from numpy.testing import assert_allclose
from PIL import Image


def test_wing_path_is_saved_as_gif(motion, tmp_path):
    path = tmp_path / "cycle.gif"
    plot.wing_path(motion, frames=6).save(path, dpi=40)
    with Image.open(path) as image:
        assert image.n_frames == 6
        assert image.format == "GIF" and image.info["loop"] == 0
        assert image.convert("RGB").getpixel((0, 0)) == (255, 255, 255)


@pytest.mark.parametrize(("options", "interval"), [({}, 40), ({"fps": 10}, 100)])
def test_wing_path_is_saved_as_a_page(motion, tmp_path, options, interval):
    path = tmp_path / "cycle.html"
    plot.wing_path(motion, frames=2).save(path, dpi=40, **options)
    page = path.read_text(encoding="utf-8")
    assert page.count("data:image/png;base64") == 2
    assert f"new Animation(frames, img_id, slider_id, {interval}," in page


@pytest.mark.parametrize("preset", ["jafferis2016", "ozaki2018-large", "arabagi2013-75hz"])
def test_the_trailing_edge_lags_in_every_model(preset):
    animation = plot.wing_path(flapwing.trajectory(preset, samples=100), frames=20)
    scene = animation._scene
    chord = np.hypot(*(scene.leading - scene.trailing).T)
    assert_allclose(chord, 1.0)
    assert_allclose(scene.leading[:, 0], 3.0 * np.radians(scene.cycle.stroke))
    rate = np.roll(scene.leading[:, 0], -1) - np.roll(scene.leading[:, 0], 1)
    behind = scene.leading[:, 0] - scene.trailing[:, 0]
    assert np.sum(behind * rate) > 0.5 * np.linalg.norm(behind) * np.linalg.norm(rate)
    animation._draw_was_started = True  # never shown


def test_every_frame_is_where_the_wing_is(motion):
    animation = plot.wing_path(motion, frames=10, pitch_sign=-1)
    scene = animation._scene
    assert scene.cycle.seconds == pytest.approx(1 / 109, rel=1e-6)
    once = motion["time_s"] >= motion["time_s"][-1] - 1.0001 / 109
    assert_allclose(
        scene.cycle.stroke, np.interp(scene.cycle.phase / 109, motion["time_s"], motion["stroke_deg"]), atol=1e-3
    )
    assert once.sum() == 201
    for frame in (0, 7):
        scene.draw(frame)
        assert_allclose(scene.edge.get_xydata()[0], scene.leading[frame])
        assert_allclose(scene.chord.get_xydata(), [scene.leading[frame], scene.trailing[frame]])
        assert scene.now.get_xdata()[0] == frame / 10
    animation._draw_was_started = True


def test_the_cycle_is_found_after_a_start_from_rest():
    table = flapwing.trajectory("ozaki2018-large", cycles=40, samples=50, from_rest=True)
    animation = plot.wing_path(table, frames=4)
    assert animation._scene.cycle.seconds == pytest.approx(1 / 109, rel=1e-6)
    animation._draw_was_started = True


@pytest.mark.parametrize("samples", [6, 3000])
def test_the_cycle_does_not_depend_on_the_number_of_samples(samples):
    phase = 2.0 * np.pi * np.arange(2 * samples + 1) / samples
    table = {"time_s": phase / 754.0, "stroke_deg": 60.0 * np.sin(phase), "pitch_deg": 45.0 * np.cos(phase)}
    animation = plot.wing_path(table, frames=4)
    assert animation._scene.cycle.seconds == pytest.approx(2.0 * np.pi / 754.0, rel=1e-9)
    animation._draw_was_started = True


def test_wing_path_mistakes(motion):
    half = motion[:100]
    assert "does not repeat" in message(ValueError, plot.wing_path, half)
    assert "less than one cycle" in message(ValueError, plot.wing_path, half, frequency=109)
    assert "two frames" in message(ValueError, plot.wing_path, motion, frames=1)
    assert "1 or -1" in message(ValueError, plot.wing_path, motion, pitch_sign=2)
    assert "did you mean `lift_mn`?" in message(ValueError, plot.wing_path, motion, lift="lift_m")


def test_small_strokes_are_readable():
    phase = np.linspace(0.0, 2.0 * np.pi, 101)
    table = {"time_s": phase / 754.0, "stroke_deg": 0.3 * np.sin(phase), "pitch_deg": 2.0 * np.cos(phase)}
    animation = plot.wing_path(table, frames=20, frequency=754.0 / (2.0 * np.pi))
    along = animation._scene.leading[:, 0]
    assert np.ptp(along) == pytest.approx(2.5, rel=1e-2)
    ticks = [text.get_text() for text in animation._scene.figure.axes[0].get_xticklabels()]
    assert ticks == ["−0.2°", "0°", "0.2°"]
    animation._draw_was_started = True


def test_a_table_without_a_model_has_the_trailing_edge_lag(motion):
    columns = {name: np.asarray(motion[name]) for name in ("time_s", "stroke_deg", "pitch_deg")}
    for sign in (1, -1):
        animation = plot.wing_path({**columns, "pitch_deg": sign * columns["pitch_deg"]}, frames=20)
        scene = animation._scene
        expected = plot.wing_path(motion, frames=20)
        assert_allclose(scene.trailing, expected._scene.trailing)
        animation._draw_was_started = expected._draw_was_started = True


def test_the_sign_of_pitch_is_of_the_model():
    signs = {"jafferis2016": 1, "ozaki2018-large": 1, "arabagi2013-75hz": -1}
    for preset, sign in signs.items():
        assert flapwing.trajectory(preset, cycles=1, samples=4).meta["pitch_sign"] == sign


def test_notebooks_show_a_page_with_buttons(motion):
    page = plot.wing_path(motion, frames=2)._repr_html_()
    assert page.count("data:image/png;base64") == 2 and "<button" in page
