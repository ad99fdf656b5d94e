//! Orbits that are found and measured over half periods, against the same orbits over whole periods.

use flap_core::num::Backend;
use flap_core::parameter::Parameter;
use flap_core::simulate::{PointRun, Row, Simulator, SolverSettings, Status, preset};

use crate::by_name::design;
use crate::robustness;
use crate::rows;

/// Number of random designs of each model.
const DRAWN: usize = 1000;

fn solver(symmetry: bool) -> SolverSettings {
    SolverSettings { symmetry, loads: true, max_cycles: 200, ..SolverSettings::default() }
}

/// Rows with half periods, and rows with whole periods.
fn both(model: &dyn Simulator, designs: &[Vec<f64>], rtol: f64) -> [Vec<Row>; 2] {
    [true, false].map(|symmetry| {
        let solver = SolverSettings { settle_tol: rtol, ..solver(symmetry).with_rtol(rtol) };
        rows::of(model, designs, Backend::best(), &solver)
    })
}

/// The size of each measure of a row: the largest magnitude among the measures with the same unit. In a row, the loads
/// follow the columns.
fn sizes(model: &dyn Simulator, row: &Row) -> Vec<f64> {
    let columns = model.columns();
    let loads = columns.len();
    let unit = |i: usize| match i.checked_sub(loads) {
        None => columns[i].unit.to_string(),
        Some(..3) => "N".to_owned(),
        Some(_) => "N m".to_owned(),
    };
    let largest = |unit_of: &str| {
        let magnitudes = row.measures.iter().enumerate().filter(|&(i, _)| unit(i) == unit_of);
        magnitudes.fold(0.0_f64, |largest, (_, value)| largest.max(value.abs()))
    };
    (0..row.measures.len()).map(|i| largest(&unit(i))).collect()
}

const HARMONICS: f64 = 1.0;
const SQUARE: f64 = 2.0;

#[test]
fn symmetric_orbits_have_the_measures_of_their_whole_periods() {
    let cases: [(&str, &[(&str, f64)]); 12] = [
        ("jafferis2016", &[]),
        (
            "jafferis2016",
            &[("drive_voltage_pp", 160.0), ("drive_frequency", 126.0), ("hinge_stiffness", 0.7e-6)],
        ),
        ("jafferis2016", &[("drive_shape", SQUARE)]),
        ("jafferis2016", &[("dielectric_loss", 0.1), ("charge_recovery", 0.5), ("stroke_damping", 1e-9)]),
        ("jafferis2016-improved", &[("centre_of_pressure", 1.0), ("transmission_growth", 1e6)]),
        (
            "jafferis2016-improved",
            &[("drive_shape", HARMONICS), ("drive_third_harmonic", -0.2), ("drive_third_phase", 0.4)],
        ),
        ("ozaki2018-small", &[]),
        ("ozaki2018-large", &[]),
        ("ozaki2018-large", &[("drive_bias", 0.0), ("dielectric_loss", 0.1), ("stroke_damping", 1e-9)]),
        ("ozaki2018-large", &[("drive_bias", 0.0), ("flow_direction", 1.0), ("drive_shape", SQUARE)]),
        ("ozaki2018-small", &[("drive_bias", 0.0), ("centre_of_pressure", 1.0), ("added_mass", 1.0)]),
        ("ozaki2018-small", &[("stroke_mode", 1.0), ("stroke_amplitude", 0.6)]),
    ];
    for (name, changes) in cases {
        let (model, values) = design(name, changes);
        let [half, whole] = both(model, &[values], 1e-8).map(|mut rows| rows.remove(0));
        assert_eq!((half.status, whole.status), (Status::Periodic, Status::Periodic), "{name} {changes:?}");
        // The edges of a square wave take most steps of a bimorph, and jumps of the map decide how often it is integrated.
        let is_edgy = name.starts_with("jafferis") && changes.contains(&("drive_shape", SQUARE));
        let limit = whole.rhs_evals * if is_edgy { 102 } else { 95 } / 100;
        assert!(half.rhs_evals < limit, "{name} {changes:?}: {} of {}", half.rhs_evals, whole.rhs_evals);
        assert!((half.floquet_max - whole.floquet_max).abs() < 1e-4, "{name} {changes:?}");
        let columns: Vec<String> = model.columns().iter().map(|column| column.name.clone()).collect();
        assert_eq!(half.measures.len(), columns.len() + 6);
        for (i, size) in sizes(model, &whole).into_iter().enumerate() {
            let (half, whole) = (half.measures[i], whole.measures[i]);
            let column = columns.get(i).map_or("load", String::as_str);
            let is_audit = column.ends_with("audit");
            assert!(
                is_audit || (half - whole).abs() <= 1e-5 * size || half.is_nan() && whole.is_nan(),
                "{name} {changes:?}: {column} is {half:e} over half periods, {whole:e} over whole ones"
            );
        }
        // Means of what changes its sign are zero.
        let is_biased = |(name, _): &(&str, f64)| !["drive_bias", "stroke_mode"].contains(name);
        let is_centred = name.starts_with("jafferis") || !changes.iter().all(is_biased);
        let mean = columns.iter().position(|column| column == "stroke_mean_deg").unwrap();
        assert_eq!(half.measures[mean] == 0.0, is_centred, "{name} {changes:?}");
    }
}

/// A constant part of the voltage that does not move the stroke still contributes power, so the period is not halved.
#[test]
fn a_bias_without_force_has_power() {
    let changes = [("piezo_coefficient", 0.0), ("dielectric_loss", 0.15), ("drive_bias", 50.0)];
    let (model, values) = design("ozaki2018-large", &changes);
    let place = model.columns().iter().position(|column| column.name == "power_dielectric_mean_mw").unwrap();
    let [halved, whole] = [true, false].map(|symmetry| {
        let row = model.run_point(&PointRun::new(Backend::best(), &solver(symmetry), &values), None);
        assert_eq!(row.status, Status::Periodic);
        row.measures[place]
    });
    assert!(whole > 0.0 && (halved / whole - 1.0).abs() < 1e-9, "{halved}, {whole}");
}

/// Points without the symmetry have the same rows with and without the setting.
#[test]
fn other_points_have_the_same_rows() {
    let cases: [(&str, &[(&str, f64)]); 8] = [
        ("jafferis2016", &[("drive_offset", 1e-3)]),
        ("jafferis2016", &[("plate_ratio", 1.001)]),
        ("jafferis2016", &[("centre_of_pressure", 2.0)]),
        ("jafferis2016", &[("drive_shape", HARMONICS), ("drive_second_harmonic", 1e-3)]),
        ("ozaki2018-small", &[("centre_of_pressure", 2.0)]),
        ("ozaki2018-large", &[("drive_shape", HARMONICS), ("drive_second_harmonic", 1e-3)]),
        ("arabagi2013-75hz", &[]),
        ("arabagi2013-30hz", &[("stroke_mode", 1.0)]),
    ];
    for (name, changes) in cases {
        let (model, values) = design(name, changes);
        let [half, whole] = both(model, &[values], 1e-6).map(|mut rows| rows.remove(0));
        assert_eq!(format!("{half:?}"), format!("{whole:?}"), "{name} {changes:?}");
    }
}

/// Random designs, many with much larger strokes and pitches than robots. The designs include bimorphs with soft hinges
/// near orbits without symmetry.
#[test]
fn random_designs_settle_on_the_orbits_of_whole_periods() {
    for name in ["jafferis2016", "ozaki2018-small"] {
        let (model, preset) = preset(name).unwrap();
        let mut designs = robustness::designs(model, DRAWN);
        if name == "jafferis2016" {
            let mut random = robustness::Random(39);
            for _ in 0..DRAWN {
                let mut values = (preset.values)();
                let mut set = |name: &str, from: f64, to: f64| {
                    let index = Parameter::index(model.parameters(), name).unwrap();
                    values[index] = from + (to - from) * random.next();
                };
                set("hinge_stiffness", 0.4e-6, 1.2e-6);
                set("drive_voltage_pp", 120.0, 220.0);
                set("drive_frequency", 100.0, 160.0);
                designs.push(values);
            }
        }
        let [half, whole] = both(model, &designs, 1e-6);
        let column = |name: &str| model.columns().iter().position(|column| column.name == name).unwrap();
        let angles = [column("stroke_amplitude_deg"), column("pitch_amplitude_deg")];
        let (mut evals, mut periodic) = ([0, 0], 0);
        for (i, (half, whole)) in half.iter().zip(&whole).enumerate() {
            assert_eq!(half.status, whole.status, "{name} {i}");
            if half.status != Status::Periodic {
                continue;
            }
            periodic += 1;
            evals = [evals[0] + half.rhs_evals, evals[1] + whole.rhs_evals];
            for angle in angles {
                let (one, other) = (half.measures[angle], whole.measures[angle]);
                assert!((one - other).abs() <= 1e-3 * other.abs(), "{name} {i}: {one} {other}");
            }
        }
        let ratio = f64::from(u32::try_from(evals[0]).unwrap()) / f64::from(u32::try_from(evals[1]).unwrap());
        println!("{name}: {periodic} of {} periodic, {ratio:.3} of the right-hand sides", designs.len());
        assert!(periodic > designs.len() / 2, "{name}");
        assert!(ratio < if name == "jafferis2016" { 0.7 } else { 0.9 }, "{name}: {ratio}");
    }
}
