//! Vehicles: symmetries, sums, derivatives.

use std::sync::Arc;

use flap_core::model::OverWings;
use flap_core::num::Backend;
use flap_core::parameter::Parameter;
use flap_core::simulate::{Change, PointRun, Row, Rows, Simulator, SolverSettings, Status, by_name, preset};
use flap_core::vehicle::{FORCES, Mount, TORQUES, Vehicle, VehicleError};

use crate::rows;

fn mounts(wings: &[(&str, bool)]) -> Vec<Mount> {
    wings.iter().map(|(name, mirrored)| Mount { name: (*name).to_owned(), mirrored: *mirrored }).collect()
}

/// A vehicle whose wings have the parameters of a preset.
struct Flier {
    vehicle: Arc<Vehicle>,
    values: Vec<f64>,
}

impl Flier {
    fn new(name: &str, wings: &[(&str, bool)]) -> Flier {
        let (model, preset) = preset(name).unwrap();
        let vehicle = Vehicle::of(model, &mounts(wings)).unwrap();
        let mut values = (preset.values)();
        values.extend(vehicle.parameters()[values.len()..].iter().map(|parameter| parameter.default));
        Flier { vehicle: Arc::new(vehicle), values }
    }

    /// A pair of wings, 4 mm from the middle.
    fn pair(name: &str) -> Flier {
        let pair = Flier::new(name, &[("left", false), ("right", true)]);
        pair.with(&[("left_position_y", 4e-3), ("right_position_y", 4e-3)])
    }

    fn place(&self, name: &str) -> usize {
        Parameter::index(self.vehicle.parameters(), name).expect(name)
    }

    fn with(mut self, changes: &[(&str, f64)]) -> Flier {
        for (name, value) in changes {
            let place = self.place(name);
            self.values[place] = *value;
        }
        self
    }

    fn row(&self) -> Row {
        let solver = SolverSettings::DEFAULT;
        self.vehicle.run_point(&PointRun::new(Backend::best(), &solver, &self.values), None)
    }

    fn measure(&self, row: &Row, name: &str) -> f64 {
        let place = self.vehicle.columns().iter().position(|column| column.name == name).expect(name);
        row.measures[place]
    }

    /// Force (mN) and torque (uN·m).
    fn wrench(&self) -> [[f64; 3]; 2] {
        let row = self.row();
        assert_eq!(row.status, Status::Periodic, "{:?}", row.reason);
        [FORCES, TORQUES].map(|names| names.map(|name| self.measure(&row, name)))
    }
}

const PRESETS: [(&str, &str); 3] = [
    ("jafferis2016", "drive_voltage_pp"),
    ("ozaki2018-large", "drive_voltage_pp"),
    ("arabagi2013-75hz", "drive_voltage_pp"),
];

fn assert_near(found: [[f64; 3]; 2], expected: [[f64; 3]; 2], tolerance: f64, what: &str) {
    for (found, expected) in found.into_iter().zip(expected) {
        let size = expected.iter().map(|part| part.abs()).fold(1e-3, f64::max);
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() <= tolerance * size, "{what}: {found}, not {expected}");
        }
    }
}

#[test]
fn one_wing_at_the_origin_has_the_lift_of_its_row() {
    for (name, _) in PRESETS {
        let flier = Flier::new(name, &[("wing", false)]);
        let (model, preset) = preset(name).unwrap();
        let values = (preset.values)();
        let solver = SolverSettings::DEFAULT;
        let alone = model.run_point(&PointRun::new(Backend::best(), &solver, &values), None);
        let column = |name: &str| model.columns().iter().position(|column| column.name == name).unwrap();
        let row = flier.row();
        let lift = alone.measures[column("lift_mean_mn")];
        assert!((flier.measure(&row, "force_up_mn") / lift - 1.0).abs() < 1e-14, "{name}");
        for own in ["stroke_pp_deg", "pitch_pp_deg"] {
            assert_eq!(flier.measure(&row, &format!("wing_{own}")), alone.measures[column(own)], "{name}");
        }
        assert_eq!(flier.measure(&row, "power_mean_mw"), alone.measures[column("power_mean_mw")], "{name}");
    }
}

#[test]
fn mirrored_wings_with_equal_drives_have_no_roll_yaw_and_side_force() {
    for (name, _) in PRESETS {
        let tilted = [
            ("left_plane_pitch", 0.1),
            ("right_plane_pitch", 0.1),
            ("left_plane_roll", 0.2),
            ("right_plane_roll", 0.2),
        ];
        let [force, torque] =
            Flier::pair(name).with(&tilted).with(&[("about_x", 1e-3), ("about_z", -2e-3)]).wrench();
        assert_eq!((force[1], torque[0], torque[2]), (0.0, 0.0, 0.0), "{name}");
        assert!(force[2] > 0.01 && torque[1].abs() > 1e-6, "{name}: {force:?} {torque:?}");
    }
}

#[test]
fn swapped_wings_turn_roll_yaw_and_side_force_about() {
    for (name, amplitude) in PRESETS {
        let pair = Flier::pair(name);
        let less = 0.9 * pair.values[pair.place(amplitude)];
        let left = Flier::pair(name).with(&[(&format!("left_{amplitude}"), less)]).wrench();
        let right = Flier::pair(name).with(&[(&format!("right_{amplitude}"), less)]).wrench();
        assert!(left[1][0] < -1e-3, "{name}: less drive on the left lowers it: {left:?}");
        let image = [[right[0][0], -right[0][1], right[0][2]], [-right[1][0], right[1][1], -right[1][2]]];
        assert_near(left, image, 1e-13, name);
        // The same as a difference about the mean.
        let mean = 0.95 * pair.values[pair.place(amplitude)];
        let difference = -0.1 * pair.values[pair.place(amplitude)];
        let other =
            pair.with(&[(amplitude, mean), (&format!("difference_{amplitude}"), difference)]).wrench();
        assert_near(other, left, 1e-6, name);
    }
}

/// The wrench of a turned vehicle is the turned wrench of the vehicle.
#[test]
fn a_turned_vehicle_has_its_wrench_turned() {
    let wings = [("one", false), ("two", false)];
    let flier = || {
        Flier::new("jafferis2016", &wings).with(&[("two_drive_voltage_pp", 150.0), ("two_position_x", -2e-3)])
    };
    let here = flier().with(&[("one_position_y", 3e-3), ("one_position_z", 1e-3)]).wrench();
    let angle: f64 = 0.7;
    let (sin, cos) = angle.sin_cos();
    let turned = flier()
        .with(&[("one_plane_yaw", angle), ("two_plane_yaw", angle)])
        .with(&[("one_position_x", -sin * 3e-3), ("one_position_y", cos * 3e-3), ("one_position_z", 1e-3)])
        .with(&[("two_position_x", -cos * 2e-3), ("two_position_y", -sin * 2e-3)])
        .wrench();
    let expected = here.map(|[x, y, z]| [cos * x - sin * y, sin * x + cos * y, z]);
    assert_near(turned, expected, 1e-12, "yaw");
}

/// The torque about another point follows from the force and the torque about the first point.
#[test]
fn torques_are_taken_about_a_point() {
    let [force, torque] = Flier::pair("jafferis2016").with(&[("left_drive_voltage_pp", 180.0)]).wrench();
    let moved = Flier::pair("jafferis2016")
        .with(&[("left_drive_voltage_pp", 180.0), ("about_x", 1e-3), ("about_y", 2e-3), ("about_z", 3e-3)])
        .wrench();
    let [a, b, c] = [1.0, 2.0, 3.0];
    let [x, y, z] = force;
    // mm times mN is uN·m.
    let expected = [torque[0] - (b * z - c * y), torque[1] - (c * x - a * z), torque[2] - (a * y - b * x)];
    assert_near(moved, [force, expected], 1e-12, "about");
}

/// Rows of lanes equal rows of scalars, for any order of the wings' points.
#[test]
fn lanes_and_scalars_have_the_same_bits() {
    let flier = Flier::pair("ozaki2018-large").with(&[("left_drive_voltage_pp", 90.0)]);
    let frequency = flier.place("drive_frequency");
    let points: Vec<Vec<f64>> = (0..20)
        .map(|i| {
            let mut values = flier.values.clone();
            values[frequency] = 95.0 + f64::from(i);
            values
        })
        .collect();
    let lanes = rows::of(&*flier.vehicle, &points, Backend::best(), &SolverSettings::DEFAULT);
    for (row, values) in lanes.iter().zip(points) {
        let alone = Flier { values, vehicle: Arc::clone(&flier.vehicle) }.row();
        assert_eq!(row.status, alone.status);
        let bits = |row: &Row| row.measures.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(row), bits(&alone));
        assert_eq!(row.state, alone.state);
    }
}

/// Derivatives of forces and torques with respect to drives of one wing, to differences, and to positions.
#[test]
fn derivatives_are_those_of_differences() {
    let solver = SolverSettings::DEFAULT.with_rtol(1e-9);
    let flier = Flier::pair("jafferis2016").with(&[
        ("left_drive_voltage_pp", 190.0),
        ("left_plane_pitch", 0.1),
        ("right_position_x", 1e-3),
        ("total_mass", 100e-6),
    ]);
    let run =
        |values: &[f64]| flier.vehicle.run_point(&PointRun::new(Backend::best(), &solver, values), None);
    let row = run(&flier.values);
    let names = [
        ("left_drive_voltage_pp", 1.0),
        ("difference_drive_voltage_pp", 1.0),
        ("drive_offset", 1.0),
        ("right_position_x", 1e-4),
        ("left_plane_pitch", 1e-2),
        ("about_z", 1e-4),
    ];
    let moved = |name: &str, size: f64| {
        let mut values = flier.values.clone();
        values[flier.place(name)] += size;
        values
    };
    let changes: Vec<Change> = names
        .iter()
        .map(|&(name, size)| Change {
            ahead: moved(name, 1e-6 * size),
            behind: moved(name, -1e-6 * size),
            size: 1e-6 * size,
        })
        .collect();
    let point = PointRun::new(Backend::best(), &solver, &flier.values);
    let gradient = |changes: &[Change]| {
        flier.vehicle.gradients().unwrap().gradient(&point, &row.state, changes).unwrap()
    };
    let one_sided: Vec<Change> =
        changes.iter().map(|change| Change { behind: flier.values.clone(), ..change.clone() }).collect();
    let (gradient, one_sided) = (gradient(&changes), gradient(&one_sided));
    for (((name, size), slopes), one_sided) in names.iter().zip(&gradient.slopes).zip(&one_sided.slopes) {
        let (ahead, behind) = (run(&moved(name, 0.1 * size)), run(&moved(name, -0.1 * size)));
        for (j, column) in flier.vehicle.columns().iter().enumerate() {
            if !FORCES.iter().chain(&TORQUES).any(|known| *known == column.name)
                && column.name != "lift_to_weight"
            {
                continue;
            }
            let expected = (ahead.measures[j] - behind.measures[j]) / (0.2 * size);
            let found = slopes[j].unwrap();
            let scale = row.measures[j].abs().max(0.05) / size;
            assert!(
                (one_sided[j].unwrap() - found).abs() < 1e-4 * scale,
                "{} by {name}, one-sided",
                column.name
            );
            assert!(
                (found - expected).abs() < 1e-4 * scale,
                "{} by {name}: {found}, not {expected}",
                column.name
            );
        }
    }
}

#[test]
fn impossible_vehicles_are_told() {
    let bimorph = by_name("bimorph").unwrap();
    let error = |wings: &[(&str, bool)]| Vehicle::of(bimorph, &mounts(wings)).err();
    assert_eq!(error(&[]), Some(VehicleError::NoWings));
    assert_eq!(error(&[("a", false), ("a", true)]), Some(VehicleError::SameName("a".to_owned())));
    assert_eq!(error(&[("Left", false)]), Some(VehicleError::Name("Left".to_owned())));
    assert_eq!(error(&[("difference", false)]), Some(VehicleError::Name("difference".to_owned())));
    let seventeen: Vec<String> = (0..17).map(|i| format!("w{i}")).collect();
    let seventeen: Vec<(&str, bool)> = seventeen.iter().map(|name| (name.as_str(), false)).collect();
    assert_eq!(error(&seventeen), Some(VehicleError::ManyWings(17)));
}

/// If the name of a wing begins like another wing or like a parameter, the names of its parameters and columns are
/// still unique.
#[test]
fn parameters_and_columns_have_names_of_their_own() {
    for wings in [[("a", false), ("a_drive", true)], [("about", false), ("wing", true)]] {
        for (model, _) in PRESETS {
            let vehicle = Flier::new(model, &wings).vehicle;
            let mut names: Vec<&str> = vehicle.parameters().iter().map(|parameter| parameter.name).collect();
            names.extend(vehicle.columns().iter().map(|column| column.name.as_str()));
            let count = names.len();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), count, "{model}, {wings:?}");
        }
    }
}

/// For each column of a wing, the model determines whether the vehicle has a sum, a column of each wing, or no column.
/// Mean powers are sums, and each wing has its own currents and motions.
#[test]
fn columns_of_wings_are_combined_as_the_model_says() {
    for (name, _) in PRESETS {
        let flier = Flier::pair(name).with(&[("difference_drive_voltage_pp", 4.0)]);
        let row = flier.row();
        assert_eq!(row.status, Status::Periodic, "{name}");
        let wing = |share: f64| {
            let (model, preset) = preset(name).unwrap();
            let mut values = (preset.values)();
            values[Parameter::index(model.parameters(), "drive_voltage_pp").unwrap()] += share * 4.0;
            let solver = SolverSettings::DEFAULT;
            model.run_point(&PointRun::new(Backend::best(), &solver, &values), None)
        };
        let (left, right) = (wing(0.5), wing(-0.5));
        let columns = flier.vehicle.columns();
        for (i, column) in flier.vehicle.model().columns().iter().enumerate() {
            let [one, other] = [&left, &right].map(|row| row.measures[i]);
            let of =
                |name: &str| columns.iter().position(|column| column.name == name).map(|j| row.measures[j]);
            let of_wings = ["left", "right"].map(|wing| of(&format!("{wing}_{}", column.name)));
            let same = |found: Option<f64>, expected: f64| {
                found.is_some_and(|found| {
                    found.total_cmp(&expected).is_eq() || (found - expected).abs() <= 1e-12 * expected.abs()
                })
            };
            match column.over_wings {
                OverWings::Sum => assert!(same(of(&column.name), one + other), "{name}: {}", column.name),
                OverWings::Each => {
                    assert!(same(of_wings[0], one) && same(of_wings[1], other), "{name}: {}", column.name);
                }
                OverWings::Omitted => assert_eq!(of_wings, [None; 2], "{name}: {}", column.name),
            }
            let is_current = column.name.starts_with("current");
            assert!(!is_current || column.over_wings == OverWings::Each, "{name}: {}", column.name);
            let is_power = column.unit == "mW";
            assert!(!is_power || column.over_wings == OverWings::Sum, "{name}: {}", column.name);
        }
    }
}

/// Vehicles with other names of wings have the same parameters, except for the names of the wings.
#[test]
fn vehicles_own_their_names() {
    let names = |wing: &str| {
        let vehicle = Flier::new("jafferis2016", &[(wing, false)]).vehicle;
        let names: Vec<String> =
            vehicle.parameters().iter().map(|parameter| parameter.name.to_owned()).collect();
        (names, vehicle.gradients().unwrap().states())
    };
    let ((one, states), (other, _)) = (names("one"), names("other"));
    assert_eq!(states[0], "one_tip_m");
    assert_eq!(one.len(), other.len());
    let changed = one.iter().zip(&other).filter(|(one, other)| one != other);
    assert!(changed.clone().count() > 6);
    for (one, other) in changed {
        assert_eq!(one.replacen("one", "other", 1), *other);
    }
}

/// If a wing is impossible, the row is invalid and its reason contains the name of the wing.
#[test]
fn an_impossible_wing_is_named() {
    let row = Flier::pair("jafferis2016").with(&[("difference_drive_voltage_pp", 1000.0)]).row();
    assert_eq!(row.status, Status::Invalid);
    let reason = row.reason.unwrap();
    assert_eq!(reason, "wing right: drive_voltage_pp is -300, but must be zero or more");
}
