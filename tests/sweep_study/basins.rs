//! Shares of initial states whose motions settle on each branch of a bistable band.

use flap_core::num::Backend;
use flap_core::simulate::{PointRun, Row, SolverSettings, TrajectoryRequest, never};
use flap_sweep::plan::{Along, Plan};
use flap_sweep::study::response::{Basin, Curve, Responses, Starts, Step};

use crate::support::{parameter, plan};

/// The bimorph with half its hinge stiffness, whose branches up and down differ from 124.25 to 127.625 Hz.
fn soft(hinge: &str) -> Plan {
    let grid = format!("preset = \"jafferis2016\"\n[params]\n{hinge}\ndrive_voltage_pp = \"160 V\"\n");
    let plan = plan(&grid);
    let frequency = parameter(&plan, "drive_frequency");
    let (plan, along) = Along::new(plan, frequency, Some([123.0, 129.0, 1.0]), None, false).expect("a range");
    plan.following(along)
}

const HINGE: &str = "hinge_stiffness = \"0.7486 uN*m/rad\"";

fn basins(plan: &Plan, starts: Starts) -> (Curve, Vec<Basin>) {
    let responses = Responses::of(plan).expect("a parameter is followed");
    let curve = responses.curve(plan.point(0));
    let basins = responses.basins(&curve, starts, &never).expect("orbits");
    (curve, basins)
}

/// Shares from other initial states. Each motion is marched alone, and its final state shows its branch.
#[test]
fn shares_agree_with_single_motions() {
    let plan = soft(HINGE);
    let (curve, basins) = basins(&plan, Starts { count: 300, seed: 7 });
    let along = plan.followed().expect("a parameter is followed");
    let backend = Backend::best();
    let solver = SolverSettings { newton: false, ..*plan.solver() };
    let mut values = plan.point(0).values;
    values[along.parameter] = 126.0;
    let run = PointRun::new(backend, &solver, &values);

    let at = |steps: &[Step]| {
        steps.iter().find(|step| step.value == 126.0).expect("a whole frequency").row.clone()
    };
    let orbits = [at(&curve.up), at(&curve.down)];
    let request = TrajectoryRequest { cycles: 1, samples_per_cycle: 200, settled: false };
    let motions = plan.simulator().motions().expect("motions");
    let samples: Vec<Vec<f64>> = (orbits.iter())
        .flat_map(|row| motions.trajectory_from(&run, Some(&row.state), &request).expect("an orbit").rows)
        .collect();
    let range = |state: usize| {
        let values = || samples.iter().map(|sample| sample[1 + state]);
        [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
    };
    let ranges = [0, 1, 2, 3].map(range);
    // Multiples of irrational numbers are uniform (Weyl).
    let irrational = [2.0_f64, 3.0, 5.0, 7.0].map(f64::sqrt);
    let mut ups = 0;
    let count = 300;
    for number in 1..=count {
        let begin: Vec<f64> = (ranges.iter().zip(irrational))
            .map(|([least, most], factor)| least + (f64::from(number) * factor).fract() * (most - least))
            .collect();
        let row = plan.simulator().run_point(&run, Some(&begin));
        // In units of the ranges. The states of both orbits differ by more than a tenth.
        let [up, down] = [0, 1].map(|branch| {
            let orbit: &Row = &orbits[branch];
            let distance = |state: usize| {
                let [least, most] = ranges[state];
                (row.state[state] - orbit.state[state]).abs() / (most - least)
            };
            (0..4).map(distance).fold(0.0, f64::max)
        });
        assert!(up.min(down) < 1e-3 && up.max(down) > 0.1, "{up} {down}");
        ups += u32::from(up < down);
    }
    let share = f64::from(ups) / f64::from(count);
    let basin = basins.iter().find(|basin| basin.value == 126.0).expect("in the band");
    let [[up, error], [down, _], [other, _]] = basin.shares();
    println!("{share} {up} ± {error}");
    assert!((up + down - 1.0).abs() < 1e-12 && other == 0.0);
    assert!((error - (up * (1.0 - up) / 300.0).sqrt()).abs() < 1e-15);
    assert!((share - up).abs() < 4.0 * error, "{share} {up} ± {error}");
}

#[test]
fn a_basin_shrinks_towards_the_end_of_its_branch() {
    let plan = soft(HINGE);
    let starts = Starts { count: 200, seed: 0 };
    let (curve, found) = basins(&plan, starts);
    assert!(found.len() >= 6 && found.iter().all(|basin| basin.motions.iter().sum::<u32>() == 200));
    let ups: Vec<f64> = found.iter().map(|basin| basin.shares()[0][0]).collect();
    assert!(ups[0] > 0.8 && ups[ups.len() - 1] < 0.45, "{ups:?}");
    assert_eq!(basins(&plan, starts).1, found, "the same seed");
    let responses = Responses::of(&plan).expect("a parameter is followed");
    let others = responses.basins(&curve, Starts { seed: 1, ..starts }, &never).expect("orbits");
    assert_ne!(others, found, "another seed");
}

#[test]
fn a_design_without_hysteresis_has_no_basins() {
    assert_eq!(basins(&soft(""), Starts { count: 10, seed: 0 }).1, []);
}
