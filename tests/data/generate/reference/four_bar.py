"""The four-bar of Arabagi, Hines and Sitti (2013). Equation numbers are the paper's; SI units and radians.

The paper's text lacks Eq. (1) to (3). docs/models/four-bar.md has the equations that replace them, and the evidence for
the corrections of the others. State: stroke theta, its rate, wing pitch phi, its rate. The wings and actuators are
assumed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import atan2, cos, degrees, hypot, pi, radians, sin, sqrt
from typing import Any

import numpy as np
from scipy.optimize import brentq

from .motion import Array, Motion, Results, Row, Surface, periodic, run, settle, unsplit, wrapped

#: Permittivity of vacuum (F/m).
EPS_0 = 8.8541878128e-12


@dataclass(frozen=True)
class Parameters:
    """The system with its first resonance at 75 Hz."""

    # Four-bar and slider-crank (m), masses of the links (kg).
    l0: float = 13.5e-3
    l1: float = 12.1e-3
    l2: float = 10e-3
    l3: float = 5e-3
    l_c: float = 3.285e-3
    l_s: float = 5e-3
    m_l: tuple[float, float, float] = (11.616e-6, 9.6e-6, 4.8e-6)
    # Series spring (N/m), hinge (N m/rad, N m s), damping of the stroke (N m s).
    k_sc: float = 1400.0
    k_rot: float = 50e-6
    d: float = 5e-9
    d_stroke: float = 2e-7
    # Drive (V, Hz).
    v_pp: float = 150.0
    v_dc: float = 50.0
    v_ref: float = 50.0
    f: float = 75.0
    # Actuator (m, Pa, m/V, kg/m³).
    act_l: float = 16e-3
    act_w: float = 18e-3
    h_p: float = 127e-6
    h_s: float = 76e-6
    e_p: float = 62e9
    e_s: float = 193e9
    d31: float = 320e-12
    rho_p: float = 7800.0
    rho_s: float = 7900.0
    eps_r: float = 3800.0
    # Wing (m, kg, kg m²).
    r0: float = 4e-3
    l_w: float = 24e-3
    c0: float = 8.3e-3
    chord: tuple[float, ...] = (1.0, 1.0, 0.0, 0.0, -2.0)
    m_w: float = 9.577e-6
    r_cg: float = 15.22e-3
    beta: float = 1.569e-3
    j_xx: float = 8.333e-11
    j_yy: float = 4.269e-10
    j_zz: float = 3.436e-10
    j_xz: float = -8.38e-12
    # Air.
    rho: float = 1.2
    c_rot: float = 2.0
    chi: float = 0.25
    # Readings: where arms are measured from in (8) and (17), the sign of the second term of (7).
    arms: str = "printed"
    am_sign: str = "consistent"
    quad: str = "gauss"
    n: int = 16


SYS75 = Parameters()
SYS30 = Parameters(
    l_c=2.1e-3,
    k_rot=20e-6,
    d=10e-9,
    v_pp=180.0,
    v_dc=30.0,
    v_ref=30.0,
    f=30.0,
    act_l=18e-3,
    r0=5e-3,
    l_w=32e-3,
    c0=10e-3,
    m_w=1.2803e-5,
    r_cg=19.96e-3,
    beta=1.533e-3,
    j_xx=1.911e-10,
    j_yy=1.0273e-9,
    j_zz=8.362e-10,
    j_xz=-1.682e-11,
)
SYSTEMS = {"sys75": SYS75, "sys30": SYS30}

Vector = tuple[float, float]


def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1]


def cross(a: Vector, b: Vector) -> float:
    return a[0] * b[1] - a[1] * b[0]


def add(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    return a[0] + factor * b[0], a[1] + factor * b[1]


@dataclass(frozen=True)
class Linkage:
    """The mechanism at one stroke: positions and their derivatives with respect to theta."""

    a: tuple[Vector, Vector, Vector]
    b: tuple[Vector, Vector, Vector]
    theta_1: tuple[float, float]
    theta_2: tuple[float, float, float]


def linkage(p: Parameters, psi: float) -> Linkage:
    """The four-bar with its pivots at (0, 0) and (L0, 0), for the angle psi of the output link."""
    b: Vector = (p.l0 + p.l3 * cos(psi), p.l3 * sin(psi))
    b_1: Vector = (-p.l3 * sin(psi), p.l3 * cos(psi))
    b_2: Vector = (-p.l3 * cos(psi), -p.l3 * sin(psi))
    d = hypot(*b)
    along = (p.l1**2 - p.l2**2 + d * d) / (2.0 * d)
    height = sqrt(p.l1**2 - along**2)
    u = (b[0] / d, b[1] / d)
    a: Vector = (along * u[0] - height * u[1], along * u[1] + height * u[0])
    # The coupler keeps its length: (B - A).(B' - A') = 0, and A' = n theta_1'.
    w, n = add(b, a, -1.0), (-a[1], a[0])
    t_1 = dot(w, b_1) / dot(w, n)
    a_1 = (n[0] * t_1, n[1] * t_1)
    apart = add(b_1, a_1, -1.0)
    t_2 = (dot(apart, apart) + dot(w, add(b_2, a, t_1 * t_1))) / dot(w, n)
    a_2 = (n[0] * t_2 - a[0] * t_1 * t_1, n[1] * t_2 - a[1] * t_1 * t_1)
    square = p.l2**2
    coupler = atan2(w[1], w[0]), cross(w, apart) / square, cross(w, add(b_2, a_2, -1.0)) / square
    return Linkage((a, a_1, a_2), (b, b_1, b_2), (t_1, t_2), coupler)


@dataclass(frozen=True)
class Transmission:
    """Turn of the input link from neutral, displacement delta of the slider and inertia G, with derivatives by theta."""

    links: Linkage
    eta: float
    delta: tuple[float, float, float]
    g: float
    half_dg: float


class FourBar:
    """The equations with the constants of one design point."""

    def __init__(self, p: Parameters) -> None:
        self.p = p
        # Unimorph: neutral axis, bending stiffness per width, free deflection per volt, blocking force per volt.
        z_p, z_s = p.h_s + p.h_p / 2.0, p.h_s / 2.0
        z_c = (p.e_p * p.h_p * z_p + p.e_s * p.h_s * z_s) / (p.e_p * p.h_p + p.e_s * p.h_s)
        stiff = p.e_p * (p.h_p**3 / 12.0 + p.h_p * (z_p - z_c) ** 2) + p.e_s * (
            p.h_s**3 / 12.0 + p.h_s * (z_s - z_c) ** 2
        )
        self.k_a = 3.0 * stiff * p.act_w / p.act_l**3
        self.gamma = p.e_p * p.d31 * (z_p - z_c) / stiff * p.act_l**2 / 2.0
        self.coupling = self.k_a * self.gamma
        area = p.act_w * p.act_l
        self.m_eff = 33.0 / 140.0 * area * (p.rho_p * p.h_p + p.rho_s * p.h_s)
        self.k_eff = self.k_a * p.k_sc / (self.k_a + p.k_sc)
        clamped = (p.eps_r * EPS_0 - p.d31**2 * p.e_p) / p.h_p + p.d31**2 * p.e_p**2 / (p.e_p * p.h_p + p.e_s * p.h_s)
        self.c_b = area * clamped + p.d31**2 * p.e_p**2 * (z_p - z_c) ** 2 * area / (4.0 * stiff)
        # Neutral: the transmission theta_1' is largest.
        self.psi_n = float(brentq(lambda psi: linkage(p, psi).theta_1[1], radians(30.0), radians(80.0), xtol=1e-15))
        a = linkage(p, self.psi_n).a[0]
        self.neutral: Vector = (a[0] / p.l1, a[1] / p.l1)
        self.j_l = [m * length**2 / 12.0 for m, length in zip(p.m_l, (p.l1, p.l2, p.l3))]
        # Strips.
        if p.quad == "gauss":
            nodes, weights = np.polynomial.legendre.leggauss(p.n)
        else:
            nodes, weights = (2.0 * np.arange(p.n) + 1.0) / p.n - 1.0, np.full(p.n, 2.0 / p.n)
        x, dr = 0.5 * (nodes + 1.0), 0.5 * weights * p.l_w
        r = p.r0 + p.l_w * x
        c = p.c0 * np.polynomial.polynomial.polyval(x, p.chord)
        self.r, self.c, self.c_dr = r, c, 0.5 * p.rho * c * dr
        # (8), (17): the arm of the velocity in chords, and the origin of the centre of pressure.
        self.kappa, self.origin = {"printed": (0.5, 0.0), "axis": (0.5 - p.chi, p.chi)}[p.arms]
        # (6), (18): rotational moments; (7): added mass.
        i_1, i_2 = ((1.0 - p.chi) ** 3 - p.chi**3) / 3.0, ((1.0 - p.chi) ** 4 + p.chi**4) / 4.0
        self.f_1 = i_1 * float(np.sum(c**3 * dr))
        self.f_1r = i_1 * float(np.sum(r * c**3 * dr))
        self.f_2 = i_2 * float(np.sum(c**4 * dr))
        self.am_1 = pi * p.rho / 4.0 * float(np.sum(r * c**2 * dr))
        self.am_2 = (
            pi * p.rho / 4.0 * (0.5 - p.chi) * float(np.sum(c**3 * dr)) * (-1.0 if p.am_sign == "printed" else 1.0)
        )
        # (13), (19).
        m = p.m_w + pi * p.rho / 4.0 * float(np.sum(c**2 * dr))
        self.product = m * p.r_cg * p.beta + p.j_xz
        self.j_phi = m * p.beta**2 + p.j_xx
        self.j_d = m * p.beta**2 + p.j_yy - p.j_zz
        self.m_r2, self.m_beta2 = m * p.r_cg**2, m * p.beta**2

    def transmission(self, theta: float) -> Transmission:
        p = self.p
        links = linkage(p, self.psi_n + theta)
        (a, a_1, a_2), (_, b_1, b_2) = links.a, links.b
        t_1, t_2 = links.theta_1
        cos_eta, sin_eta = dot(a, self.neutral) / p.l1, cross(self.neutral, a) / p.l1
        # Slider-crank: the rod is offset by e, and spans g of the slider's line.
        e, e_1, e_2 = p.l_c * (1.0 - cos_eta), p.l_c * sin_eta, p.l_c * cos_eta
        g = sqrt(p.l_s**2 - e * e)
        g_1 = -e * e_1 / g
        g_2 = -(e_1 * e_1 + e * e_2) / g - (e * e_1) ** 2 / g**3
        slope, bend = p.l_c * cos_eta - g_1, -p.l_c * sin_eta - g_2
        delta = (p.l_c * sin_eta + p.l_s - g, slope * t_1, bend * t_1 * t_1 + slope * t_2)
        # (13): the middles of the links are A/2, (A + B)/2 and (O3 + B)/2; link 3 turns with theta.
        first = [(0.5 * a_1[i], 0.5 * (a_1[i] + b_1[i]), 0.5 * b_1[i]) for i in range(2)]
        second = [(0.5 * a_2[i], 0.5 * (a_2[i] + b_2[i]), 0.5 * b_2[i]) for i in range(2)]
        inertia = (
            self.j_l[0] * t_1 * t_1 + self.j_l[1] * links.theta_2[1] ** 2 + self.j_l[2] + self.m_eff * delta[1] ** 2
        )
        half = (
            self.j_l[0] * t_1 * t_2
            + self.j_l[1] * links.theta_2[1] * links.theta_2[2]
            + self.m_eff * delta[1] * delta[2]
        )
        for k, mass in enumerate(p.m_l):
            inertia += mass * (first[0][k] ** 2 + first[1][k] ** 2)
            half += mass * (first[0][k] * second[0][k] + first[1][k] * second[1][k])
        return Transmission(links, atan2(sin_eta, cos_eta), delta, inertia, half)

    def voltage(self, t: float) -> tuple[float, float]:
        """The voltage and its rate."""
        p, omega = self.p, 2.0 * pi * self.p.f
        return p.v_dc + 0.5 * p.v_pp * sin(omega * t), 0.5 * p.v_pp * omega * cos(omega * t)

    def force(self, volts: float, delta: float) -> float:
        """The force on the crank, (1): actuator and series spring push from the voltage of rest."""
        return self.k_eff * (self.gamma * (volts - self.p.v_ref) - delta)

    def translation(
        self, theta_dot: float, phi: float, phi_dot: float, sides: Sequence[float]
    ) -> tuple[float, float, float]:
        """Lift and the moments about both axes, (5), (8) to (10), (16), (17).

        `sides` are those of phi, of cos phi and of each strip's velocity. The angle of attack of a strip that moves
        with the sign s is alpha = 90 deg + s phi. Folded into 0 to 90 deg it is the same for both signs.
        """
        side, up, s = sides[0], sides[1], np.array(sides[2:])
        # (8): horizontal velocity at the arm kappa c.
        u = self.r * theta_dot + self.kappa * phi_dot * cos(phi) * self.c
        folded = up * (0.5 * pi - side * phi)
        c_l = 0.225 + 1.58 * sin(radians(2.13 * degrees(folded) - 7.2))
        c_d = 1.92 - 1.55 * cos(radians(2.04 * degrees(folded) - 9.82))
        # Lift up, and push against the motion; both have the sign of u.
        pressure = self.c_dr * u * u * s
        lift, push = -c_l * side * up * pressure, -c_d * pressure
        attack = np.where(s * side > 0.0, pi - folded, folded)
        arm = (0.82 / pi * attack + 0.05 - self.origin) * self.c
        moment = arm @ (push * cos(phi) + lift * sin(phi))
        return float(lift.sum()), float(self.r @ push), float(moment)

    def strip_surfaces(self, theta_dot: Callable[[float, Any], float], phi: int) -> list[Surface]:
        """The velocities (8) of the strips, whose signs turn their forces; the state has phi and its rate at the index
        `phi`.
        """

        def surface(r: float, arm: float) -> Surface:
            return lambda t, y: r * theta_dot(t, y) + arm * y[phi + 1] * cos(y[phi])

        return [surface(r, arm) for r, arm in zip(self.r.tolist(), (self.kappa * self.c).tolist())]

    def rotation(self, phi: float, phi_dot: float, side: float) -> tuple[float, float, float]:
        """Lift and the moments about both axes, (6) and (18)."""
        k = -0.5 * self.p.c_rot * self.p.rho * side * phi_dot * phi_dot
        return k * self.f_1 * sin(phi), k * self.f_1r * cos(phi), k * self.f_2

    def added_lift(self, y: Sequence[float], accelerations: Sequence[float]) -> float:
        """(7): the lift of the added mass."""
        _, theta_dot, phi, phi_dot = y
        theta_ddot, phi_ddot = accelerations
        stroke = theta_ddot * cos(phi) - theta_dot * phi_dot * sin(phi)
        return -(self.am_1 * stroke + self.am_2 * phi_ddot) * sin(phi)

    def mass(self, phi: float, g: float) -> tuple[float, float, float]:
        """The mass matrix of (14) and (15)."""
        stroke = self.m_r2 + (self.m_beta2 + self.p.j_yy) * sin(phi) ** 2 + self.p.j_zz * cos(phi) ** 2 + g
        return stroke, self.product * cos(phi), self.j_phi

    def accelerations(
        self, volts: float, y: Sequence[float], sides: Sequence[float], at: Transmission | None = None
    ) -> tuple[float, float]:
        """(14) and (15): `sides` are those of the surfaces of `motion`."""
        p = self.p
        theta, theta_dot, phi, phi_dot = y
        at = at or self.transmission(theta)
        _, q_theta, q_phi = self.translation(theta_dot, phi, phi_dot, sides[2:])
        _, r_theta, r_phi = self.rotation(phi, phi_dot, sides[1])
        m_11, m_12, m_22 = self.mass(phi, at.g)
        drive = self.force(volts, at.delta[0]) * at.delta[1]
        right_1 = (
            drive
            + q_theta
            + r_theta
            - p.d_stroke * theta_dot
            + self.product * sin(phi) * phi_dot**2
            - self.j_d * sin(2.0 * phi) * theta_dot * phi_dot
            - at.half_dg * theta_dot**2
        )
        right_2 = q_phi + r_phi - p.d * phi_dot - p.k_rot * phi + 0.5 * self.j_d * sin(2.0 * phi) * theta_dot**2
        determinant = m_11 * m_22 - m_12 * m_12
        return (m_22 * right_1 - m_12 * right_2) / determinant, (m_11 * right_2 - m_12 * right_1) / determinant

    def rates(self, t: float, y: Sequence[float], sides: Sequence[float]) -> Sequence[float]:
        theta_ddot, phi_ddot = self.accelerations(self.voltage(t)[0], y, sides)
        return (y[1], theta_ddot, y[3], phi_ddot)

    def motion(self) -> Motion:
        surfaces: list[Surface] = [
            lambda t, y: y[1],
            lambda t, y: y[3],
            lambda t, y: y[2],
            lambda t, y: cos(y[2]),
            *self.strip_surfaces(lambda t, y: y[1], 2),
        ]
        omega = 2.0 * pi * self.p.f
        return Motion(self.rates, surfaces, scale=(0.3, 0.3 * omega, 0.5, 0.5 * omega))

    def integrands(self, t: float, y: Sequence[float], sides: Sequence[float]) -> Sequence[float]:
        p = self.p
        theta, theta_dot, phi, phi_dot = y
        volts, rate = self.voltage(t)
        at = self.transmission(theta)
        accelerations = self.accelerations(volts, y, sides, at)
        lift, q_theta, q_phi = self.translation(theta_dot, phi, phi_dot, sides[2:])
        lift_rot, r_theta, r_phi = self.rotation(phi, phi_dot, sides[1])
        drive = self.force(volts, at.delta[0]) * at.delta[1] * theta_dot
        # Reciprocity: the charge is C_b V + coupling * tip displacement, which is delta plus the stretch of the series
        # spring.
        tip = at.delta[1] * theta_dot + self.k_eff * (self.gamma * rate - at.delta[1] * theta_dot) / p.k_sc
        current = self.c_b * rate + self.coupling * tip
        wave = 2.0 * pi * p.f * t
        return (
            lift,
            lift_rot,
            self.added_lift(y, accelerations),
            drive,
            p.d_stroke * theta_dot**2,
            p.d * phi_dot**2,
            -(q_theta * theta_dot + q_phi * phi_dot),
            -(r_theta * theta_dot + r_phi * phi_dot),
            volts * current,
            theta,
            phi,
            theta * cos(wave),
            theta * sin(wave),
            phi * cos(wave),
            phi * sin(wave),
        )


def point(row: Row) -> Parameters:
    """The design point of a row of steady_cases.csv."""
    return replace(
        SYSTEMS[row["system"]],
        quad=row["quad"],
        n=int(row["N"]),
        f=float(row["f_Hz"]),
        v_pp=float(row["Vpp_V"]),
        v_dc=float(row["Vdc_V"]),
        v_ref=float(row["Vref_V"]),
        k_rot=float(row["krot_Nm"]),
        k_sc=float(row["ksc_N_m"]),
        d=float(row["d_Nms"]),
        d_stroke=float(row["D_Nms"]),
        arms=row["arms"],
        am_sign=row["am_sign"],
    )


def steady(row: Row) -> Results:
    """A row of steady_cases.csv."""
    model = FourBar(point(row))
    period, motion = 1.0 / model.p.f, model.motion()
    orbit = periodic(motion, period, settle(motion, period, np.zeros(4)))
    cycle = run(motion, 0.0, period, orbit.y, integrands=model.integrands)
    mean = cycle.integrals / period
    theta_min, theta_max = cycle.extremes(0, lambda y: float(y[0]))
    phi_min, phi_max = cycle.extremes(1, lambda y: float(y[2]))
    theta_1, phi_1 = 2.0 * complex(mean[11], -mean[12]), 2.0 * complex(mean[13], -mean[14])
    return {
        "theta_pp_rad": theta_max - theta_min,
        "phi_pp_rad": phi_max - phi_min,
        "theta_mean_rad": mean[9],
        "phi_mean_rad": mean[10],
        "theta1_rad": abs(theta_1),
        "phi1_rad": abs(phi_1),
        "phase_lag_deg": float(np.angle(theta_1 / phi_1, deg=True)) % 360.0,
        "theta1_arg_deg": wrapped(float(np.angle(theta_1, deg=True))),
        "lift_mean_N": mean[0] + mean[1] + mean[2],
        "lift_trans_N": mean[0],
        "lift_rot_N": mean[1],
        "lift_addmass_N": mean[2],
        "P_drive_W": mean[3],
        "P_flapdamp_W": mean[4],
        "P_hingedamp_W": mean[5],
        "P_aero_trans_W": mean[6],
        "P_aero_rot_W": mean[7],
        "P_elec_W": mean[8],
        "energy_audit_rel": (mean[3] - mean[4:8].sum()) / mean[3],
        "y0_theta": orbit.y[0],
        "y0_thetadot": orbit.y[1],
        "y0_phi": orbit.y[2],
        "y0_phidot": orbit.y[3],
        "poincare_resid": orbit.residual,
    }


def again(row: Row, results: Results) -> Results:
    """The distance by which a state of steady_cases.csv misses itself after one period of RK45, which locates no
    surfaces.
    """
    model = FourBar(point(row))
    begin = np.array([results[name] for name in ("y0_theta", "y0_thetadot", "y0_phi", "y0_phidot")])
    return missed(model.motion(), 1.0 / model.p.f, begin, "RK45")


def missed(motion: Motion, period: float, begin: Array, method: str) -> Results:
    return {"max_rel_dev_2nd_solver": motion.distance(unsplit(motion, 0.0, period, begin, method, 1e-10).y, begin)}


class Prescribed:
    """The passive pitch of a wing whose stroke is theta = Theta sin(omega t)."""

    def __init__(self, p: Parameters, amplitude: float) -> None:
        self.wing, self.p, self.amplitude, self.omega = FourBar(p), p, amplitude, 2.0 * pi * p.f

    def stroke(self, t: float) -> tuple[float, float, float]:
        size, wave = self.amplitude, self.omega * t
        return size * sin(wave), size * self.omega * cos(wave), -size * self.omega**2 * sin(wave)

    def acceleration(self, t: float, y: Sequence[float], sides: Sequence[float]) -> float:
        """(14) for a given theta."""
        phi, phi_dot = y
        _, theta_dot, theta_ddot = self.stroke(t)
        wing, p = self.wing, self.p
        moment = wing.translation(theta_dot, phi, phi_dot, sides[1:])[2] + wing.rotation(phi, phi_dot, sides[0])[2]
        moment += 0.5 * wing.j_d * sin(2.0 * phi) * theta_dot**2 - wing.product * cos(phi) * theta_ddot
        return (moment - p.d * phi_dot - p.k_rot * phi) / wing.j_phi

    def rates(self, t: float, y: Sequence[float], sides: Sequence[float]) -> Sequence[float]:
        return (y[1], self.acceleration(t, y, sides))

    def motion(self) -> Motion:
        surfaces: list[Surface] = [
            lambda t, y: y[1],
            lambda t, y: y[0],
            lambda t, y: cos(y[0]),
            *self.wing.strip_surfaces(lambda t, y: self.stroke(t)[1], 0),
        ]
        return Motion(self.rates, surfaces, scale=(0.5, 0.5 * self.omega))

    def integrands(self, t: float, y: Sequence[float], sides: Sequence[float]) -> Sequence[float]:
        phi, phi_dot = y
        theta, theta_dot, theta_ddot = self.stroke(t)
        added = self.wing.added_lift((theta, theta_dot, phi, phi_dot), (theta_ddot, self.acceleration(t, y, sides)))
        return (
            self.wing.translation(theta_dot, phi, phi_dot, sides[1:])[0],
            self.wing.rotation(phi, phi_dot, sides[0])[0],
            added,
            phi,
            phi * cos(self.omega * t),
            phi * sin(self.omega * t),
        )


def prescribed(row: Row) -> Prescribed:
    """The design point of a row of rotation_only.csv."""
    p = replace(
        SYSTEMS[row["system"]],
        quad=row["quad"],
        n=int(row["N"]),
        f=float(row["f_Hz"]),
        arms=row["arms"],
        k_rot=float(row["krot_Nm"]),
        d=float(row["d_Nms"]),
    )
    return Prescribed(p, float(row["Theta_rad"]))


def rotation_only(row: Row) -> Results:
    """A row of rotation_only.csv: the stroke is prescribed."""
    model = prescribed(row)
    period, motion = 1.0 / model.p.f, model.motion()
    orbit = periodic(motion, period, settle(motion, period, np.zeros(2)))
    cycle = run(motion, 0.0, period, orbit.y, integrands=model.integrands)
    mean = cycle.integrals / period
    phi_min, phi_max = cycle.extremes(0, lambda y: float(y[0]))
    phi_1 = 2.0 * complex(mean[4], -mean[5])
    return {
        "phi_pp_rad": phi_max - phi_min,
        "phi1_rad": abs(phi_1),
        # The first harmonic of the stroke is -i Theta.
        "phase_lag_deg": float(np.angle(-1j / phi_1, deg=True)) % 360.0,
        "phi_mean_rad": mean[3],
        "lift_mean_N": mean[0] + mean[1] + mean[2],
        "lift_trans_N": mean[0],
        "lift_rot_N": mean[1],
        "lift_addmass_N": mean[2],
        "phi0": orbit.y[0],
        "phidot0": orbit.y[1],
        "poincare_resid": orbit.residual,
    }


def rotation_again(row: Row, results: Results) -> Results:
    """The distance by which a state of rotation_only.csv misses itself after one period of Radau."""
    model = prescribed(row)
    return missed(model.motion(), 1.0 / model.p.f, np.array([results["phi0"], results["phidot0"]]), "Radau")


def kinematics(row: Row) -> Results:
    """A row of kinematics_vectors.csv."""
    at = FourBar(SYSTEMS[row["system"]]).transmission(float(row["theta"]))
    links = at.links
    return {
        "theta1_minus_neutral": at.eta,
        "theta1_p": links.theta_1[0],
        "theta1_pp": links.theta_1[1],
        "theta2": links.theta_2[0],
        "theta2_p": links.theta_2[1],
        "theta2_pp": links.theta_2[2],
        "delta": at.delta[0],
        "delta_p": at.delta[1],
        "delta_pp": at.delta[2],
        "G": at.g,
        "half_dG": at.half_dg,
    }


def slopes(row: Row) -> Results:
    """A row of rhs_vectors.csv: the drive is that of the system at the time `t`."""
    model = FourBar(replace(SYSTEMS[row["system"]], arms=row["arms"], quad=row["quad"], n=int(row["N"])))
    y = [float(row[name]) for name in ("theta", "theta_dot", "phi", "phi_dot")]
    theta, theta_dot, phi, phi_dot = y
    sides = [1.0 if surface(0.0, y) >= 0.0 else -1.0 for surface in model.motion().surfaces]
    volts = model.voltage(float(row["t"]))[0]
    at = model.transmission(theta)
    accelerations = model.accelerations(volts, y, sides, at)
    lift, q_theta, q_phi = model.translation(theta_dot, phi, phi_dot, sides[2:])
    lift_rot, r_theta, r_phi = model.rotation(phi, phi_dot, sides[1])
    m_11, m_12, m_22 = model.mass(phi, at.g)
    kinetic = m_11 * theta_dot**2 + 2.0 * m_12 * theta_dot * phi_dot + m_22 * phi_dot**2
    return {
        "theta_ddot": accelerations[0],
        "phi_ddot": accelerations[1],
        "M_drive": model.force(volts, at.delta[0]) * at.delta[1],
        "Qth_trans": q_theta,
        "Qphi_trans": q_phi,
        "Qth_rot": r_theta,
        "Qphi_rot": r_phi,
        "lift_trans": lift,
        "lift_rot": lift_rot,
        "lift_addmass": model.added_lift(y, accelerations),
        "M11": m_11,
        "M12": m_12,
        "M22": m_22,
        "energy": 0.5 * (kinetic + model.p.k_rot * phi**2 + model.k_eff * at.delta[0] ** 2),
    }


def transient(rows: Sequence[Row]) -> list[Results]:
    """Rows of transient_sys75.csv: the motion from rest at their times."""
    times = [float(row["t"]) for row in rows]
    found = run(FourBar(SYS75).motion(), 0.0, times[-1], np.zeros(4), at=times)
    return [dict(zip(("theta", "theta_dot", "phi", "phi_dot"), y.tolist())) for y in found.samples]
