//! Loads of the air on wings: against independent sums over strips, and against energy and momentum.

use flap_core::model::bimorph::{self, Bimorph};
use flap_core::model::direct_drive::{self, DirectDrive};
use flap_core::model::four_bar::{self, FourBar};
use flap_core::model::{Instant, Load, Model, SignalSet};
use flap_core::num::Backend;
use flap_core::parameter::Parameter;
use flap_core::simulate::{PointRun, SolverSettings, Status, preset};

use crate::by_name::design;
use crate::data::assert_close;

/// An instant of a motion, its load, and its signals.
struct At<S: SignalSet> {
    y: [f64; 4],
    dy: [f64; 4],
    load: Load<f64>,
    signals: S::Of<f64>,
}

/// Instants of the settled motion of a preset with changes.
fn instants<M: Model<4>>(
    model: &M,
    values: &[f64],
    side: impl Fn(&M::Constants<f64>, &[f64; 4], &[f64; 4]) -> f64,
) -> (M::Constants<f64>, Vec<At<M::Signals>>) {
    let simulator = flap_core::simulate::by_name(M::DESCRIPTION.name).unwrap();
    let solver = SolverSettings::DEFAULT.with_rtol(1e-9);
    let run = PointRun::new(Backend::best(), &solver, values);
    let request = flap_core::simulate::TrajectoryRequest { cycles: 1, samples_per_cycle: 200, settled: true };
    let motion = simulator.motions().unwrap().trajectory(&run, &request).unwrap();
    let model = model.variant(values);
    let c = model.start(values).unwrap().constants;
    let at = motion.rows.iter().map(|row| {
        let y = [row[1], row[2], row[3], row[4]];
        let input = model.input(&c, row[0]);
        let guess = model.rhs(&c, &input, 1.0, &y);
        let side = side(&c, &y, &guess);
        let dy = model.rhs(&c, &input, side, &y);
        let instant = Instant { input: &input, side, y: &y, dy: &dy };
        At { y, dy, load: model.load(&c, instant), signals: model.signals(&c, instant) }
    });
    let at = at.collect();
    (c, at)
}

/// Integrals over the span by Simpson's rule. `strip` returns force along the stroke axis, force against the stroke,
/// and moment about the span axis, each per width.
fn over_span(offset: f64, length: f64, strip: impl Fn(f64, f64) -> [f64; 3]) -> [f64; 5] {
    const PARTS: u32 = 2000;
    let mut sums = [0.0; 5];
    for i in 0..=PARTS {
        let x = f64::from(i) / f64::from(PARTS);
        let rule = if i == 0 || i == PARTS { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
        let weight = rule * length / f64::from(3 * PARTS);
        let radius = offset + x * length;
        let [lift, drag, span] = strip(radius, x);
        for (sum, part) in sums.iter_mut().zip([lift, drag, radius * lift, radius * drag, span]) {
            *sum += weight * part;
        }
    }
    sums
}

fn assert_load(load: &Load<f64>, sums: [f64; 5], size: [f64; 2], what: &str) {
    let found = [load.lift, load.drag, load.lift_moment, load.drag_moment, load.span_moment];
    for (i, (found, expected)) in found.into_iter().zip(sums).enumerate() {
        let size = size[usize::from(i > 1)];
        assert!(
            (found - expected).abs() < 1e-6 * size,
            "{what}, {i}: {found:e}, not {expected:e} of {size:e}"
        );
    }
}

/// Largest force and moment of a motion.
fn sizes<S: SignalSet>(at: &[At<S>]) -> [f64; 2] {
    let largest = |part: fn(&Load<f64>) -> f64| at.iter().map(|at| part(&at.load).abs()).fold(0.0, f64::max);
    [largest(|load| load.drag), largest(|load| load.drag_moment)]
}

#[test]
fn the_load_of_the_four_bar_is_that_of_its_strips() {
    for arms in [0.0, 1.0] {
        let values = design("arabagi2013-75hz", &[("arms", arms), ("strips", 32.0)]).1;
        let p = four_bar::Params::from_values(&values);
        let side = |_: &_, y: &[f64; 4], _: &[f64; 4]| y[1].tan().signum();
        let (_, at) = instants(&FourBar::SINE, &values, side);
        let sizes = sizes(&at);
        let mut compared = 0;
        for (i, at) in at.iter().enumerate() {
            let [_, phi, _, _] = at.y;
            let [theta_dot, phi_dot, theta_ddot, phi_ddot] = at.dy;
            let (sin, cos) = phi.sin_cos();
            let kappa = if arms == 0.0 { 0.5 } else { 0.5 - p.axis_position };
            let velocity = |r: f64, c: f64| r * theta_dot + kappa * c * phi_dot * cos;
            let chord = |x: f64| p.chord(x).max(0.0);
            // Gauss's rule is exact where the flow has one direction.
            let directions: Vec<bool> = (0..=100)
                .map(|i| f64::from(i) / 100.0)
                .map(|x| velocity(p.wing_offset + x * p.wing_length, chord(x)) > 0.0)
                .collect();
            if directions.contains(&true) && directions.contains(&false) {
                continue;
            }
            compared += 1;
            let sums = over_span(p.wing_offset, p.wing_length, |r, x| {
                let c = chord(x);
                let u = velocity(r, c);
                let s = u.signum();
                // The attack angle, from the flow to the chord, folded to at most 90 degrees.
                let alpha = std::f64::consts::FRAC_PI_2 + s * phi;
                let folded = std::f64::consts::FRAC_PI_2 - (alpha - std::f64::consts::FRAC_PI_2).abs();
                let lift = p.lift_offset + p.lift_amplitude * (p.lift_slope * folded - p.lift_phase).sin();
                let drag = p.drag_offset - p.drag_amplitude * (p.drag_slope * folded - p.drag_phase).cos();
                let q = 0.5 * p.air_density * u * u * c;
                let upwards = -(alpha - std::f64::consts::FRAC_PI_2).signum();
                let (force_up, force_along) = (upwards * lift * q, -s * drag * q);
                let centre = p.pressure_slope * alpha + p.pressure_offset;
                let lever = (centre - if arms == 0.0 { 0.0 } else { p.axis_position }) * c;
                // Along the wing's normal (cos φ along the stroke, sin φ up), at the distance `lever` below the axis.
                let normal = force_along * cos + force_up * sin;
                // Rotation: each element of the chord, at z behind the axis, is pushed against its own motion.
                let (behind, before) = ((1.0 - p.axis_position) * c, p.axis_position * c);
                let rotation = -0.5 * p.rotation_drag * p.air_density * phi_dot.abs() * phi_dot;
                let rotated = rotation * (behind.powi(3) - before.powi(3)) / 3.0;
                let turned = rotation * (behind.powi(4) + before.powi(4)) / 4.0;
                // Added mass at the mid-chord.
                let mid = (0.5 - p.axis_position) * c;
                let acceleration = r * (theta_ddot * cos - theta_dot * phi_dot * sin) + mid * phi_ddot;
                let added = -std::f64::consts::FRAC_PI_4 * p.air_density * c * c * acceleration;
                let more = rotated + added;
                [
                    force_up + more * sin,
                    -(force_along + more * cos),
                    // The moment that turns φ up turns the trailing edge with the stroke.
                    -(normal * lever + turned + added * mid),
                ]
            });
            assert_load(&at.load, sums, sizes, &format!("arms {arms}, sample {i}"));
        }
        assert!(compared > 100, "{compared} samples");
    }
}

#[test]
fn the_load_of_the_direct_drive_is_that_of_its_strips() {
    let chord = |x: f64| 9e-3 * (1.0 - 0.4 * x);
    let mut changes = vec![("chord_table", 1.0), ("mean_chord", 7.2e-3)];
    let stations: Vec<String> = (0..11).map(|i| format!("chord_{i}")).collect();
    for (i, station) in stations.iter().enumerate() {
        changes.push((station, chord(0.1 * i as f64)));
    }
    let values = design("ozaki2018-large", &changes).1;
    let p = direct_drive::Params::from_values(&values);
    let offset = p.wing_offset.unwrap_or(0.5 * p.actuator_length);
    let mid = p.wing_length * 0.5 + offset;
    let mean_velocity = |y: &[f64; 4]| mid * y[2] - 0.5 * chord(0.5) * y[3] * y[1].cos();
    let side = |_: &_, y: &[f64; 4], _: &[f64; 4]| mean_velocity(y).signum();
    let (_, at) = instants(&DirectDrive::SINE, &values, side);
    let sizes = sizes(&at);
    // The mean chord and the span make the lift coefficient.
    let mean_chord = 9e-3 * 0.8;
    let aspect = 0.5 * p.wing_length / mean_chord;
    let k_lift =
        std::f64::consts::FRAC_PI_2 * (p.wing_length / mean_chord) / (1.0 + (aspect * aspect + 1.0).sqrt());
    for (i, at) in at.iter().enumerate() {
        let [_, psi, phi_dot, psi_dot] = at.y;
        let [_, _, phi_ddot, psi_ddot] = at.dy;
        let (sin, cos) = psi.sin_cos();
        let s = mean_velocity(&at.y).signum();
        let c_lift = k_lift * (2.0 * psi).sin();
        let c_drag = 0.5 * (p.drag_coefficient_max + p.drag_coefficient_min)
            + 0.5 * (p.drag_coefficient_max - p.drag_coefficient_min) * (2.0 * psi).cos();
        let rotation = -0.5 * p.air_density * p.rotation_drag * psi_dot * psi_dot.abs();
        let sums = over_span(offset, p.wing_length, |r, x| {
            let c = chord(x);
            let u = r * phi_dot - 0.5 * c * psi_dot * cos;
            let q = 0.5 * p.air_density * c * u * u * s;
            let (lift, drag) = (c_lift * q, c_drag * q);
            let attack = (std::f64::consts::FRAC_PI_2 - s * psi).abs();
            let lever = (p.pressure_slope * attack + p.pressure_offset) * c;
            let acceleration = r * (phi_ddot * cos - phi_dot * psi_dot * sin) - 0.5 * c * psi_ddot;
            let added = -std::f64::consts::FRAC_PI_4 * p.air_density * c * c * acceleration;
            [
                lift - added * sin,
                drag - added * cos,
                (lift * sin + drag * cos) * lever + rotation * 0.25 * c.powi(4) - added * 0.5 * c,
            ]
        });
        assert_load(&at.load, sums, sizes, &format!("sample {i}"));
    }
}

/// The drag's moment times the stroke rate is the power of the drag. The moment about the hinge is the moment in the
/// equation of motion (2).
#[test]
fn the_load_of_the_bimorph_does_its_work() {
    let values = design("jafferis2016", &[]).1;
    let p = bimorph::Params::from_values(&values);
    let (_, at) = instants(&Bimorph::SINE, &values, |_, _, _| 1.0);
    let sizes = sizes(&at);
    for at in &at {
        let [_, x_dot, psi, _] = at.y;
        let [_, x_ddot, _, psi_ddot] = at.dy;
        let ratio = p.transmission_ratio;
        assert_close(at.load.drag_moment * ratio * x_dot, at.signals.power_drag, 1e-9, "power");
        assert_close(at.load.lift_moment, p.pressure_radius * at.load.lift, 1e-12, "lever");
        let moment = p.wing_inertia_hinge * psi_ddot + p.hinge_stiffness * psi
            - p.wing_inertia_product * ratio * x_ddot * psi.cos()
            - 0.5 * p.wing_inertia_hinge * (ratio * x_dot).powi(2) * (2.0 * psi).sin();
        assert!((at.load.span_moment - moment).abs() < 1e-9 * sizes[1], "{} {moment}", at.load.span_moment);
    }
}

/// The force and the moment at the shoulder, in axes that do not move.
#[test]
fn loads_turn_with_the_stroke() {
    let load = Load {
        stroke: std::f64::consts::FRAC_PI_2,
        lift: 2.0,
        drag: 3.0,
        lift_moment: 5.0,
        drag_moment: 7.0,
        span_moment: 11.0,
    };
    // A left wing that points forward moves to the right: its drag pulls to the left.
    let expected = [0.0, 3.0, 2.0, 11.0, -5.0, 7.0];
    for (found, expected) in load.at_shoulder().into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
    }
    let rest = Load { stroke: 0.0, ..load };
    assert_eq!(rest.at_shoulder(), [-3.0, 0.0, 2.0, 5.0, 11.0, 7.0]);
}

/// With the setting `loads`, rows contain the mean load after their measures, and all other bits stay the same.
#[test]
fn rows_have_mean_loads() {
    for name in ["jafferis2016", "ozaki2018-large", "arabagi2013-75hz"] {
        let (model, preset) = preset(name).unwrap();
        let values = (preset.values)();
        let solver = SolverSettings { loads: true, ..SolverSettings::DEFAULT };
        let row =
            |solver: &SolverSettings| model.run_point(&PointRun::new(Backend::best(), solver, &values), None);
        let (with, without) = (row(&solver), row(&SolverSettings::DEFAULT));
        assert_eq!(with.status, Status::Periodic);
        let columns = model.columns().len();
        assert_eq!(with.measures.len(), columns + 6);
        for (one, other) in with.measures.iter().zip(&without.measures) {
            assert_eq!(one.to_bits(), other.to_bits(), "{name}");
        }
        let lift = model.columns().iter().position(|column| column.name == "lift_mean_mn").unwrap();
        assert_close(with.measures[columns + 2] * 1e3, with.measures[lift], 1e-14, name);
    }
}

/// The lift of a wing on a moving body equals the upward component of its load.
#[test]
fn the_lift_of_a_moving_wing_is_its_load() {
    let solver = SolverSettings { loads: true, ..SolverSettings::DEFAULT.with_rtol(1e-8) };
    for name in ["jafferis2016", "ozaki2018-large", "arabagi2013-75hz"] {
        let (model, preset) = preset(name).unwrap();
        let parameters = model.parameters();
        let place = |name| Parameter::index(parameters, name);
        for (motion, size) in [
            ("body_velocity_forward", 2.0),
            ("body_velocity_left", 3.0),
            ("body_velocity_up", 0.5),
            ("body_rate_roll", 20.0),
        ] {
            let mut values = (preset.values)();
            values[place(motion).unwrap()] = size;
            if let Some(flow) = place("flow_direction") {
                values[flow] = f64::from(direct_drive::FlowDirection::Blade as u8);
            }
            let row = model.run_point(&PointRun::new(Backend::best(), &solver, &values), None);
            assert_eq!(row.status, Status::Periodic, "{name}, {motion}: {:?}", row.reason);
            let lift = model.columns().iter().position(|column| column.name == "lift_mean_mn").unwrap();
            let load = row.measures[model.columns().len() + 2] * 1e3;
            assert_close(row.measures[lift], load, 2e-5, &format!("{name}, {motion}"));
        }
    }
}

/// The force on a blade does not depend on the side of the stroke axis at which the blade is mounted.
#[test]
fn a_hardly_moving_wing_across_the_axis_has_the_lift_of_rest() {
    let (model, preset) = preset("ozaki2018-small").unwrap();
    let place = |name| Parameter::index(model.parameters(), name).unwrap();
    let lift = model.columns().iter().position(|column| column.name == "lift_mean_mn").unwrap();
    let lift_at = |velocity: f64| {
        let mut values = (preset.values)();
        values[place("flow_direction")] = f64::from(direct_drive::FlowDirection::Blade as u8);
        values[place("wing_offset")] = -6e-3;
        values[place("body_velocity_up")] = velocity;
        model.run_point(&PointRun::new(Backend::best(), &SolverSettings::DEFAULT, &values), None).measures
            [lift]
    };
    assert_close(lift_at(1e-9), lift_at(0.0), 1e-5, "lift");
}
