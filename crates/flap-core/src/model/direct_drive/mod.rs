//! A unimorph piezoelectric actuator bolted straight to a wing that pitches on a flexure hinge.
//!
//! Ozaki and Hamaguchi, "Electro-aero-mechanical model of piezoelectric direct-driven flapping-wing
//! actuator", Applied Sciences 8, 1699 (2018). Lagrangian wing inertia, added mass in the mass matrix,
//! quasi-steady translational and rotational aerodynamics in moment form, current and power.

mod chord;
mod columns;
mod constants;
mod params;
mod rhs;

pub use chord::BLADES;
pub use constants::Constants;
pub use params::{AddedMass, CentreOfPressure, FlowDirection, LiftSign, Params};
pub use rhs::{AddedMassLoad, Aerodynamics, added_mass, aerodynamics, balance, current, lift, mean_velocity};

use super::motions::Imposed;
use super::stroke_and_pitch as states;
use super::{Derived, Description, EnergyBalance, Model, Motions, Signal};
use crate::drive::{Drive, DriveConstants, Wave};
use crate::modes::{Mode, natural_frequencies};
use crate::num::Lanes;
use crate::ode::{Ode, Start};
use crate::parameter::Invalid;

/// The model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DirectDrive {
    /// The drive voltage, or the prescribed stroke.
    pub drive: Drive,
    /// Direction of the air's flow over the wing while it reverses.
    pub flow: FlowDirection,
}

impl Ode<4> for DirectDrive {
    type Constants<R: Lanes> = Constants<R>;
    type Input<R: Lanes> = Wave<R>;

    #[inline(always)]
    fn input<R: Lanes>(&self, c: &Constants<R>, t: R) -> Wave<R> {
        self.drive.at(&c.drive, t)
    }

    /// The paper takes one direction of flow for the whole wing: forces jump where it changes. Those of blade elements
    /// do not.
    const SWITCHES: bool = true;

    #[inline(always)]
    fn next_break<R: Lanes>(&self, c: &Constants<R>, t: R) -> R {
        self.drive.next_break(&c.drive, t)
    }

    #[inline(always)]
    fn rhs<R: Lanes>(&self, c: &Constants<R>, drive: &Wave<R>, side: R, y: &[R; 4]) -> [R; 4] {
        let balance = balance(c, self.flow, side, &states::state(&self.drive, drive, y));
        if self.drive.prescribes_stroke() {
            balance.prescribed(y, drive, c.drive.rate)
        } else {
            balance.driven(y, c.gamma * drive.value)
        }
    }

    #[inline(always)]
    fn switch<R: Lanes>(&self, c: &Constants<R>, y: &[R; 4], dy: &[R; 4]) -> [R; 2] {
        match self.flow {
            FlowDirection::Uniform => mean_velocity(c, y, dy),
            // A function that never changes its sign.
            FlowDirection::Blade => [y[0].lit(1.0), y[0].lit(0.0)],
        }
    }
}

impl Model<4, { columns::S }> for DirectDrive {
    const DESCRIPTION: Description = Description {
        name: "direct-drive",
        doc: "unimorph bolted to the wing, passive pitch, blade-element aerodynamics (Ozaki and Hamaguchi 2018)",
        parameters: Params::TABLE,
        presets: Params::PRESETS,
    };
    const STATES: [&'static str; 4] = states::NAMES;
    const SIGNALS: [Signal; columns::S] = columns::SIGNALS;
    const DERIVED: &'static [Derived<DirectDrive, Constants<f64>, { columns::S }>] = columns::DERIVED;
    const ENERGY: Option<EnergyBalance> = Some(columns::ENERGY);

    fn variant(&self, values: &[f64]) -> DirectDrive {
        let Params { waveform, stroke, flow_direction, .. } = Params::from_values(values);
        DirectDrive {
            drive: self.drive.of_point(waveform.drive_shape, stroke.stroke_mode),
            flow: flow_direction,
        }
    }

    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 4>, Invalid> {
        let params = Params::from_values(values);
        self.drive.check(&params.waveform)?;
        let constants = Constants::derive(&params)?;
        Ok(states::start(&self.drive, &constants.drive, constants, [0.1, 0.3]))
    }

    #[inline(always)]
    fn drive<R: Lanes>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    #[inline(always)]
    fn signals<R: Lanes>(
        &self,
        c: &Constants<R>,
        drive: &Wave<R>,
        side: R,
        y: &[R; 4],
        dy: &[R; 4],
    ) -> [R; columns::S] {
        let y = states::state(&self.drive, drive, y);
        let [phi, psi, phi_dot, psi_dot] = y;
        let (sin, cos) = psi.sin_cos();
        let air = aerodynamics(c, self.flow, side, &y, sin, cos);
        let added = added_mass(c, sin, cos, &states::slope(&self.drive, drive, dy));
        // A prescribed stroke says nothing about the actuator.
        let unknown = self.drive.prescribes_stroke();
        let current = if unknown { phi.lit(f64::NAN) } else { current(c, drive, phi_dot) };
        [
            phi,
            psi,
            lift(c, &air, &added, sin),
            air.lift,
            air.drag,
            current * drive.value,
            -(air.stroke_moment * phi_dot + air.pitch_moment * psi_dot),
            -(air.rotation_moment * psi_dot),
            current,
            (drive.value - c.drive.bias) * (current - c.c_p * drive.rate),
        ]
    }
}

impl Motions<4, { columns::S }> for DirectDrive {
    fn drive_mut(&mut self) -> &mut Drive {
        &mut self.drive
    }

    fn drive_constants_mut(c: &mut Constants<f64>) -> &mut DriveConstants<f64> {
        &mut c.drive
    }

    fn modes(c: &Constants<f64>) -> [Mode; 2] {
        Mode::pair(["mode_1", "mode_2"], DirectDrive::linear_modes(c))
    }

    fn rest_voltage(_c: &Constants<f64>) -> f64 {
        0.0
    }

    fn struck(c: &Constants<f64>, stroke_rate: f64) -> [f64; 4] {
        states::struck(DirectDrive::mass_at_rest(c), stroke_rate)
    }

    fn placed(_c: &Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<Wave<f64>, 4> {
        states::placed(stroke, pitch)
    }
}

impl DirectDrive {
    /// Natural frequencies (Hz) of small motions about ψ = 0 with the added mass of still air, the lower first.
    pub fn linear_modes(c: &Constants<f64>) -> [f64; 2] {
        natural_frequencies(DirectDrive::mass_at_rest(c), [c.k_phi, c.k_w])
    }

    /// The mass matrix [M₁₁, M₁₂, M₂₂] (kg·m²) at ψ = 0, with the added mass.
    fn mass_at_rest(c: &Constants<f64>) -> [f64; 3] {
        [c.m11 + c.a11, c.m12 - c.a12, c.m22 + c.a22]
    }
}
