//! Readings of the paper, and the two motions with a soft hinge, against the reference.

use flap_core::model::bimorph::{ActuatorStiffness, CentreOfPressure, FieldTransition, Params, Signals};

use super::orbit::{cycle, distance, march};
use super::{driven, measure, params, settled};
use crate::data::{Record, assert_close, table};

/// The parameters of a reference row.
fn point(record: &Record) -> Params {
    let p = driven(&params("T1"), record);
    assert_close(p.transmission_ratio, record.number("T_rad_per_m"), 1e-14, &record.name);
    match record.text("variant") {
        "eq6-printed" => Params { field_transition: FieldTransition::Printed, ..p },
        "eq11-printed" => Params { centre_of_pressure: CentreOfPressure::Literal, ..p },
        "eq11-signed-alpha" => Params { centre_of_pressure: CentreOfPressure::Directional, ..p },
        "kact-const" => Params { actuator_stiffness: ActuatorStiffness::Constant, ..p },
        "k_wh x0.5" => {
            assert_close(0.5 * p.hinge_stiffness, record.number("k_wh_Nm_per_rad"), 1e-14, &record.name);
            Params { hinge_stiffness: 0.5 * p.hinge_stiffness, ..p }
        }
        other => panic!("variant {other} is not compared"),
    }
}

fn orbit_state(record: &Record) -> [f64; 4] {
    ["x0_m", "v0_m_per_s", "psi0_rad", "psidot0_rad_per_s"].map(|column| record.number(column))
}

/// Newtons per milligram-force in the reference tables.
const MGF: f64 = 9.81e-6;

const COLUMNS: [(&str, &str, f64); 5] = [
    ("stroke_pp_deg", "stroke_pp_deg", 1.0),
    ("pitch_max_deg", "psi_pos_deg", 1.0),
    ("pitch_min_deg", "psi_neg_deg", 1.0),
    ("lift_mean_mn", "lift_mean_mgf", MGF * 1e3),
    ("power_mechanical_mean_mw", "P_mech_W", 1e3),
];

#[test]
fn orbits_reached_from_rest_equal_the_reference() {
    let mut worst = 0.0_f64;
    for record in table("bimorph/variant_cases.csv") {
        if record.text("branch") == "sweep-down" {
            continue;
        }
        let row = settled(&point(&record), 1e-8);
        for (ours, theirs, factor) in COLUMNS {
            let (actual, expected) = (measure(&row, ours), factor * record.number(theirs));
            let what = format!("{ours} of {} {}", record.text("variant"), record.name);
            assert_close(actual, expected, 1e-5, &what);
            worst = worst.max((actual / expected - 1.0).abs());
        }
    }
    println!("variants from rest: {worst:.1e}");
}

/// Every orbit of the reference is an orbit of flap, also if motions from rest settle on another orbit.
#[test]
fn orbits_of_the_reference_repeat() {
    for record in table("bimorph/variant_cases.csv") {
        let (p, y) = (point(&record), orbit_state(&record));
        let end = march(&p, y, 40, 1e-9);
        let away = distance(&end, &y);
        assert!(away < 1e-7, "{}: {away:e}", record.name);
        let Signals { stroke, pitch, lift, .. } = cycle(&p, end, 1e-9).0;
        let what = |name| format!("{name} of {}", record.name);
        assert_close(
            (stroke.max - stroke.min).to_degrees(),
            record.number("stroke_pp_deg"),
            1e-6,
            &what("stroke"),
        );
        assert_close(pitch.max.to_degrees(), record.number("psi_pos_deg"), 1e-6, &what("pitch"));
        assert_close(lift.mean / MGF, record.number("lift_mean_mgf"), 1e-5, &what("lift"));
    }
}

/// With half the hinge's stiffness, 160 V and 126 Hz, the wing has two orbits, with strokes of 114 and of 59 degrees. A
/// motion from rest settles on the orbit with 114 degrees.
#[test]
fn a_soft_hinge_has_two_motions() {
    let records = table("bimorph/variant_cases.csv");
    let lower = records.iter().find(|record| record.text("branch") == "sweep-down").unwrap();
    let p = point(lower);
    let above = measure(&settled(&p, 1e-8), "stroke_pp_deg");
    let below = cycle(&p, march(&p, orbit_state(lower), 100, 1e-8), 1e-8).0.stroke;
    assert_close(above, 114.3, 1e-3, "upper motion");
    assert_close((below.max - below.min).to_degrees(), 59.276_549, 1e-5, "lower motion");
}
