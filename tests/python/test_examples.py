"""The examples run as they are, and what they say is so."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import flapwing
import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[2] / "examples/python"


def script(name):
    """The path of an example without the number in front of its name."""
    (path,) = EXAMPLES.glob(f"[0-9][0-9]_{name}.py")
    return path


def run(name, *arguments, code=0):
    """The output of a script. Warnings are errors, those of other libraries and of Dask's workers too."""
    command = [sys.executable, "-W", "error", script(name), *arguments]
    ended = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, timeout=300)
    assert ended.returncode == code, ended.stderr
    return ended.stdout if code == 0 else ended.stderr


def load(name):
    """A script as a module."""
    spec = importlib.util.spec_from_file_location(f"example_{name}", script(name))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def indices(printed):
    """The printed tables: by result and parameter, S1, its error, ST, its error."""
    tables = {}
    for line in printed.splitlines():
        if heading := re.match(r"(\w+): mean", line):
            table = tables[heading[1]] = {}
        elif row := re.match(r"(\w+) +(-?[\d.]+) +([\d.]+) +(-?[\d.]+) +([\d.]+)$", line):
            table[row[1]] = tuple(map(float, row.groups()[1:]))
    return tables


@pytest.fixture(scope="module")
def sobol():
    return indices(run("sobol_indices"))


def test_sobol_indices_are_shares_of_a_variance(sobol):
    names = load("sobol_indices").UNCERTAIN["ozaki2018-large"]
    assert list(sobol) == ["lift_mean_mn", "power_mean_mw"]
    for table in sobol.values():
        assert sorted(table) == sorted(names)
        for first, first_error, total, total_error in table.values():
            assert -first_error <= first <= total + first_error + total_error
            assert 0 <= total <= 1
        assert 0.4 < sum(row[0] for row in table.values()) < 1.05
        assert sum(row[2] for row in table.values()) > 0.95
        # Parameters that detune the wing matter most; the total indices are in order.
        assert next(iter(table)) == "shim_thickness"
        totals = [row[2] for row in table.values()]
        assert totals == sorted(totals, reverse=True)


@pytest.mark.parametrize("name", ["shim_thickness", "piezo_coefficient"])
def test_sobol_first_order_is_that_of_its_definition(sobol, name):
    # Var E(Y | x) / Var Y, by Gauss' rule over the parameter and a Latin hypercube over the others.
    from scipy.stats import qmc

    problem = load("sobol_indices").uncertain_parameters("ozaki2018-large", 0.1)
    lowest, highest = np.array(problem["bounds"]).T
    nodes, weights = np.polynomial.legendre.leggauss(8)
    others = qmc.LatinHypercube(problem["num_vars"], rng=2).random(600)
    points = np.tile(others, (len(nodes), 1))
    place = problem["names"].index(name)
    points[:, place] = np.repeat((nodes + 1) / 2, len(others))
    points = lowest + (highest - lowest) * points
    lift = flapwing.evaluate("ozaki2018-large", dict(zip(problem["names"], points.T)))["lift_mean_mn"]
    lift = lift.reshape(len(nodes), len(others))
    weights = weights / 2
    mean = weights @ lift.mean(axis=1)
    variance = weights @ (lift**2).mean(axis=1) - mean**2
    explained = weights @ lift.mean(axis=1) ** 2 - mean**2
    first, error, _, _ = sobol["lift_mean_mn"][name]
    assert explained / variance == pytest.approx(first, abs=1.5 * error + 0.02)


def test_sobol_leaves_out_whole_blocks(monkeypatch, capsys):
    example = load("sobol_indices")
    periodic = np.ones(32, dtype=bool)
    periodic[[9, 14]] = False
    assert example.rows_of_whole_blocks(periodic, 6).tolist() == [True] * 8 + [False] * 8 + [True] * 16

    monkeypatch.setattr(example, "BASES", {"small": 256})
    monkeypatch.setattr(sys, "argv", ["sobol_indices.py", "--preset", "jafferis2016", "--spread", "25"])
    example.main()
    printed = capsys.readouterr().out
    unsettled = int(re.search(r"(\d+) unsettled", printed)[1])
    left_out = int(re.search(r"(\d+) blocks hold a motion that is not periodic", printed)[1])
    assert 0 < left_out <= unsettled
    assert f"{256 - left_out} of 256 blocks" in printed
    assert all(np.isfinite(row).all() for table in indices(printed).values() for row in table.values())

    monkeypatch.setattr(sys, "argv", ["sobol_indices.py", "--preset", "jafferis2016", "--spread", "40"])
    with pytest.raises(SystemExit, match="smaller --spread"):
        example.main()


def test_pareto_front_is_one(tmp_path):
    from pymoo.indicators.hv import HV
    from scipy.stats import qmc

    example = load("pareto_pymoo")
    out, picture = tmp_path / "front.csv", tmp_path / "front.png"
    run("pareto_pymoo", "--out", out, "--picture", picture)
    assert picture.read_bytes().startswith(b"\x89PNG")
    front = np.genfromtxt(out, delimiter=",", names=True)
    assert len(front) > 50

    # Nothing in it beats anything else in it.
    lift, power = front["lift_mean_mn"], front["power_supply_mw"]
    no_worse = (lift[:, None] >= lift) & (power[:, None] <= power)
    better = (lift[:, None] > lift) | (power[:, None] < power)
    assert not (no_worse & better).any()

    # It keeps to the limits, and is what `run` says of such designs.
    assert (front["strain_surface_max"] <= example.STRAIN).all()
    assert (front["stroke_pp_deg"] <= example.STROKE_DEG).all()
    assert (front["pitch_peak_deg"] <= example.PITCH_DEG).all()
    # The strain is what holds the strongest design back.
    assert front["strain_surface_max"].max() > 0.97 * example.STRAIN
    strongest = front[np.argmax(lift)]
    ratio = strongest["transmission_ratio"] / flapwing.params("jafferis2016")["transmission_ratio"].value
    stiffness = flapwing.params("jafferis2016")["transmission_stiffness"].value * ratio**-0.14
    row = flapwing.run(
        "jafferis2016", transmission_stiffness=stiffness, **{name: strongest[name] for name in example.VARIABLES}
    )
    assert row["lift_mean_mn"] == pytest.approx(strongest["lift_mean_mn"], rel=1e-6)
    assert row["vehicle_lift_mgf"] >= example.VEHICLE_MG

    # The search is worth it: more is dominated than by as many random designs.
    lowest, highest = np.array(list(example.VARIABLES.values())).T
    sample = qmc.scale(qmc.LatinHypercube(len(lowest), rng=3).random(np.prod(example.SIZES["small"])), lowest, highest)
    answer = {}
    example.Wing(example.STRAIN)._evaluate(sample, answer)
    allowed = answer["F"][(answer["G"] <= 0).all(axis=1)]
    dominated = HV(ref_point=np.array([0.0, 45.0]))
    assert dominated(np.column_stack([-lift, power])) > dominated(allowed)


def test_pareto_keeps_out_what_is_not_periodic():
    example = load("pareto_pymoo")
    answer = {}
    points = np.array([[250.0, 120.0, 3333.0, 0.2e-6], [200.0, 120.0, 3333.0, 1.5e-6]])
    example.Wing(example.STRAIN)._evaluate(points, answer)
    assert (answer["G"][0] > 0).all() and answer["G"][1, -1] < 0
    assert np.isfinite(answer["F"]).all() and np.isfinite(answer["G"]).all()


def test_fit_recovers_what_is_true(tmp_path):
    table = r"^(\w+) +{} +([\d.e-]+) +([\d.e-]+) +[\d.]+ +([\d.e-]+) +([\d.e-]+)$"
    truth = r"^(\w+) +[\d.e-]+ +([\d.e-]+)$"

    def intervals(printed):
        rows = re.findall(table.format(r"(?:N\*m/rad|kg\*m\^2)?"), printed, re.MULTILINE)
        return {name: tuple(map(float, cells)) for name, *cells in rows}

    printed = run("fit_bimorph")
    found = intervals(printed)
    true = {name: float(value) for name, value in re.findall(truth, printed, re.MULTILINE)}
    assert list(found) == list(true) == load("fit_bimorph").FITTED
    for name, (value, error, low, high) in found.items():
        assert low < value < high and low < true[name] < high and 0 < error < 0.02 * value

    data = tmp_path / "measured.csv"
    columns, _ = load("fit_bimorph").synthetic(160.0)
    np.savetxt(data, np.column_stack(list(columns.values())), delimiter=",", header=",".join(columns), comments="")
    assert intervals(run("fit_bimorph", data)) == found


def test_map_has_its_maximum_at_the_right_place(tmp_path):
    import xarray

    example = load("xarray_map")
    saved, picture = tmp_path / "map.nc", tmp_path / "map.png"
    printed = run("xarray_map", "--save", saved, "--picture", picture)
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert "at an end of the range" not in printed

    # The same by another way: every point as a batch, without xarray.
    grid = flapwing.Grid(example.grid(**example.STEPS["small"]))
    names = ["hinge_stiffness", "drive_voltage_pp", "drive_frequency"]
    axes = [axis[name] for axis, name in zip(grid.axes, names)]
    points = [column.ravel() for column in np.meshgrid(*axes, indexing="ij")]
    table = flapwing.evaluate("ozaki2018-large", dict(zip(names, points)))
    lift = table["lift_mean_mn"].reshape([len(axis) for axis in axes])
    with xarray.open_dataset(saved, engine="scipy") as atlas:
        assert atlas["lift_mean_mn"].dims == ("hinge_stiffness", "drive_voltage_pp")
        assert atlas["lift_mean_mn"].attrs["units"] == "mN"
        assert (atlas["lift_mean_mn"].values == lift.max(axis=2)).all()
        assert (atlas["best_frequency_hz"].values == np.array(axes[2])[lift.argmax(axis=2)]).all()
    most, hinge, volts, hertz = map(
        float, re.search(r"most lift of all: (\S+) mN at (\S+) uN\*m/rad, (\S+) V, (\S+) Hz", printed).groups()
    )
    top = lift.argmax()
    assert most == pytest.approx(lift.max(), abs=1e-3)
    assert [hinge * 1e-6, volts, hertz] == pytest.approx([column[top] for column in points])
    # The peak between the steps is within one of them.
    fine = np.arange(hertz - 6, hertz + 6.01, 0.25)
    design = {"hinge_stiffness": hinge * 1e-6, "drive_voltage_pp": volts}
    table = flapwing.evaluate("ozaki2018-large", {"drive_frequency": fine}, **design)
    assert abs(fine[table["lift_mean_mn"].argmax()] - hertz) <= 2
    guess, simulated = map(float, re.search(r"interpolated (\S+) mN, simulated (\S+) mN", printed).groups())
    assert guess == pytest.approx(simulated, rel=0.02)


def test_cluster_gives_the_same_bytes(tmp_path):
    example = load("dask_cluster")
    out, local = tmp_path / "cluster.csv", tmp_path / "local.csv"
    printed = run("dask_cluster", "--out", out)
    assert "369 points on 2 workers" in printed
    assert "The same bytes as without the cluster." in printed
    flapwing.sweep(example.grid(example.STEP_HZ["small"]), out=local)
    assert out.read_bytes() == local.read_bytes()


def designs(printed):
    """The printed designs: by search, its number of designs and right-hand sides (millions), measures and parameters."""
    found = {}
    for block in re.split(r"^(?=\S)", printed, flags=re.MULTILINE)[1:]:
        name, count, work = re.match(r"(.+): (\d+) designs, ([\d.]+) million right-hand sides", block).groups()
        cells = {name: float(value) for name, value in re.findall(r"^  (\w+) +(\S+)", block, re.MULTILINE)}
        found[name] = (int(count), float(work), cells)
    return found


def test_derivatives_find_a_better_design_in_less_work(monkeypatch):
    # The path of SLSQP depends on the rounding of the BLAS, whose kernels depend on the processor.
    monkeypatch.setenv("OPENBLAS_CORETYPE", "Haswell")
    example = load("gradient_design")
    found = designs(run("gradient_design", "--starts", 1, "--generations", 40))
    exact, evolved = found["SLSQP with derivatives"], found["differential evolution"]
    assert exact[0] < 0.1 * evolved[0] and exact[1] < evolved[1] / 3
    assert exact[2]["efficiency_gf_per_w"] > evolved[2]["efficiency_gf_per_w"] > 15
    for _, _, cells in found.values():
        # The printed design is within its bounds and limits, and `run` says the same of it.
        design = {name: cells[name] for name in example.VARIABLES}
        for name, (lowest, highest) in example.VARIABLES.items():
            assert lowest * 0.999 < design[name] / example.BASE[name] < highest * 1.001
        for name, limit in example.LIMITS.items():
            assert cells[name] < 1.001 * limit
        assert cells["vehicle_lift_mgf"] > 0.999 * example.LIFT_MGF
        row = flapwing.run(example.PRESET, **design)
        assert row["efficiency_gf_per_w"] == pytest.approx(cells["efficiency_gf_per_w"], rel=0.01)
    preset = flapwing.run(example.PRESET)
    assert exact[2]["efficiency_gf_per_w"] > 1.15 * preset["efficiency_gf_per_w"]


def test_linear_tolerances_part_from_samples_where_measures_bend():
    printed = run("tolerance_linear", "--builds", 512)
    ratios = {}
    for block in printed.split("relative standard deviations for deviations of ")[1:]:
        rows = re.findall(r"^ *(\d+) Hz +(\w+) +[\d.]+% +[\d.]+% +([\d.]+)( +they part)?$", block, re.MULTILINE)
        assert len(rows) == 12
        deviation = float(re.match(r"[\d.]+", block)[0])
        for hertz, _, ratio, parts in rows:
            assert bool(parts) == (abs(float(ratio) - 1) >= 0.1) or float(ratio) in (0.9, 1.1)
            ratios.setdefault((deviation, int(hertz)), []).append(float(ratio))
    for hertz in (95, 105):
        assert all(0.94 < ratio < 1.06 for ratio in ratios[1, hertz])
    assert all(0.85 < ratio < 1.05 for ratio in ratios[5, 95])
    assert all(ratio < 0.85 for ratio in ratios[5, 120])


def test_each_drive_makes_its_torque():
    told = run("vehicle_torques")
    rows = {name.strip(): list(map(float, cells.split())) for name, cells in re.findall(
        r"^(\w[\w ,]*?) {2,}((?:-?\d+\.\d+ *){4})$", told, re.MULTILINE
    )}  # fmt: skip
    assert len(rows) == 7 and all(3 > row[3] > 2 for row in rows.values())
    assert rows["sine"][:3] == [0, 0, 0]
    split = next(name for name in rows if name.startswith("split cycle,") and name.endswith("deg"))
    for torque, (one, other) in enumerate(
        [("more on the left", "more on the right"), ("bias backward", "bias forward"), (split, "split cycle, swapped")]
    ):
        for name, sign in ((one, 1), (other, -1)):
            others = [abs(rows[name][i]) for i in range(3) if i != torque]
            assert sign * rows[name][torque] > 0.3 and max(others) < 0.2 * abs(rows[name][torque]), name


def test_wrench_map_is_near_to_a_quadratic_one(tmp_path):
    out = tmp_path / "map.csv"
    told = run("wrench_map", "--size", "small", "--out", out)
    assert re.match(r"256 combinations of 4 inputs in [\d.]+ s: {'periodic': 256}", told)
    table = {name: list(map(float, cells.split())) for name, cells in re.findall(
        r"^(\w[\w ()]*?) {2,}((?:-?\d+\.\d+ *){4})$", told, re.MULTILINE
    )}  # fmt: skip
    # Each input makes its own: lift, roll, pitch, yaw.
    inputs = load("wrench_map").INPUTS
    matrix = np.array([table[name] for name in inputs])
    assert (np.abs(matrix).argmax(axis=0) == range(4)).all()
    assert (np.array(table["left over (rms)"]) < 0.1 * np.array(table["range"])).all()
    rows = flapwing.read(out)
    assert len(rows) == 256 and list(rows)[1:5] == list(inputs)
