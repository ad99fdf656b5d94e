"""Pictures in the sizes of papers: nothing overlaps or leaves the figure."""

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from figures import HERTZ, VOLTS, drawn, fails, grid, loop, message
from flapwing import plot
from matplotlib.figure import Figure

CUBE = {"drive_voltage_pp": VOLTS, "hinge_stiffness": [6e-5, 8e-5], "drive_frequency": HERTZ}

ALONG, ABOUT = ("forward", "left", "up"), ("roll", "pitch", "yaw")


def gaps():
    table = fails(fails(grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ), [0, 1]), [7], "subharmonic")
    table = {**table, "power_translational_mean_mw": table["lift_mean_mn"]}
    return {name: column[:-3] for name, column in table.items()}


def vehicle():
    rng = np.random.default_rng(1)
    table = grid(drive_offset=np.linspace(-60.0, 60.0, 7))
    names = [f"force_{axis}_mn" for axis in ("forward", "left", "up")]
    names += [f"torque_{axis}_unm" for axis in ("roll", "pitch", "yaw")]
    return {**table, **{name: 1e-3 * rng.normal(size=7) for name in names}}


def sample():
    rng = np.random.default_rng(2)
    names = ["drive_frequency", "hinge_stiffness", "wing_length"]
    table = grid(drive_frequency=np.arange(80.0))
    columns = {name: rng.uniform(1.0, 2.0, 80) for name in names}
    table = {"point": table["point"], **columns, "status": table["status"]}
    return {**table, "lift_mean_mn": rng.normal(3.0, 0.5, 80), "power_mean_mw": rng.normal(50.0, 5.0, 80)}


def flight():
    names = [f"{stem}_{name}_{unit}" for stem, unit in (("velocity", "m_s"), ("position", "m")) for name in ALONG]
    names += [f"{stem}_{name}_{unit}" for stem, unit in (("rate", "rad_s"), ("angle", "rad")) for name in ABOUT]
    rng = np.random.default_rng(3)
    return {"time_s": np.linspace(0.0, 1.0, 20), **{name: rng.normal(size=20) for name in [*names, "amplitude"]}}


KINDS = {
    "response": lambda motion: plot.response(gaps(), "lift_mean_mn"),
    "response_panels": lambda motion: plot.response_panels(
        grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ), ["lift_mean_mn", "power_mean_mw"]
    ),
    "heatmap": lambda motion: plot.heatmap(gaps(), "power_translational_mean_mw"),
    "reduced": lambda motion: plot.heatmap(grid(**CUBE), "lift_mean_mn", reduce="max", annotate=True),
    "points": lambda motion: plot.heatmap(
        fails(sample(), [3, 4]), "lift_mean_mn", x="drive_frequency", y="hinge_stiffness", annotate=True
    ),
    "pareto": lambda motion: plot.pareto(grid(**CUBE), maximize="lift_mean_mn", minimize="power_mean_mw"),
    "scatter": lambda motion: plot.scatter(sample(), "power_mean_mw", "lift_mean_mn", color="wing_length"),
    "histogram": lambda motion: plot.histogram(sample(), "lift_mean_mn"),
    "correlations": lambda motion: plot.tornado(sample(), "lift_mean_mn"),
    "tornado": lambda motion: plot.tornado("ozaki2018-large", "lift_mean_mn", top=6),
    "trajectory": lambda motion: plot.trajectory(motion, ["stroke_deg", "pitch_deg", "lift_mn"]),
    "trajectories": lambda motion: plot.trajectory({"published design": motion, "own design": motion}),
    "hysteresis": lambda motion: plot.hysteresis(loop()),
    "control_matrix": lambda motion: plot.control_matrix(
        1e-3 * np.arange(24.0).reshape(6, 4),
        inputs=["drive_voltage_pp", "difference_drive_voltage_pp", "drive_offset", "difference_drive_offset"],
    ),
    "flight": lambda motion: plot.flight({"coupled": flight(), "averaged": flight()}),
    "force_panels": lambda motion: plot.force_panels(vehicle()),
}


def texts(ax):
    """The extents of the labels of axes and of their numbers (pixels)."""
    labels = [ax.xaxis.label, ax.yaxis.label]
    shown = [label for label in labels if label.get_text()]
    for axis in (ax.xaxis, ax.yaxis):
        low, high = sorted(axis.get_view_interval())
        ticks = [tick for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
        shown += [label for tick in ticks for label in (tick.label1, tick.label2) if label.get_visible()]
    return [label.get_window_extent() for label in shown if label.get_text()]


@pytest.mark.parametrize("width", [3.3, 7.0])
@pytest.mark.parametrize("kind", KINDS)
def test_nothing_overlaps_in_a_column_or_on_a_page(kind, width, motion):
    with plot.style(width=width, font_size=8):
        picture = KINDS[kind](motion)
        figure = picture if isinstance(picture, Figure) else picture.figure
        assert figure.get_size_inches()[0] == width
        drawn(figure)
        boxes = [(ax, box) for ax in figure.axes for box in texts(ax)]
        for place, (ax, box) in enumerate(boxes):
            for other, another in boxes[place + 1 :]:
                if other is not ax:
                    assert not box.padded(-1.0).overlaps(another.padded(-1.0)), (kind, box, another)
            # Labels of other axes, such as a colour bar, lie outside of these axes.
            for each in figure.axes:
                if each is not ax:
                    assert not box.padded(-1.0).overlaps(each.get_window_extent()), (kind, box)


def test_the_size_and_the_letters_are_set():
    before = mpl.rcParams.copy()
    table = grid(drive_frequency=HERTZ)
    for width, inches in (("3.3 in", 3.3), ("84 mm", 84 / 25.4), ("8.4cm", 84 / 25.4), (7, 7.0)):
        with plot.style(width=width):
            ax = plot.response(table, "lift_mean_mn")
            assert ax.figure.get_size_inches() == pytest.approx([inches, 1.0 + 0.42 * inches])
            assert ax.xaxis.label.get_fontsize() == pytest.approx(8.0)
            assert plt.figure().get_size_inches()[0] == pytest.approx(inches)
    with plot.style(width=5, height="2 in", font_size=10):
        ax = plot.response(table, "lift_mean_mn")
        assert ax.figure.get_size_inches() == pytest.approx([5.0, 2.0])
        assert ax.xaxis.label.get_fontsize() == pytest.approx(10.0)
    with plot.style(font_size=7):
        assert plot.response(table, "lift_mean_mn").figure.get_size_inches() == pytest.approx([6.4, 4.0])
    assert mpl.rcParams == before


def test_a_figure_size_of_the_user_is_kept():
    with mpl.rc_context({"figure.figsize": (5.5, 3.0)}):
        sizes = [
            plot.response(grid(drive_frequency=HERTZ), "lift_mean_mn").figure.get_size_inches(),
            plot.response_panels(grid(drive_frequency=HERTZ), ["lift_mean_mn", "power_mean_mw"]).get_size_inches(),
        ]
    assert sizes[0] == pytest.approx([5.5, 3.0]) and sizes[1] == pytest.approx([5.5, 3.0 * 5.4 / 4.0])


@pytest.mark.parametrize("ending", ["pdf", "svg"])
def test_a_figure_is_saved_for_a_paper(ending, tmp_path):
    path = tmp_path / f"map.{ending}"
    with plot.style(width="3.3 in"):
        plot.heatmap(gaps(), "lift_mean_mn").figure.savefig(path)
    text = path.read_bytes()
    # 3.3 inches are 237.6 points; letters of a PDF are TrueType.
    assert b"237.6" in text and (ending == "svg" or b"/CIDFontType2" in text)


def test_mistakes_in_sizes():
    def styled(**options):
        with plot.style(**options):
            pass

    for wrong in ("3.3", "3.3 ft", "wide", ". in", "1.2.3 in"):
        assert '"84 mm" or "8.4 cm"' in message(ValueError, styled, width=wrong)
    assert "`width` must be more than 0" in message(ValueError, styled, width=0)
    assert "`height` is list" in message(TypeError, styled, height=[3])
    assert "`font_size` is str" in message(TypeError, styled, font_size="8 pt")
    assert "more than 0 points" in message(ValueError, styled, font_size=float("nan"))
