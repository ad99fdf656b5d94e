"""The direct drive of Ozaki and Hamaguchi (2018). Equation numbers are the paper's; SI units and radians.

Eq. (11), (17), (23) to (25), (35) and (38) are in their corrected forms: docs/models/direct-drive.md has the evidence. The y axis
points to the leading edge, which is up, so that y_g is negative. State: stroke phi, wing pitch psi, their rates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import cos, degrees, pi, sin, sqrt
from typing import Any

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import least_squares

from .motion import Array, Motion, Orbit, Results, Row, Run, Surface, periodic, run, settle, unsplit, wrapped

#: Permittivity of vacuum (F/m), newtons per gram-force.
EPS_0 = 8.8541878128e-12
GF = 9.80665e-3


@dataclass(frozen=True)
class Parameters:
    """Table A1, the small type."""

    # Wing (m, kg, kg m²).
    length: float = 17.0e-3
    chord: float = 6.51e-3
    r_g: float = 9.42e-3
    y_g: float = -2.48e-3
    m_w: float = 2.31e-6
    j_wx: float = 4.81e-12
    j_wy: float = 5.07e-11
    j_wxy: float = 3.62e-13
    j_b: float = 3.89e-9
    k_w: float = 1.48e-4
    # Shape moments (22) and (33); the chord at R/2, which the paper does not give.
    i_03: float = 1.02
    i_04: float = 1.04
    i_12: float = 0.88
    i_13: float = 0.89
    i_21: float = 0.82
    i_22: float = 0.84
    i_31: float = 0.85
    i_rd: float = 4.68e-10
    c_mid: float = 6.51e-3
    #: Distance from the stroke axis to the root: the paper has no number, half an actuator is assumed.
    x_r: float = 5.25e-3
    # Actuator: length, widths at root and tip, layers from the piezo outwards (m, Pa, kg/m³, m/V, F/m).
    l_a: float = 10.5e-3
    w_r: float = 6.0e-3
    w_t: float = 2.4e-3
    t: tuple[float, float, float] = (100e-6, 10e-6, 100e-6)
    e: tuple[float, float, float] = (14.3e9, 5.0e9, 50.3e9)
    rho_i: tuple[float, float, float] = (8000.0, 1500.0, 2250.0)
    d_pz: float = 950e-12
    eps_pz: float = 2920.0 * EPS_0
    # Air.
    rho: float = 1.29
    c_d_max: float = 5.0
    c_d_min: float = 0.4
    c_rd: float = 3.5
    #: The chord over its mean, 1 + a1 P1 + a2 P2 + a3 P3 with Legendre polynomials from root to tip: fitted to the
    #: shape moments.
    legendre: tuple[float, float, float] = (0.0562, -0.0913, 0.176)


SMALL = Parameters()
LARGE = Parameters(
    length=32.4e-3,
    chord=8.34e-3,
    r_g=15.6e-3,
    y_g=-2.57e-3,
    m_w=4.09e-6,
    j_wx=1.03e-11,
    j_wy=2.70e-10,
    j_wxy=7.12e-12,
    j_b=1.47e-8,
    k_w=8.64e-5,
    i_03=1.12,
    i_04=1.23,
    i_12=0.84,
    i_13=0.88,
    i_21=0.75,
    i_22=0.73,
    i_31=0.74,
    i_rd=1.49e-9,
    c_mid=8.34e-3,
    x_r=10.5e-3,
    l_a=21.0e-3,
    w_r=10.4e-3,
    w_t=4.4e-3,
    t=(100e-6, 10e-6, 130e-6),
    legendre=(-0.212, -0.3696, 0.0482),
)
TYPES = {"small": SMALL, "large": LARGE}


def chord_of(p: Parameters, r: Any) -> Any:
    """The chord over its mean at the fraction r of the span."""
    return np.polynomial.legendre.legval(2.0 * r - 1.0, [1.0, *p.legendre])


def nodes(count: int) -> tuple[Array, Array]:
    """Gauss-Legendre nodes and weights for 0 to 1."""
    x, weights = np.polynomial.legendre.leggauss(count)
    return 0.5 * (x + 1.0), 0.5 * weights


def with_chord_moments(p: Parameters) -> Parameters:
    """The shape moments (22), (33) and the chord at R/2 of the chord instead of Table A1."""
    r, weights = nodes(16)
    chord, x = chord_of(p, r), r + p.x_r / p.length

    def moment(i: int, j: int) -> float:
        return float(np.sum(weights * chord**j * x**i))

    return replace(
        p,
        i_03=moment(0, 3),
        i_04=moment(0, 4),
        i_12=moment(1, 2),
        i_13=moment(1, 3),
        i_21=moment(2, 1),
        i_22=moment(2, 2),
        i_31=moment(3, 1),
        i_rd=0.25 * p.chord**4 * moment(0, 4),
        c_mid=p.chord * float(chord_of(p, 0.5)),
    )


@dataclass(frozen=True)
class Air:
    """Forces and moments of the air: translational lift, moments about the stroke axis and the hinge, rotational
    moment.
    """

    lift: float
    m_tr_y: float
    m_tr_x: float
    m_rot: float


@dataclass(frozen=True)
class Added:
    """Force and moments of the added mass, (28) to (30)."""

    force: float
    m_y2: float
    m_x: float


class DirectDrive:
    """The equations with the constants of one design point.

    `dcp` is the reading of the angle in Eq. (24). `blades` is the number of blade elements that each have a direction
    of flow; 0 is the paper's one direction for the whole wing. `lagrangian` adds the gyroscopic terms that the paper's
    added mass lacks. `lift_sign` is the sign of F_am sin psi in Eq. (35), as printed +1.
    """

    def __init__(
        self,
        p: Parameters,
        v_0: float,
        f: float,
        *,
        dcp: str = "directional",
        blades: int = 0,
        lagrangian: bool = False,
        lift_sign: float = -1.0,
    ) -> None:
        self.p, self.v_0, self.f = p, v_0, f
        self.dcp, self.blades, self.lagrangian, self.lift_sign = dcp, blades, lagrangian, lift_sign
        layers = list(zip(p.t, p.e, p.rho_i))
        self.z = [sum(p.t[: i + 1]) - p.t[i] / 2.0 for i in range(3)]
        self.z_c = sum(e * t * z for (t, e, _), z in zip(layers, self.z)) / sum(e * t for t, e, _ in layers)  # (8)
        self.s_a = sum(e * (t**3 / 12.0 + t * (z - self.z_c) ** 2) for (t, e, _), z in zip(layers, self.z))  # (10)
        self.mu = sum(rho * t for t, _, rho in layers)
        widths = p.w_r + p.w_t
        self.j_a = self.mu * (p.w_r + 5.0 * p.w_t) * p.l_a**3 / 120.0  # (6)
        self.k_phi = self.s_a * widths / (2.0 * p.l_a)  # (11)
        self.gamma = 0.5 * p.e[0] * p.d_pz * (self.z[0] - self.z_c) * widths  # (11), (38)
        self.c_p = p.eps_pz * widths * p.l_a / (2.0 * p.t[0])  # (37)
        # (17).
        x_g = p.r_g + p.x_r
        self.m_11 = self.j_a + p.j_b + p.m_w * x_g**2 + p.j_wy
        self.m_s = p.j_wx + p.m_w * p.y_g**2
        self.m_12 = p.m_w * x_g * p.y_g + p.j_wxy
        self.m_22 = self.m_s
        # (28) to (30), (26), (32).
        rho, c, r = p.rho, p.chord, p.length
        self.a_11 = pi / 4.0 * rho * c**2 * r**3 * p.i_22
        self.a_12 = pi / 8.0 * rho * c**3 * r**2 * p.i_13
        self.a_22 = pi / 16.0 * rho * c**4 * r * p.i_04
        self.f_1 = pi / 4.0 * rho * c**2 * r**2 * p.i_12
        self.f_2 = pi / 8.0 * rho * c**3 * r * p.i_03
        self.k_l = pi / 2.0 * r / c / (1.0 + sqrt((r / (2.0 * c)) ** 2 + 1.0))
        self.k_rot = 0.5 * rho * p.c_rd * r * p.i_rd
        self.half = 0.5 * rho * c * r
        self.x_mid = r / 2.0 + p.x_r
        if blades:
            at, weights = nodes(blades)
            self.blade_x, self.blade_c = p.x_r + r * at, c * chord_of(p, at)
            self.blade_area = self.blade_c * weights * r

    def modes(self) -> list[float]:
        """Frequencies (Hz) of the linear modes, with the added mass."""
        mass = [[self.m_11 + self.a_11, self.m_12 - self.a_12], [self.m_12 - self.a_12, self.m_22 + self.a_22]]
        squares = eigh(np.diag([self.k_phi, self.p.k_w]), mass, eigvals_only=True)
        return [sqrt(square) / (2.0 * pi) for square in squares]

    def mass(self, psi: float) -> tuple[float, float, float]:
        stroke = self.m_11 + self.m_s * sin(psi) ** 2 + self.a_11 * cos(psi) ** 2
        return stroke, (self.m_12 - self.a_12) * cos(psi), self.m_22 + self.a_22

    def voltage(self, t: float) -> tuple[float, float]:
        omega = 2.0 * pi * self.f
        return self.v_0 * sin(omega * t) + self.v_0, self.v_0 * omega * cos(omega * t)

    def u_bar(self, y: Sequence[float]) -> float:
        """The velocity of the middle of the wing, whose sign is the direction of flow."""
        return self.x_mid * y[2] - 0.5 * self.p.c_mid * y[3] * cos(y[1])

    def d_cp(self, psi: float, side_psi: float, s: Any) -> Any:
        """(24): for the side of psi and the direction s of the flow. |psi| < 90 deg on both sides of every surface."""
        turned = {"directional": s, "folded": side_psi, "literal": 1.0}[self.dcp] * psi
        return 0.82 / pi * np.abs(pi / 2.0 - turned) + 0.05

    def air(self, y: Sequence[float], sides: Sequence[float]) -> Air:
        """(21) to (25), (32): `sides` are those of the surfaces of `motion`."""
        p = self.p
        _, psi, phi_dot, psi_dot = y
        w = psi_dot * cos(psi)
        c_l = self.k_l * sin(2.0 * psi)
        c_d = (p.c_d_max + p.c_d_min) / 2.0 + (p.c_d_max - p.c_d_min) / 2.0 * cos(2.0 * psi)
        c_n = c_l * sin(psi) + c_d * cos(psi)
        m_rot = -self.k_rot * sides[1] * psi_dot * psi_dot
        if self.blades:
            each = np.array(sides[3 : 3 + self.blades])
            u = self.blade_x * phi_dot - 0.5 * self.blade_c * w
            pressure = 0.5 * p.rho * each * u * u * self.blade_area
            arms = self.blade_c * self.d_cp(psi, sides[2], each)
            return Air(
                c_l * float(pressure.sum()), -c_d * float(pressure @ self.blade_x), c_n * float(pressure @ arms), m_rot
            )
        s, r, c = sides[3], p.length, p.chord
        b_l = p.i_21 * r**2 * phi_dot**2 - p.i_12 * r * c * phi_dot * w + 0.25 * p.i_03 * c**2 * w**2
        b_x = p.i_22 * r**2 * phi_dot**2 - p.i_13 * r * c * phi_dot * w + 0.25 * p.i_04 * c**2 * w**2
        b_y = p.i_31 * r**2 * phi_dot**2 - p.i_22 * r * c * phi_dot * w + 0.25 * p.i_13 * c**2 * w**2
        arm = c * float(self.d_cp(psi, sides[2], s))
        return Air(self.half * c_l * b_l * s, -self.half * r * c_d * b_y * s, self.half * arm * c_n * b_x * s, m_rot)

    def accelerations(self, volts: float, y: Sequence[float], air: Air) -> tuple[float, float]:
        """Lagrange's equations, with the added mass (28) to (30) on the left."""
        phi, psi, phi_dot, psi_dot = y
        s, c = sin(psi), cos(psi)
        q_1 = (
            self.gamma * volts
            - self.k_phi * phi
            - 2.0 * self.m_s * phi_dot * psi_dot * s * c
            + self.m_12 * psi_dot**2 * s
            + self.a_11 * phi_dot * psi_dot * s * c
            + air.m_tr_y
        )
        q_2 = (
            -self.p.k_w * psi
            + self.m_s * phi_dot**2 * s * c
            - self.a_12 * phi_dot * psi_dot * s
            + air.m_tr_x
            + air.m_rot
        )
        if self.lagrangian:
            e = (self.a_11 * phi_dot * c - self.a_12 * psi_dot) * s
            q_1, q_2 = q_1 + psi_dot * e, q_2 - phi_dot * e
        m_11, m_12, m_22 = self.mass(psi)
        determinant = m_11 * m_22 - m_12 * m_12
        return (m_22 * q_1 - m_12 * q_2) / determinant, (m_11 * q_2 - m_12 * q_1) / determinant

    def added(self, y: Sequence[float], accelerations: Sequence[float]) -> Added:
        _, psi, phi_dot, psi_dot = y
        phi_ddot, psi_ddot = accelerations
        a = phi_ddot * cos(psi) - phi_dot * psi_dot * sin(psi)
        return Added(
            -self.f_1 * a + self.f_2 * psi_ddot,
            -self.a_11 * a + self.a_12 * psi_ddot,
            self.a_12 * a - self.a_22 * psi_ddot,
        )

    def lift(self, psi: float, air: Air, added: Added) -> float:
        """(35), up."""
        return air.lift + self.lift_sign * added.force * sin(psi)

    def current(self, rate: float, phi_dot: float) -> float:
        """(40)."""
        return self.c_p * rate + self.gamma * phi_dot

    def rates(self, t: float, y: Sequence[float], sides: Sequence[float]) -> Sequence[float]:
        phi_ddot, psi_ddot = self.accelerations(self.voltage(t)[0], y, self.air(y, sides))
        return (y[2], y[3], phi_ddot, psi_ddot)

    def surfaces(self) -> list[Surface]:
        def blade(x: float, c: float) -> Surface:
            return lambda t, y: x * y[2] - 0.5 * c * y[3] * cos(y[1])

        flow: list[Surface] = [lambda t, y: self.u_bar(y)]
        if self.blades:
            flow = [blade(x, c) for x, c in zip(self.blade_x.tolist(), self.blade_c.tolist())]
        return [lambda t, y: y[2], lambda t, y: y[3], lambda t, y: y[1], *flow]

    def motion(self) -> Motion:
        omega = 2.0 * pi * (self.f or self.modes()[0])
        return Motion(self.rates, self.surfaces(), scale=(0.1, 0.3, 0.1 * omega, 0.3 * omega))

    def integrands(self, t: float, y: Sequence[float], sides: Sequence[float]) -> Sequence[float]:
        phi, psi, phi_dot, psi_dot = y
        volts, rate = self.voltage(t)
        air = self.air(y, sides)
        added = self.added(y, self.accelerations(volts, y, air))
        current = self.current(rate, phi_dot)
        power = volts * current
        wave = 2.0 * pi * self.f * t
        return (
            phi,
            psi,
            phi * cos(wave),
            phi * sin(wave),
            psi * cos(wave),
            psi * sin(wave),
            self.lift(psi, air, added),
            air.lift,
            power,
            # The side of the current is that of the power, because the voltage is positive.
            power * (sides[-2] > 0.0),
            current**2,
            -(air.m_tr_y * phi_dot + air.m_tr_x * psi_dot),
            -air.m_rot * psi_dot,
            -(added.m_y2 * cos(psi) * phi_dot + added.m_x * psi_dot),
        )

    def settled(self) -> Orbit:
        motion, period = self.motion(), 1.0 / self.f
        return periodic(motion, period, settle(motion, period, np.zeros(4)))


def model_of(row: Row) -> DirectDrive:
    """The design point and the reading of a row of steady_cases.csv, variants.csv or blade_cases.csv."""
    p = replace(TYPES[row["type"]], k_w=float(row["k_w_Nm"]), x_r=float(row["x_r_m"]))
    if row["case"] == "jxy_negative":
        p = replace(p, j_wxy=-p.j_wxy)
    if row["case"].startswith("blade_"):
        p = with_chord_moments(p)
    return DirectDrive(
        p,
        float(row["V0_V"]),
        float(row["f_Hz"]),
        dcp=row["dcp"],
        blades=64 if row["sgn"] == "blade" else 0,
        lagrangian=row["case"] == "am_lagrangian",
        lift_sign=1.0 if row["case"] == "lift_eq35_printed_sign" else -1.0,
    )


def orbit(row: Row) -> Results:
    """A row of steady_cases.csv, variants.csv or blade_cases.csv."""
    model = model_of(row)
    return measures(model, model.settled())


def measures(model: DirectDrive, orbit: Orbit) -> Results:
    def current(t: float, y: Any) -> float:
        return model.current(model.voltage(t)[1], y[2])

    def current_rate(t: float, y: Any) -> float:
        omega = 2.0 * pi * model.f
        sides = [1.0 if surface(t, y) >= 0.0 else -1.0 for surface in model.surfaces()]
        phi_ddot = model.rates(t, y[:4], sides)[2]
        return -model.c_p * model.v_0 * omega**2 * sin(omega * t) + model.gamma * phi_ddot

    motion = model.motion()
    cycle = run(motion, 0.0, 1.0 / model.f, orbit.y, integrands=model.integrands, watched=[current, current_rate])
    mean = cycle.integrals * model.f
    phi_min, phi_max = cycle.extremes(0, lambda y: float(y[0]))
    psi_min, psi_max = cycle.extremes(1, lambda y: float(y[1]))
    phi_1, psi_1 = 2.0 * complex(mean[2], -mean[3]), 2.0 * complex(mean[4], -mean[5])
    peak = max(abs(current(t, y)) for number, t, y in cycle.crossings if number == len(motion.surfaces) + 1)
    slide, switches = sliding(model, cycle)
    first, second = model.modes()
    return {
        "phi_amp_deg": degrees(phi_max - phi_min) / 2.0,
        "psi_amp_deg": degrees(psi_max - psi_min) / 2.0,
        "phi_mean_deg": degrees(mean[0]),
        "psi_mean_deg": degrees(mean[1]),
        "phi_max_deg": degrees(phi_max),
        "phi_min_deg": degrees(phi_min),
        "psi_max_deg": degrees(psi_max),
        "psi_min_deg": degrees(psi_min),
        "phi1_amp_deg": degrees(abs(phi_1)),
        "psi1_amp_deg": degrees(abs(psi_1)),
        "phase_phi_minus_psi_deg": wrapped(float(np.angle(phi_1 / psi_1, deg=True))),
        # The first harmonic of the voltage is -i V_0.
        "phase_V_minus_phi_deg": wrapped(float(np.angle(-1j / phi_1, deg=True))),
        "lift_mean_N": mean[6],
        "lift_mean_gf": mean[6] / GF,
        "lift_tr_mean_N": mean[7],
        "power_mean_W": mean[8],
        "power_pos_mean_W": mean[9],
        "eff_gf_per_W": mean[6] / GF / mean[8],
        "current_peak_A": peak,
        "current_rms_A": sqrt(mean[10]),
        "diss_trans_W": mean[11],
        "diss_rot_W": mean[12],
        "addedmass_W": mean[13],
        "energy_residual_rel": (mean[8] - mean[11] - mean[12]) / mean[8],
        "periodicity_residual": orbit.residual,
        "floquet_max": orbit.multiplier,
        "n_sign_switches": switches,
        "slide": slide,
        "x_phi0": orbit.y[0],
        "x_psi0": orbit.y[1],
        "x_phidot0": orbit.y[2],
        "x_psidot0": orbit.y[3],
        "mode1_Hz": first,
        "mode2_Hz": second,
    }


def sliding(model: DirectDrive, cycle: Run) -> tuple[int, int]:
    """The number of switches of the mean flow's direction after which the motion would turn back, and that of all of
    them.

    After such a switch the motion would slide along the surface, and its continuation on the other side would be wrong.
    Blade elements have no mean direction of flow.
    """
    if model.blades:
        return 0, 0
    switches = [(t, y) for number, t, y in cycle.crossings if number == 3]
    back = 0
    for t, state in switches:
        y = state.tolist()
        outer = [1.0 if surface(t, y) >= 0.0 else -1.0 for surface in model.surfaces()[:3]]
        step = 1e-9 / model.f
        change = []
        for side in (1.0, -1.0):
            moved = state + step * np.asarray(model.rates(t, y, [*outer, side]), dtype=float)
            change.append(model.u_bar(moved.tolist()) - model.u_bar(y))
        back += change[0] * change[1] <= 0.0
    return back, len(switches)


def again(row: Row, results: Results) -> Results:
    """Comparison of a row of steady_cases.csv with other solvers, which locate no surfaces."""
    model = model_of(row)
    begin = np.array([results[name] for name in ("x_phi0", "x_psi0", "x_phidot0", "x_psidot0")])
    # Integrands have the sides of the current and of its rate, which is not used.
    sides: list[Surface] = [lambda t, y: model.current(model.voltage(t)[1], y[2]), lambda t, y: 1.0]
    motion = model.motion()
    motion = replace(motion, surfaces=[*motion.surfaces, *sides])
    found = {}
    for method, name in (("DOP853", "dop853"), ("Radau", "radau")):
        cycle = unsplit(motion, 0.0, 1.0 / model.f, begin, method, 1e-9, model.integrands)
        mean = cycle.integrals * model.f
        found[f"reldiff_lift_{name}_1e-9"] = mean[6] / results["lift_mean_N"] - 1.0
        found[f"reldiff_power_{name}_1e-9"] = mean[8] / results["power_mean_W"] - 1.0
        found[f"return_err_{name}_1e-9"] = motion.distance(cycle.y, begin)
    return found


def constants(row: Row) -> Results:
    """A row of derived_constants.csv."""

    def value(p: Parameters) -> float:
        m = DirectDrive(p, 0.0, 0.0)
        first, second = m.modes()
        return {
            "z0": m.z[0],
            "z1": m.z[1],
            "z2": m.z[2],
            "zc": m.z_c,
            "SA": m.s_a,
            "mu": m.mu,
            "JA": m.j_a,
            "kphi": m.k_phi,
            "Gamma": m.gamma,
            "Cp": m.c_p,
            "x_r": p.x_r,
            "m11": m.m_11,
            "ms": m.m_s,
            "m12": m.m_12,
            "m22": m.m_22,
            "a11": m.a_11,
            "a12": m.a_12,
            "a22": m.a_22,
            "f1": m.f_1,
            "f2": m.f_2,
            "KL": m.k_l,
            "A_w": p.chord * p.length,
            "krot": m.k_rot,
            "mode1_Hz": first,
            "mode2_Hz": second,
        }[row["name"]]

    return {"small": value(SMALL), "large": value(LARGE)}


def slopes(row: Row) -> Results:
    """A row of rhs_vectors.csv."""
    model = DirectDrive(TYPES[row["type"]], 0.0, 0.0, dcp=row["dcp"])
    y = [float(row[name]) for name in ("phi", "psi", "phidot", "psidot")]
    return signals(model, float(row["V_V"]), float(row["Vdot_V_s"]), y) | {"ubar_m_s": model.u_bar(y)}


def signals(model: DirectDrive, volts: float, rate: float, y: Sequence[float]) -> Results:
    """Accelerations, forces, moments and current of a state."""
    sides = [1.0 if surface(0.0, y) >= 0.0 else -1.0 for surface in model.surfaces()]
    air = model.air(y, sides)
    phi_ddot, psi_ddot = model.accelerations(volts, y, air)
    added = model.added(y, (phi_ddot, psi_ddot))
    return {
        "phiddot": phi_ddot,
        "psiddot": psi_ddot,
        "F_lift_N": model.lift(y[1], air, added),
        "F_tr_lift_N": air.lift,
        "F_am_N": added.force,
        "M_tr_y_Nm": air.m_tr_y,
        "M_tr_x_Nm": air.m_tr_x,
        "M_rot_Nm": air.m_rot,
        "M_am_y2_Nm": added.m_y2,
        "M_am_x_Nm": added.m_x,
        "current_A": model.current(rate, y[2]),
    }


def trajectory(rows: Sequence[Row]) -> list[Results]:
    """Rows of traj_small_30V_209Hz_steady.csv: the periodic motion of the small type at 30 V and 209 Hz, at their
    times.
    """
    model = DirectDrive(SMALL, 30.0, 209.0)
    times = [float(row["t_s"]) for row in rows]
    motion = run(model.motion(), 0.0, max(times[-1], 1e-6), model.settled().y, at=times)
    found = []
    for t, state in zip(times, motion.samples):
        y = state.tolist()
        volts, rate = model.voltage(t)
        results = signals(model, volts, rate, y)
        results["phiddot_rad_s2"], results["psiddot_rad_s2"] = results.pop("phiddot"), results.pop("psiddot")
        results |= dict(zip(("phi_rad", "psi_rad", "phidot_rad_s", "psidot_rad_s"), y))
        found.append(
            results | {"V_V": volts, "sgn": float(np.sign(model.u_bar(y))), "power_W": volts * results["current_A"]}
        )
    return found


def impulse_fits(rows: Sequence[Row]) -> list[Results]:
    """Rows of impulse_fits.csv: the free motion after an impulse of the voltage, of the sign that drives the stroke up."""
    found = []
    for row in rows:
        p = TYPES[row["type"]]
        if row["params"] == "kw_swapped":
            p = replace(p, k_w={"small": LARGE, "large": SMALL}[row["type"]].k_w)
        model = DirectDrive(p, 0.0, 0.0)
        mode = model.modes()[0]
        push = abs(model.gamma) * float(row["impulse_Vs"])
        m_11, m_12, m_22 = model.mass(0.0)
        determinant = m_11 * m_22 - m_12 * m_12
        begin = [0.0, 0.0, m_22 * push / determinant, -m_12 * push / determinant]
        window = int(row["window_cycles_of_mode1"]) / mode
        times = np.linspace(0.0, window, int(row["n_samples"]))
        motion = np.array(run(model.motion(), 0.0, window, begin, at=times).samples)
        phi = motion[:, 0]
        f, decay, left = damped_sine(times, phi, mode)
        found.append(
            {
                "phidot0": begin[2],
                "psidot0": begin[3],
                "phi_first_peak_deg": degrees(np.abs(phi).max()),
                "psi_peak_deg": degrees(np.abs(motion[:, 1]).max()),
                "window_s": window,
                "fit_f_Hz": f,
                "fit_lambda_1_s": decay,
                "fit_rel_rms": left,
            }
        )
    return found


def damped_sine(t: Array, values: Array, mode: float) -> tuple[float, float, float]:
    """Frequency (Hz), decay (1/s) and relative root mean square of what is left of the best A e^(-lambda t) sin(2 pi f
    t + p).

    Sine and cosine of A and p are linear, so that the search is over f and lambda alone.
    """

    def left(q: Array) -> Array:
        envelope = np.exp(-q[1] * mode * t)
        waves = envelope * np.array([np.sin(2.0 * pi * q[0] * mode * t), np.cos(2.0 * pi * q[0] * mode * t)])
        factors = np.linalg.lstsq(waves.T, values, rcond=None)[0]
        return np.asarray(factors @ waves - values) / np.linalg.norm(values)

    best = least_squares(left, [1.0, 0.0], xtol=1e-15, ftol=1e-15, gtol=1e-15, x_scale=[0.01, 0.1], jac="3-point")
    return float(best.x[0] * mode), float(best.x[1] * mode), float(np.linalg.norm(best.fun))
