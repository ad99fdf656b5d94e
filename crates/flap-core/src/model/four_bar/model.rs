//! The four-bar model: equations of motion, signals, columns of the results, and experiments such as chirps.

use super::aerodynamics::{added_mass_lift, aerodynamics, load, side_of};
use super::constants::Constants;
use super::general;
use super::params::Params;
use super::rhs::{
    balance, charging_current, current, driving_force, force, mass_matrix, stroke_damping, tip, transmission,
};
use super::strips::Moving;
use super::variant::FourBar;
use crate::aero::{HarmonicParameters, Wing, chord_table};
use crate::body::{BodyMotion, BodyTerms};
use crate::drive::{Drive, DriveConstants, Wave};
use crate::model::Measure::{Peak, Supply};
use crate::model::OverWings::{Each, Sum};
use crate::model::readings::{charging, efficiency, grams_force, hinge_strain, lag_degrees};
use crate::model::stroke_and_pitch as states;
use crate::model::{
    Derived, Description, ExperimentModel, Imposed, Instant, Load, Model, Signal, SignalCycle, Terms, Unit,
};
use crate::modes::Mode;
use crate::num::{Lanes, Real};
use crate::ode::step::Attempt;
use crate::ode::{Ode, Start, input};
use crate::parameter::Invalid;
use crate::piezo::supplied;
use crate::springs::Stiffening;

crate::signals! {
    /// Signals of the four-bar model.
    pub struct Signals {
        stroke: (Unit::DEG, "stroke angle", [Amplitude, PeakToPeak, Mean, Max, Min, First]) principal First,
        pitch: (Unit::DEG, "pitch of the wing on its hinge", [Amplitude, PeakToPeak, Peak, Mean, Max, Min, First]) principal First,
        lift: (Unit::MN, "lift of the wing, Eq. (4)", [Mean, Max, Min]) principal Mean of_wings [Mean],
        lift_translational: (Unit::MN, "lift due to the translation of the wing, Eq. (5)", [Mean]),
        lift_rotational: (Unit::MN, "lift due to the rotation of the wing, Eq. (6)", [Mean]),
        lift_added_mass: (Unit::MN, "lift due to the added mass, Eq. (7)", [Mean]),
        drag: (Unit::MN, "translational drag of the wing along the stroke, Eq. (5)", [Magnitude]),
        power_drive: (Unit::MW, "mechanical power of the actuator on the stroke; the mean equals the sum of the means of power_stroke_damping, power_hinge_damping, power_translational and power_rotational", [Mean]),
        power_stroke_damping: (Unit::MW, "power lost in the damping of the stroke", [Mean]),
        power_hinge_damping: (Unit::MW, "power lost in the damping of the hinge", [Mean]),
        power_translational: (Unit::MW, "power lost to translational aerodynamic forces", [Mean]),
        power_rotational: (Unit::MW, "power lost to the rotational drag, Eqs. (6) and (18)", [Mean]),
        power: (Unit::MW, "electrical power (current times voltage; not in Arabagi et al. 2013); the mean equals the sum of the means of power_drive and power_dielectric", [Mean]) principal Mean needs [Supply],
        power_dielectric: (Unit::MW, "power lost in the dielectric of the actuator", [Mean]),
        current: (Unit::MA, "current into the actuator (not in Arabagi et al. 2013)", [Rms, Peak]),
        tip: (Unit::UM, "displacement of the actuator's tip", [PeakToPeak, Peak]),
        power_transduced: (Unit::MW, "electrical power without the power of capacitances and of the constant part of the voltage", []),
        power_driving: (Unit::MW, "mechanical power of the actuator without the power of the actuator's stiffness", []),
    }
}

type Column = Derived<FourBar, Constants<f64>, Signals>;

#[rustfmt::skip]
const DERIVED: &[Column] = &[
    Column::new("stroke_lag_deg", "deg", "phase by which the first harmonic of the stroke lags the first harmonic of the drive voltage, from -180 to 180",
        |model, _, cycle| lag_degrees(cycle.stroke.phase(), model.drive.first_phase())).over_wings(Each),
    Column::new("pitch_lag_deg", "deg", "phase by which the first harmonic of the pitch lags the first harmonic of the stroke, from -180 to 180: the phase shift of Arabagi et al. 2013",
        |_, _, cycle| lag_degrees(cycle.pitch.phase(), cycle.stroke.phase())).over_wings(Each),
    Column::new("lift_mean_gf", "gf", "mean lift of the wing in grams-force",
        |_, _, cycle| grams_force(cycle.lift.mean)),
    Column::new("efficiency_gf_per_w", "gf/W", "lift_mean_gf divided by the mean electrical power (power_mean_mw)",
        |_, _, cycle| efficiency(grams_force(cycle.lift.mean), cycle.power.mean)),
    Column::new("power_supply_mw", "mW", "mean power that the supply delivers: mean of the positive part of the electrical power, minus charge_recovery times the returned power",
        |_, c, cycle| supplied(cycle.power.measure(Supply), cycle.power.mean, c.actuator.charge_recovery) * 1e3).over_wings(Sum),
    Column::new("power_capacitive_mw", "mW", "power that charges the capacitance of the blocked actuator, without recovery: C V_pp^2 f / 2",
        |model, c, _| {
            charging(c.actuator.capacitance, model.drive.voltage_range(&c.drive), c.drive.frequency()) * 1e3
        }).over_wings(Sum),
    Column::new("energy_audit", "", "relative difference between the mean power of the actuator's force and power_drive_mean_mw; zero except for the integration error",
        |_, _, cycle| FourBar::energy_audit(cycle)),
    Column::new("electrical_audit", "", "relative difference between the mean of current times voltage and power_mean_mw; zero except for the integration error",
        |_, _, cycle| cycle.power.audit(&cycle.power_transduced)),
    Column::new("hinge_strain_max", "", "largest strain of the outer faces of the hinge's flexure, which is assumed to bend to an arc of a circle; empty without hinge_thickness and hinge_length",
        |_, c, cycle| hinge_strain(c.wing.hinge_strain, cycle.pitch.measure(Peak))).over_wings(Each),
    Column::new("field_max_v_per_um", "V/um", "largest electric field in the piezoelectric layer",
        |model, c, _| model.drive.largest_voltage(&c.drive) / c.actuator.piezo_thickness * 1e-6).over_wings(Each),
    Column::new("mode_1_hz", "Hz", "lower of the two natural frequencies of small undamped motions, with the added mass of still air",
        |_, c, _| FourBar::modes(c)[0].frequency),
    Column::new("mode_2_hz", "Hz", "upper of the two natural frequencies of small undamped motions, with the added mass of still air",
        |_, c, _| FourBar::modes(c)[1].frequency),
];

impl Ode<4> for FourBar {
    type Constants<R: Real> = Constants<R>;
    type Input<R: Real> = Wave<R>;

    #[inline(always)]
    fn input<R: Real>(&self, c: &Constants<R>, t: R) -> Wave<R> {
        self.drive.at(&c.drive, t)
    }

    /// At the switching surface, the lift jumps, while the accelerations of the wing hardly jump (see
    /// `side_of`). The mean lift over a step that contains a jump is inaccurate. The following numbers are
    /// from 816 points of the 75 Hz system at rtol 1e-6. The search for the jumps increases the number of
    /// evaluations of the right-hand side by 7 %. The search reduces the median error of the mean lift from
    /// 9e-4 to 7e-7, and the largest error from 2e-2 to 1e-5. The errors of the mean lift are relative to the
    /// components of the lift. With the search for the jumps, the motion settles at every point. Without the
    /// search for the jumps, the motion does not settle at a few points in a thousand.
    const SWITCHES: bool = true;

    #[inline(always)]
    fn next_break<R: Real>(&self, c: &Constants<R>, t: R) -> R {
        self.drive.next_break(&c.drive, t)
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, c: &Constants<R>, drive: &Wave<R>, side: R, y: &[R; 4]) -> [R; 4] {
        self.derivative::<R, false>(c, drive, side, y)
    }

    const HAS_PLAIN: bool = true;

    /// Returns true if the equations of motion need no terms of the module `general`.
    #[inline(always)]
    fn is_plain(&self) -> bool {
        self.terms.is_plain()
    }

    #[inline(always)]
    fn plain_rhs<R: Real>(&self, c: &Constants<R>, drive: &Wave<R>, side: R, y: &[R; 4]) -> [R; 4] {
        self.derivative::<R, true>(c, drive, side, y)
    }

    #[inline(always)]
    fn switch<R: Real>(&self, _c: &Constants<R>, y: &[R; 4], _dy: &[R; 4]) -> [R; 2] {
        side_of(y[1], y[3])
    }
}

impl FourBar {
    /// Returns the time derivative of the state. If `PLAIN` is true, the function contains no code of the
    /// module `general`.
    #[inline(always)]
    fn derivative<R: Real, const PLAIN: bool>(
        &self,
        c: &Constants<R>,
        drive: &Wave<R>,
        side: R,
        y: &[R; 4],
    ) -> [R; 4] {
        let at = states::state(&self.drive, drive, y);
        let links = transmission(c, at[0]);
        let balance = if PLAIN || self.is_plain() {
            balance(c, &links, side, &at)
        } else {
            general::balance(c, self, &links, side, &at)
        };
        if self.drive.prescribes_stroke() {
            balance.prescribed(y, drive, c.drive.rate)
        } else {
            balance.driven(y, force(&c.actuator, drive, links.displacement) * links.slope)
        }
    }

    /// Returns the signals at one instant. If `PLAIN` is true, the function contains no code of the module
    /// `general`.
    #[inline(always)]
    fn signals_at<R: Real, const PLAIN: bool>(
        &self,
        c: &Constants<R>,
        at: Instant<'_, R, Wave<R>, 4>,
    ) -> Signals<R> {
        let Instant { input: drive, side, y, dy } = at;
        let y = states::state(&self.drive, drive, y);
        let [theta, phi, theta_dot, phi_dot] = y;
        let (sin, cos) = phi.sin_cos();
        let mut added_mass = added_mass_lift(&c.air, sin, cos, &states::slope(&self.drive, drive, dy));
        let air = if PLAIN || self.is_plain() {
            aerodynamics(c, false, side, &y, sin, cos)
        } else {
            let (air, of_body) = general::air(c, self, side, &y);
            added_mass = added_mass + of_body;
            air
        };
        let links = transmission(c, theta);
        let slider_rate = links.slope * theta_dot;
        let leakage = c.actuator.conductance * (drive.value - self.drive.mean_voltage(&c.drive));
        // A prescribed stroke does not determine the actuator's force and current.
        let [force, current, leakage] = if self.drive.prescribes_stroke() {
            [theta.lit(f64::NAN); 3]
        } else {
            let current = current(&c.actuator, drive, slider_rate);
            [force(&c.actuator, drive, links.displacement), current + leakage, leakage]
        };
        let swing = drive.value - c.drive.bias;
        let rotation_lift = air.rotation.force * sin;
        let [rotation_stroke, rotation_pitch] = air.rotation_moments(cos);
        Signals {
            stroke: theta,
            pitch: phi,
            lift: air.lift + rotation_lift + added_mass,
            lift_translational: air.lift,
            lift_rotational: rotation_lift,
            lift_added_mass: added_mass,
            drag: air.drag,
            power_drive: force * slider_rate,
            power_stroke_damping: stroke_damping(&c.wing, &links) * theta_dot * theta_dot,
            power_hinge_damping: c.wing.hinge_damping * phi_dot * phi_dot,
            power_translational: -(air.stroke_moment * theta_dot + air.pitch_moment * phi_dot),
            power_rotational: -(rotation_stroke * theta_dot + rotation_pitch * phi_dot),
            power: current * drive.value,
            power_dielectric: leakage * drive.value,
            current,
            tip: tip(&c.actuator, links.displacement, force),
            power_transduced: swing * (current - charging_current(&c.actuator, drive)),
            power_driving: driving_force(&c.actuator, swing) * slider_rate,
        }
    }
}

/// Returns the parameters that depend on a user-defined wing.
///
/// In the four-bar model, the rotation axis is at the same fraction of the chord along the whole span. For a
/// user-defined wing, the parameter axis_position is the wing's area ahead of the hinge's axis, divided by
/// the whole area.
fn wing(wing: &Wing) -> Vec<(&'static str, f64)> {
    let before = wing.outline.integral(|_, leading, _| leading);
    let mut found = vec![("wing_offset", wing.offset), ("wing_length", wing.outline.length())];
    found.extend(chord_table(&wing.outline));
    found.push(("axis_position", before / wing.area()));
    if let Some(masses) = wing.masses() {
        let [chord, product, span] = masses.about_centre();
        found.extend([
            ("wing_mass", masses.mass),
            ("mass_centre_radius", masses.radius),
            ("mass_centre_depth", masses.depth),
            ("wing_inertia_span", span),
            ("wing_inertia_normal", span + chord),
            ("wing_inertia_chord", chord),
            ("wing_inertia_product", product),
        ]);
    }
    found
}

impl Model<4> for FourBar {
    type Signals = Signals;

    const DESCRIPTION: Description<'static> = Description {
        pitch_sign: -1,
        loads: true,
        wing: Some(wing),
        ..Description::new(
            "four-bar",
            "unimorph, slider-crank and four-bar, passive pitch, strip aerodynamics (Arabagi, Hines and Sitti 2013)",
            Params::TABLE,
            Params::PRESETS,
        )
    };
    const STATES: [&'static str; 4] = states::NAMES;
    const DERIVED: &'static [Column] = DERIVED;

    fn variant(&self, values: &[f64]) -> FourBar {
        let p = Params::from_values(values);
        let air = p.circulation_factor != 0.0 || p.harmonics != HarmonicParameters::NONE;
        let stiffening = !Stiffening::of(p.stroke_stiffening, &p.hinge).is_zero();
        FourBar {
            drive: self.drive.of_point(p.waveform.drive_shape, p.stroke.stroke_mode),
            terms: Terms { body: p.body.terms(), air, stiffening },
        }
    }

    fn with_terms_of(&self, other: &FourBar) -> FourBar {
        FourBar { terms: self.terms.or(other.terms), ..self.clone() }
    }

    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 4>, Invalid> {
        let params = Params::from_values(values);
        self.drive.check(&params.waveform)?;
        let constants =
            Constants { moving: Moving::of(&params, self.terms.body)?, ..Constants::derive(&params)? };
        Ok(states::start(&self.drive, &constants.drive, constants, [0.3, 0.5]))
    }

    #[inline(always)]
    fn drive<R: Real>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    fn with_motion(c: &Constants<f64>, motion: BodyMotion<f64>) -> Constants<f64> {
        Constants { moving: Moving { motion, ..c.moving }, ..*c }
    }

    #[inline(always)]
    fn signals<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Signals<R> {
        self.signals_at::<R, false>(c, at)
    }

    #[inline(always)]
    fn plain_signals<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Signals<R> {
        self.signals_at::<R, true>(c, at)
    }

    /// The mean powers satisfy ⟨Vi⟩ − ⟨dielectric loss⟩ = ⟨F δ̇⟩ = ⟨power lost to damping and air⟩. Actuator,
    /// springs and inertia return all stored energy within a period.
    fn balance_energy(cycle: &mut Signals<SignalCycle>) {
        let (stroke, hinge) = (cycle.power_stroke_damping, cycle.power_hinge_damping);
        let (translation, rotation) = (cycle.power_translational, cycle.power_rotational);
        cycle.power_drive.balance(&[stroke, hinge, translation, rotation]);
        cycle.power.balance(&[stroke, hinge, translation, rotation, cycle.power_dielectric]);
    }

    fn energy_audit(cycle: &Signals<SignalCycle>) -> f64 {
        cycle.power_drive.audit(&cycle.power_driving)
    }

    #[inline(always)]
    fn load<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Load<R> {
        let Instant { input: drive, side, y, dy } = at;
        let y = states::state(&self.drive, drive, y);
        let slope = states::slope(&self.drive, drive, dy);
        if self.terms.body == BodyTerms::None && !self.terms.air {
            load(c, side, &y, &slope)
        } else {
            general::load(c, self, side, &y, &slope)
        }
    }

    #[inline(always)]
    fn impulse<R: Lanes>(&self, c: &Constants<R>, attempt: &Attempt<'_, R, 4>) -> [R; 6] {
        if self.terms.body == BodyTerms::None {
            return self.impulse_of_stages(c, attempt);
        }
        general::impulse(
            c,
            attempt,
            #[inline(always)]
            |at, y| states::state(&self.drive, &input(self, c, at), y),
            #[inline(always)]
            |at, dy| states::slope(&self.drive, &input(self, c, at), dy),
        )
    }

    /// On a moving body, the lifts of the strips jump at different times, and the integrator does not search
    /// for the times of the jumps.
    fn has_slopes(&self) -> bool {
        self.terms.body == BodyTerms::None
    }
}

impl ExperimentModel<4> for FourBar {
    const FREE_SIGNALS: &'static [Signal] = &[Signals::SIGNALS.stroke, Signals::SIGNALS.pitch];

    fn with_drive(&self, change: impl FnOnce(&Drive) -> Drive) -> FourBar {
        FourBar { drive: change(&self.drive), ..*self }
    }

    fn with_drive_constants(c: &Constants<f64>, drive: DriveConstants<f64>) -> Constants<f64> {
        Constants { drive, ..*c }
    }

    /// Returns the natural modes for the mass matrix M(0) and the stiffness matrix K = diag(k_eff δ′(0)²,
    /// k_rot), at zero stroke and pitch. At the voltage V_ref, the actuator exerts no force at zero stroke.
    fn modes(c: &Constants<f64>) -> Vec<Mode> {
        let links = transmission(c, 0.0);
        let stiffness = c.actuator.stiffness * links.slope * links.slope;
        Mode::coupled(mass_matrix(c, links.inertia, 0.0, 1.0), [stiffness, c.wing.hinge_stiffness])
    }

    fn resting(c: &Constants<f64>) -> Constants<f64> {
        Self::with_drive_constants(c, Self::drive(c).still(c.actuator.rest_voltage))
    }

    fn struck(c: &Constants<f64>, stroke_rate: f64) -> [f64; 4] {
        states::struck(mass_matrix(c, transmission(c, 0.0).inertia, 0.0, 1.0), stroke_rate)
    }

    fn placed(_c: &Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<Wave<f64>, 4> {
        states::placed(stroke, pitch)
    }
}
