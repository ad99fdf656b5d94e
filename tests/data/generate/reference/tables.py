"""The tables of tests/data: given columns, functions that compute the others, and bounds for differences."""

from __future__ import annotations

import csv
import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from . import bimorph, direct_drive, four_bar, own_equations
from .motion import Results, Row

REPOSITORY = Path(__file__).resolve().parents[4]
DATA = REPOSITORY / "tests/data"

#: The size that a difference is relative to: another column, a number, or the largest magnitude of the column itself.
#: Columns without an entry are relative to the committed number.
Size = str | float
PEAK = "peak"


@dataclass(frozen=True)
class Table:
    """A file below tests/data."""

    path: str
    #: Columns that are given. Every other column is computed.
    inputs: Sequence[str]
    compute: Callable[[Sequence[Row]], Iterable[Results]]
    #: Largest relative difference to the committed numbers, and of some columns.
    bound: float
    bounds: Mapping[str, float] = field(default_factory=dict)
    sizes: Mapping[str, Size] = field(default_factory=dict)
    #: Columns that are compared with zero.
    residuals: Sequence[str] = ()
    #: Columns that compare with other solvers, computed only when the file is written.
    second: Sequence[str] = ()
    again: Callable[[Row, Results], Results] | None = None
    #: Indices of the rows of the quick check.
    quick: Sequence[int] = ()


def each(function: Callable[[Row], Results]) -> Callable[[Sequence[Row]], Iterable[Results]]:
    """Computes rows that do not depend on each other."""
    return lambda rows: map(function, rows)


def motor_wing(rows: Sequence[Row]) -> Iterable[Results]:
    """Runs the script of the motor-driven wing, whose points are in the script."""
    command = [sys.executable, str(REPOSITORY / "examples/own_model/reference.py")]
    out = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()
    found = list(csv.DictReader(out))
    if [[row[name] for name in MOTOR_INPUTS] for row in found] != [
        [row[name] for name in MOTOR_INPUTS] for row in rows
    ]:
        raise ValueError("motor_wing.csv has other points than examples/own_model/reference.py")
    return [{name: float(cell) for name, cell in row.items() if name not in MOTOR_INPUTS} for row in found]


MOTOR_INPUTS = ("voltage", "frequency", "length", "stiffness")
BIMORPH_ORBIT = {
    "x0_m": "x_amp_m",
    "psi0_rad": "psi_max_rad",
    "x_mean_m": "x_amp_m",
    "drag_signed_mean_N": "drag_abs_mean_N",
    "P_hinge_aero_W": "P_hinge_damp_W",
    "P_hinge_Ixz_W": "P_hinge_damp_W",
    "P_hinge_cent_W": "P_hinge_damp_W",
}
DIRECT_ORBIT_INPUTS = ("case", "type", "V0_V", "f_Hz", "k_w_Nm", "x_r_m", "dcp", "sgn")
DIRECT_ORBIT = {"psi_mean_deg": "psi_amp_deg", "addedmass_W": "power_mean_W"}
DIRECT_RESIDUALS = ("energy_residual_rel", "periodicity_residual")
DIRECT_BOUNDS = {"floquet_max": 5e-6, "power_pos_mean_W": 5e-8}
FOUR_LIFT = {name: "lift_trans_N" for name in ("lift_mean_N", "lift_rot_N", "lift_addmass_N")}

TABLES = (
    Table("bimorph/taper_gains.csv", ("w_r", "l_r"), each(bimorph.taper), 1e-15, quick=range(12)),
    Table(
        "bimorph/rhs_vectors.csv",
        (
            *("case", "x_m", "v_m_per_s", "psi_rad", "psidot_rad_per_s"),
            *("V1_V", "V2_V", "dV1_V_per_s", "dV2_V_per_s"),
        ),
        each(bimorph.slopes),
        1e-13,
        quick=range(12),
    ),
    Table(
        "bimorph/steady_cases.csv",
        ("case", "set", "rho_kg_per_m3", "Vpp_V", "f_Hz"),
        each(bimorph.steady),
        1e-8,
        {"floquet_abs_max": 2e-5, "P_elec_pos_W": 5e-8},
        BIMORPH_ORBIT,
        residuals=("periodicity_residual_scaled",),
        quick=(20,),
    ),
    Table(
        "bimorph/transient_cases.csv",
        ("set", "Vpp_V", "f_Hz", "cycles"),
        each(bimorph.transient),
        1e-8,
        second=("scaled_diff_dop853_1e11", "scaled_diff_lsoda_1e11"),
        again=bimorph.transient_again,
        quick=(3,),
    ),
    Table(
        "bimorph/variant_cases.csv",
        ("variant", "branch", "T_rad_per_m", "K_t_N_per_m", "k_wh_Nm_per_rad", "Vpp_V", "f_Hz"),
        each(bimorph.variant),
        1e-8,
        {"floquet_abs_max": 2e-5},
        {"lift_mean_mgf": 10.0},
        second=("residual_scaled_lsoda", "residual_scaled_dop853"),
        again=bimorph.variant_again,
        quick=(3,),
    ),
    Table(
        "bimorph/chirp_envelope_160V.csv",
        ("cycle",),
        bimorph.chirp_envelope,
        1e-7,
        # The committed extremes are less accurate than the others: LSODA at rtol 1e-12 confirms the recomputed ones to
        # 1e-11.
        {"psi_absmax_deg": 5e-7},
        sizes={"stroke_pp_deg": PEAK, "psi_absmax_deg": PEAK},
        quick=range(5),
    ),
    Table("direct-drive/derived_constants.csv", ("name",), each(direct_drive.constants), 1e-15, quick=range(25)),
    Table(
        "direct-drive/rhs_vectors.csv",
        ("type", "dcp", "V_V", "Vdot_V_s", "phi", "psi", "phidot", "psidot"),
        each(direct_drive.slopes),
        1e-13,
        quick=range(36),
    ),
    Table(
        "direct-drive/steady_cases.csv",
        DIRECT_ORBIT_INPUTS,
        each(direct_drive.orbit),
        1e-8,
        DIRECT_BOUNDS,
        DIRECT_ORBIT,
        residuals=DIRECT_RESIDUALS,
        second=[
            f"{what}_{solver}_1e-9"
            for solver in ("dop853", "radau")
            for what in ("reldiff_lift", "reldiff_power", "return_err")
        ],
        again=direct_drive.again,
        quick=(15,),
    ),
    Table(
        "direct-drive/variants.csv",
        DIRECT_ORBIT_INPUTS,
        each(direct_drive.orbit),
        1e-8,
        DIRECT_BOUNDS,
        DIRECT_ORBIT,
        residuals=DIRECT_RESIDUALS,
        quick=(11,),
    ),
    Table(
        "direct-drive/blade_cases.csv",
        DIRECT_ORBIT_INPUTS,
        each(direct_drive.orbit),
        1e-8,
        DIRECT_BOUNDS | {"floquet_max": 5e-4},
        DIRECT_ORBIT,
        residuals=DIRECT_RESIDUALS,
        quick=(8,),
    ),
    Table(
        "direct-drive/impulse_fits.csv",
        ("type", "params", "impulse_Vs", "window_cycles_of_mode1", "n_samples"),
        direct_drive.impulse_fits,
        1e-7,
        sizes={"fit_lambda_1_s": "fit_f_Hz", "fit_rel_rms": 1.0},
        quick=(60,),
    ),
    Table(
        "direct-drive/traj_small_30V_209Hz_steady.csv",
        ("t_s",),
        direct_drive.trajectory,
        1e-8,
        sizes={
            name: PEAK
            for name in (
                *("phi_rad", "psi_rad", "phidot_rad_s", "psidot_rad_s", "phiddot_rad_s2", "psiddot_rad_s2"),
                *("F_lift_N", "F_tr_lift_N", "F_am_N", "M_tr_y_Nm", "M_tr_x_Nm", "M_rot_Nm", "M_am_y2_Nm", "M_am_x_Nm"),
                *("current_A", "power_W"),
            )
        },
        quick=range(10),
    ),
    Table(
        "four-bar/kinematics_vectors.csv",
        ("system", "theta"),
        each(four_bar.kinematics),
        1e-13,
        sizes={
            name: PEAK for name in ("theta1_minus_neutral", "theta1_pp", "theta2_p", "delta", "delta_pp", "half_dG")
        },
        quick=range(20),
    ),
    Table(
        "four-bar/rhs_vectors.csv",
        ("system", "arms", "quad", "N", "t", "theta", "theta_dot", "phi", "phi_dot"),
        each(four_bar.slopes),
        1e-12,
        quick=range(48),
    ),
    Table(
        "four-bar/steady_cases.csv",
        (
            *("id", "system", "variant", "quad", "N", "f_Hz", "Vpp_V", "Vdc_V", "Vref_V"),
            *("krot_Nm", "ksc_N_m", "d_Nms", "D_Nms", "arms", "am_sign"),
        ),
        each(four_bar.steady),
        1e-7,
        sizes={
            "theta_mean_rad": "theta1_rad",
            "phi_mean_rad": "phi1_rad",
            "y0_theta": "theta1_rad",
            "y0_phi": "phi1_rad",
            **FOUR_LIFT,
        },
        residuals=("poincare_resid", "energy_audit_rel"),
        second=("max_rel_dev_2nd_solver",),
        again=four_bar.again,
        quick=(3,),
    ),
    Table(
        "four-bar/rotation_only.csv",
        ("id", "system", "quad", "N", "f_Hz", "Theta_rad", "arms", "krot_Nm", "d_Nms"),
        each(four_bar.rotation_only),
        1e-7,
        sizes={"phi_mean_rad": "phi1_rad", "phi0": "phi1_rad", **FOUR_LIFT},
        residuals=("poincare_resid",),
        second=("max_rel_dev_2nd_solver",),
        again=four_bar.rotation_again,
        quick=(1,),
    ),
    Table(
        "four-bar/transient_sys75.csv",
        ("t",),
        four_bar.transient,
        1e-7,
        sizes={name: PEAK for name in ("theta", "theta_dot", "phi", "phi_dot")},
        quick=range(12),
    ),
    Table("own_equations.csv", ("id", "F0", "f"), each(own_equations.row), 1e-8, quick=(0,)),
    Table("motor_wing.csv", MOTOR_INPUTS, motor_wing, 1e-8),
)
