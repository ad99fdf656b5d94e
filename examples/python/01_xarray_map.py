"""A map of the largest lift and of the frequency of the largest lift, over hinge stiffness and voltage.

The script sweeps a wing of Ozaki et al. over hinge stiffness, voltage and frequency, and converts the result to
labelled arrays. The script then selects designs by value, finds the best frequency of each design, interpolates between
designs, and prints a map.

    python 01_xarray_map.py
    python 01_xarray_map.py --size full --save map.nc --picture map.png

The script requires xarray and SciPy, and `--picture` requires matplotlib: pip install xarray scipy matplotlib

S. Hoyer and J. Hamman, "xarray: N-D labeled arrays and datasets in Python", J. Open Res. Softw. 5 (2017) 10.
"""

import argparse
from typing import Any

import flapwing
import numpy as np
import xarray

# Values of hinge stiffness and voltage, and the step of the frequency (Hz).
STEPS: dict[str, dict[str, Any]] = {
    "small": {"hinge": 5, "voltage": 4, "hz": 2.0},
    "full": {"hinge": 21, "voltage": 11, "hz": 0.5},
}


def grid(hinge: int, voltage: int, hz: float) -> dict[str, Any]:
    """Return a grid as a dictionary with the contents of a grid file."""
    return {
        "preset": "ozaki2018-large",
        "axes": {
            "hinge_stiffness": {"from": "20 uN*m/rad", "to": "100 uN*m/rad", "n": hinge},
            "drive_voltage_pp": {"from": "40 V", "to": "100 V", "n": voltage},
            "drive_frequency": {"from": "90 Hz", "to": "130 Hz", "step": f"{hz} Hz"},
        },
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--size", choices=list(STEPS), default="small")
    parser.add_argument("--save", metavar="FILE", help="write the map as netCDF")
    parser.add_argument("--picture", metavar="FILE", help="draw the map")
    arguments = parser.parse_args()

    table = flapwing.sweep(grid(**STEPS[arguments.size]))
    data = table.to_xarray()
    print(f"{len(table)} points ({', '.join(f'{count} {status}' for status, count in table.counts.items())})")
    print(f"dimensions: {dict(data.sizes)}")

    # A motion that is not periodic has no lift: nan, which the largest of the others passes over.
    lift = data["lift_mean_mn"]
    best = lift.max("drive_frequency")
    best_frequency = lift.idxmax("drive_frequency").assign_attrs(data["drive_frequency"].attrs)

    # A best frequency at an end of the axis is not a peak.
    ends = data["drive_frequency"].isel(drive_frequency=[0, -1]).values
    cut = int(np.isin(best_frequency, ends).sum())
    if cut:
        print(f"{cut} designs lift most at an end of the range: make it wider")

    # Everything else at each design's best frequency.
    at_best = data[["power_mean_mw", "stroke_amplitude_deg"]].sel(drive_frequency=best_frequency)
    atlas = at_best.assign(lift_mean_mn=best, best_frequency_hz=best_frequency).drop_vars("drive_frequency")

    print("\nmost lift (mN) at the best frequency (Hz), over hinge stiffness (uN*m/rad, down) and voltage (V, right)")
    print(" " * 8 + "".join(f"{volts:>16.0f}" for volts in atlas["drive_voltage_pp"].values[:: step(atlas, 1)]))
    for hinge in atlas["hinge_stiffness"].values[:: step(atlas, 0)]:
        row = atlas.sel(hinge_stiffness=hinge).isel(drive_voltage_pp=slice(None, None, step(atlas, 1)))
        cells = zip(row["lift_mean_mn"].values, row["best_frequency_hz"].values)
        print(f"{hinge * 1e6:8.1f}" + "".join(f"{most:9.3f} ({at:4.0f})" for most, at in cells))

    # The place of the largest lift of all, with all its coordinates.
    top = lift.isel(lift.argmax(...))
    print(
        f"\nmost lift of all: {float(top):.3f} {lift.attrs['units']} "
        f"at {float(top['hinge_stiffness']) * 1e6:.1f} uN*m/rad, "
        f"{float(top['drive_voltage_pp']):g} V, {float(top['drive_frequency']):g} Hz"
    )

    # Between designs: linear interpolation, beside a simulation of that very point.
    wanted = {"hinge_stiffness": 93e-6, "drive_voltage_pp": 75.0, "drive_frequency": 107.0}
    guessed = float(lift.interp(wanted))
    simulated = flapwing.evaluate("ozaki2018-large", wanted)["lift_mean_mn"][0]
    print(
        f"at 93 uN*m/rad, 75 V and 107 Hz: interpolated {guessed:.3f} mN, simulated {simulated:.3f} mN "
        f"({guessed / simulated - 1:+.1%})"
    )

    if arguments.save:
        atlas.to_netcdf(arguments.save, engine="scipy")
        print(f"wrote {arguments.save}")
    if arguments.picture:
        draw(atlas, arguments.picture)
        print(f"drew {arguments.picture}")


def step(atlas: xarray.Dataset, dimension: int) -> int:
    """Return the step for printing the values along an axis of the map, so that at most eight values of the axis are
    printed."""
    return -(-list(atlas["lift_mean_mn"].shape)[dimension] // 8)


def draw(atlas: xarray.Dataset, path: str) -> None:
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise SystemExit("--picture needs matplotlib: pip install matplotlib") from None

    figure = Figure(figsize=(9, 4), layout="constrained")
    named = {"lift_mean_mn": "most mean lift (mN)", "best_frequency_hz": "drive frequency of most lift (Hz)"}
    micro = atlas.assign_coords(hinge_stiffness=atlas["hinge_stiffness"] * 1e6)
    for axes, (name, label) in zip(figure.subplots(1, 2), named.items()):
        micro[name].plot.pcolormesh(ax=axes, x="drive_voltage_pp", y="hinge_stiffness", cbar_kwargs={"label": label})
        axes.set_xlabel("drive voltage, peak to peak (V)")
        axes.set_ylabel("hinge stiffness (uN*m/rad)")
    figure.savefig(path, dpi=150)


if __name__ == "__main__":
    main()
