//! With progressive tolerances, flap finds the same orbits as motions from rest at full tolerance.

use flap_core::model::bimorph;
use flap_core::num::Backend;
use flap_core::simulate::{Row, Simulator, SolverSettings, Status, all, by_name};

use crate::{robustness, rows};

/// Number of random designs of each model.
const DRAWN: usize = 2000;

/// Largest number of drive periods of a march.
const PATIENCE: u32 = 400;

/// The counts of random designs of all models in `docs/models/methods.md`. The counts are possible designs, designs
/// settled by search and march, by the search alone, and by marching alone.
const DOCUMENTED: [usize; 4] = [4594, 3420, 929, 0];

fn progressive() -> SolverSettings {
    SolverSettings { max_cycles: PATIENCE, ..SolverSettings::default() }
}

fn full() -> SolverSettings {
    SolverSettings { progressive: false, ..progressive() }
}

/// Settings for marching without Newton shooting, with a tolerance above the jitter of the period map.
fn marching() -> SolverSettings {
    SolverSettings { newton: false, settle_tol: 1e-5, ..full() }
}

/// True if both rows are of the same motion: of the same status, with the same stroke and pitch to 1 %.
fn agree(model: &dyn Simulator, one: &Row, other: &Row) -> bool {
    let angle = |name: &str| name == "stroke_amplitude_deg" || name == "pitch_amplitude_deg";
    let measures = model.columns().iter().zip(one.measures.iter().zip(&other.measures));
    let mut angles = measures.filter(|(column, _)| angle(&column.name));
    one.status == other.status && angles.all(|(_, (a, b))| (a - b).abs() <= 1e-2 * a.abs())
}

/// Numbers of designs.
struct Counts {
    possible: usize,
    /// Designs that settle on the same motion by the search and by marching alone.
    by_both: usize,
    by_search_alone: usize,
    by_marching_alone: usize,
}

/// Compares the rows of `designs` with the rows at full tolerance and with the rows of marching alone, and prints the
/// counts.
fn compare(model: &dyn Simulator, what: &str, designs: &[Vec<f64>]) -> Counts {
    let [found, full, marched] =
        [progressive(), full(), marching()].map(|solver| rows::of(model, designs, Backend::best(), &solver));
    let settled = |row: &Row| matches!(row.status, Status::Periodic | Status::Subharmonic);
    let (mut compared, mut other, mut other_march, mut evals) = (0, 0, 0, [0, 0]);
    let [mut possible, mut by_search_alone, mut by_marching_alone] = [0; 3];
    for ((found, full), marched) in found.iter().zip(&full).zip(&marched) {
        other += usize::from(!agree(model, found, full));
        possible += usize::from(found.status != Status::Invalid);
        by_search_alone += usize::from(settled(found) && !settled(marched));
        by_marching_alone += usize::from(!settled(found) && settled(marched));
        // Either may leave a motion unsettled that the other settles.
        if settled(found) && settled(marched) {
            compared += 1;
            other_march += usize::from(!agree(model, found, marched));
        }
        if settled(found) {
            evals = [evals[0] + found.rhs_evals, evals[1] + full.rhs_evals];
        }
    }
    println!(
        "{what}: {} designs, {possible} possible, {other} with another motion than at full tolerance; {compared} settle by \
         marching too, {other_march} on another motion; {by_search_alone} settle by the search alone, {by_marching_alone} by \
         marching alone; {:.3} of the right-hand sides of those that settle",
        designs.len(),
        evals[0] as f64 / evals[1] as f64
    );
    assert_eq!((other, other_march), (0, 0), "{what}");
    assert!(compared > designs.len() / 3, "{what}");
    assert!(evals[0] < evals[1], "{what}");
    Counts { possible, by_both: compared, by_search_alone, by_marching_alone }
}

#[test]
fn random_designs_settle_on_the_orbits_of_full_tolerance() {
    let mut sum = [0; 4];
    for &model in all() {
        let counts = compare(model, model.name(), &robustness::designs(model, DRAWN));
        let Counts { possible, by_both, by_search_alone, by_marching_alone } = counts;
        for (sum, count) in sum.iter_mut().zip([possible, by_both, by_search_alone, by_marching_alone]) {
            *sum += count;
        }
    }
    println!("of all: {sum:?}");
    // The numbers of docs/models/methods.md, but for designs at the edge of settling in the periods of a march.
    for (count, documented) in sum.into_iter().zip(DOCUMENTED) {
        assert!(count.abs_diff(documented) <= 10, "{sum:?} is not {DOCUMENTED:?}");
    }
}

/// With half of the hinge stiffness, the bimorph has two orbits between 124 and 128 Hz.
#[test]
fn a_bistable_bimorph_settles_on_the_orbits_of_full_tolerance() {
    let base = bimorph::Params::jafferis2016();
    let mut designs = Vec::new();
    for voltage in 0..24 {
        for frequency in 0..48 {
            let p = bimorph::Params {
                hinge_stiffness: 0.5 * base.hinge_stiffness,
                drive_voltage_pp: 140.0 + 2.0 * f64::from(voltage),
                drive_frequency: 116.0 + 0.375 * f64::from(frequency),
                ..base.clone()
            };
            designs.push(p.to_values());
        }
    }
    let _ = compare(by_name("bimorph").unwrap(), "bistable bimorph", &designs);
}

#[test]
fn the_orbit_meets_the_residual_that_was_asked_for() {
    for settle_tol in [1e-5, 1e-6, 1e-7] {
        for &model in all() {
            let solver = SolverSettings { settle_tol, ..progressive().with_rtol(1e-7) };
            for row in rows::of(model, &robustness::designs(model, 100), Backend::best(), &solver) {
                let kept = row.status != Status::Periodic || row.residual <= settle_tol;
                assert!(kept, "{row:?} at {settle_tol:e}");
            }
        }
    }
}
