//! Random designs around the presets: every design has a row with its status.

use crate::terms::is_left_out;
use flap_core::num::Backend;
use flap_core::parameter::Kind;
use flap_core::simulate::{Simulator, SolverSettings, Status, all};

use crate::rows;

/// Number of random designs of each model.
const DRAWN: usize = 2400;

/// A generator of numbers in [0, 1) (SplitMix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) as f64 / 2.0_f64.powi(64)
    }
}

/// Random designs: every number of the presets times a log-uniform factor from 0.5 to 1.5. Counts stay whole numbers,
/// and choices keep their values.
pub(crate) fn designs(model: &dyn Simulator, count: usize) -> Vec<Vec<f64>> {
    let mut random = Random(2016);
    let presets = model.presets();
    (0..count)
        .map(|i| {
            let mut values = (presets[i % presets.len()].values)();
            let numbers = values.iter_mut().zip(model.parameters());
            for (value, parameter) in numbers.filter(|(value, parameter)| !is_left_out(parameter, **value)) {
                let factor = 0.5 * 3.0_f64.powf(random.next());
                // The terms of a chord describe one shape together.
                if matches!(parameter.kind, Kind::Choice(_)) || parameter.name.starts_with("chord_") {
                    continue;
                }
                *value *= factor;
                if parameter.name == "strips" {
                    *value = value.round();
                }
            }
            values
        })
        .collect()
}

#[test]
fn a_thousand_possible_random_designs_of_each_model_have_rows() {
    let solver = SolverSettings { max_cycles: 200, settle_tol: 1e-5, ..SolverSettings::default() };
    for &model in all() {
        let designs = designs(model, DRAWN);
        let rows = rows::of(model, &designs, Backend::best(), &solver);
        assert_eq!(rows.len(), DRAWN);
        let counts = Status::ALL.map(|status| rows.iter().filter(|row| row.status == status).count());
        println!("{}: {:?} are {counts:?}", model.name(), Status::ALL.map(Status::name));
        for row in &rows {
            let periodic = row.status == Status::Periodic;
            assert_eq!(row.measures.len(), if periodic { model.columns().len() } else { 0 });
            assert_eq!(row.floquet_max.is_nan(), row.period == 0, "{row:?}");
            assert_eq!(row.period > 1, row.status == Status::Subharmonic, "{row:?}");
            assert!(!periodic || row.residual <= 1e-5, "{row:?}");
            assert_eq!(row.reason.is_some(), row.status == Status::Invalid);
        }
        // A march may settle on an orbit that just touches the surface where forces jump: what becomes of changes there
        // is not known.
        let unknown = rows.iter().filter(|row| row.stable() == Some(false)).count();
        assert!(unknown <= 2, "{}: {unknown} orbits are not stable", model.name());
        // Links of other lengths often do not meet, and plates of other widths may end in a point.
        let [periodic, .., invalid] = counts;
        let possible = DRAWN - invalid;
        assert!(possible >= 1000, "{}: {possible} designs are possible", model.name());
        // Most designs near a published one fly.
        assert!(periodic * 10 > possible * 9, "{}: {periodic} of {possible} are periodic", model.name());
    }
}
