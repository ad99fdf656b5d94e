//! Rows and single motions of the direct-drive model.

use super::columns::{self, S};
use super::constants::Constants;
use super::dynamics::DirectDrive;
use super::params::Params;
use super::rhs::{added_mass, aerodynamics, current, lift, load};
use super::wing;
use crate::aero::Wing;
use crate::drive::{Drive, DriveConstants, Wave};
use crate::model::stroke_and_pitch as states;
use crate::model::{Derived, Description, EnergyBalance, Imposed, Instant, Load, Model, Motions, Signal};
use crate::modes::Mode;
use crate::num::Lanes;
use crate::ode::Start;
use crate::parameter::Invalid;

impl Model<4, S> for DirectDrive {
    const DESCRIPTION: Description = Description {
        name: "direct-drive",
        doc: "unimorph bolted to the wing, passive pitch, blade-element aerodynamics (Ozaki and Hamaguchi 2018)",
        parameters: Params::TABLE,
        presets: Params::PRESETS,
    };
    const STATES: [&'static str; 4] = states::NAMES;
    const SIGNALS: [Signal; S] = columns::SIGNALS;
    const DERIVED: &'static [Derived<DirectDrive, Constants<f64>, S>] = columns::DERIVED;
    const LOADS: bool = true;
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

    fn wing(wing: &Wing) -> Vec<(&'static str, f64)> {
        wing::parameters(wing)
    }

    #[inline(always)]
    fn drive<R: Lanes>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    #[inline(always)]
    fn signals<R: Lanes>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> [R; S] {
        let Instant { input: drive, side, y, dy } = at;
        let y = states::state(&self.drive, drive, y);
        let [phi, psi, phi_dot, psi_dot] = y;
        let (sin, cos) = psi.sin_cos();
        let air = aerodynamics(c, self.flow, side, &y, sin, cos);
        let added = added_mass(c, sin, cos, &states::slope(&self.drive, drive, dy));
        // A prescribed stroke says nothing about the actuator.
        let unknown = self.drive.prescribes_stroke();
        let leakage = c.conductance * (drive.value - self.drive.mean_voltage(&c.drive));
        let [current, leakage] =
            if unknown { [phi.lit(f64::NAN); 2] } else { [current(c, drive, phi_dot) + leakage, leakage] };
        [
            phi,
            psi,
            lift(c, &air, &added, sin),
            air.lift,
            air.drag,
            current * drive.value,
            -(air.stroke_moment * phi_dot + air.pitch_moment * psi_dot),
            -(air.rotation_moment * psi_dot),
            c.stroke_damping * phi_dot * phi_dot,
            c.hinge_damping * psi_dot * psi_dot,
            leakage * drive.value,
            current,
            (drive.value - c.drive.bias) * (current - c.c_p * drive.rate),
        ]
    }

    #[inline(always)]
    fn load<R: Lanes>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Load<R> {
        let Instant { input: drive, side, y, dy } = at;
        let y = states::state(&self.drive, drive, y);
        let (sin, cos) = y[1].sin_cos();
        let air = aerodynamics(c, self.flow, side, &y, sin, cos);
        let added = added_mass(c, sin, cos, &states::slope(&self.drive, drive, dy));
        load(c, &air, &added, &y, [sin, cos])
    }
}

impl Motions<4, S> for DirectDrive {
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
