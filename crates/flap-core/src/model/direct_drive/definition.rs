//! Rows and single motions of the direct-drive model.

use super::columns::{self, Signals};
use super::constants::Constants;
use super::dynamics::DirectDrive;
use super::params::Params;
use super::rhs::{added_mass, aerodynamics, current, lift, load};
use super::wing;
use crate::aero::Wing;
use crate::drive::{Drive, DriveConstants, Wave};
use crate::model::stroke_and_pitch as states;
use crate::model::{Derived, Description, Imposed, Instant, Load, Model, Motions, Signal, SignalCycle};
use crate::modes::Mode;
use crate::num::Real;
use crate::ode::Start;
use crate::parameter::Invalid;

impl Model<4> for DirectDrive {
    type Signals = Signals;

    const DESCRIPTION: Description = Description {
        name: "direct-drive",
        doc: "unimorph bolted to the wing, passive pitch, blade-element aerodynamics (Ozaki and Hamaguchi 2018)",
        parameters: Params::TABLE,
        presets: Params::PRESETS,
    };
    const STATES: [&'static str; 4] = states::NAMES;
    const DERIVED: &'static [Derived<DirectDrive, Constants<f64>, Signals>] = columns::DERIVED;
    const LOADS: bool = true;

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
    fn drive<R: Real>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    #[inline(always)]
    fn signals<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Signals<R> {
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
        Signals {
            stroke: phi,
            pitch: psi,
            lift: lift(c, &air, &added, sin),
            lift_translational: air.lift,
            drag: air.drag,
            power: current * drive.value,
            power_translational: -(air.stroke_moment * phi_dot + air.pitch_moment * psi_dot),
            power_rotational: -(air.rotation_moment * psi_dot),
            power_stroke_damping: c.stroke_damping * phi_dot * phi_dot,
            power_hinge_damping: c.hinge_damping * psi_dot * psi_dot,
            power_dielectric: leakage * drive.value,
            current,
            power_transduced: (drive.value - c.drive.bias) * (current - c.c_p * drive.rate),
        }
    }

    /// ⟨Vj⟩ = −⟨M_tr,y φ̇ + (M_tr,x′ + M_rot) ψ̇⟩ + ⟨damping⟩ + ⟨dielectric loss⟩: all else is given back within a period.
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
        let air = aerodynamics(c, self.flow, side, &y, sin, cos);
        let added = added_mass(c, sin, cos, &states::slope(&self.drive, drive, dy));
        load(c, &air, &added, &y, [sin, cos])
    }
}

impl Motions<4> for DirectDrive {
    const FREE_SIGNALS: &'static [Signal] = &[Signals::SIGNALS.stroke, Signals::SIGNALS.pitch];

    fn drive_mut(&mut self) -> &mut Drive {
        &mut self.drive
    }

    fn drive_constants_mut(c: &mut Constants<f64>) -> &mut DriveConstants<f64> {
        &mut c.drive
    }

    fn modes(c: &Constants<f64>) -> Vec<Mode> {
        Mode::of(["mode_1", "mode_2"], DirectDrive::linear_modes(c))
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
