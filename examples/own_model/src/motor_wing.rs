//! A wing on the shaft of a motor, with a spring. The states are the flap angle, the flap rate, and the
//! current of the motor. The pitch is not a state, because the flap rate determines the pitch.
//!
//! Park and Abolfathi, "Direct Drive Design and Operational Performance Analysis of an Insect-Sized Flapping-Wing Micro
//! Air Vehicle" (2024). The equations and numbers are from the public repository of the paper,
//! saatvikbasil/UCL-MicroFlapping.
//!
//! ```text
//! L_a di/dt = V sin ωt − R_a i − K_b β̇
//! J β̈ = K_t i − b_m β̇ − K β − (I₃ C_D + I₄) β̇|β̇|
//! ```

mod columns;
mod params;

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use flap_core::drive::{Drive, DriveConstants, Wave, WaveformParameters};
use flap_core::model::{Derived, Description, Instant, Model, SignalCycle};
use flap_core::num::Real;
use flap_core::ode::{Ode, Start};
use flap_core::parameter::Invalid;
use flap_core::quadrature::gauss_legendre;

use columns::Signals;
pub(crate) use params::Params;

/// The model of a motor-driven wing. All points use the same form of the equations, so the model has no
/// choices.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MotorWing;

flap_core::per_lane! {
    /// Constants of a point. Each SIMD lane computes one point with its own constants.
    pub struct Constants<R> {
        /// Drive voltage.
        pub drive: DriveConstants<R>,
        /// R_a (Ω).
        pub resistance: R,
        /// 1/L_a (1/H).
        pub inverse_inductance: R,
        /// K_b (V·s/rad).
        pub back_emf: R,
        /// K_t (N·m/A).
        pub torque: R,
        /// b_m (N·m·s/rad).
        pub bearing_damping: R,
        /// K (N·m/rad).
        pub stiffness: R,
        /// J (kg·m²).
        pub inertia: R,
        /// I₂ (kg·m): lift divided by the lift coefficient and the squared flap rate.
        pub lift_moment: R,
        /// I₃ (kg·m²): drag torque divided by the drag coefficient and the squared flap rate.
        pub drag_moment: R,
        /// I₄ (kg·m²): torque on the rotating chord divided by the squared flap rate.
        pub rotation_moment: R,
        /// C_α (s): decrease of the attack angle divided by the magnitude of the flap rate.
        pub attack_slope: R,
    }
}

/// Returns ∫ f(r, c) dr over the span of a wing, where r is the radius and c is the chord. The wing begins at
/// the radius `root` (m).
///
/// The outline of the wing is a quarter of an ellipse: c = `chord` √(1 − x²) (m) at r = root + x · length,
/// with x = sin θ.
fn over_wing(root: f64, length: f64, chord: f64, f: impl Fn(f64, f64) -> f64) -> f64 {
    let value = |theta: f64| {
        let (sin, cos) = theta.sin_cos();
        length * cos * f(root + length * sin, chord * cos)
    };
    FRAC_PI_2 * gauss_legendre(12).iter().map(|node| node.weight * value(FRAC_PI_2 * node.x)).sum::<f64>()
}

impl Constants<f64> {
    fn derive(p: &Params) -> Result<Constants<f64>, Invalid> {
        let root = 0.5 * p.base_length;
        let chord = p.root_chord.unwrap_or(p.wing_length / 3.0);
        let integral = |f: fn(f64, f64) -> f64| over_wing(root, p.wing_length, chord, f);
        let (r2_c, r3_c) = (integral(|r, c| r.powi(2) * c), integral(|r, c| r.powi(3) * c));

        // J_w: base, leading edge and root spar of carbon, and the membrane at its radius of gyration.
        let (base, spar) = (p.base_width * p.base_height, p.spar_section);
        let membrane_radius = r3_c / r2_c;
        let membrane = p.membrane_density * p.membrane_thickness * FRAC_PI_4 * chord * p.wing_length;
        let wing_inertia = p.spar_density * base * p.base_length.powi(3) / 3.0
            + p.spar_density * spar * p.wing_length * (p.wing_length + root).powi(2) / 3.0
            + p.spar_density * spar * chord * root.powi(2) / 3.0
            + membrane * membrane_radius.powi(2);
        let added_inertia = FRAC_PI_4 * p.air_density * integral(|r, c| (r * c).powi(2));
        let inertia = p.rotor_inertia + wing_inertia + added_inertia;

        let drive = DriveConstants::new(p.drive_frequency, &WaveformParameters::SINE, [0.0, p.drive_voltage]);
        let constants = Constants {
            resistance: p.resistance,
            inverse_inductance: 1.0 / p.inductance,
            back_emf: p.back_emf_constant.unwrap_or(p.torque_constant),
            torque: p.torque_constant,
            bearing_damping: p.bearing_damping,
            stiffness: p.spring_stiffness.unwrap_or(inertia * drive.rate * drive.rate),
            inertia,
            lift_moment: 0.5 * p.air_density * r2_c,
            drag_moment: 0.5 * p.air_density * r3_c,
            rotation_moment: 5.0 * 0.5 * p.air_density * integral(|_, c| c.powi(4)) / 8.0,
            attack_slope: p.attack_slope,
            drive,
        };
        Invalid::unless_finite(constants)
    }
}

impl<R: Real> Constants<R> {
    /// Returns the attack angle (rad) at a flap rate. The attack angle is 90° at rest, decreases with the
    /// flap rate, and is never below 45°.
    #[inline(always)]
    fn attack(&self, rate: R) -> R {
        let falling = self.attack_slope.mul_add(-rate.abs(), rate.lit(FRAC_PI_2));
        falling.max(rate.lit(FRAC_PI_4))
    }

    /// Returns the lift (N) at a flap rate.
    #[inline(always)]
    fn lift(&self, rate: R) -> R {
        let angle = self.attack(rate) * 2.13 + (-0.1257);
        let coefficient = angle.sin() * 1.58 + 0.225;
        self.lift_moment * coefficient * rate * rate
    }

    /// Returns the aerodynamic torque (N·m) at a flap rate. The aerodynamic torque opposes the motion.
    #[inline(always)]
    fn air_torque(&self, rate: R) -> R {
        let angle = self.attack(rate) * 2.04 + (-0.1714);
        let coefficient = angle.sin_cos().1 * -1.55 + 1.92;
        self.drag_moment.mul_add(coefficient, self.rotation_moment) * rate * rate.abs()
    }
}

impl Ode<3> for MotorWing {
    type Constants<R: Real> = Constants<R>;
    type Input<R: Real> = Wave<R>;

    #[inline(always)]
    fn input<R: Real>(&self, c: &Constants<R>, t: R) -> Wave<R> {
        Drive::SINE.at(&c.drive, t)
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, c: &Constants<R>, voltage: &Wave<R>, _side: R, y: &[R; 3]) -> [R; 3] {
        let [flap, rate, current] = *y;
        let torque = c.torque * current - c.bearing_damping * rate - c.stiffness * flap - c.air_torque(rate);
        let driving = voltage.value - c.resistance * current - c.back_emf * rate;
        [rate, torque / c.inertia, driving * c.inverse_inductance]
    }
}

impl Model<3> for MotorWing {
    type Signals = Signals;

    const DESCRIPTION: Description<'static> = Description::new(
        "motor-wing",
        "wing on the shaft of a motor, pitch by speed (Park and Abolfathi 2024)",
        Params::TABLE,
        Params::PRESETS,
    );
    const STATES: [&'static str; 3] = ["stroke_rad", "stroke_rate_rad_s", "current_a"];
    const DERIVED: &'static [Derived<MotorWing, Constants<f64>, Signals>] = columns::DERIVED;

    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 3>, Invalid> {
        let params = Params::from_values(values);
        let constants = Constants::derive(&params)?;
        let drive = constants.drive;
        // Typical sizes of flap angle (rad), rate (rad/s) and current (A).
        let scale = [0.5, 0.5 * drive.rate, 0.1];
        Ok(Start::new(constants, [0.0; 3], drive.period(), scale))
    }

    #[inline(always)]
    fn drive<R: Real>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    #[inline(always)]
    fn signals<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 3>) -> Signals<R> {
        let Instant { input: voltage, y, .. } = at;
        let [flap, rate, current] = *y;
        let power = voltage.value * current;
        Signals {
            stroke: flap,
            lift: c.lift(rate),
            power,
            power_air: c.air_torque(rate) * rate,
            power_resistive: c.resistance * current * current,
            power_bearing: c.bearing_damping * rate * rate,
            // The motor's conversion is lossless only if its two constants are one.
            power_magnetic: (c.back_emf - c.torque) * current * rate,
            current,
            power_terminal: power,
        }
    }

    /// The spring, the inertia and the inductance return all stored energy within a period. The power balance
    /// therefore leaves out the powers of spring, inertia and inductance.
    fn balance_energy(cycle: &mut Signals<SignalCycle>) {
        let &mut Signals { power_air, power_resistive, power_bearing, power_magnetic, .. } = cycle;
        cycle.power.balance(&[power_air, power_resistive, power_bearing, power_magnetic]);
    }

    fn energy_audit(cycle: &Signals<SignalCycle>) -> f64 {
        cycle.power.audit(&cycle.power_terminal)
    }
}
