//! Flights of a vehicle over time: conservation laws, symmetry, and the linear model.

#![allow(clippy::unwrap_used, reason = "helpers of tests may panic as tests do")]

use flap_core::body::BodyParameters;
use flap_core::parameter::Parameter;
use flap_core::simulate::{SolverSettings, never};
use flap_sweep::plan::Plan;
use flap_sweep::vehicle::control::{Input, VehicleRun};
use flap_sweep::vehicle::flight::{FED_BACK, FlightError, FlightRecord, FlightRequest, fly};
use nalgebra::{DMatrix, Rotation3, Vector3};

use crate::support::plan;

/// The case `t1_140` of `tests/data/body`. Its weight is the lift.
const ROBOT: &str = "\
preset = \"jafferis2016\"
[vehicle]
about = [0, 0, \"-3 mm\"]
total_mass = 6.915643907926958e-5
body_inertia_roll = 1.5e-9
body_inertia_pitch = 1.5e-9
body_inertia_yaw = 0.5e-9
[[vehicle.wings]]
name = \"left\"
position = [0, \"2 mm\", 0]
[[vehicle.wings]]
name = \"right\"
position = [0, \"2 mm\", 0]
mirrored = true
[params]
drive_voltage_pp = \"140 V\"
drive_frequency = \"120 Hz\"
";

/// The mass of the robot (kg).
const MASS: f64 = 6.915_643_907_926_958e-5;

const REST: FlightRequest = FlightRequest {
    seconds: 0.2,
    disturbance: [0.0; FED_BACK],
    inputs: Vec::new(),
    gains: None,
    is_averaged: false,
    samples: None,
};

fn try_to_fly(plan: &Plan, request: &FlightRequest) -> Result<FlightRecord, FlightError> {
    let vehicle_run =
        VehicleRun { vehicle: plan.vehicle().unwrap(), solver: plan.solver(), interrupted: &never };
    fly(&vehicle_run, &plan.point(0).values, request)
}

fn flown(plan: &Plan, request: &FlightRequest) -> FlightRecord {
    let record = try_to_fly(plan, request).unwrap();
    assert_eq!(record.end, None);
    record
}

/// A flight request with a disturbance of one state.
fn disturbed(state: usize, by: f64) -> FlightRequest {
    let mut disturbance = [0.0; FED_BACK];
    disturbance[state] = by;
    FlightRequest { disturbance, ..REST.clone() }
}

/// A tumbling body in vacuum falls on a parabola, and keeps energy and angular momentum.
#[test]
fn a_body_in_vacuum_falls_freely() {
    let vacuum = ROBOT.replace("140 V", "0 V") + "air_density = 0\n";
    let vacuum = plan(&vacuum.replace("body_inertia_yaw", "body_inertia_product = 0.2e-9\nbody_inertia_yaw"));
    let disturbance = [0.3, -0.2, 0.5, 20.0, -30.0, 40.0, 0.1, 0.2, 0.3];
    let record =
        flown(&vacuum, &FlightRequest { seconds: 0.1, disturbance, samples: Some(3), ..REST.clone() });
    let (mass, gravity, moments, product) = (MASS, 9.80665, [1.5e-9, 1.5e-9, 0.5e-9], 0.2e-9);
    let at = |row: &[f64]| {
        let velocity = Vector3::new(row[1], row[2], row[3]);
        let rate = Vector3::new(row[4], row[5], row[6]);
        let turned = Rotation3::from_euler_angles(row[7], row[8], row[9]);
        let spin = Vector3::new(
            moments[0] * rate.x - product * rate.z,
            moments[1] * rate.y,
            moments[2] * rate.z - product * rate.x,
        );
        let energy = 0.5 * (mass * velocity.norm_squared() + rate.dot(&spin)) + mass * gravity * row[12];
        (turned * velocity, turned * spin, energy)
    };
    assert_eq!(record.rows.len(), 36);
    let (velocity, spin, energy) = at(&record.rows[0]);
    for row in &record.rows {
        let time = row[0];
        let (now, spin_now, energy_now) = at(row);
        assert!((energy_now / energy - 1.0).abs() < 1e-5, "{energy_now} J after {energy} J at {time} s");
        assert!((spin_now - spin).norm() < 1e-5 * spin.norm(), "{spin_now} after {spin} at {time} s");
        let fallen = velocity - Vector3::new(0.0, 0.0, gravity * time);
        assert!((now - fallen).norm() < 1e-6, "{now} instead of {fallen} at {time} s");
        let place = velocity * time - Vector3::new(0.0, 0.0, 0.5 * gravity * time * time);
        assert!((Vector3::new(row[10], row[11], row[12]) - place).norm() < 1e-7);
        assert!(row[13..].iter().all(|component| *component == 0.0));
    }
}

/// The robot with `factor` times its mass and inertia, and the same weight: all accelerations are smaller.
fn robot(factor: f64) -> Plan {
    let inertia = |name: &str, value: f64| format!("{name} = {:e}\n", value * factor);
    let properties = [
        inertia("total_mass", MASS),
        inertia("body_inertia_roll", 1.5e-9),
        inertia("body_inertia_pitch", 1.5e-9),
        inertia("body_inertia_yaw", 0.5e-9),
        format!("gravity = {}\n", 9.80665 / factor),
    ];
    let (before, after) = ROBOT.split_once("total_mass").unwrap();
    let (_, wings) = after.split_once("[[").unwrap();
    plan(&format!("{before}{}[[{wings}", properties.concat()))
}

/// Returns the largest difference between coupled flight and linear model in the disturbed state, as a share of this state.
///
/// The undisturbed flight `at_rest` is subtracted from the coupled flight.
fn deviation(plan: &Plan, at_rest: &FlightRecord, seconds: f64, state: usize, by: f64) -> f64 {
    let request = FlightRequest { seconds, ..disturbed(state, by) };
    let coupled = flown(plan, &request);
    let averaged = flown(plan, &FlightRequest { is_averaged: true, ..request });
    let (mut error, mut size) = (0.0_f64, 0.0_f64);
    for ((coupled, averaged), rest) in coupled.rows.iter().zip(&averaged.rows).zip(&at_rest.rows) {
        assert!((coupled[0] - averaged[0]).abs() < 1e-12);
        error = error.max((coupled[1 + state] - rest[1 + state] - averaged[1 + state]).abs());
        size = size.max(averaged[1 + state].abs());
    }
    error / size
}

/// The robot follows the linear model after small disturbances, within the share in the table.
///
/// The linear model leaves out the vibration of the body in each beat. It is exact for a heavy body.
#[test]
fn small_disturbances_are_those_of_the_linear_model() {
    let [(light, light_at_rest), (heavy, heavy_at_rest)] =
        [(1.0, 0.2), (30.0, 1.0)].map(|(factor, seconds)| {
            let plan = robot(factor);
            let at_rest = flown(&plan, &FlightRequest { seconds, ..REST.clone() });
            (plan, at_rest)
        });
    for (state, by, limit, limit_heavy) in [
        (0, 0.02, 0.15, 0.01),
        (1, 0.02, 0.1, 0.01),
        (2, 0.02, 0.01, 0.002),
        (3, 1.0, 0.05, 0.01),
        (4, 1.0, 0.12, 0.01),
        (5, 1.0, 0.3, 0.02),
        (6, 0.02, 0.1, 0.01),
        (7, 0.02, 0.12, 0.01),
    ] {
        let found = deviation(&light, &light_at_rest, 0.2, state, by);
        let found_heavy = deviation(&heavy, &heavy_at_rest, 1.0, state, by / 30.0);
        assert!(found < limit && found_heavy < limit_heavy);
    }
}

/// Without a disturbance, a trimmed vehicle stays at its position. The vibration of the body adds 0.3 % of the weight
/// to the lift.
#[test]
fn a_vehicle_at_hover_stays() {
    for (factor, share) in [(1.0, 1.0), (30.0, 0.05)] {
        for row in flown(&robot(factor), &REST).rows {
            assert!(row[1].abs() < 0.002 * share && row[3].abs() < 0.03 * share, "{row:?}");
            assert!(row[5].abs() < 0.02 * share && row[8].abs() < 0.002 * share, "{row:?}");
            assert!((row[15] / 0.678_193 - 1.0).abs() < 0.006 * share, "{row:?}");
            // Symmetric wings give no other motion.
            for other in [2, 4, 6, 7, 9, 11, 14, 16, 18] {
                assert_eq!(row[other].abs().to_bits(), 0, "{row:?}");
            }
        }
    }
}

/// The mirrored disturbance gives the mirrored flight, within errors of integration. Rounding changes the steps.
#[test]
fn a_mirrored_disturbance_gives_a_mirrored_flight() {
    let plan = plan(ROBOT);
    let mirror =
        [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
    let disturbance = [0.05, 0.08, -0.03, 1.0, 2.0, -3.0, 0.05, 0.02, 0.1];
    let other = core::array::from_fn(|i| disturbance[i] * mirror[i]);
    let [one, other] = [disturbance, other].map(|disturbance| {
        flown(&plan, &FlightRequest { disturbance, samples: Some(2), ..REST.clone() }).rows
    });
    let mut largest = [0.0_f64; 18];
    let mut errors = [0.0_f64; 18];
    for (one, other) in one.iter().zip(&other) {
        for i in 0..18 {
            largest[i] = largest[i].max(one[1 + i].abs());
            errors[i] = errors[i].max((one[1 + i] - mirror[i] * other[1 + i]).abs());
        }
    }
    for i in 0..18 {
        assert!(errors[i] < 2e-4 * largest[i], "{} of {} in column {}", errors[i], largest[i], i + 1);
    }
}

/// Impossible requests return a reason.
#[test]
fn impossible_flights_are_refused() {
    let plan = plan(ROBOT);
    let refused = |request: FlightRequest| try_to_fly(&plan, &request).unwrap_err().to_string();
    assert!(refused(FlightRequest { seconds: 0.0, ..REST.clone() }).starts_with("a flight of 0 s"));
    assert!(refused(FlightRequest { samples: Some(0), ..REST.clone() }).starts_with("0 samples"));
    assert!(refused(disturbed(3, f64::NAN)).starts_with("the disturbance of rate_roll"));
    let inputs = vec![Input::of(plan.vehicle().unwrap(), "bias").unwrap()];
    let gains = Some(DMatrix::zeros(2, FED_BACK));
    let message = refused(FlightRequest { inputs: inputs.clone(), gains, ..REST.clone() });
    assert!(message.starts_with("the gains have 2 rows and 9 columns, but must be 1 x 9"), "{message}");
}

/// A heavy body moves steadily. In each model, its wings settle on the force and torque of a row with the same body
/// motion.
#[test]
fn wings_on_a_heavy_body_have_the_wrench_of_rows() {
    for (design, limit) in [
        ("preset = \"jafferis2016\"\n[params]\ndrive_voltage_pp = 140\ndrive_frequency = 120\n", 1e-6),
        ("preset = \"ozaki2018-large\"\n[params]\nflow_direction = \"blade\"\n", 1e-5),
        ("preset = \"arabagi2013-75hz\"\n[params]\n", 1e-4),
    ] {
        let heavy = plan(&format!(
            "{design}\n[vehicle]\nabout = [0, 0, -0.003]\ntotal_mass = 1e6\nbody_inertia_roll = 1\nbody_inertia_pitch = 1\n\
             body_inertia_yaw = 1\ngravity = 1e-12\n[[vehicle.wings]]\nname = \"left\"\nposition = [0, 0.002, 0]\n\
             plane = {{ pitch = 0.1 }}\n[[vehicle.wings]]\nname = \"right\"\nposition = [0, 0.002, 0]\nmirrored = true\n"
        ));
        let solver = SolverSettings { rtol: 1e-9, atol: 1e-11, ..*heavy.solver() };
        let vehicle_run =
            VehicleRun { vehicle: heavy.vehicle().unwrap(), solver: &solver, interrupted: &never };
        let parameters = heavy.parameters();
        for motion in [[0.2, -0.3, 0.1, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 3.0, -5.0, 8.0]] {
            let mut values = heavy.point(0).values;
            let mut disturbance = [0.0; FED_BACK];
            for (i, name) in BodyParameters::MOTION.iter().enumerate() {
                values[Parameter::index(parameters, name).unwrap()] = motion[i];
                disturbance[i] = motion[i];
            }
            let expected = vehicle_run.wrench(&vehicle_run.row(&values, None));
            let request = FlightRequest { seconds: 0.6, disturbance, ..REST.clone() };
            let record = fly(&vehicle_run, &heavy.point(0).values, &request).unwrap();
            let found = &record.rows.last().unwrap()[13..];
            for part in [0..3, 3..6] {
                let size = part.clone().map(|i| expected[i].abs()).fold(0.0, f64::max);
                for i in part {
                    let error = (found[i] - expected[i]).abs() / size;
                    assert!(error < limit, "{design}: {found:?} instead of {expected:?}");
                }
            }
        }
    }
}

/// A flight begins with the given yaw, also beyond half a turn.
#[test]
fn a_flight_begins_with_any_yaw() {
    let plan = plan(ROBOT);
    let yaw = |by: f64, is_averaged: bool| {
        let request = FlightRequest { seconds: 0.02, is_averaged, ..disturbed(8, by) };
        let record = flown(&plan, &request);
        let place = record.columns.iter().position(|column| column == "angle_yaw_rad").unwrap();
        record.rows[0][place]
    };
    for by in [0.0, 3.0, 3.5, 4.8, 7.0] {
        assert!((yaw(by, false) - by).abs() < 0.02, "{by}: {}", yaw(by, false));
        assert!((yaw(by, true) - by).abs() < 0.02, "{by}: {}", yaw(by, true));
    }
}

/// The yaw angle is the integral of the yaw rate, also if the body turns more than once in a wing beat.
#[test]
fn fast_turns_change_the_yaw_by_their_rate() {
    let heavy = plan(&ROBOT.replace("0.5e-9", "5e-8").replace("1.5e-9", "5e-8"));
    for (rate, samples) in [(400.0, None), (-400.0, None), (1800.0, None), (1800.0, Some(2))] {
        let request = FlightRequest { seconds: 0.06, samples, ..disturbed(5, rate) };
        let record = flown(&heavy, &request);
        let [time, yaw_rate, yaw] = ["time_s", "rate_yaw_rad_s", "angle_yaw_rad"]
            .map(|name| record.columns.iter().position(|column| column == name).unwrap());
        for two in record.rows.windows(2) {
            let change = two[1][yaw] - two[0][yaw];
            let mean = f64::midpoint(two[0][yaw_rate], two[1][yaw_rate]);
            let expected = mean * (two[1][time] - two[0][time]);
            assert!((change - expected).abs() < 0.02 * expected.abs(), "{rate}: {change}, not {expected}");
        }
    }
}

/// Both kinds of flight end at the first beat for which an input is out of range.
#[test]
fn flights_end_where_an_input_leaves_its_range() {
    let plan = plan(ROBOT);
    let inputs = vec![Input::of(plan.vehicle().unwrap(), "amplitude").unwrap()];
    // 140 V less a gain times the velocity leaves the range in the second beat.
    let mut gains = DMatrix::zeros(1, FED_BACK);
    gains[(0, 0)] = 1e6;
    for is_averaged in [false, true] {
        let (inputs, gains) = (inputs.clone(), Some(gains.clone()));
        let record =
            try_to_fly(&plan, &FlightRequest { inputs, gains, is_averaged, ..disturbed(0, 0.1) }).unwrap();
        assert_eq!(record.rows.len(), 1);
        let end = record.end.unwrap();
        assert!(end.contains("drive_voltage_pp is -"), "{end}");
        if !is_averaged {
            assert!(end.starts_with("drive_voltage_pp is -"), "{end}");
            assert_eq!(record.columns[13], "amplitude");
            assert_eq!(record.rows[0][13].to_bits(), 140.0_f64.to_bits());
        }
    }
}
