"""The bimorph of Jafferis, Graule and Wood (2016). Equation numbers are the paper's; SI units and radians.

Eq. (6) and Eq. (11) are in their corrected forms: docs/models/bimorph.md has the evidence. The printed forms are the
readings `eq6-printed` and `eq11-printed`. State: tip displacement x, its rate, wing pitch psi, its rate. One actuator
with one wing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import Decimal, localcontext
from math import cos, degrees, exp, expm1, log1p, pi, sin, sqrt
from typing import Any

import numpy as np

from .motion import Array, Motion, Orbit, Results, Row, Run, Surface, periodic, run, settle, unsplit, wrapped

#: Newtons per milligram-force in the tables.
MGF = 9.81e-6
#: First frequency (Hz) and its rate (Hz/s) of the frequency sweep of Eq. (7).
CHIRP = (1.0, 15.0)


@dataclass(frozen=True)
class Parameters:
    """Table I."""

    # Piezo stress per field f31 (N/(V m)) in Eq. (6), elastic modulus (Pa) in Eq. (4).
    f31_min: float = 14.0
    f31_max: float = 29.0
    a1: float = 8000.0
    a2: float = -230.0
    a3: float = 10e-6
    a4: float = 69e-9
    field_0: float = 0.4e6
    e_min: float = 38.5e9
    e_max: float = 81e9
    e_cf: float = 340e9
    eps_0: float = -0.047e-2
    # Actuator (m), fitted factors.
    t_pzt: float = 135e-6
    t_cf: float = 50e-6
    l_pzt: float = 9e-3
    w_n: float = 1.125e-3
    l_r: float = 0.25
    w_r: float = 1.556
    p5: float = 0.8
    p4: float = 0.79
    p3: float = 0.7
    c_act: float = 10.1e-9
    # Transmission (rad/m, N/m), wing (kg m², m, m²), hinge (N m/rad).
    transmission: float = 3333.0
    k_t: float = 197.7
    i_zz: float = 51.1e-12
    i_am: float = 10.22e-12
    i_xx: float = 0.95 * 1.29e-12
    i_xz: float = 0.29 * 2.8e-12
    length: float = 17e-3
    area: float = 54.59e-6
    r_2: float = 0.564
    width: float = 4.5e-3
    w_2: float = 0.43
    b_max: float = 1.25 * 3.4
    b_min: float = 0.39 * 0.4
    b_lift: float = 1.8
    r_cp: float = 1.42 * 9.56e-3
    w_cp1: float = 0.39 * 1.93e-3
    p_min: float = 0.132
    p_max: float = 0.151
    kappa_wh: float = 0.985 * 1.52e-6
    #: The paper does not give the air density (kg/m³).
    rho: float = 1.2


TABLE_1 = Parameters()


def scaled(factor: float) -> Parameters:
    """The transmission of Fig. 5: section III-A scales the stiffnesses with it."""
    return replace(
        TABLE_1,
        transmission=factor * TABLE_1.transmission,
        k_t=factor ** (2.0 - 2.14) * TABLE_1.k_t,
        kappa_wh=factor**-1.47 * TABLE_1.kappa_wh,
    )


SETS = {
    "T1": TABLE_1,
    "T2": scaled(0.8),
    "T3": scaled(0.6),
    # The redesign of section III-B.
    "RD": replace(TABLE_1, transmission=2666.0, k_t=215.0, kappa_wh=2.29e-6),
}


def taper_gain(w_r: float, l_r: float) -> float:
    """G in Eq. (3) to 17 digits: the closed form in 60-digit arithmetic, because it cancels near w_r = 1."""
    with localcontext() as context:
        context.prec = 60
        w, e = Decimal(w_r), Decimal(l_r)
        if w == 1:
            return float((1 + 2 * e) / (1 + 3 * e + 3 * e * e))
        first = -6 * (w - 1) * (-3 + 4 * e * (w - 1) + 2 * w)
        second = 3 * (-2 + 2 * e * (w - 1) + w) ** 2 * ((2 - w) / w).ln()
        return float(8 * (1 - w) ** 3 * (1 + 2 * e) / (first + second))


class Bimorph:
    """The equations with the constants of one design point.

    `reading` is a name in the column `variant` of variant_cases.csv, or empty for the corrected equations.
    """

    def __init__(self, p: Parameters, v_pp: float, f: float | None, reading: str = "") -> None:
        self.p, self.v_pp, self.f, self.reading = p, v_pp, f, reading
        # (5), (3): strain per tip displacement, stiffness, (6): force.
        self.s_eps = (p.t_pzt + p.t_cf) / (p.l_pzt**2 * (1.0 + 2.0 * p.l_r))
        gain = taper_gain(p.w_r, p.l_r)
        self.k_pre = p.p4 * p.p5 * p.w_n * gain / (p.l_pzt**3 * (1.0 + 2.0 * p.l_r))
        self.d_e = p.t_pzt * (1.5 * p.t_cf**2 + 3.0 * p.t_cf * p.t_pzt + 2.0 * p.t_pzt**2)
        self.d_c = p.e_cf * p.t_cf**3 / 4.0
        self.f_pre = 3.0 * p.p3 * gain * p.w_n * p.t_pzt * (p.t_pzt + p.t_cf) / (4.0 * p.l_pzt)
        self.c_plate = p.c_act / 4.0
        self.m_e = (p.i_zz + p.i_am) * p.transmission**2
        # (8) to (11).
        self.b1, self.b2 = (p.b_max + p.b_min) / 2.0, (p.b_max - p.b_min) / 2.0
        half = 0.5 * p.rho * p.area
        self.pressure = half * p.r_2**2 * p.length**2 * p.transmission**2
        self.c_a = self.pressure * p.r_cp * p.transmission * self.b1
        self.c_b = self.pressure * p.r_cp * p.transmission * self.b2
        self.c_c = half * p.w_cp1 * p.w_2**2 * p.width**2 * p.b_max

    def e_e(self, u: float) -> float:
        """The secant modulus, (4), for u = a_1 s_eps |x|."""
        p = self.p
        sigma = 1.0 / (1.0 + exp(-p.a1 * p.eps_0))
        if abs(u) < 1e-5:
            mean = sigma + sigma * (1.0 - sigma) * u / 2.0 + sigma * (1.0 - sigma) * (1.0 - 2.0 * sigma) * u * u / 6.0
        else:
            mean = log1p(sigma * expm1(u)) / u
        return p.e_min + (p.e_max - p.e_min) / 2.0 * mean

    def k_act(self, magnitude: float) -> float:
        """The stiffness of the actuator, (3), for |x|."""
        u = 0.0 if self.reading == "kact-const" else self.p.a1 * self.s_eps * magnitude
        return self.k_pre * (self.e_e(u) * self.d_e + self.d_c)

    def voltages(self, t: float) -> tuple[float, float, float]:
        """V_1, V_2 and dV_2/dt = -dV_1/dt, (7)."""
        if self.f is None:
            theta, rate = 2.0 * pi * (CHIRP[0] + CHIRP[1] * t / 2.0) * t, 2.0 * pi * (CHIRP[0] + CHIRP[1] * t)
        else:
            theta, rate = 2.0 * pi * self.f * t, 2.0 * pi * self.f
        half = self.v_pp / 2.0
        return half * (1.0 - sin(theta)), half * (1.0 + sin(theta)), half * cos(theta) * rate

    def g(self, volts: float) -> tuple[float, float, float]:
        """The force of a plate without strain, (6), and its first two derivatives with respect to the voltage."""
        p = self.p
        field = volts / p.t_pzt
        s = 1.0 / (1.0 + exp(-p.a3 * (field - p.field_0)))
        s1, s2 = p.a3 * s * (1.0 - s), p.a3**2 * s * (1.0 - s) * (1.0 - 2.0 * s)
        high, slope = p.f31_max * (1.0 - p.a4 * field), -p.a4 * p.f31_max
        rise = high - p.f31_min
        # As printed, f31_min is divided by 1 + exp z too.
        low = (1.0 - s, -s1, -s2) if self.reading == "eq6-printed" else (1.0, 0.0, 0.0)
        f31 = p.f31_min * low[0] + rise * s
        f31_1 = p.f31_min * low[1] + slope * s + rise * s1
        f31_2 = p.f31_min * low[2] + 2.0 * slope * s1 + rise * s2
        scale = self.f_pre / p.t_pzt
        return self.f_pre * field * f31, scale * (f31 + field * f31_1), scale / p.t_pzt * (2.0 * f31_1 + field * f31_2)

    def forces(self, volts: tuple[float, float], x: float) -> tuple[float, float]:
        """F_1 and F_2, (6)."""
        strain = self.p.a2 * self.s_eps * x
        return self.g(volts[0])[0] * (1.0 - strain), self.g(volts[1])[0] * (1.0 + strain)

    def arm(self, psi: float, sides: Sequence[float]) -> float:
        """W_cp2, (11): `sides` of x, v, psi, psi rate and of the content of the bars."""
        p = self.p
        return p.area / p.length * (p.p_min + (p.p_max - p.p_min) * sides[4] * self.bars(psi, sides[1], sides[2]))

    def bars(self, psi: float, side_v: float, side_psi: float) -> float:
        """The content of the bars in (11)."""
        side = {"eq11-printed": 1.0, "eq11-signed-alpha": side_v}.get(self.reading, side_psi)
        return 1.0 - 2.0 / pi * side * psi

    def accelerations(
        self, volts: tuple[float, float], y: Sequence[float], sides: Sequence[float]
    ) -> tuple[float, float]:
        """(1) and (2)."""
        p = self.p
        x, v, psi, psi_dot = y
        f_1, f_2 = self.forces(volts, x)
        cos_2psi, sin_2psi = cos(2.0 * psi), sin(2.0 * psi)
        v_v = sides[1] * v * v
        drag = self.b1 + self.b2 * cos_2psi
        stiffness = self.k_act(sides[0] * x) + p.k_t
        x_ddot = (f_1 - f_2 - stiffness * x - (self.c_a + self.c_b * cos_2psi) * v_v) / self.m_e
        # (10), (11): the moment of the air about the hinge.
        c_d = self.pressure * self.arm(psi, sides) * (drag * cos(psi) + p.b_lift * sin_2psi * sin(psi))
        psi_ddot = (
            c_d * v_v
            + p.i_xz * p.transmission * x_ddot * cos(psi)
            + 0.5 * p.i_xx * (p.transmission * v) ** 2 * sin_2psi
            - p.kappa_wh * psi
            - self.c_c * sides[3] * psi_dot * psi_dot
        ) / p.i_xx
        return x_ddot, psi_ddot

    def rates(self, t: float, y: Sequence[float], sides: Sequence[float]) -> Sequence[float]:
        x_ddot, psi_ddot = self.accelerations(self.voltages(t)[:2], y, sides)
        return (y[1], x_ddot, y[3], psi_ddot)

    def air(self, v: float, psi: float, side_v: float) -> tuple[float, float]:
        """Lift (up) and drag (against the stroke) of the wing."""
        push = self.pressure * side_v * v * v
        return push * self.p.b_lift * sin(2.0 * psi), push * (self.b1 + self.b2 * cos(2.0 * psi))

    def charges(self, volts: tuple[float, float], x: float) -> tuple[float, float]:
        """Charges of the plates by reciprocity: the x-derivative of the co-energy is (6)."""
        b = self.p.a2 * self.s_eps
        slopes = self.g(volts[0])[1], self.g(volts[1])[1]
        return (
            self.c_plate * volts[0] + slopes[0] * (x - b / 2.0 * x * x),
            self.c_plate * volts[1] - slopes[1] * (x + b / 2.0 * x * x),
        )

    def currents(self, volts: tuple[float, float], rate_2: float, x: float, v: float) -> tuple[float, float]:
        """Time derivatives of the charges."""
        b = self.p.a2 * self.s_eps
        (_, g1_1, g2_1), (_, g1_2, g2_2) = self.g(volts[0]), self.g(volts[1])
        i_1 = -self.c_plate * rate_2 - g2_1 * rate_2 * (x - b / 2.0 * x * x) + g1_1 * (1.0 - b * x) * v
        i_2 = self.c_plate * rate_2 - g2_2 * rate_2 * (x + b / 2.0 * x * x) - g1_2 * (1.0 + b * x) * v
        return i_1, i_2

    def motion(self) -> Motion:
        surfaces: list[Surface] = [
            lambda t, y: y[0],
            lambda t, y: y[1],
            lambda t, y: y[2],
            lambda t, y: y[3],
            lambda t, y: self.bars(y[2], float(np.sign(y[1])), float(np.sign(y[2]))),
        ]
        return Motion(self.rates, surfaces, scale=(3e-4, 0.25, 1.0, 800.0))

    def integrands(self, t: float, y: Sequence[float], sides: Sequence[float]) -> Sequence[float]:
        p = self.p
        x, v, psi, psi_dot = y
        v_1, v_2, rate_2 = self.voltages(t)
        x_ddot = self.accelerations((v_1, v_2), y, sides)[0]
        f_1, f_2 = self.forces((v_1, v_2), x)
        i_1, i_2 = self.currents((v_1, v_2), rate_2, x, v)
        lift, drag = self.air(v, psi, sides[1])
        c_d = self.pressure * self.arm(psi, sides)
        c_d *= (self.b1 + self.b2 * cos(2.0 * psi)) * cos(psi) + p.b_lift * sin(2.0 * psi) * sin(psi)
        theta = 2.0 * pi * (self.f or 0.0) * t
        return (
            lift,
            sides[1] * drag,
            drag,
            (f_1 - f_2) * v,
            (self.c_a + self.c_b * cos(2.0 * psi)) * sides[1] * v**3,
            v_1 * i_1 + v_2 * i_2,
            v_1 * i_1 * (sides[5] > 0.0) + v_2 * i_2 * (sides[6] > 0.0),
            i_1 * i_1,
            i_2 * i_2,
            self.c_c * sides[3] * psi_dot**3,
            c_d * sides[1] * v * v * psi_dot,
            p.i_xz * p.transmission * x_ddot * cos(psi) * psi_dot,
            0.5 * p.i_xx * (p.transmission * v) ** 2 * sin(2.0 * psi) * psi_dot,
            x,
            x * cos(theta),
            x * sin(theta),
            psi * cos(theta),
            psi * sin(theta),
        )

    def settled(self, y: Sequence[float] | Array = (0.0, 0.0, 0.0, 0.0)) -> Orbit:
        """The orbit that a motion from this state comes to."""
        assert self.f is not None
        motion, period = self.motion(), 1.0 / self.f
        return periodic(motion, period, settle(motion, period, y))

    def measured(self, orbit: Orbit) -> tuple[Run, Array]:
        """One period of an orbit, and the means of the integrands over it."""
        assert self.f is not None

        def current(number: int) -> Surface:
            def value(t: float, y: Any) -> float:
                v_1, v_2, rate_2 = self.voltages(t)
                return self.currents((v_1, v_2), rate_2, y[0], y[1])[number]

            return value

        period = run(
            self.motion(), 0.0, 1.0 / self.f, orbit.y, integrands=self.integrands, watched=[current(0), current(1)]
        )
        return period, period.integrals * self.f


def model_of(row: Row) -> Bimorph:
    """The design point and the reading of a row of steady_cases.csv or variant_cases.csv."""
    p = replace(
        TABLE_1,
        transmission=float(row["T_rad_per_m"]),
        k_t=float(row["K_t_N_per_m"]),
        kappa_wh=float(row["k_wh_Nm_per_rad"]),
        rho=float(row.get("rho_kg_per_m3", TABLE_1.rho)),
    )
    return Bimorph(p, float(row["Vpp_V"]), float(row["f_Hz"]), row.get("variant", ""))


def steady(row: Row) -> Results:
    """A row of steady_cases.csv."""
    p = SETS[row["set"]]
    # The columns that the set implies are results, too.
    implied = {"T_rad_per_m": p.transmission, "K_t_N_per_m": p.k_t, "k_wh_Nm_per_rad": p.kappa_wh}
    model = model_of(row)
    return implied | measures(model, model.settled())


def measures(model: Bimorph, orbit: Orbit) -> Results:
    p, f = model.p, model.f
    assert f is not None
    period, mean = model.measured(orbit)
    x_min, x_max = period.extremes(1, lambda y: float(y[0]))
    psi_min, psi_max = period.extremes(3, lambda y: float(y[2]))
    # First harmonics, 2 <q exp(-i theta)>. That of -sin theta is i.
    x_1, psi_1 = 2.0 * complex(mean[14], -mean[15]), 2.0 * complex(mean[16], -mean[17])
    stroke = p.transmission * (x_max - x_min)
    strain = model.s_eps * max(x_max, -x_min)
    capacitive = 0.5 * p.c_act * model.v_pp**2 * f
    return {
        "x0_m": orbit.y[0],
        "v0_m_per_s": orbit.y[1],
        "psi0_rad": orbit.y[2],
        "psidot0_rad_per_s": orbit.y[3],
        "stroke_pp_rad": stroke,
        "stroke_pp_deg": degrees(stroke),
        "x_amp_m": (x_max - x_min) / 2.0,
        "x_mean_m": mean[13],
        "psi_max_rad": max(psi_max, -psi_min),
        "psi_pos_rad": psi_max,
        "psi_neg_rad": psi_min,
        "psi_pos_deg": degrees(psi_max),
        "psi_neg_deg": degrees(psi_min),
        "psi_max_deg": degrees(max(psi_max, -psi_min)),
        "phase_x_drive_deg": wrapped(float(np.angle(x_1 / 1j, deg=True))),
        "phase_psi_x_deg": wrapped(float(np.angle(psi_1 / x_1, deg=True))),
        "x_fund_m": abs(x_1),
        "psi_fund_rad": abs(psi_1),
        "lift_mean_N": mean[0],
        "lift_mean_mgf": mean[0] / MGF,
        "drag_abs_mean_N": mean[1],
        "drag_signed_mean_N": mean[2],
        "strain_mid_max": strain,
        # At the surface of the plate instead of its middle.
        "strain_surf_max": strain * (2.0 * p.t_pzt + p.t_cf) / (p.t_pzt + p.t_cf),
        "P_mech_W": mean[3],
        "P_drag_W": mean[4],
        "P_elec_W": mean[5],
        "P_elec_pos_W": mean[6],
        "i1_rms_A": sqrt(mean[7]),
        "i2_rms_A": sqrt(mean[8]),
        "P_hinge_damp_W": mean[9],
        "P_hinge_aero_W": mean[10],
        "P_hinge_Ixz_W": mean[11],
        "P_hinge_cent_W": mean[12],
        "P_cap_vehicle_W": capacitive,
        "P_cap_actuator_W": capacitive / 2.0,
        "floquet_abs_max": orbit.multiplier,
        "periodicity_residual_scaled": orbit.residual,
    }


def variant(row: Row) -> Results:
    """A row of variant_cases.csv: a reading of the paper, or one of two motions of a hinge of half the stiffness.

    The branches `sweep-up` and `sweep-down` are reached in steps of 1 Hz from 6 Hz below or above, with 30 periods
    each.
    """
    model = model_of(row)
    begin = np.zeros(4)
    step = {"sweep-up": 1.0, "sweep-down": -1.0}.get(row["branch"])
    if step:
        for number in range(6, 0, -1):
            f = float(row["f_Hz"]) - step * number
            motion = model_of(row | {"f_Hz": repr(f)}).motion()
            begin = unsplit(motion, 0.0, 30.0 / f, begin, "DOP853", 1e-6).y
    return measures(model, model.settled(begin))


def variant_again(row: Row, results: Results) -> Results:
    """The distances by which a state of variant_cases.csv misses itself after one period of other solvers."""
    motion = model_of(row).motion()
    begin = np.array([results[name] for name in ("x0_m", "v0_m_per_s", "psi0_rad", "psidot0_rad_per_s")])
    found = {}
    for method in ("LSODA", "DOP853"):
        end = unsplit(motion, 0.0, 1.0 / float(row["f_Hz"]), begin, method, 1e-11).y
        found[f"residual_scaled_{method.lower()}"] = motion.distance(end, begin)
    return found


def slopes(row: Row) -> Results:
    """A row of rhs_vectors.csv."""
    model = Bimorph(TABLE_1, 0.0, None)
    y = [float(row[name]) for name in ("x_m", "v_m_per_s", "psi_rad", "psidot_rad_per_s")]
    volts = float(row["V1_V"]), float(row["V2_V"])
    rate_2 = float(row["dV2_V_per_s"])
    sides = [1.0 if value >= 0.0 else -1.0 for value in y]
    sides.append(1.0 if model.bars(y[2], sides[1], sides[2]) >= 0.0 else -1.0)
    x_ddot, psi_ddot = model.accelerations(volts, y, sides)
    f_1, f_2 = model.forces(volts, y[0])
    q_1, q_2 = model.charges(volts, y[0])
    i_1, i_2 = model.currents(volts, rate_2, y[0], y[1])
    lift, drag = model.air(y[1], y[2], sides[1])
    return {
        "F1_N": f_1,
        "F2_N": f_2,
        "K_act_N_per_m": model.k_act(abs(y[0])),
        "E_e_Pa": model.e_e(model.p.a1 * model.s_eps * abs(y[0])),
        "xdd_m_s2": x_ddot,
        "psidd_rad_s2": psi_ddot,
        "lift_N": lift,
        "drag_N": drag,
        "q1_C": q_1,
        "q2_C": q_2,
        "i1_A": i_1,
        "i2_A": i_2,
    }


def from_rest(row: Row) -> tuple[Motion, float]:
    """The motion of a row of transient_cases.csv and its end: some drive periods, or a time of the frequency sweep."""
    if row["set"] == "T1-chirp":
        return Bimorph(TABLE_1, float(row["Vpp_V"]), None).motion(), float(row["t_end_s"])
    model = Bimorph(SETS[row["set"]], float(row["Vpp_V"]), float(row["f_Hz"]))
    return model.motion(), int(row["cycles"]) / float(row["f_Hz"])


def transient(row: Row) -> Results:
    """A row of transient_cases.csv."""
    motion, end = from_rest(row)
    y = run(motion, 0.0, end, np.zeros(4)).y
    return {"t_end_s": end, "x_m": y[0], "v_m_per_s": y[1], "psi_rad": y[2], "psidot_rad_per_s": y[3]}


def transient_again(row: Row, results: Results) -> Results:
    """The distance of the ends of a row of transient_cases.csv and of other solvers."""
    motion, end = from_rest(row)
    y = np.array([results[name] for name in ("x_m", "v_m_per_s", "psi_rad", "psidot_rad_per_s")])
    return {
        f"scaled_diff_{method.lower()}_1e11": motion.distance(
            unsplit(motion, 0.0, end, np.zeros(4), method, 1e-11).y, y
        )
        for method in ("DOP853", "LSODA")
    }


def chirp_envelope(rows: Sequence[Row]) -> list[Results]:
    """Rows of chirp_envelope_160V.csv: extremes of each cycle of the frequency sweep from rest, Table I at 160 V."""
    model = Bimorph(TABLE_1, 160.0, None)
    motion = model.motion()
    begin, y = 0.0, np.zeros(4)
    found = []
    for row in rows:
        # The phase is a whole number of turns.
        end = (-CHIRP[0] + sqrt(CHIRP[0] ** 2 + 2.0 * CHIRP[1] * (int(row["cycle"]) + 1))) / CHIRP[1]
        cycle = run(motion, begin, end, y)
        x_min, x_max = cycle.extremes(1, lambda y: float(y[0]))
        psi_min, psi_max = cycle.extremes(3, lambda y: float(y[2]))
        stroke = degrees(TABLE_1.transmission * (x_max - x_min))
        found.append({"t_end_s": end, "stroke_pp_deg": stroke, "psi_absmax_deg": degrees(max(psi_max, -psi_min))})
        begin, y = end, cycle.y
    return found


def taper(row: Row) -> Results:
    """A row of taper_gains.csv."""
    return {"G": taper_gain(float(row["w_r"]), float(row["l_r"]))}
