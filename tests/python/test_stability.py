"""Damping matrices and hover in the rows of a sweep, and eigenvalues of hover from these rows."""

import flapwing
import numpy as np
import pytest

GRID = """
preset = "jafferis2016"
[params]
drive_voltage_pp = 140.0
drive_frequency = 120.0
[axes]
hinge_stiffness = [1.4e-6, 1.6e-6]
[vehicle]
DAMPING
about = ["0 mm", "0 mm", "-3 mm"]
[[vehicle.wings]]
name = "left"
position = ["0 mm", "2 mm", "0 mm"]
[[vehicle.wings]]
name = "right"
position = ["0 mm", "2 mm", "0 mm"]
mirrored = true
"""


def test_rows_with_damping_have_the_eigenvalues_of_the_linear_model():
    rows = flapwing.sweep(GRID.replace("DAMPING", "damping = true"), rtol=1e-8)
    inertia = [1.5e-9, 1.4e-9, 0.5e-9]
    found = flapwing.hover_eigenvalues(rows, 69e-6, inertia, body_inertia_product=1e-10)
    assert found.shape == (2, 8)
    place = ["0 mm", "2 mm", "0 mm"]
    wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    names = ["body_inertia_roll", "body_inertia_pitch", "body_inertia_yaw"]
    params = {"drive_voltage_pp": 140.0, "drive_frequency": 120.0, **dict(zip(names, inertia, strict=True))}
    design = {"preset": "jafferis2016", "params": {**params, "body_inertia_product": 1e-10}}
    vehicle = flapwing.Vehicle(design, wings, about=["0 mm", "0 mm", "-3 mm"], total_mass="69 mg")
    for row, stiffness in enumerate([1.4e-6, 1.6e-6]):
        model = vehicle.linear(hinge_stiffness=stiffness, rtol=1e-8)
        yaw = rows["d_torque_yaw_unm_per_si_body_rate_yaw"][row] * 1e-6
        assert yaw == pytest.approx(model.damping[5, 5], rel=1e-6)
        expected = np.sort_complex(model.eigenvalues[np.abs(model.eigenvalues) > 1e-6])
        own = np.sort_complex(found[row][np.abs(found[row]) > 1e-6])
        np.testing.assert_allclose(own, expected, rtol=1e-4)
        assert (np.diff(found[row].real) <= 0).all()


def test_mistakes_of_damping_and_eigenvalues_have_help():
    with pytest.raises(flapwing.GridError, match="`damping` must be true or false"):
        flapwing.Grid(GRID.replace("DAMPING", 'damping = "yes"'))
    with pytest.raises(ValueError, match="set damping = true"):
        flapwing.hover_eigenvalues({"lift_mean_mn": np.ones(2)}, 69e-6, [1e-9, 1e-9, 1e-9])
    parts = [f"force_{way}_mn" for way in ("forward", "left", "up")]
    parts += [f"torque_{way}_unm" for way in ("roll", "pitch", "yaw")]
    motions = [f"velocity_{way}" for way in ("forward", "left", "up")] + ["rate_roll", "rate_pitch", "rate_yaw"]
    rows = {f"d_{of}_per_si_body_{by}": np.zeros(2) for of in parts for by in motions}
    assert flapwing.hover_eigenvalues(rows, 69e-6, [1e-9, 1e-9, 1e-9]).shape == (2, 8)
    for mass, inertia, message in [
        (69e-6, [1e-9, 1e-9], "`body_inertia` must be a list of the three moments"),
        (69e-6, {"roll": 1e-9, "pitch": 1e-9, "yaw": 1e-9}, "`body_inertia` must be a list of the three moments"),
        ("69 mg", [1e-9, 1e-9, 1e-9], "`total_mass` must be a finite number in SI units"),
        (69e-6, [[1e-9] * 3, 1e-9, 1e-9], "`body_inertia` must be .* for each of the 2 rows"),
        (np.nan, [1e-9, 1e-9, 1e-9], "`total_mass` must be a finite number in SI units"),
        (-1.0, [1e-9, 1e-9, 1e-9], "not positive definite"),
        (69e-6, [1e-9, np.inf, 1e-9], "`body_inertia` must be a finite number"),
        (69e-6, [1e-9, -1e-9, 1e-9], "not positive definite"),
    ]:
        with pytest.raises(ValueError, match=message):
            flapwing.hover_eigenvalues(rows, mass, inertia)
    for gravity in (np.nan, "9.81 m/s^2", [9.81] * 3):
        with pytest.raises(ValueError, match="`gravity` must be a finite number in SI units"):
            flapwing.hover_eigenvalues(rows, 69e-6, [1e-9, 1e-9, 1e-9], gravity=gravity)
    name = "d_force_up_mn_per_si_body_rate_yaw"
    with pytest.raises(TypeError, match=rf"`rows\['{name}'\]` is list\nit must be numbers"):
        flapwing.hover_eigenvalues({**rows, name: ["a", "b"]}, 69e-6, [1e-9, 1e-9, 1e-9])
    with pytest.raises(ValueError, match="columns of the damping matrix have 2 to 3 rows\ngive each"):
        flapwing.hover_eigenvalues({**rows, name: np.zeros(3)}, 69e-6, [1e-9, 1e-9, 1e-9])
    with pytest.raises(TypeError, match="`rows` is int"):
        flapwing.hover_eigenvalues(3, 69e-6, [1e-9, 1e-9, 1e-9])


def test_rows_at_hover_have_the_numbers_of_the_linear_model():
    place = ["0 mm", "2 mm", "0 mm"]
    wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    body = {"body_inertia_roll": 1.5e-9, "body_inertia_pitch": 1.5e-9, "body_inertia_yaw": 0.5e-9}
    design = {"preset": "jafferis2016", "params": {"drive_voltage_pp": 140.0, "drive_frequency": 120.0, **body}}
    about = ["0 mm", "0 mm", "-3 mm"]
    given = flapwing.Vehicle(design, wings, about=about, total_mass="69 mg")
    hovering = flapwing.Vehicle(design, wings, about=about, total_mass="69 mg", trim="hover", damping=True)
    row, model = flapwing.run(hovering), given.linear(trim=True)
    growing = model.eigenvalues[0]
    assert row["hover_growth_1_s"] == pytest.approx(growing.real, rel=1e-9)
    assert row["hover_period_s"] == pytest.approx(2 * np.pi / abs(growing.imag), rel=1e-9)
    assert row["d_torque_yaw_unm_per_si_body_rate_yaw"] * 1e-6 == pytest.approx(model.damping[5, 5], rel=1e-9)
    for name, value in zip(model.inputs, model.input_values, strict=True):
        assert row[f"hover_{name}_v"] == pytest.approx(value, rel=1e-9, abs=1e-12)
    # The vehicle at hover begins its linear model and its flight at hover.
    assert abs(hovering.linear().residual[2]) < 1e-5 * 69e-6 * 9.81 < abs(given.linear().residual[2])
    with pytest.raises(ValueError, match="remove trim and damping from the vehicle"):
        flapwing.evaluate(hovering, {"drive_frequency": [120.0]}, return_states=True)
    # Derivatives contain the change of the inputs.
    stiffness = 1.5e-6 * np.array([0.995, 1.0, 1.005])
    table = flapwing.evaluate(hovering, {"hinge_stiffness": stiffness}, gradient=["hinge_stiffness"], rtol=1e-9)
    for measure in ("hover_amplitude_v", "power_mean_mw"):
        slope = (table[measure][2] - table[measure][0]) / (stiffness[2] - stiffness[0])
        assert table[f"d_{measure}_per_si_hinge_stiffness"][1] == pytest.approx(slope, rel=2e-4)
    # Damping cannot be negative, so its derivative at zero is one-sided.
    damping = np.array([0.0, 1e-10])
    table = flapwing.evaluate(hovering, {"stroke_damping": damping}, gradient=["stroke_damping"], rtol=1e-9)
    for measure in ("hover_amplitude_v", "power_mean_mw"):
        slope = (table[measure][1] - table[measure][0]) / damping[1]
        assert table[f"d_{measure}_per_si_stroke_damping"][0] == pytest.approx(slope, rel=2e-3)
    best = flapwing.sweep({**hovering, "axes": {"about_z": ["-1 mm", "-3 mm", "-5 mm"]}})
    assert np.argmin(best["hover_growth_1_s"]) == 1


def test_mistakes_of_trims_have_help():
    grid = GRID.replace("DAMPING", 'trim = "hover"')
    with pytest.raises(flapwing.GridError, match="rows at hover require total_mass"):
        flapwing.Grid(grid)
    with pytest.raises(flapwing.GridError, match="`trim` has no option `hovr`"):
        flapwing.Grid(grid.replace("hover", "hovr"))
    derived = '[derived]\ndrive_voltage_pp = "1e8 * hinge_stiffness"\n'
    massive = grid.replace("drive_voltage_pp = 140.0\n", "").replace("trim =", 'total_mass = "69 mg"\ntrim =')
    with pytest.raises(flapwing.GridError, match="changes drive_voltage_pp, which is derived"):
        flapwing.Grid(massive + derived)
