//! The bimorph model: equations of motion, signals, columns of the results, and experiments such as chirps.

use core::cmp::Ordering;
use core::f64::consts::PI;

use super::constants::{Constants, check_transitions};
use super::general::{self, Air, air_at};
use super::params::{CentreOfPressure, Params};
use super::rhs::{
    Plate, charging_power, currents, derivative, double_angle, leakage, lift_and_drag, load, plate_forces,
    plates, secant_stiffness, stroke_damping, tip_drag,
};
use super::strips::Moving;
use super::transmission::{Law, Transmission, stroke};
use super::variant::Bimorph;
use crate::aero::{HarmonicParameters, Wing};
use crate::body::{BodyMotion, BodyTerms};
use crate::drive::{Drive, DriveConstants, Shape, StrokeMode, Wave, Waveform};
use crate::model::Measure::{Peak, PeakToPeak, Supply};
use crate::model::OverWings::{Each, Sum};
use crate::model::readings::{efficiency, grams_force, hinge_strain, lag_degrees};
use crate::model::signal::DEGREES;
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

/// Largest weight that a vehicle can carry, divided by the largest lift of the vehicle. Section IV of the
/// paper reserves 20 % of the largest lift for control.
const HOVER_SHARE: f64 = 0.8;

crate::signals! {
    /// Signals of the bimorph model.
    pub struct Signals {
        stroke: (Unit::DEG, "stroke angle", [Amplitude, PeakToPeak, Mean, Max, Min, First]) principal First,
        pitch: (Unit::DEG, "pitch of the wing", [Amplitude, PeakToPeak, Peak, Mean, Max, Min, First]) principal First,
        lift: (Unit::MN, "lift of the wing", [Mean, Max, Min]) principal Mean of_wings [Mean],
        drag: (Unit::MN, "drag of the wing along the stroke", [Mean, Magnitude]),
        power: (Unit::MW, "electrical power of both plates (current times voltage); the mean equals the sum of the means of power_drag, power_stroke_damping and power_dielectric", [Mean]) principal Mean,
        power_plate_1: (Unit::MW, "electrical power of plate 1", [Supply]),
        power_plate_2: (Unit::MW, "electrical power of plate 2", [Supply]),
        power_mechanical: (Unit::MW, "power of the plates' forces at the actuator's tip; the mean equals the sum of the means of power_drag and power_stroke_damping", [Mean]),
        power_drag: (Unit::MW, "power lost to the drag of the wing along the stroke, Eq. (8)", [Mean]),
        power_rotational: (Unit::MW, "power lost to the rotational drag about the hinge, Eq. (9)", [Mean]),
        power_stroke_damping: (Unit::MW, "power lost in the damping of the stroke", [Mean]),
        power_hinge_damping: (Unit::MW, "power lost in the damping of the hinge", [Mean]),
        power_dielectric: (Unit::MW, "power lost in the dielectric of both plates", [Mean]),
        current_1: (Unit::MA, "current into plate 1", [Rms, Peak]),
        current_2: (Unit::MA, "current into plate 2", [Rms, Peak]),
        force_1: (Unit::MN, "force of plate 1 at the actuator's tip, Eq. (6)", [Peak]),
        force_2: (Unit::MN, "force of plate 2 at the actuator's tip, Eq. (6)", [Peak]),
        power_transduced: (Unit::MW, "electrical power of both plates without the power that charges the capacitance of the plates", []),
    }
}

type Column = Derived<Bimorph, Constants<f64>, Signals>;

#[rustfmt::skip]
const DERIVED: &[Column] = &[
    Column::new("stroke_lag_deg", "deg", "phase by which the first harmonic of the stroke lags the difference F_1 - F_2 of the plates' forces, from -180 to 180; F_1 - F_2 has the opposite phase of the waveform, such as -sin(w t)",
        |model, _, cycle| lag_degrees(cycle.stroke.phase(), model.drive.first_phase() + PI)).over_wings(Each),
    Column::new("pitch_lag_deg", "deg", "phase by which the first harmonic of the pitch lags the first harmonic of the stroke, from -180 to 180",
        |_, _, cycle| lag_degrees(cycle.pitch.phase(), cycle.stroke.phase())).over_wings(Each),
    Column::new("stroke_pp_deg_per_v", "deg/V", "stroke_pp_deg divided by drive_voltage_pp: the vertical axis of Figs. 4a and 5",
        |_, c, cycle| cycle.stroke.measure(PeakToPeak) * DEGREES / (2.0 * c.drive.amplitude)),
    Column::new("tip_pp_um", "um", "difference between the largest and the smallest displacement of the actuator's tip",
        |_, c, cycle| tip_pp(c, cycle) * 1e6).over_wings(Each),
    Column::new("tip_peak_um", "um", "largest displacement of the actuator's tip from rest",
        |_, c, cycle| tip_peak(c, cycle) * 1e6).over_wings(Each),
    Column::new("lift_mean_gf", "gf", "mean lift of the wing in grams-force",
        |_, _, cycle| grams_force(cycle.lift.mean)),
    Column::new("vehicle_lift_mgf", "mgf", "mean lift of a vehicle's two wings in milligrams-force",
        |_, _, cycle| vehicle_lift(cycle)),
    Column::new("payload_mg", "mg", "80 % of vehicle_lift_mgf, minus vehicle_mass (Table II); the remaining 20 % of the lift is reserved for control",
        |_, c, cycle| HOVER_SHARE * vehicle_lift(cycle) - c.vehicle_mass * 1e6),
    Column::new("power_supply_mw", "mW", "mean power that the supply delivers: sum of the positive parts of the powers of both plates, minus charge_recovery times the returned power",
        |_, c, cycle| supplied(positive_power(cycle), cycle.power.mean, c.charge_recovery) * 1e3).over_wings(Sum),
    Column::new("power_capacitive_mw", "mW", "power that charges the capacitance of one actuator, without recovery: C_act V_pp^2 f / 4 (P in Jafferis et al. 2016)",
        |model, c, _| capacitive_power(model, c) * 1e3).over_wings(Sum),
    Column::new("efficiency_gf_per_w", "gf/W", "lift_mean_gf divided by the mean electrical power (power_mean_mw); empty if the power is zero or less",
        |_, _, cycle| efficiency(grams_force(cycle.lift.mean), cycle.power.mean)),
    Column::new("efficiency_capacitive_gf_per_w", "gf/W", "lift_mean_gf divided by power_capacitive_mw: the lift-to-power ratio of Jafferis et al. 2016 (1 gf/W is 1 mg/mW)",
        |model, c, cycle| grams_force(cycle.lift.mean) / capacitive_power(model, c)),
    Column::new("energy_audit", "", "relative difference between the mean of current times voltage and power_mean_mw; zero except for the integration error",
        |_, _, cycle| Bimorph::energy_audit(cycle)),
    Column::new("strain_mid_max", "", "largest strain of the plates' mid-planes, Eq. (5)",
        |_, c, cycle| tip_peak(c, cycle) * c.strain_per_tip).over_wings(Each),
    Column::new("strain_surface_max", "", "largest strain of the plates' outer faces (listed in Table II)",
        |_, c, cycle| tip_peak(c, cycle) * c.strain_per_tip * c.surface_strain_ratio).over_wings(Each),
    Column::new("hinge_strain_max", "", "largest strain of the outer faces of the hinge's flexure, which is assumed to bend to an arc of a circle; empty without hinge_thickness and hinge_length",
        |_, c, cycle| hinge_strain(c.hinge_strain, cycle.pitch.measure(Peak))).over_wings(Each),
    Column::new("field_max_v_per_um", "V/um", "largest electric field in the plates",
        |model, c, _| voltage_max(model, &c.drive, c.half_offset) * c.field_per_volt * 1e-6).over_wings(Each),
    Column::new("mode_stroke_hz", "Hz", "natural frequency of small stroke motions, without drag",
        |_, c, _| Bimorph::modes(c)[0].frequency),
    Column::new("mode_hinge_hz", "Hz", "natural frequency of small pitch motions, without drag",
        |_, c, _| Bimorph::modes(c)[1].frequency),
];

/// Returns the time integrals and extrema of the signals over the second half of a symmetric period. The
/// second half of the period equals the first half with the two plates exchanged, and with opposite signs of
/// stroke, pitch and drag.
fn second_half(first: &Signals<Totals<f64>>) -> Signals<Totals<f64>> {
    let same = Signals::map(first, |_, totals| totals.repeated());
    Signals {
        stroke: first.stroke.negated(),
        pitch: first.pitch.negated(),
        drag: first.drag.negated(),
        power_plate_1: same.power_plate_2,
        power_plate_2: same.power_plate_1,
        current_1: same.current_2,
        current_2: same.current_1,
        force_1: same.force_2,
        force_2: same.force_1,
        ..same
    }
}

/// Number of bisection steps that compute the voltage difference between the plates to rounding accuracy.
const MOST_HALVINGS: usize = 60;

/// Returns the largest displacement of the actuator's tip (m).
fn tip_peak(c: &Constants<f64>, cycle: &Signals<SignalCycle>) -> f64 {
    c.tip(cycle.stroke.measure(Peak))
}

/// Returns the peak-to-peak displacement of the actuator's tip (m).
fn tip_pp(c: &Constants<f64>, cycle: &Signals<SignalCycle>) -> f64 {
    if c.ratio_growth == 0.0 {
        return cycle.stroke.measure(PeakToPeak) / c.ratio;
    }
    c.tip(cycle.stroke.max) - c.tip(cycle.stroke.min)
}

/// Returns the mean of the positive part of the electrical power, added up for both plates (W).
fn positive_power(cycle: &Signals<SignalCycle>) -> f64 {
    [cycle.power_plate_1, cycle.power_plate_2].iter().map(|plate| plate.measure(Supply)).sum()
}

/// Returns the mean lift of two wings in milligrams-force.
fn vehicle_lift(cycle: &Signals<SignalCycle>) -> f64 {
    2e3 * grams_force(cycle.lift.mean)
}

/// Returns the mean power (W) that charges the capacitances of both plates, if the power supply recovers no
/// charge. The voltages of the plates are ½V_pp (1 ± wave).
fn capacitive_power(model: &Bimorph, c: &Constants<f64>) -> f64 {
    let [low, high] = model.drive.range(&c.drive);
    let voltage_pp = c.drive.amplitude * (high - low);
    c.c_p * voltage_pp * voltage_pp * c.drive.rate / (2.0 * PI)
}

/// Returns the largest magnitude of the voltage across either plate (V). The voltages are ½V_pp (1 − wave) +
/// `offset` for plate 1 and ½V_pp (1 + wave) − `offset` for plate 2.
fn voltage_max(model: &Bimorph, drive: &DriveConstants<f64>, offset: f64) -> f64 {
    let [low, high] = model.drive.range(drive);
    let bias = drive.amplitude;
    let plates = [
        bias * (1.0 - low) + offset,
        bias * (1.0 - high) + offset,
        bias * (1.0 + low) - offset,
        bias * (1.0 + high) - offset,
    ];
    plates.into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// Lift and drag of the wing, and the powers that the wing loses to drag and to rotational drag.
struct Losses<R> {
    lift: R,
    drag: R,
    power_drag: R,
    power_rotational: R,
}

impl<R: Real> Losses<R> {
    /// Returns lift, drag and lost powers for a body at rest. `rate` is the stroke rate divided by the
    /// transmission ratio T.
    #[inline(always)]
    fn at_rest(c: &Constants<R>, rate: R, [sin_2psi, cos_2psi]: [R; 2], psi_dot: R) -> Losses<R> {
        let [lift, drag] = lift_and_drag(c, false, rate, [sin_2psi, cos_2psi]);
        Losses {
            lift,
            drag,
            power_drag: tip_drag(c, cos_2psi) * rate * rate * rate.abs(),
            power_rotational: c.c_c * psi_dot * psi_dot * psi_dot.abs(),
        }
    }

    /// Returns lift, drag and lost powers for the aerodynamic load `air`.
    #[inline(always)]
    fn of(c: &Constants<R>, air: &Air<R>, rate: R, psi_dot: R) -> Losses<R> {
        Losses {
            lift: air.load.lift,
            drag: air.load.drag,
            power_drag: air.load.drag_moment * (c.ratio * rate),
            power_rotational: -(air.rotation_moment * psi_dot),
        }
    }
}

impl Ode<4> for Bimorph {
    type Constants<R: Real> = Constants<R>;
    type Input<R: Real> = [Plate<R>; 2];

    /// Returns voltages and forces of the two plates at time `t` (s).
    #[inline(always)]
    fn input<R: Real>(&self, c: &Constants<R>, t: R) -> [Plate<R>; 2] {
        plates(c, &self.drive.wave(&c.drive, t))
    }

    #[inline(always)]
    fn next_break<R: Real>(&self, c: &Constants<R>, t: R) -> R {
        self.drive.next_break(&c.drive, t)
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, c: &Constants<R>, plates: &[Plate<R>; 2], side: R, y: &[R; 4]) -> [R; 4] {
        if self.is_plain() {
            self.plain_rhs(c, plates, side, y)
        } else {
            general::derivative(c, self, plates, y)
        }
    }

    const HAS_PLAIN: bool = true;

    /// Returns true if the equations of motion need no terms of the module `general`.
    #[inline(always)]
    fn is_plain(&self) -> bool {
        self.terms.is_plain()
    }

    #[inline(always)]
    fn plain_rhs<R: Real>(&self, c: &Constants<R>, plates: &[Plate<R>; 2], _side: R, y: &[R; 4]) -> [R; 4] {
        derivative(c, self.law, self.centre_of_pressure, plates, y)
    }
}

impl Bimorph {
    /// Returns the signals at one instant, given the aerodynamic forces and lost powers `air`.
    #[inline(always)]
    fn signals_in<R: Real>(
        &self,
        c: &Constants<R>,
        at: Instant<'_, R, [Plate<R>; 2], 4>,
        air: &Losses<R>,
    ) -> Signals<R> {
        let Instant { input: plates, y, .. } = at;
        let [x, x_dot, psi, psi_dot] = *y;
        let transmission = Transmission::at(c, self.law, x);
        let rate = transmission.times(x_dot);
        let [f_1, f_2] = plate_forces(c, plates, x);
        let [i_1, i_2] = currents(c, plates, x, x_dot);
        let [leak_1, leak_2] = leakage(c, plates, self.mean_voltages(c));
        let (i_1, i_2) = (i_1 + leak_1, i_2 + leak_2);
        let [v_1, v_2] = [plates[0].voltage.value, plates[1].voltage.value];
        let (power_1, power_2) = (v_1 * i_1, v_2 * i_2);
        Signals {
            stroke: stroke(c, self.law, x),
            pitch: psi,
            lift: air.lift,
            drag: air.drag,
            power: power_1 + power_2,
            power_plate_1: power_1,
            power_plate_2: power_2,
            power_mechanical: (f_1 - f_2) * x_dot,
            power_drag: air.power_drag,
            power_rotational: air.power_rotational,
            power_stroke_damping: stroke_damping(c, &transmission, x_dot, rate) * x_dot,
            power_hinge_damping: c.hinge_damping * psi_dot * psi_dot,
            power_dielectric: v_1 * leak_1 + v_2 * leak_2,
            current_1: i_1,
            current_2: i_2,
            force_1: f_1,
            force_2: f_2,
            power_transduced: power_1 + power_2 - charging_power(c, plates),
        }
    }

    /// Returns the mean voltages of the two plates (V) over a period.
    #[inline(always)]
    fn mean_voltages<R: Real>(&self, c: &Constants<R>) -> [R; 2] {
        let DriveConstants { bias, amplitude, .. } = c.drive;
        let swing = amplitude * self.drive.mean();
        [bias + c.half_offset - swing, bias - c.half_offset + swing]
    }
}

/// Returns the parameters that depend on a user-defined wing.
///
/// The lever arms `pressure_radius` and `rotation_pressure_width` are computed from blade elements. In the
/// presets, the lever arms of the aerodynamic forces contain factors that were fitted to one vehicle.
fn wing(wing: &Wing) -> Vec<(&'static str, f64)> {
    let length = wing.offset + wing.outline.length();
    let (area, width) = (wing.area(), wing.outline.width());
    let mut found = vec![
        ("wing_length", length),
        ("wing_area", area),
        ("wing_radius_2", (wing.area_moment(2) / area).sqrt() / length),
        ("wing_width", width),
        ("wing_width_2", (wing.width_moment(2) / area).sqrt() / width),
        ("added_inertia_stroke", wing.added_inertia()),
        ("pressure_radius", wing.area_moment(3) / wing.area_moment(2)),
        ("rotation_pressure_width", wing.width_moment(3) / wing.width_moment(2)),
    ];
    if let Some(masses) = wing.masses() {
        found.extend([
            ("wing_inertia_stroke", masses.rr),
            ("wing_inertia_hinge", masses.zz),
            ("wing_inertia_product", masses.rz),
        ]);
    }
    found
}

impl Model<4> for Bimorph {
    type Signals = Signals;

    const DESCRIPTION: Description<'static> = Description {
        loads: true,
        wing: Some(wing),
        ..Description::new(
            "bimorph",
            "bimorph actuator with a transmission, passive hinge, lumped quasi-steady aerodynamics (Jafferis et al. 2016)",
            Params::TABLE,
            Params::PRESETS,
        )
    };
    const STATES: [&'static str; 4] = ["tip_m", "tip_rate_m_s", "pitch_rad", "pitch_rate_rad_s"];
    const SIGNALS_OF_SLOPES: bool = false;
    const DERIVED: &'static [Column] = DERIVED;

    fn variant(&self, values: &[f64]) -> Bimorph {
        let p = Params::from_values(values);
        let Params { waveform, transmission_growth, centre_of_pressure, .. } = &p;
        let air = p.has_sections() || p.harmonics != HarmonicParameters::NONE;
        let stiffening = !Stiffening::of(p.stroke_stiffening, &p.hinge).is_zero();
        Bimorph {
            drive: self.drive.of_point(waveform.drive_shape, StrokeMode::Free),
            law: if *transmission_growth == 0.0 { Law::Constant } else { Law::Square },
            centre_of_pressure: *centre_of_pressure,
            terms: Terms { body: p.body.terms(), air, stiffening },
        }
    }

    fn with_terms_of(&self, other: &Bimorph) -> Bimorph {
        let law = if other.law == Law::Square { Law::Square } else { self.law };
        Bimorph { law, terms: self.terms.or(other.terms), ..self.clone() }
    }

    /// Returns the data with which a simulation from rest starts, see [`Model::start`].
    ///
    /// The typical sizes of the states equal the typical sizes in the direct-drive model, so tolerances and
    /// residuals are comparable. The typical sizes are 0.1 rad of stroke and 0.3 rad of pitch. The typical
    /// size of each rate is the typical size of its angle times the angular drive frequency.
    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 4>, Invalid> {
        let params = Params::from_values(values);
        self.drive.check(&params.waveform)?;
        check_transitions(&params, voltage_max(self, &params.drive(), 0.5 * params.drive_offset))?;
        let constants =
            Constants { moving: Moving::of(&params, self.terms.body)?, ..Constants::derive(&params)? };
        let DriveConstants { rate, .. } = constants.drive;
        let tip = 0.1 / params.transmission_ratio;
        let scale = [tip, tip * rate, 0.3, 0.3 * rate];
        Ok(Start::new(constants, [0.0; 4], constants.drive.period(), scale))
    }

    /// If the equations are symmetric, the second half of a period mirrors the first half about the zero
    /// state. The symmetry requires equal plates, a symmetric waveform, a body at rest, and a centre of
    /// pressure that is not "literal".
    fn symmetry(&self, c: &Constants<f64>) -> Option<Symmetry<Signals, 4>> {
        let [f_1, f_2] = c.force_per_stress;
        let is_symmetric = f_1 == f_2
            && c.half_offset == 0.0
            && self.terms.body == BodyTerms::None
            && self.centre_of_pressure != CentreOfPressure::Literal
            && self.drive.is_symmetric(&c.drive);
        is_symmetric.then_some(Symmetry { centre: [0.0; 4], second_half: Some(second_half) })
    }

    #[inline(always)]
    fn drive<R: Real>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    fn with_motion(c: &Constants<f64>, motion: BodyMotion<f64>) -> Constants<f64> {
        Constants { moving: Moving { motion, ..c.moving }, ..*c }
    }

    #[inline(always)]
    fn signals<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, [Plate<R>; 2], 4>) -> Signals<R> {
        if self.is_plain() {
            return self.plain_signals(c, at);
        }
        let [x, x_dot, _, psi_dot] = *at.y;
        let rate = Transmission::at(c, self.law, x).times(x_dot);
        let air = air_at(c, self, self.terms.body == BodyTerms::All, at);
        self.signals_in(c, at, &Losses::of(c, &air, rate, psi_dot))
    }

    #[inline(always)]
    fn plain_signals<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, [Plate<R>; 2], 4>) -> Signals<R> {
        let [x, x_dot, psi, psi_dot] = *at.y;
        let (sin, cos) = psi.sin_cos();
        let (sin_2psi, cos_2psi) = double_angle(sin, cos);
        let rate = Transmission::at(c, self.law, x).times(x_dot);
        self.signals_in(c, at, &Losses::at_rest(c, rate, [sin_2psi, cos_2psi], psi_dot))
    }

    /// The mean powers satisfy ⟨V₁i₁ + V₂i₂⟩ − ⟨dielectric loss⟩ = ⟨(F₁ − F₂) ẋ⟩ = ⟨power lost to drag and
    /// damping of the stroke⟩. Drag and damping of the stroke are the only losses in Eq. (1).
    fn balance_energy(cycle: &mut Signals<SignalCycle>) {
        let (drag, damping) = (cycle.power_drag, cycle.power_stroke_damping);
        cycle.power.balance(&[drag, damping, cycle.power_dielectric]);
        cycle.power_mechanical.balance(&[drag, damping]);
    }

    fn energy_audit(cycle: &Signals<SignalCycle>) -> f64 {
        cycle.power.audit(&cycle.power_transduced)
    }

    #[inline(always)]
    fn load<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, [Plate<R>; 2], 4>) -> Load<R> {
        if !self.is_plain() || self.terms.body == BodyTerms::Loads {
            return air_at(c, self, self.terms.body != BodyTerms::None, at).load;
        }
        let [x, x_dot, psi, psi_dot] = *at.y;
        let rate = Transmission::at(c, self.law, x).times(x_dot);
        load(c, false, self.centre_of_pressure, stroke(c, self.law, x), x_dot, rate, [psi, psi_dot])
    }

    /// The drive voltage can cross the stress transition of Eq. (6) within a fraction of a step. When the
    /// voltage crosses the stress transition, the currents have peaks.
    #[inline(always)]
    fn parts(&self) -> u32 {
        if self.drive.waveform == Waveform::Shape(Shape::Square) { 6 } else { 2 }
    }
}

impl ExperimentModel<4> for Bimorph {
    const FREE_SIGNALS: &'static [Signal] = &[Signals::SIGNALS.stroke, Signals::SIGNALS.pitch];

    fn with_drive(&self, change: impl FnOnce(&Drive) -> Drive) -> Bimorph {
        Bimorph { drive: change(&self.drive), ..*self }
    }

    fn with_drive_constants(c: &Constants<f64>, drive: DriveConstants<f64>) -> Constants<f64> {
        c.with_drive(drive)
    }

    /// Returns the natural modes of stroke and pitch without drag. Eq. (1) contains no moment that the hinge
    /// exerts on the stroke, so the two modes are independent:
    ///
    /// ```text
    /// ω_s = √((K_act(0) + K_t)/m_e)     ω_h = √(κ_wh/I_xx)
    /// ```
    ///
    /// The added mass of the wing's sections adds a₁₁ T² to m_e and a₂₂ to I_xx. The added mass also couples
    /// stroke and pitch. The coupling e is the product of the off-diagonal entries of the mass matrix,
    /// divided by the product of the diagonal entries:
    ///
    /// ```text
    /// (1 − e) ω⁴ − (ω_s² + ω_h²) ω² + ω_s² ω_h² = 0     e = a₁₂ (I_xz + a₁₂) T²/((m_e + a₁₁ T²)(I_xx + a₂₂))
    /// ```
    ///
    /// If the equation for ω has no real solutions, the frequencies are NaN.
    fn modes(c: &Constants<f64>) -> Vec<Mode> {
        let stiffness = secant_stiffness(c, 0.0) + c.k_t;
        let squared_ratio = c.ratio * c.ratio;
        let inverse_mass = c.inverse_m_e / (1.0 + c.added.a11 * squared_ratio * c.inverse_m_e);
        let inverse_inertia = c.inverse_i_xx / (1.0 + c.added.a22 * c.inverse_i_xx);
        let [stroke, hinge] = [stiffness * inverse_mass, c.kappa_wh * inverse_inertia];
        let coupling = c.added.a12 * (c.i_xz + c.added.a12) * squared_ratio * inverse_mass * inverse_inertia;
        let squares = if coupling == 0.0 {
            [stroke, hinge]
        } else {
            let root = ((stroke - hinge).powi(2) + 4.0 * coupling * stroke * hinge).sqrt();
            let sum = stroke + hinge + root;
            let [slow, fast] = [2.0 * stroke * hinge / sum, 0.5 * sum / (1.0 - coupling)];
            if stroke < hinge { [slow, fast] } else { [fast, slow] }
        };
        Mode::of(["mode_stroke", "mode_hinge"], squares.map(|square| square.sqrt() / (2.0 * PI)))
    }

    /// Returns the constants for a constant voltage of ½V_pp on both plates. If the plates have different
    /// forces at equal voltages, a voltage difference between the plates balances the forces.
    fn resting(c: &Constants<f64>) -> Constants<f64> {
        let still = c.drive.still(c.drive.bias);
        let with_half = |half_offset: f64| Constants { half_offset, ..*c }.with_drive(still);
        let [mut low, mut high] = [-c.drive.bias, c.drive.bias];
        // The force of the first plate minus the force of the second plate increases with the difference.
        for _ in 0..MOST_HALVINGS {
            let middle = f64::midpoint(low, high);
            let balanced = with_half(middle);
            let [first, second] = plates(&balanced, &Wave::with_rate(0.0, 0.0)).map(|plate| plate.force);
            match first.total_cmp(&second) {
                Ordering::Equal => return balanced,
                Ordering::Less => low = middle,
                Ordering::Greater => high = middle,
            }
        }
        with_half(f64::midpoint(low, high))
    }

    /// Returns the state after an impulse on the stroke. The impulse also causes the pitch rate ψ̇ = (I_xz +
    /// a₁₂) T ẋ/(I_xx + a₂₂). The pitch rate follows from Eq. (2) with the added mass of the wing's sections.
    fn struck(c: &Constants<f64>, stroke_rate: f64) -> [f64; 4] {
        let tip_rate = stroke_rate / c.ratio;
        [0.0, tip_rate, 0.0, (c.i_xz + c.added.a12) * stroke_rate / (c.i_xx + c.added.a22)]
    }

    fn placed(c: &Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<[Plate<f64>; 2], 4> {
        let x = c.tip(stroke[0]);
        // φ = T (x + τ x³/3), differentiated twice.
        let (ratio, slope) = (c.ratio * (1.0 + c.ratio_growth * x * x), 2.0 * c.ratio * c.ratio_growth * x);
        let x_dot = stroke[1] / ratio;
        let x_ddot = (stroke[2] - slope * x_dot * x_dot) / ratio;
        let unknown = plates(c, &Wave::with_rate(f64::NAN, f64::NAN));
        ([x, x_dot, pitch[0], pitch[1]], [x_dot, x_ddot, pitch[1], pitch[2]], unknown)
    }
}
