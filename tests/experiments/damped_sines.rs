//! The free motion after an impulse against the reference's fits of damped sines.

use flap_core::model::direct_drive::Params;
use flap_core::num::Backend;
use flap_core::simulate::{ImpulseRequest, PointRun, SolverSettings, by_name};
use flap_experiments::damped_sine::{DampedSine, fit};

use crate::data::{Record, assert_close, table};

/// The parameters of a reference row: the preset's parameters, or the parameters with the hinge stiffnesses of both
/// types swapped.
fn type_of(record: &Record) -> Params {
    let p = match record.text("type") {
        "small" => Params::ozaki2018_small(),
        "large" => Params::ozaki2018_large(),
        other => panic!("no type {other}"),
    };
    match (record.text("params"), record.text("type")) {
        ("table", _) => p,
        ("kw_swapped", "small") => Params { hinge_stiffness: 8.64e-5, ..p },
        ("kw_swapped", "large") => Params { hinge_stiffness: 1.48e-4, ..p },
        (other, _) => panic!("no parameters {other}"),
    }
}

/// The motion after the impulse of a reference row, and the damped sine that fits its stroke (rad).
fn released(record: &Record) -> (Vec<Vec<f64>>, DampedSine) {
    let solver = SolverSettings { rtol: 1e-9, atol: 1e-11, ..SolverSettings::default() };
    let duration = record.number("window_s");
    let intervals = record.text("n_samples").parse::<u32>().unwrap() - 1;
    let request = ImpulseRequest { stroke_rate: record.number("phidot0"), duration, intervals };
    let values = type_of(record).to_values();
    let model = by_name("direct-drive").unwrap();
    let motion = model
        .experiments()
        .unwrap()
        .free_response(&PointRun::new(Backend::best(), &solver, &values), &request)
        .unwrap();
    assert_eq!(motion.rows.len(), intervals as usize + 1);
    let stroke: Vec<f64> = motion.rows.iter().map(|row| row[1]).collect();
    let fit = fit(duration / f64::from(intervals), &stroke);
    (motion.rows, fit.unwrap_or_else(|| panic!("no fit for {}", record.name)))
}

/// Compares all rows, including poor fits. In poor fits, two modes and a changing decay leave a residual of up to a
/// quarter.
#[test]
fn damped_sines_equal_the_reference() {
    let mut largest = [0.0_f64; 3];
    for record in table("direct-drive/impulse_fits.csv") {
        let (rows, fit) = released(&record);
        assert_close(rows[0][3], record.number("phidot0"), 1e-15, "stroke rate");
        assert_close(rows[0][4], record.number("psidot0"), 1e-12, "pitch rate");
        let frequency = record.number("fit_f_Hz");
        // The decay counts per period: some are nearly zero.
        let errors = [
            (fit.frequency - frequency) / frequency,
            (fit.decay - record.number("fit_lambda_1_s")) / frequency,
            fit.relative_rms - record.number("fit_rel_rms"),
        ];
        for (largest, error) in largest.iter_mut().zip(errors) {
            assert!(error.abs() < 1e-7, "{}: {fit:?}, errors {errors:?}", record.name);
            *largest = largest.max(error.abs());
        }
    }
    println!("largest errors of frequency, decay and what is left over: {largest:?}");
}
