// The bimorph of Jafferis, Graule and Wood (2016), preset jafferis2016 of flap: docs/models/bimorph.md has the equations.
// Time is the phase of the drive (rad), states are in units of their typical sizes: all points share the phase, and one
// absolute tolerance serves all states.
#pragma once

#include <array>
#include <cmath>

namespace bimorph {

constexpr double PI = 3.14159265358979323846;

constexpr double TRANSMISSION = 3333;                                          // T (rad/m)
constexpr double TIP_SCALE = 0.1 / TRANSMISSION, PITCH_SCALE = 0.3;            // of a typical motion (m, rad)

// Actuator. STRAIN: s_ε (1/m), TAPER: G for a width ratio of 1.556 and an extension ratio of 0.25.
constexpr double LENGTH = 9e-3, WIDTH = 1.125e-3, PLATE = 135e-6, SHIM = 50e-6, EXTENSION = 1.5;
constexpr double TAPER = 0.8844130643539749;
constexpr double STRAIN = (PLATE + SHIM) / (LENGTH * LENGTH * EXTENSION);
constexpr double STIFFNESS_FACTOR = 0.79 * 0.8 * WIDTH * TAPER / (LENGTH * LENGTH * LENGTH * EXTENSION);
constexpr double PER_MODULUS = STIFFNESS_FACTOR * PLATE * (1.5 * SHIM * SHIM + 3 * SHIM * PLATE + 2 * PLATE * PLATE);
constexpr double STIFFENING = 8000 * STRAIN;                                   // a₁ s_ε (1/m)
constexpr double SOFT = PER_MODULUS * 38.5e9 + STIFFNESS_FACTOR * 340e9 / 4 * SHIM * SHIM * SHIM;  // (N/m)
constexpr double HARD = PER_MODULUS * 0.5 * (81e9 - 38.5e9) / STIFFENING;      // force of the stiffening (N)
constexpr double SIGMA = 0.022753943462804;                                    // σ(a₁ε₀)
constexpr double PER_STRESS = 3 * 0.7 * TAPER * WIDTH * PLATE * (PLATE + SHIM) / (4 * LENGTH);  // F_pre (N/Pa)
constexpr double FORCE_SLOPE = -230 * STRAIN;                                  // b (1/m)

// Transmission and wing.
constexpr double SPRING = 197.7;                                               // K_t (N/m)
constexpr double MASS = (51.1 + 10.22) * 1e-12 * TRANSMISSION * TRANSMISSION;  // m_e (kg)
constexpr double INERTIA = 0.95 * 1.29e-12, PRODUCT = 0.29 * 2.8e-12;          // I_xx, I_xz (kg m²)
constexpr double HINGE = 0.985 * 1.52e-6;                                      // κ_wh (N m/rad)
constexpr double AREA = 54.59e-6, WING = 17e-3, AIR = 0.5 * 1.2 * AREA;
constexpr double DRAG_MEAN = 0.5 * (1.25 * 3.4 + 0.39 * 0.4), DRAG_SWING = 0.5 * (1.25 * 3.4 - 0.39 * 0.4), LIFT = 1.8;
// ½ρA_w r̂₂²R²T² (kg/m)
constexpr double PRESSURE = AIR * (0.564 * WING * TRANSMISSION) * (0.564 * WING * TRANSMISSION);
constexpr double TIP_DRAG = PRESSURE * 1.42 * 9.56e-3 * TRANSMISSION;
constexpr double MOMENT = PRESSURE * AREA / WING;
constexpr double ARM_LEAST = 0.132, ARM_SWING = 0.151 - 0.132;
constexpr double HINGE_DRAG = AIR * 0.39 * 1.93e-3 * (0.43 * 4.5e-3) * (0.43 * 4.5e-3) * 1.25 * 3.4;  // C_C (N m s²)

// Tip, its rate, hinge angle, its rate: in units of their scales, and of the drive's angular frequency.
template <class Real> using State = std::array<Real, 4>;

// Their rates. Not an array: with one, GCC does not make vectors of a loop over lanes.
template <class Real> struct Rates {
    Real x, v, psi, w;
};

// Difference and sum of the forces of both plates without strain (N).
template <class Real> struct Push {
    Real difference, sum;
};

// g(V), (6).
template <class Real> inline __attribute__((always_inline)) Real plate(Real volts) {
    using std::exp;
    const Real field = volts * Real(1 / PLATE);
    const Real turned = 1 / (1 + exp(Real(10e-6) * (Real(0.4e6) - field)));
    return Real(PER_STRESS) * field * (14 + (29 - Real(29 * 69e-9) * field - 14) * turned);
}

// The plates under a drive voltage with this sine of its phase, (7).
template <class Real> inline __attribute__((always_inline)) Push<Real> push(Real volts_pp, Real sine) {
    const Real half = Real(0.5) * volts_pp;
    const Real first = plate(half - half * sine), second = plate(half + half * sine);
    return {first - second, first + second};
}

// The rates, (1) and (2), at an angular frequency of the drive (rad/s), with sine and cosine of the hinge angle.
template <class Real>
inline __attribute__((always_inline)) Rates<Real> rates(Real omega, Push<Real> push, Real x, Real v, Real psi, Real w,
                                                        Real sine, Real cosine) {
    using std::abs;
    using std::copysign;
    using std::exp;
    using std::log;
    const Real tip = Real(TIP_SCALE) * x, speed = Real(TIP_SCALE) * omega * v;
    const Real pitch = Real(PITCH_SCALE) * psi, turn = Real(PITCH_SCALE) * omega * w;
    const Real sin_2 = 2 * sine * cosine, cos_2 = 2 * cosine * cosine - 1;
    const Real flow = speed * abs(speed);
    const Real drag = Real(DRAG_MEAN) + Real(DRAG_SWING) * cos_2;

    const Real stiffening = log(1 + Real(SIGMA) * (exp(Real(STIFFENING) * abs(tip)) - 1));
    const Real elastic = Real(SOFT + SPRING) * tip + copysign(Real(HARD) * stiffening, tip);
    const Real force = push.difference - Real(FORCE_SLOPE) * tip * push.sum;
    const Real a = (force - elastic - Real(TIP_DRAG) * drag * flow) * Real(1 / MASS);

    const Real arm = Real(ARM_LEAST) + Real(ARM_SWING) * abs(1 - abs(pitch) * Real(2 / PI));
    const Real air = Real(MOMENT) * arm * (drag * cosine + Real(LIFT) * sin_2 * sine) * flow;
    const Real swing = Real(PRODUCT * TRANSMISSION) * a * cosine +
                       Real(0.5 * INERTIA * TRANSMISSION * TRANSMISSION) * speed * speed * sin_2;
    const Real spring = Real(HINGE) * pitch + Real(HINGE_DRAG) * turn * abs(turn);
    const Real alpha = (air + swing - spring) * Real(1 / INERTIA);

    const Real per_square = 1 / (omega * omega);
    return {v, a * Real(1 / TIP_SCALE) * per_square, w, alpha * Real(1 / PITCH_SCALE) * per_square};
}

}  // namespace bimorph
