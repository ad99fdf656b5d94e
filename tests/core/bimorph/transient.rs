//! Motions from rest against reference end states.

use flap_core::model::ExperimentModel;
use flap_core::model::bimorph::{Bimorph, Constants, Params};
use flap_core::num::Backend;
use flap_core::ode::Start;
use flap_core::simulate::{ChirpRequest, PointRun, SolverSettings, Trajectory};

use super::orbit::{distance, march};
use super::{driven, model, params};
use crate::data::{Record, assert_close, table};
use crate::rows::worse;
use crate::span::{self, tolerances};

fn end_state(record: &Record) -> [f64; 4] {
    ["x_m", "v_m_per_s", "psi_rad", "psidot_rad_per_s"].map(|column| record.number(column))
}

fn largest_error(rtol: f64) -> f64 {
    let mut largest = 0.0_f64;
    for record in table("bimorph/transient_cases.csv") {
        if record.text("set") == "T1-chirp" {
            continue;
        }
        let p = driven(&params(record.text("set")), &record);
        let cycles = record.text("cycles").parse().unwrap();
        let end = march(&p, [0.0; 4], cycles, rtol);
        let error = distance(&end, &end_state(&record));
        println!("rtol {rtol:.0e}, {}: {error:.1e}", record.name);
        largest = worse(largest, error);
    }
    largest
}

#[test]
fn motions_from_rest_equal_the_reference() {
    let error = largest_error(1e-10);
    assert!(error < 1e-7, "{error:e}");
    let error = largest_error(1e-8);
    assert!(error < 2e-6, "{error:e}");
    let error = largest_error(1e-6);
    assert!(error < 1e-4, "{error:e}");
}

/// Eq. (7): a frequency sweep that starts at 1 Hz and rises by 15 Hz/s.
#[test]
fn the_frequency_sweep_of_eq_7_equals_the_reference() {
    let records = table("bimorph/transient_cases.csv");
    let record = records.iter().find(|record| record.text("set") == "T1-chirp").unwrap();
    let p = Params { drive_voltage_pp: record.number("Vpp_V"), ..params("T1") };
    let (model, constants) = Bimorph::SINE.chirped(&Constants::derive(&p).unwrap(), 1.0, 15.0);
    let start = Start::new(constants, [0.0; 4], record.number("t_end_s"), [3e-5, 0.025, 0.3, 250.0]);
    let end = span::end(&model, &tolerances(1e-10), &start);
    let error = distance(&end, &end_state(record));
    println!("chirp: {error:.1e}");
    assert!(error < 1e-6, "{error:e}");
}

/// The frequency sweep of Eq. (7), cycle by cycle.
#[test]
fn the_envelope_of_the_frequency_sweep_equals_the_reference() {
    let records = table("bimorph/chirp_envelope_160V.csv");
    let end = records.last().unwrap().number("t_end_s");
    let p = Params { drive_voltage_pp: 160.0, ..params("T1") };
    let solver = SolverSettings { rtol: 1e-7, atol: 1e-9, ..SolverSettings::default() };
    let request = ChirpRequest { from: 1.0, to: 1.0 + 15.0 * end, rate: 15.0, samples_per_cycle: 0 };
    let response = model()
        .experiments()
        .unwrap()
        .chirp(&PointRun::new(Backend::best(), &solver, &p.to_values()), &request)
        .unwrap();
    let Trajectory { columns, rows } = response.envelope;
    let column = |name| columns.iter().position(|column| column == name).unwrap();
    let [stroke, pitch] = [column("stroke_pp_deg"), column("pitch_peak_deg")];
    assert!(rows.len() >= records.len());
    let mut largest = [0.0_f64; 2];
    for (row, record) in rows.iter().zip(&records) {
        assert_close(row[1], record.number("t_end_s"), 1e-12, &record.name);
        for (i, (actual, theirs)) in
            [(row[stroke], "stroke_pp_deg"), (row[pitch], "psi_absmax_deg")].into_iter().enumerate()
        {
            largest[i] = worse(largest[i], (actual - record.number(theirs)).abs());
        }
    }
    println!(
        "chirp envelope: stroke within {:.1e} deg, hinge angle within {:.1e} deg",
        largest[0], largest[1]
    );
    assert!(largest[0] < 1e-3 && largest[1] < 1e-3, "{largest:?}");
}
