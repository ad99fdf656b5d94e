// The reference equations: a bimorph of Jafferis, Graule and Wood (2016) with constant stiffness and a sinusoidal force,
// as in examples/own_equations. States are in units of their typical sizes, so that one absolute tolerance serves all.
#pragma once

#include <array>
#include <cmath>

namespace model {

constexpr double PI = 3.14159265358979323846;
constexpr int PERIODS = 40;           // from rest
constexpr int MEASURED = 5;           // the last of them
constexpr int SAMPLES_PER_PERIOD = 64;

constexpr double X_SCALE = 1e-4;      // tip of the actuator (m)
constexpr double V_SCALE = 0.1;       // its rate (m/s)
constexpr double W_SCALE = 1e3;       // rate of the hinge angle (rad/s)

constexpr double TRANSMISSION = 3333;                                            // T (rad/m)
constexpr double MASS = (51.1 + 10.22) * 1e-12 * TRANSMISSION * TRANSMISSION;    // at the tip (kg)
constexpr double STIFFNESS = 395;                                                // of the actuator (N/m)
constexpr double INERTIA = 1.2255e-12;                                           // I_xx (kg m²)
constexpr double COUPLING = 0.812e-12;                                           // I_xz (kg m²)
constexpr double HINGE = 1.497e-6;                                               // κ (N m/rad)
constexpr double DRAG_MEAN = 0.5 * (4.25 + 0.156);
constexpr double DRAG_SWING = 0.5 * (4.25 - 0.156);
constexpr double LIFT = 1.8;
constexpr double ARM_LEAST = 0.132, ARM_SWING = 0.151 - 0.132;
// ½ ρ A r₂² (R T)²: pressure on the wing per squared tip speed (kg/m).
constexpr double PRESSURE =
    0.5 * 1.2 * 54.59e-6 * 0.564 * 0.564 * (0.017 * TRANSMISSION) * (0.017 * TRANSMISSION);
constexpr double TIP_DRAG = PRESSURE * 13.58e-3 * TRANSMISSION;
constexpr double MOMENT = PRESSURE * 54.59e-6 / 0.017;
constexpr double HINGE_DRAG = 0.5 * 1.2 * 54.59e-6 * 0.753e-3 * 0.43 * 0.43 * 4.5e-3 * 4.5e-3 * 4.25;

// Tip, its rate, hinge angle, its rate.
template <class Real> using State = std::array<Real, 4>;

// Their rates. Not an array: with one, GCC does not make vectors of a loop over lanes.
template <class Real> struct Rates {
    Real x, v, psi, w;
};

// The rates under this force, with sine and cosine of the hinge angle.
template <class Real>
inline __attribute__((always_inline)) Rates<Real> rates(Real force, Real x, Real v, Real psi, Real w, Real sine,
                                                        Real cosine) {
    using std::abs;
    v *= Real(V_SCALE);
    w *= Real(W_SCALE);
    const Real sin_2psi = 2 * sine * cosine, cos_2psi = 1 - 2 * sine * sine;
    const Real speed = v * abs(v);
    const Real drag = Real(DRAG_MEAN) + Real(DRAG_SWING) * cos_2psi;
    const Real a = (force - Real(STIFFNESS * X_SCALE) * x - Real(TIP_DRAG) * drag * speed) * Real(1 / MASS);
    const Real arm = Real(ARM_LEAST) + Real(ARM_SWING) * abs(1 - abs(psi) * Real(2 / PI));
    const Real air = Real(MOMENT) * arm * (drag * cosine + Real(LIFT) * sin_2psi * sine) * speed;
    const Real swing =
        (Real(COUPLING * TRANSMISSION) * a + Real(INERTIA * TRANSMISSION * TRANSMISSION) * v * v * sine) * cosine;
    const Real spring = Real(HINGE) * psi + Real(HINGE_DRAG) * w * abs(w);
    const Real alpha = (air + swing - spring) * Real(1 / INERTIA);
    return {v * Real(1 / X_SCALE), a * Real(1 / V_SCALE), w, alpha * Real(1 / W_SCALE)};
}

}  // namespace model
