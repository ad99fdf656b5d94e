"""Makes the pictures of docs/how-to/plots-python.md, devices.md and hover.md, in less than a minute:

    pip install "./crates/flap-py[plot,fit]" control
    python docs/site/pictures.py             # into docs/pictures
    python docs/site/pictures.py elsewhere

Each function makes one picture of what it computes itself, or of a `softened` bimorph; copy what you need.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")  # files, no windows

import flapwing
import matplotlib.pyplot as plt
import numpy as np
from flapwing import plot
from matplotlib.axes import Axes
from matplotlib.figure import Figure

REPOSITORY = Path(__file__).parents[2]

DRIVE = {"drive_voltage_pp": "140 V", "drive_frequency": "120 Hz"}

# Maps keep all of their colours: with few, their colour bars have steps.
MAPS = ("best", "column", "control-matrix", "gaps", "heatmap", "hover-growth")


def softened(volts: dict[str, str], highest: str, where: dict[str, str] | None = None) -> flapwing.Table:
    """A sweep of the bimorph with a softened hinge: over voltages, and over frequencies from 60 Hz to the highest."""
    return flapwing.sweep(
        {
            "preset": "jafferis2016",
            "params": {"hinge_stiffness": "0.7486 uN*m/rad"},
            "axes": {"drive_voltage_pp": volts, "drive_frequency": {"from": "60 Hz", "to": highest, "step": "1 Hz"}},
            "where": where or {},
        }
    )


def response() -> Axes:
    """Frequency responses of the bimorph with a softened hinge; from 180 V on some motions are not periodic."""
    volts = {"from": "80 V", "to": "240 V", "step": "40 V"}
    return plot.response(softened(volts, "160 Hz"), "vehicle_lift_mgf")


def measures() -> Figure:
    """Three measures of the four-bar over frequency, at three stiffnesses of its series spring."""
    table = flapwing.sweep(REPOSITORY / "examples" / "arabagi_fig11.toml")
    return plot.response_panels(table, ["stroke_pp_deg", "lift_mean_mn", "power_mean_mw"])


def heatmap(large: flapwing.Table) -> Axes:
    """Efficiency of the large direct drive over frequency and hinge stiffness, at one of the sweep's voltages."""
    return plot.heatmap(large, "efficiency_gf_per_w", drive_voltage_pp=100)


def best(large: flapwing.Table) -> Axes:
    """The largest efficiency over the voltages of the same sweep."""
    return plot.heatmap(large, "efficiency_gf_per_w", y="hinge_stiffness", reduce="max", annotate=True)


def column(large: flapwing.Table) -> Axes:
    """The same map in the width of a column."""
    with plot.style(width="3.3 in", font_size=8):
        return plot.heatmap(large, "efficiency_gf_per_w", drive_voltage_pp=100)


def points() -> Axes:
    """Lift of the bimorph with a softened hinge at the points of a sample."""
    sampled = {
        "drive_voltage_pp": {"from": "160 V", "to": "280 V"},
        "drive_frequency": {"from": "80 Hz", "to": "150 Hz"},
    }
    grid = {
        "preset": "jafferis2016",
        "params": {"hinge_stiffness": "0.7486 uN*m/rad"},
        "sample": {"method": "sobol", "n": 200, "parameters": sampled},
    }
    return plot.heatmap(flapwing.sweep(grid), "vehicle_lift_mgf")


def gaps() -> Axes:
    """Lift of the bimorph with a softened hinge: some motions are not periodic, and some designs are not run."""
    volts = {"from": "160 V", "to": "280 V", "step": "20 V"}
    amplifier = {"within_the_amplifier": "drive_voltage_pp * drive_frequency < 34000"}
    return plot.heatmap(softened(volts, "140 Hz", amplifier), "vehicle_lift_mgf")


def pareto(large: flapwing.Table) -> Axes:
    """Lift against power of all designs of the same sweep."""
    return plot.pareto(large, maximize="lift_mean_mn", minimize="power_mean_mw", color="drive_frequency")


def scatter(builds: flapwing.Table) -> Axes:
    """Lift, strain and stroke of two thousand builds of the bimorph."""
    return plot.scatter(builds)


def histogram(builds: flapwing.Table) -> Axes:
    """The lift of these builds, with percentiles."""
    return plot.histogram(builds, "vehicle_lift_mgf")


def correlations(builds: flapwing.Table) -> Axes:
    """Rank correlations of the parameters that differ from build to build with the lift."""
    return plot.tornado(builds, "vehicle_lift_mgf")


def trajectory() -> Figure:
    """Two cycles of the bimorph."""
    return plot.trajectory(flapwing.trajectory("jafferis2016"), ["stroke_deg", "pitch_deg", "lift_mn"])


def designs() -> Figure:
    """Two cycles of the bimorph with two hinges."""
    motions = {
        "published hinge": flapwing.trajectory("jafferis2016"),
        "stiffer hinge": flapwing.trajectory("jafferis2016", hinge_stiffness="2 uN*m/rad"),
    }
    return plot.trajectory(motions, ["stroke_deg", "pitch_deg", "lift_mn"])


def devices() -> Figure:
    """Responses of the three wings of docs/how-to/devices.md, with the parameters from `flap device wing`."""
    wings = {
        "short": {
            "hinge_stiffness": "0.95 uN*m/rad",
            "wing_length": "14 mm",
            "wing_area": "46.8 mm^2",
            "wing_radius_2": 0.6056596838,
            "wing_width": "4 mm",
            "wing_width_2": 0.4837862599,
            "added_inertia_stroke": "11.74282095 ng*m^2",
            "pressure_radius": "10.36519258 mm",
            "rotation_pressure_width": "2.67424111 mm",
            "wing_inertia_stroke": "20.74608 ng*m^2",
            "wing_inertia_hinge": "396.8376 pg*m^2",
            "wing_inertia_product": "562.872 pg*m^2",
        },
        "middle": {
            "hinge_stiffness": "0.71 uN*m/rad",
            "wing_length": "16 mm",
            "wing_area": "46.83 mm^2",
            "wing_radius_2": 0.5982406786,
            "wing_width": "3.4 mm",
            "wing_width_2": 0.4753828557,
            "added_inertia_stroke": "12.78351255 ng*m^2",
            "pressure_radius": "11.82644957 mm",
            "rotation_pressure_width": "2.255703407 mm",
            "wing_inertia_stroke": "29.450218 ng*m^2",
            "wing_inertia_hinge": "290.5143231 pg*m^2",
            "wing_inertia_product": "287.480725 pg*m^2",
        },
        "long": {
            "hinge_stiffness": "0.57 uN*m/rad",
            "wing_length": "18 mm",
            "wing_area": "46.8 mm^2",
            "wing_radius_2": 0.5897068865,
            "wing_width": "3 mm",
            "wing_width_2": 0.4602895747,
            "added_inertia_stroke": "13.57607347 ng*m^2",
            "pressure_radius": "13.25485992 mm",
            "rotation_pressure_width": "1.952589475 mm",
            "wing_inertia_stroke": "40.19344 ng*m^2",
            "wing_inertia_hinge": "225.80015 pg*m^2",
            "wing_inertia_product": "-10.604 pg*m^2",
        },
    }
    frequencies = {"drive_frequency": {"from": "70 Hz", "to": "160 Hz", "step": "1 Hz"}}
    responses = {
        name: flapwing.sweep({"preset": "jafferis2016", "params": wing, "axes": frequencies}, drive_voltage_pp="180 V")
        for name, wing in wings.items()
    }
    return plot.response_panels(responses, ["stroke_pp_deg", "vehicle_lift_mgf", "efficiency_gf_per_w"])


def wing_path() -> plot.Animation:
    """One cycle of it, seen from the wing's tip."""
    return plot.wing_path(flapwing.trajectory("jafferis2016"), frames=36)


def hysteresis() -> Axes:
    """The bimorph with a softened hinge, bistable around 126 Hz."""
    table = flapwing.respond(
        "jafferis2016",
        start="115 Hz",
        stop="135 Hz",
        step="1 Hz",
        unstable=True,
        hinge_stiffness="0.7486 uN*m/rad",
        drive_voltage_pp="160 V",
    )
    return plot.hysteresis(table)


def fit() -> Figure:
    """A fit of hinge and drag to synthetic readings."""
    points = {
        "drive_frequency": np.tile(np.linspace(70, 150, 15), 2),
        "drive_voltage_pp": np.repeat([120.0, 160.0], 15),
    }
    rows = flapwing.evaluate("jafferis2016", points, hinge_stiffness="1.3 uN*m/rad")
    readings = {**points, "stroke_pp_deg": rows["stroke_pp_deg"] * np.random.default_rng(1).normal(1, 0.02, 30)}
    return plot.fit(
        flapwing.fit("jafferis2016", readings, ["hinge_stiffness", "drag_coefficient_max"], sigma="2 %", starts=2)
    )


def tornado() -> Axes:
    """Sensitivities of the lift of the large direct drive."""
    return plot.tornado("ozaki2018-large", "lift_mean_mn", top=10)


def vehicle() -> flapwing.Vehicle:
    """Two bimorph wings beside each other, 2 mm above the centre of mass."""
    place = ["0 mm", "1.5 mm", "0 mm"]
    wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    return flapwing.Vehicle("jafferis2016", wings, about=["0 mm", "0 mm", "-2 mm"])


def control_matrix() -> Axes:
    """Changes of the vehicle's force and torque with its amplitudes and biases."""
    inputs = ["drive_voltage_pp", "difference_drive_voltage_pp", "drive_offset", "difference_drive_offset"]
    return plot.control_matrix(flapwing.evaluate(vehicle(), {"drive_frequency": [120.0]}, gradient=inputs))


def force_panels() -> Figure:
    """Force and torque over the bias, with more amplitude on the left."""
    course = {**vehicle(), "axes": {"drive_offset": {"from": "-60 V", "to": "60 V", "step": "5 V"}}}
    return plot.force_panels(flapwing.sweep(course, difference_drive_voltage_pp="20 V"))


def hovering() -> flapwing.Vehicle:
    """The robot of docs/how-to/hover.md."""
    place = ["0 mm", "2 mm", "0 mm"]
    wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    body = {"body_inertia_roll": 1.5e-9, "body_inertia_pitch": 1.5e-9, "body_inertia_yaw": 0.5e-9}
    design = {"preset": "jafferis2016", "params": {**DRIVE, **body}}
    return flapwing.Vehicle(design, wings, about=["0 mm", "0 mm", "-3 mm"], total_mass="69 mg")


def eigenvalues() -> Axes:
    """Eigenvalues about hover, with wings that respond to the motion of the body and with prescribed wing motion."""
    models = {response: hovering().linear(trim=True, body_response=response) for response in ("passive", "frozen")}
    return plot.eigenvalues(models)


def hover_growth() -> Axes:
    """The map of docs/how-to/hover.md: growth rates of hover over the height of the wings and the hinge."""
    robot = hovering()
    axes = {
        "hinge_stiffness": {"from": 1.3e-6, "to": 1.7e-6, "n": 5},
        "about_z": {"from": "-6 mm", "to": "-1 mm", "step": "0.5 mm"},
    }
    rows = flapwing.sweep({**robot, "vehicle": {**robot["vehicle"], "trim": "hover"}, "axes": axes})
    return plot.heatmap(rows, "hover_growth_1_s", x="about_z", y="hinge_stiffness")


def flights() -> dict[str, flapwing.Table]:
    """Flights with a linear-quadratic regulator, of the coupled motion and of the linear model."""
    import control

    robot = hovering()
    model = robot.linear(trim=True)
    states, inputs = [0.1, 0.1, 0.1, 5.0, 5.0, 5.0, 0.1, 0.1, 0.5], [10.0, 2.0, 10.0, 10.0]
    gains, _, _ = control.lqr(model.A, model.B, np.diag(np.power(states, -2.0)), np.diag(np.power(inputs, -2.0)))
    disturbance = {"velocity_forward": "0.1 m/s", "rate_pitch": "2 rad/s"}
    options: dict[str, Any] = {"disturbance": disturbance, "gains": gains, "inputs": model.inputs}
    return {
        "coupled": flapwing.fly(robot, seconds=1, **options),
        "averaged": flapwing.fly(robot, seconds=1, averaged=True, **options),
    }


def main() -> None:
    """Writes all pictures to a folder."""
    parser = argparse.ArgumentParser(description="Makes the pictures of some pages in docs/how-to.")
    parser.add_argument("folder", nargs="?", type=Path, default=REPOSITORY / "docs" / "pictures")
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)

    large = flapwing.sweep(REPOSITORY / "examples" / "ozaki_large.toml")
    builds = flapwing.sweep(REPOSITORY / "examples" / "jafferis_tolerance.toml")
    pictures = {
        "response": response(),
        "measures": measures(),
        "heatmap": heatmap(large),
        "best": best(large),
        "points": points(),
        "column": column(large),
        "gaps": gaps(),
        "pareto": pareto(large),
        "scatter": scatter(builds),
        "histogram": histogram(builds),
        "correlations": correlations(builds),
        "trajectory": trajectory(),
        "designs": designs(),
        "devices": devices(),
        "hysteresis": hysteresis(),
        "tornado": tornado(),
        "fit": fit(),
        "control-matrix": control_matrix(),
        "force-panels": force_panels(),
        "hover-growth": hover_growth(),
    }
    for name, picture in pictures.items():
        figure = picture.get_figure(root=True)
        assert figure is not None
        save(figure, folder / f"py-{name}.png", name not in MAPS)
    path = folder / "py-wing-path.gif"
    wing_path().save(path, dpi=56)
    share_colours(path)
    plt.close("all")
    last = eigenvalues().get_figure(root=True)
    assert last is not None
    save(last, folder / "py-eigenvalues.png", True)
    flown = flights()
    save(plot.flight(flown), folder / "py-flight.png", True)
    path = folder / "py-flight.gif"
    wing = flapwing.trajectory("jafferis2016", **DRIVE)
    plot.flight_film(flown["coupled"][:36], wing, frames=36).save(path, dpi=50)
    share_colours(path)
    plt.close("all")


def save(figure: Figure, path: Path, few: bool) -> None:
    """A PNG, small if it has few colours, which are enough for lines."""
    from PIL import Image

    figure.savefig(path, dpi=90)
    plt.close(figure)
    with Image.open(path) as image:
        drawn = image.convert("RGB")
    if few:
        drawn = drawn.quantize(256, dither=Image.Dither.NONE)
    drawn.save(path, optimize=True)


def share_colours(path: Path) -> None:
    """A GIF in which all frames have the colours of the first: a third of the size."""
    from PIL import Image, ImageSequence

    with Image.open(path) as animation:
        duration = animation.info["duration"]
        frames = [frame.convert("RGB") for frame in ImageSequence.Iterator(animation)]
    colours = frames[0].quantize(64, dither=Image.Dither.NONE)
    first, *others = [frame.quantize(palette=colours, dither=Image.Dither.NONE) for frame in frames]
    first.save(path, save_all=True, append_images=others, duration=duration, loop=0)


if __name__ == "__main__":
    main()
