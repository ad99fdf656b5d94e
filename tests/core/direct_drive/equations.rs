//! Forces, moments and accelerations against reference vectors, on scalars and lanes.

use fearless_simd::Simd;
use flap_core::drive::Driven;
use flap_core::model::direct_drive::{
    Constants, DirectDrive, Params, added_mass, aerodynamics, current, lift, mean_velocity,
};
use flap_core::num::{Arithmetic, InstructionSet, Kernel, Lanes, PerLane, Unfused, Vector};
use flap_core::ode::Ode;

use super::{centre_of_pressure, params};
use crate::data::{Record, assert_close, table};

const TOLERANCE: f64 = 1e-11;

struct Case {
    constants: Constants<f64>,
    drive: Driven<f64>,
    side: f64,
    y: [f64; 4],
    record: Record,
}

fn cases() -> Vec<Case> {
    table("direct-drive/rhs_vectors.csv")
        .into_iter()
        .map(|record| Case {
            constants: Constants::derive(&Params {
                centre_of_pressure: centre_of_pressure(record.text("dcp")),
                ..params(record.text("type"))
            })
            .unwrap(),
            drive: Driven::with_rate(record.number("V_V"), record.number("Vdot_V_s")),
            side: record.number("ubar_m_s").signum(),
            y: ["phi", "psi", "phidot", "psidot"].map(|column| record.number(column)),
            record,
        })
        .collect()
}

#[test]
fn accelerations_forces_and_moments_equal_the_reference() {
    for case in cases() {
        let Case { constants: c, drive, side, y, record } = case;
        let dy = DirectDrive::default().rhs(&c, &drive, side, &y);
        let (sin, cos) = y[1].sin_cos();
        let air = aerodynamics(&c, side, &y, sin, cos);
        let added = added_mass(&c, sin, cos, &dy);
        for (column, actual) in [
            ("phidot", dy[0]),
            ("psidot", dy[1]),
            ("phiddot", dy[2]),
            ("psiddot", dy[3]),
            ("F_lift_N", lift(&c, &air, &added, sin)),
            ("F_tr_lift_N", air.lift),
            ("F_am_N", added.force),
            ("M_tr_y_Nm", air.stroke_moment),
            ("M_tr_x_Nm", air.pitch_moment),
            ("M_rot_Nm", air.rotation_moment),
            ("M_am_y2_Nm", added.chord_moment),
            ("M_am_x_Nm", added.span_moment),
            ("ubar_m_s", mean_velocity(&c, &y, &dy)[0]),
            ("current_A", current(&c, &drive, y[2])),
        ] {
            assert_close(actual, record.number(column), TOLERANCE, &format!("{column} of {}", record.name));
        }
    }
}

/// The rate that comes with the switching function is its derivative along the motion.
#[test]
fn rate_of_the_mean_velocity_is_its_derivative() {
    for Case { constants: c, drive, side, y, record } in cases() {
        let dy = DirectDrive::default().rhs(&c, &drive, side, &y);
        let [_, rate] = mean_velocity(&c, &y, &dy);
        let at = |dt: f64| mean_velocity(&c, &std::array::from_fn(|i| y[i] + dt * dy[i]), &dy)[0];
        let dt = 1e-8;
        assert_close((at(dt) - at(-dt)) / (2.0 * dt), rate, 1e-5, &record.name);
    }
}

struct RhsOnLanes;

impl Kernel for RhsOnLanes {
    type Output = (Vec<[f64; 4]>, usize);

    /// Derivatives of all cases, a different one in every lane.
    fn run<S: Simd>(self, simd: S) -> (Vec<[f64; 4]>, usize) {
        let cases = cases();
        let mut derivatives = Vec::new();
        for group in cases.chunks(Vector::<S>::LANES) {
            let zero = Vector::<S>::splat(simd, 0.0);
            let mut c = Constants::<Vector<S>>::fill(simd, &group[0].constants);
            let mut drive = Driven::with_rate(zero, zero);
            let mut side = zero;
            let mut y = [zero; 4];
            for (lane, case) in group.iter().enumerate() {
                c.set(lane, &case.constants);
                drive.value.set_lane(lane, case.drive.value);
                side.set_lane(lane, case.side);
                for i in 0..4 {
                    y[i].set_lane(lane, case.y[i]);
                }
            }
            let dy = DirectDrive::default().rhs(&c, &drive, side, &y);
            derivatives.extend((0..group.len()).map(|lane| dy.map(|d| d.lane(lane))));
        }
        (derivatives, Vector::<S>::LANES)
    }
}

#[test]
fn every_lane_equals_the_scalar_bit_for_bit() {
    for set in InstructionSet::available() {
        let (derivatives, lanes) = set.dispatch(RhsOnLanes);
        assert!(lanes >= 4, "{set} has {lanes} lanes");
        for (case, lane) in cases().iter().zip(derivatives) {
            let scalar = match set.arithmetic() {
                Arithmetic::Fused => {
                    DirectDrive::default().rhs(&case.constants, &case.drive, case.side, &case.y)
                }
                Arithmetic::Unfused => {
                    let c = Constants::<Unfused>::fill((), &case.constants);
                    let drive = Driven::with_rate(Unfused(case.drive.value), Unfused(case.drive.rate));
                    DirectDrive::default()
                        .rhs(&c, &drive, Unfused(case.side), &case.y.map(Unfused))
                        .map(|d| d.0)
                }
            };
            assert_eq!(lane.map(f64::to_bits), scalar.map(f64::to_bits), "{set}, {}", case.record.name);
        }
    }
}

#[test]
fn arithmetic_classes_agree_to_rounding() {
    for case in cases() {
        let fused = DirectDrive::default().rhs(&case.constants, &case.drive, case.side, &case.y);
        let c = Constants::<Unfused>::fill((), &case.constants);
        let drive = Driven::with_rate(Unfused(case.drive.value), Unfused(case.drive.rate));
        let unfused = DirectDrive::default().rhs(&c, &drive, Unfused(case.side), &case.y.map(Unfused));
        for i in 0..4 {
            assert_close(unfused[i].0, fused[i], 1e-11, &case.record.name);
        }
    }
}
