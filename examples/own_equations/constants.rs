//! Constants that are computed from the numbers of Table I, and typical sizes of the states.

pub(crate) const TRANSMISSION: f64 = 3333.0; // T (rad/m)
pub(crate) const MASS: f64 = (51.1 + 10.22) * 1e-12 * TRANSMISSION * TRANSMISSION; // at the tip (kg)
pub(crate) const STIFFNESS: f64 = 395.0; // of the actuator (N/m)
pub(crate) const INERTIA: f64 = 1.2255e-12; // I_xx (kg m²)
pub(crate) const COUPLING: f64 = 0.812e-12; // I_xz (kg m²)
pub(crate) const HINGE: f64 = 1.497e-6; // κ (N m/rad)
pub(crate) const DRAG_MEAN: f64 = 0.5 * (4.25 + 0.156);
pub(crate) const DRAG_SWING: f64 = 0.5 * (4.25 - 0.156);
pub(crate) const LIFT: f64 = 1.8;
/// ½ ρ A r₂² (R T)²: aerodynamic force per coefficient and per squared speed of the actuator's tip (kg/m).
pub(crate) const PRESSURE: f64 =
    0.5 * 1.2 * 54.59e-6 * 0.564 * 0.564 * (0.017 * TRANSMISSION) * (0.017 * TRANSMISSION);
/// Drag force at the actuator's tip, divided by the drag coefficient and the squared tip speed (kg/m), Eq.
/// (8).
pub(crate) const TIP_DRAG: f64 = PRESSURE * 13.58e-3 * TRANSMISSION;
/// Aerodynamic moment about the hinge (kg), Eq. (10). The moment is divided by the squared tip speed, the
/// force coefficient, and the lever arm in mean wing widths.
pub(crate) const MOMENT: f64 = PRESSURE * 54.59e-6 / 0.017;
/// Aerodynamic damping moment about the hinge, divided by the squared pitch rate (kg m²), Eq. (11).
pub(crate) const HINGE_DRAG: f64 = 0.5 * 1.2 * 54.59e-6 * 0.753e-3 * 0.43 * 0.43 * 4.5e-3 * 4.5e-3 * 4.25;

/// Typical sizes of the states: displacement (m) and speed (m/s) of the actuator's tip, pitch (rad), pitch
/// rate (rad/s).
pub(crate) const SCALE: [f64; 4] = [1e-4, 0.1, 1.0, 1e3];
