"""Makes the pictures docs/pictures/learn-NAME.png of the pages in docs/start and docs/learn. Without a NAME, the script
makes all pictures.

    python examples/learn/make_pictures.py [NAME]...

Each picture is drawn by the commands on the picture's page. The script then reduces the picture to a width of 1040
pixels and to at most 256 colours. The script requires the command `flap` on the PATH, and the package flapwing with the
extras `plot` and `fit`.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import flapwing
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from flapwing import plot
from PIL import Image

matplotlib.use("Agg")  # files, no windows

HERE = Path(__file__).parent
PICTURES = HERE.parents[1] / "docs/pictures"
FIRST = """\
preset = "ozaki2018-large"
[axes]
drive_voltage_pp = ["60 V", "80 V", "100 V"]
drive_frequency = { from = "90 Hz", to = "130 Hz", step = "1 Hz" }
"""

# The commands behind each picture; the last one writes picture.png.
COMMANDS = {
    "first": ["flap sweep first.toml", "flap plot first.csv --y lift_mean_mn --out picture.png"],
    "motion": ["flap run robot.toml --trajectory motion.csv", "flap plot motion.csv --out picture.png"],
    "response": ["flap sweep response.toml", "flap plot response.csv --y vehicle_lift_mgf --out picture.png"],
    "hysteresis": [
        "flap respond robot.toml --set 'hinge_stiffness=0.3 uN*m/rad' --set 'drive_voltage_pp=240 V'"
        " --from '85 Hz' --to '105 Hz' --step '1 Hz' --unstable --out loop.csv",
        "flap plot loop.csv --out picture.png",
    ],
    "builds": [
        "flap sweep builds.toml",
        "flap plot builds.csv --kind histogram --x vehicle_lift_mgf --out picture.png",
    ],
    "vehicle": [
        "flap vehicle vehicle.toml --point 3 --inputs amplitude,amplitude_difference,bias --format csv > matrix.csv",
        "flap plot matrix.csv --out picture.png",
    ],
    "map": [
        "flap sweep map.toml",
        "flap plot map.csv --kind map --x hinge_stiffness --y drive_frequency --color vehicle_lift_mgf"
        " --where 'drive_voltage_pp=140 V' --out picture.png",
    ],
}

# Pictures whose file is too large with 256 colours.
COLOURS = {"fit": 64, "motion": 96}


def wing(picture: Path) -> None:
    """Draw the outline of the wing, with the axis of the hinge."""
    span, leading, trailing = np.loadtxt(HERE / "outline.csv", delimiter=",", skiprows=1).T
    figure, ax = plt.subplots(figsize=(6.5, 2.6), dpi=160, layout="constrained")
    ax.fill(np.concatenate([span, span[::-1]]), np.concatenate([leading, -trailing[::-1]]), fc="#d5e3f0", ec="#1f5582")
    ax.axhline(0.0, color="black", linewidth=1, linestyle="--")
    ax.annotate("hinge axis", (15.2, 0.15))
    ax.annotate("leading edge", (6.0, 0.75))
    ax.annotate("trailing edge", (6.0, -4.8))
    ax.set(xlabel="distance from the root (mm)", ylabel="mm", aspect="equal", xlim=(-0.5, 18), ylim=(-5.2, 1.6))
    figure.savefig(picture)


def fit(picture: Path) -> None:
    """Draw the readings and the fitted model."""
    free = ["hinge_stiffness", "rotation_pressure_width", "drag_coefficient_max"]
    found = flapwing.fit("robot.toml", "measured.csv", free, sigma="1 deg", starts=2)
    plot.fit(found, "data").savefig(picture, dpi=160)


def make(name: str) -> None:
    path = Path("picture.png")
    path.unlink(missing_ok=True)
    if name in COMMANDS:
        Path("first.toml").write_text(FIRST, encoding="utf-8")
        subprocess.run("\n".join(COMMANDS[name]), shell=True, check=True)
    else:
        {"wing": wing, "fit": fit}[name](path)
    drawn = Image.open(path).convert("RGB")
    drawn = drawn.resize((1040, round(1040 * drawn.height / drawn.width)), Image.Resampling.LANCZOS)
    target = PICTURES / f"learn-{name}.png"
    drawn.quantize(COLOURS.get(name, 256), dither=Image.Dither.NONE).save(target, optimize=True)
    print(target.name, target.stat().st_size)


if __name__ == "__main__":
    names = sys.argv[1:] or [*COMMANDS, "wing", "fit"]
    with tempfile.TemporaryDirectory() as folder:
        for file in [*HERE.glob("*.toml"), *HERE.glob("*.csv")]:
            shutil.copy(file, folder)
        os.chdir(folder)
        for name in names:
            make(name)
        os.chdir(HERE)
