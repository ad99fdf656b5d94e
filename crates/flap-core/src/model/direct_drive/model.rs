//! The direct-drive model: equations of motion, signals, columns of the results, and experiments such as
//! chirps.

use super::constants::Constants;
use super::general;
use super::params::{FlowDirection, Params};
use super::rhs::{added_mass, aerodynamics, balance, current, lift, load, mean_velocity};
use super::variant::DirectDrive;
use crate::aero::{HarmonicParameters, Wing, chord_table};
use crate::body::{BodyMotion, BodyTerms};
use crate::drive::{Drive, DriveConstants, Wave};
use crate::model::Measure::{Peak, Supply};
use crate::model::OverWings::{Each, Sum};
use crate::model::readings::{charging, efficiency, grams_force, hinge_strain, lag_degrees};
use crate::model::stroke_and_pitch as states;
use crate::model::{
    Derived, Description, ExperimentModel, Imposed, Instant, Load, Model, Signal, SignalCycle, SignalSet,
    Symmetry, Terms, Totals, Unit,
};
use crate::modes::Mode;
use crate::num::Real;
use crate::ode::{Ode, Start};
use crate::parameter::Invalid;
use crate::piezo::supplied;
use crate::springs::Stiffening;

crate::signals! {
    /// Signals of the direct-drive model.
    pub struct Signals {
        stroke: (Unit::DEG, "stroke angle", [Amplitude, PeakToPeak, Mean, Max, Min, First]) principal First,
        pitch: (Unit::DEG, "pitch of the wing on its hinge", [Amplitude, PeakToPeak, Peak, Mean, Max, Min, First]) principal First,
        lift: (Unit::MN, "lift of the wing, Eq. (35)", [Mean, Max, Min]) principal Mean of_wings [Mean],
        lift_translational: (Unit::MN, "lift of the wing without the contribution of the added mass, Eq. (21)", [Mean]),
        drag: (Unit::MN, "translational drag of the wing along the stroke, Eq. (19)", [Magnitude]),
        power: (Unit::MW, "electrical power, Eq. (40), current times voltage; the mean equals the sum of the mean losses in air, dampers and dielectric", [Mean]) principal Mean needs [Supply],
        power_translational: (Unit::MW, "power lost to translational aerodynamic forces", [Mean]),
        power_rotational: (Unit::MW, "power lost to the rotational drag, Eq. (32)", [Mean]),
        power_stroke_damping: (Unit::MW, "power lost in the damping of the stroke", [Mean]),
        power_hinge_damping: (Unit::MW, "power lost in the damping of the hinge", [Mean]),
        power_dielectric: (Unit::MW, "power lost in the dielectric of the actuator", [Mean]),
        current: (Unit::MA, "current into the actuator, Eq. (39)", [Rms, Peak]),
        power_transduced: (Unit::MW, "electrical power without the power of the capacitance and of the constant part of the voltage", []),
    }
}

type Column = Derived<DirectDrive, Constants<f64>, Signals>;

#[rustfmt::skip]
const DERIVED: &[Column] = &[
    Column::new("stroke_lag_deg", "deg", "phase by which the first harmonic of the stroke lags the first harmonic of the drive voltage, from -180 to 180",
        |model, _, cycle| lag_degrees(cycle.stroke.phase(), model.drive.first_phase())).over_wings(Each),
    Column::new("pitch_lag_deg", "deg", "phase by which the first harmonic of the pitch lags the first harmonic of the stroke, from -180 to 180",
        |_, _, cycle| lag_degrees(cycle.pitch.phase(), cycle.stroke.phase())).over_wings(Each),
    Column::new("lift_mean_gf", "gf", "mean lift of the wing in grams-force",
        |_, _, cycle| grams_force(cycle.lift.mean)),
    Column::new("efficiency_gf_per_w", "gf/W", "lift_mean_gf divided by the mean electrical power (power_mean_mw); empty if the power is zero or less",
        |_, _, cycle| efficiency(grams_force(cycle.lift.mean), cycle.power.mean)),
    Column::new("power_supply_mw", "mW", "mean power that the supply delivers: mean of the positive part of the electrical power, minus charge_recovery times the returned power",
        |_, c, cycle| supplied(cycle.power.measure(Supply), cycle.power.mean, c.charge_recovery) * 1e3).over_wings(Sum),
    Column::new("power_capacitive_mw", "mW", "power that charges the actuator's capacitance, without recovery: C V_pp^2 f / 2",
        |model, c, _| charging(c.c_p, model.drive.voltage_range(&c.drive), c.drive.frequency()) * 1e3).over_wings(Sum),
    Column::new("energy_audit", "", "relative difference between the mean of current times voltage and power_mean_mw; zero except for the integration error",
        |_, _, cycle| DirectDrive::energy_audit(cycle)),
    Column::new("strain_surface_max", "", "largest strain of the piezoelectric layer's outer face, from the bending of the actuator",
        |_, c, cycle| cycle.stroke.measure(Peak) * c.strain_per_stroke.abs()).over_wings(Each),
    Column::new("hinge_strain_max", "", "largest strain of the outer faces of the hinge's flexure, which is assumed to bend to an arc of a circle; empty without hinge_thickness and hinge_length",
        |_, c, cycle| hinge_strain(c.hinge_strain, cycle.pitch.measure(Peak))).over_wings(Each),
    Column::new("field_max_v_per_um", "V/um", "largest electric field in the piezoelectric layer",
        |model, c, _| model.drive.largest_voltage(&c.drive) / c.piezo_thickness * 1e-6).over_wings(Each),
    Column::new("mode_1_hz", "Hz", "lower of the two natural frequencies of small motions in still air, without aerodynamic damping",
        |_, c, _| DirectDrive::modes(c)[0].frequency),
    Column::new("mode_2_hz", "Hz", "upper of the two natural frequencies of small motions in still air, without aerodynamic damping",
        |_, c, _| DirectDrive::modes(c)[1].frequency),
];

/// Returns the time integrals and extrema of the signals over the second half of a period, which mirrors the
/// first half about the zero state.
fn second_half(first: &Signals<Totals<f64>>) -> Signals<Totals<f64>> {
    Signals {
        stroke: first.stroke.negated(),
        pitch: first.pitch.negated(),
        drag: first.drag.negated(),
        current: first.current.negated(),
        ..Signals::map(first, |_, totals| totals.repeated())
    }
}

impl Ode<4> for DirectDrive {
    type Constants<R: Real> = Constants<R>;
    type Input<R: Real> = Wave<R>;

    #[inline(always)]
    fn input<R: Real>(&self, c: &Constants<R>, t: R) -> Wave<R> {
        self.drive.at(&c.drive, t)
    }

    /// In the paper, the whole wing has one direction of flow, so forces jump when this direction changes.
    /// With blade elements, no forces jump.
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
    fn switch<R: Real>(&self, c: &Constants<R>, y: &[R; 4], dy: &[R; 4]) -> [R; 2] {
        match self.flow {
            FlowDirection::Uniform => mean_velocity(c, y, dy),
            // Switching is off: this function never changes its sign.
            FlowDirection::Blade => [y[0].lit(1.0), y[0].lit(0.0)],
        }
    }
}

impl DirectDrive {
    /// Returns the mass matrix [M₁₁, M₁₂, M₂₂] (kg·m²) at ψ = 0, with the added mass.
    fn mass_at_rest(c: &Constants<f64>) -> [f64; 3] {
        [c.m11 + c.added.a11, c.m12 - c.added.a12, c.m22 + c.added.a22]
    }

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
        let balance = if PLAIN || self.is_plain() {
            balance(c, self.flow, side, &at)
        } else {
            general::balance(c, self, side, &at)
        };
        if self.drive.prescribes_stroke() {
            balance.prescribed(y, drive, c.drive.rate)
        } else {
            balance.driven(y, c.gamma * drive.value)
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
        let [phi, psi, phi_dot, psi_dot] = y;
        let (sin, cos) = psi.sin_cos();
        let slope = states::slope(&self.drive, drive, dy);
        let (air, added, translational) = if PLAIN || self.is_plain() {
            let air = aerodynamics(c, false, self.flow, side, &y, sin, cos);
            let power = -(air.stroke_moment * phi_dot + air.pitch_moment * psi_dot);
            (air, added_mass(c, sin, cos, &slope), power)
        } else {
            let air = general::air(c, self, self.terms.body == BodyTerms::All, side, &y, [sin, cos]);
            let power = air.translational_power([phi_dot, psi_dot], cos);
            (air.forces, air.with_added_mass(c, [sin, cos], &slope), power)
        };
        // A prescribed stroke does not determine the actuator's force, so its quantities are unknown.
        let unknown = self.drive.prescribes_stroke();
        let leakage = c.conductance * (drive.value - self.drive.mean_voltage(&c.drive));
        let [current, leakage] =
            if unknown { [phi.lit(f64::NAN); 2] } else { [current(c, drive, phi_dot) + leakage, leakage] };
        Signals {
            stroke: phi,
            pitch: psi,
            lift: lift(c, &air, &added, sin),
            lift_translational: air.lift,
            drag: air.drag,
            power: current * drive.value,
            power_translational: translational,
            power_rotational: -(air.rotation_moment * psi_dot),
            power_stroke_damping: c.stroke_damping * phi_dot * phi_dot,
            power_hinge_damping: c.hinge_damping * psi_dot * psi_dot,
            power_dielectric: leakage * drive.value,
            current,
            power_transduced: (drive.value - c.drive.bias) * (current - c.c_p * drive.rate),
        }
    }
}

/// Returns the parameters that depend on a user-defined wing. In the direct-drive model, the hinge's axis is
/// the leading edge of the wing.
fn wing(wing: &Wing) -> Vec<(&'static str, f64)> {
    let mut found = vec![("wing_length", wing.outline.length()), ("wing_offset", wing.offset)];
    found.extend(chord_table(&wing.outline));
    if let Some(masses) = wing.masses() {
        let [chord, product, span] = masses.about_centre();
        found.extend([
            ("wing_mass", masses.mass),
            ("mass_centre_span", masses.radius - wing.offset),
            // Positive towards the leading edge.
            ("mass_centre_chord", -masses.depth),
            ("wing_inertia_span", span),
            ("wing_inertia_chord", chord),
            ("wing_inertia_product", -product),
        ]);
    }
    found
}

impl Model<4> for DirectDrive {
    type Signals = Signals;

    const DESCRIPTION: Description<'static> = Description {
        loads: true,
        wing: Some(wing),
        ..Description::new(
            "direct-drive",
            "unimorph attached directly to the wing, passive pitch, blade-element aerodynamics (Ozaki and Hamaguchi 2018)",
            Params::TABLE,
            Params::PRESETS,
        )
    };
    const STATES: [&'static str; 4] = states::NAMES;
    const DERIVED: &'static [Column] = DERIVED;

    fn variant(&self, values: &[f64]) -> DirectDrive {
        let p = Params::from_values(values);
        let Params { waveform, stroke, flow_direction, .. } = &p;
        let air = p.circulation_factor != 0.0
            || p.rotation_force_factor != 0.0
            || p.harmonics != HarmonicParameters::NONE;
        let stiffening = !Stiffening::of(p.stroke_stiffening, &p.hinge).is_zero();
        DirectDrive {
            drive: self.drive.of_point(waveform.drive_shape, stroke.stroke_mode),
            flow: *flow_direction,
            terms: Terms { body: p.body.terms(), air, stiffening },
        }
    }

    fn with_terms_of(&self, other: &DirectDrive) -> DirectDrive {
        DirectDrive { terms: self.terms.or(other.terms), ..self.clone() }
    }

    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 4>, Invalid> {
        let params = Params::from_values(values);
        self.drive.check(&params.waveform)?;
        let constants = Constants::derive(&params)?.with_motion(&params, self.terms.body)?;
        Ok(states::start(&self.drive, &constants.drive, constants, [0.1, 0.3]))
    }

    /// The second half of a period mirrors the first half about the position in which the wing rests under
    /// the constant part of the voltage. The constant part of the voltage only shifts the stroke.
    fn symmetry(&self, c: &Constants<f64>) -> Option<Symmetry<Signals, 4>> {
        let [.., literal] = c.attack;
        if literal != 0.0 || self.terms.body != BodyTerms::None || !self.drive.is_symmetric(&c.drive) {
            return None;
        }
        let stroke = c.gamma * c.drive.bias / c.k_phi;
        // A constant part of the voltage contributes power also if it does not move the stroke.
        let second_half = (c.drive.bias == 0.0).then_some(second_half as fn(&_) -> _);
        Some(Symmetry { centre: [stroke, 0.0, 0.0, 0.0], second_half })
    }

    #[inline(always)]
    fn drive<R: Real>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    fn with_motion(c: &Constants<f64>, motion: BodyMotion<f64>) -> Constants<f64> {
        Constants { moving: motion, ..*c }
    }

    #[inline(always)]
    fn signals<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Signals<R> {
        self.signals_at::<R, false>(c, at)
    }

    #[inline(always)]
    fn plain_signals<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Signals<R> {
        self.signals_at::<R, true>(c, at)
    }

    /// The mean electrical power is ⟨Vj⟩ = −⟨M_tr,y φ̇ + (M_tr,x′ + M_rot) ψ̇⟩ + ⟨damping⟩ + ⟨dielectric
    /// loss⟩. Energy that is not lost to air, damping or the dielectric is stored and returned within a
    /// period.
    fn balance_energy(cycle: &mut Signals<SignalCycle>) {
        cycle.power.balance(&[
            cycle.power_translational,
            cycle.power_rotational,
            cycle.power_stroke_damping,
            cycle.power_hinge_damping,
            cycle.power_dielectric,
        ]);
    }

    fn energy_audit(cycle: &Signals<SignalCycle>) -> f64 {
        cycle.power.audit(&cycle.power_transduced)
    }

    #[inline(always)]
    fn load<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Load<R> {
        let Instant { input: drive, side, y, dy } = at;
        let y = states::state(&self.drive, drive, y);
        let (sin, cos) = y[1].sin_cos();
        let slope = states::slope(&self.drive, drive, dy);
        let (air, added) = if self.terms.body == BodyTerms::None && !self.terms.air {
            (aerodynamics(c, false, self.flow, side, &y, sin, cos), added_mass(c, sin, cos, &slope))
        } else {
            let air = general::air(c, self, self.terms.body != BodyTerms::None, side, &y, [sin, cos]);
            (air.forces, air.with_added_mass(c, [sin, cos], &slope))
        };
        load(c, &air, &added, &y, [sin, cos])
    }
}

impl ExperimentModel<4> for DirectDrive {
    const FREE_SIGNALS: &'static [Signal] = &[Signals::SIGNALS.stroke, Signals::SIGNALS.pitch];

    fn with_drive(&self, change: impl FnOnce(&Drive) -> Drive) -> DirectDrive {
        DirectDrive { drive: change(&self.drive), ..*self }
    }

    fn with_drive_constants(c: &Constants<f64>, drive: DriveConstants<f64>) -> Constants<f64> {
        Constants { drive, ..*c }
    }

    /// Returns the natural modes of small motions about ψ = 0, with the added mass in still air.
    fn modes(c: &Constants<f64>) -> Vec<Mode> {
        Mode::coupled(DirectDrive::mass_at_rest(c), [c.k_phi, c.k_w])
    }

    fn resting(c: &Constants<f64>) -> Constants<f64> {
        Self::with_drive_constants(c, Self::drive(c).still(0.0))
    }

    fn struck(c: &Constants<f64>, stroke_rate: f64) -> [f64; 4] {
        states::struck(DirectDrive::mass_at_rest(c), stroke_rate)
    }

    fn placed(_c: &Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<Wave<f64>, 4> {
        states::placed(stroke, pitch)
    }
}
