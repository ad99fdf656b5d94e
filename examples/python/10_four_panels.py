"""Four pictures in one figure for a paper. The figure is 7 inches wide, and its text has a size of 7 points:

    pip install "./crates/flap-py[plot]"
    python examples/python/10_four_panels.py              # writes docs/pictures/py-four-panels.png
    python examples/python/10_four_panels.py figure.pdf   # any format of matplotlib

The script creates the axes, and the functions of `flapwing.plot` draw in these axes. The settings of the script
determine the sizes of letters and lines.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")  # files, no windows

import flapwing
import matplotlib.pyplot as plt
from flapwing import plot
from matplotlib.figure import Figure

REPOSITORY = Path(__file__).parents[2]


def use_style_of_paper() -> None:
    """Set small letters and thin lines for all pictures."""
    plt.rc("font", size=7.0)
    plt.rc("axes", linewidth=0.6)
    plt.rc("lines", linewidth=1.0, markersize=4.0)
    plt.rc("legend", framealpha=0.85, edgecolor="none", fontsize=6.5, title_fontsize=6.5)


def four_panels() -> Figure:
    """Return a figure of 7 by 5 inches with a response, a map, a Pareto front and a hysteresis loop."""
    large = flapwing.sweep(REPOSITORY / "examples" / "ozaki_large.toml")
    loop = flapwing.respond(
        "jafferis2016",
        start="115 Hz",
        stop="135 Hz",
        step="1 Hz",
        unstable=True,
        hinge_stiffness="0.7486 uN*m/rad",
        drive_voltage_pp="160 V",
    )

    figure, ((a, b), (c, d)) = plt.subplots(2, 2, figsize=(7.0, 5.0), layout="constrained")
    plot.response(large[large["drive_voltage_pp"] % 20 == 0], "lift_mean_mn", hinge_stiffness=9e-5, ax=a)
    a.set_ylim(0.0, 8.0)  # room for the legend above the curves
    plot.heatmap(large, "efficiency_gf_per_w", drive_voltage_pp=100, ax=b)
    plot.pareto(large, maximize="lift_mean_mn", minimize="power_mean_mw", color="drive_frequency", ax=c)
    plot.hysteresis(loop, ax=d)
    for letter, ax in zip("abcd", (a, b, c, d)):
        ax.set_title(letter, loc="left", fontweight="bold", fontsize=8.0)
    return figure


def main() -> None:
    """Write the figure to a file."""
    parser = argparse.ArgumentParser(description="Makes a figure of four panels.")
    parser.add_argument("file", nargs="?", type=Path, default=REPOSITORY / "docs" / "pictures" / "py-four-panels.png")
    file = parser.parse_args().file
    with plt.rc_context():
        use_style_of_paper()
        figure = four_panels()
        figure.savefig(file, dpi=150)
    if file.suffix == ".png":
        reduce(file)


def reduce(path: Path) -> None:
    """Reduce the number of colours of a PNG file, so that the file becomes smaller."""
    from PIL import Image

    with Image.open(path) as image:
        few = image.convert("RGB").quantize(256, dither=Image.Dither.NONE)
    few.save(path, optimize=True)


if __name__ == "__main__":
    main()
