"""A fit of hinge, wing inertia and drag to a stroke that was measured over frequency.

Fits parameters of the bimorph of Jafferis et al. to a frequency response by nonlinear least squares, and says how
well the data determine them. The data are a table in CSV with the column `frequency_hz` and one or more columns named
as flapwing names measures: `stroke_pp_deg`, `pitch_amplitude_deg` (`flapwing.measures("jafferis2016")` lists them).
All columns count alike, so they should have about the same error of measurement.

    python fit_bimorph.py measured.csv --voltage 160
    python fit_bimorph.py --write-data synthetic.csv     without data: makes some with noise, and finds the true values

Parameters are fitted as logarithms of their ratios to the preset: they stay positive, and errors are relative. A step
of the fit needs the response and its derivatives with respect to every parameter; all of these points go through one
call of `flapwing.evaluate`: the frequencies are the axis of a grid, and each set of parameters is a row of columns.

A response does not determine all parameters: if the force, both stiffnesses, both inertias and the drag on the stroke
all grow by the same factor, the motion stays the same. One of them has to be known, here the force and the
stiffnesses. Inertia and stiffness together mostly determine the resonance, so a fit of the transmission's stiffness as
well makes the error of the inertia more than three times as large. Drag and hinge remain strongly correlated: both
turn the wing. The script prints the condition number of the Jacobian, with its columns scaled to length 1, and the
correlations. Above some 30, fit fewer parameters or measure the pitch as well.

Needs scipy: pip install scipy

M. A. Branch, T. F. Coleman and Y. Li, "A subspace, interior, and conjugate gradient method for large-scale
bound-constrained minimization problems", SIAM J. Sci. Comput. 21 (1999) 1-23, as `scipy.optimize.least_squares`.
G. A. F. Seber and C. J. Wild, "Nonlinear Regression" (Wiley 1989), section 5.1, for the confidence intervals.
"""

import argparse
from typing import Any

import flapwing
import numpy as np
from scipy.optimize import least_squares
from scipy.stats import t as students_t

PRESET = "jafferis2016"
FITTED = ["hinge_stiffness", "wing_inertia_stroke", "drag_coefficient_max"]
# Ratios to the preset within which values are looked for.
LOWEST, HIGHEST = 0.5, 2.0
# Relative step of the differences, and a tolerance at which the integration's error divided by the step is small.
STEP = 1e-3
RTOL = 1e-8

Array = np.ndarray[Any, np.dtype[np.float64]]

# Synthetic data: true ratios to the preset, and the standard deviation of the noise of a reading.
TRUE_RATIOS = [1.15, 0.93, 0.90]
NOISE_DEG = 1.0
READINGS = {"small": 21, "full": 81}


class Response:
    """Measured columns as a function of the logarithms of the parameters' ratios to the preset."""

    def __init__(self, names: list[str], frequency: Array, measured: dict[str, Array], voltage: float) -> None:
        self.names = names
        self.nominal = np.array([flapwing.params(PRESET)[name].value for name in names], dtype=float)
        self.measured = measured
        # Every set of parameters is run at all operating points.
        self.grid = flapwing.Grid(
            {"preset": PRESET, "params": {"drive_voltage_pp": voltage}, "axes": {"drive_frequency": frequency}}
        )

    def model(self, logs: Array) -> Array:
        """The response of the model, for many parameter sets at once: rows of `logs` in, rows of readings out.

        Readings are nan where the motion is not periodic.
        """
        sets = dict(zip(self.names, (np.exp(logs) * self.nominal).T))
        table = flapwing.evaluate(self.grid, sets, measures=list(self.measured), rtol=RTOL)
        columns = [table[name].reshape(len(logs), len(self.grid)) for name in self.measured]
        return np.concatenate(columns, axis=1)

    def residuals(self, logs: Array) -> Array:
        """Model less measurement (deg).

        A trial step of the fit may come where a motion is not periodic. The residual there is that of a wing at rest:
        so large that the step is refused. `jacobian` and the result do not accept such points.
        """
        model = self.model(logs[np.newaxis])[0]
        difference: Array = np.nan_to_num(model, nan=0.0) - np.concatenate(list(self.measured.values()))
        return difference

    def jacobian(self, logs: Array) -> Array:
        """Derivatives of the residuals by central differences, all columns in one batch."""
        steps = STEP * np.eye(len(logs))
        model = self.model(np.concatenate([logs + steps, logs - steps]))
        if np.isnan(model).any():
            raise SystemExit(f"No periodic motion near {self.named(logs)}: leave out some frequencies.")
        above, below = np.split(model, 2)
        return (above - below).T / (2 * STEP)

    def named(self, logs: Array) -> str:
        values = np.exp(logs) * self.nominal
        return ", ".join(f"{name} = {value:.4g}" for name, value in zip(self.names, values))


def read(path: str) -> tuple[Array, dict[str, Array]]:
    """Frequencies, and the other columns by name."""
    data = np.genfromtxt(path, delimiter=",", names=True)
    names = data.dtype.names or ()
    if "frequency_hz" not in names:
        raise SystemExit(f"{path} has no column `frequency_hz`")
    measured = {name: np.atleast_1d(data[name]) for name in names if name != "frequency_hz"}
    known = flapwing.measures(PRESET)
    for name, values in measured.items():
        if name not in known:
            raise SystemExit(f"{path}: `{name}` is not among the measures {', '.join(known)}")
        if not np.isfinite(values).all():
            raise SystemExit(f"{path}: `{name}` has cells without a number")
    if not measured:
        raise SystemExit(f"{path} has frequencies, but no column of a measure such as `stroke_pp_deg`")
    return np.atleast_1d(data["frequency_hz"]), measured


def synthetic(names: list[str], readings: int, voltage: float, seed: int) -> tuple[Array, dict[str, Array], Array]:
    """Frequencies, a noisy response of the model with other parameters than the preset's, and the noise."""
    frequency = np.linspace(70.0, 150.0, readings)
    response = Response(names, frequency, {"stroke_pp_deg": frequency}, voltage)
    exact = response.model(np.log(TRUE_RATIOS)[np.newaxis])[0]
    noise = np.random.default_rng(seed).normal(0.0, NOISE_DEG, readings)
    return frequency, {"stroke_pp_deg": exact + noise}, noise


def fit(response: Response) -> tuple[Any, Array, int]:
    """The fit, and the covariance of the logarithms of the ratios as the scatter of the data implies it."""
    start = np.zeros(len(response.names))
    bounds = (np.log(LOWEST), np.log(HIGHEST))
    found = least_squares(response.residuals, start, response.jacobian, bounds, x_scale="jac", xtol=1e-6, ftol=1e-8)
    freedom = len(found.fun) - len(found.x)
    variance = found.fun @ found.fun / freedom
    return found, variance * np.linalg.inv(found.jac.T @ found.jac), freedom


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("data", nargs="?", metavar="CSV", help="measured response; without it, synthetic data are made")
    parser.add_argument("--size", choices=list(READINGS), default="small", help="of synthetic data")
    parser.add_argument("--voltage", type=float, default=160.0, help="drive voltage, peak to peak (V)")
    parser.add_argument("--seed", type=int, default=1, help="of the synthetic data's noise")
    parser.add_argument("--write-data", metavar="CSV", help="write the synthetic data")
    arguments = parser.parse_args()

    if arguments.data:
        frequency, measured = read(arguments.data)
    else:
        frequency, measured, noise = synthetic(FITTED, READINGS[arguments.size], arguments.voltage, arguments.seed)
        rms = np.sqrt(np.mean(noise**2))
        print(
            f"synthetic data: {len(frequency)} readings with noise of {rms:.3f} deg rms, drawn with a standard", end=" "
        )
        print(f"deviation of {NOISE_DEG:g} deg")
        if arguments.write_data:
            rows = np.column_stack([frequency, *measured.values()])
            header = ",".join(["frequency_hz", *measured])
            np.savetxt(arguments.write_data, rows, delimiter=",", header=header, comments="", fmt="%.6g")
            print(f"wrote {arguments.write_data}")
    if len(frequency) * len(measured) <= len(FITTED):
        raise SystemExit(f"{len(FITTED)} parameters need more than {len(FITTED)} readings")

    response = Response(FITTED, frequency, measured, arguments.voltage)
    found, covariance, freedom = fit(response)
    if not found.success:
        raise SystemExit(f"The fit has not converged: {found.message}")
    if np.isnan(response.model(found.x[np.newaxis])).any():
        raise SystemExit(f"Not every motion is periodic at the best fit, {response.named(found.x)}.")

    error = np.sqrt(np.diag(covariance))
    quantile = students_t.ppf(0.975, freedom)
    rms, deviation = np.sqrt(np.mean(found.fun**2)), np.sqrt(found.fun @ found.fun / freedom)
    print(f"{found.nfev} steps; residuals: {rms:.3f} deg rms, {np.abs(found.fun).max():.3f} deg at most")
    print(f"standard deviation of a reading, with {freedom} degrees of freedom: {deviation:.3f} deg\n")
    print(f"{'parameter':20} {'unit':8} {'value':>11} {'95 % from':>11} {'to':>11} {'error, %':>9}", end="")
    print("" if arguments.data else f" {'true':>11} {'off by':>11}")
    for place, name in enumerate(FITTED):
        nominal = response.nominal[place]
        ends = nominal * np.exp(found.x[place] + quantile * error[place] * np.array([0, -1, 1]))
        unit = flapwing.params(PRESET)[name].unit
        print(f"{name:20} {unit:8} {ends[0]:11.5g} {ends[1]:11.5g} {ends[2]:11.5g} {100 * error[place]:9.2f}", end="")
        if arguments.data:
            print()
        else:
            off = (found.x[place] - np.log(TRUE_RATIOS[place])) / error[place]
            print(f" {nominal * TRUE_RATIOS[place]:11.5g} {off:+5.1f} sigma")
    for name, place in zip(FITTED, found.active_mask):
        if place:
            print(f"`{name}` is at the end of its range: its error is not what is stated.")

    scaled = found.jac / np.linalg.norm(found.jac, axis=0)
    condition = np.linalg.cond(scaled)
    print(f"\ncondition of the Jacobian: {condition:.1f}; correlations:")
    for name, row in zip(FITTED, covariance / np.outer(error, error)):
        print(f"{name:20} " + " ".join(f"{value:6.2f}" for value in row))
    if condition > 30:
        print("The data hardly tell these parameters apart: fit fewer, or measure pitch as well.")


if __name__ == "__main__":
    main()
