//! Responses up and down: bistable designs have hysteresis, and other designs have no hysteresis.

use std::num::NonZeroUsize;

use flap_core::num::Backend;
use flap_core::simulate::{PointRun, Status};
use flap_sweep::files::csv_sink::CsvSink;
use flap_sweep::plan::{Along, Plan};
use flap_sweep::run::{Outcome, RowWriter, RunOptions, Summary};
use flap_sweep::study::response::{BandKind, Curve, Responses, Step, Verdict};
use flap_sweep::table::layout::{Cell, Layout};

use crate::support::{bits, column, parameter, plan};

/// The bimorph with half its hinge stiffness or its full hinge stiffness, at some voltages.
fn bimorph(soft: bool, volts: &[u32]) -> Plan {
    let hinge = if soft { "hinge_stiffness = \"0.7486 uN*m/rad\"" } else { "" };
    let volts: Vec<String> = volts.iter().map(|volts| format!("\"{volts} V\"")).collect();
    plan(&format!(
        "preset = \"jafferis2016\"\n[params]\n{hinge}\n[axes]\ndrive_voltage_pp = [{}]\n[solver]\nmax_cycles = 300\n",
        volts.join(", ")
    ))
}

/// Every whole frequency of a range (Hz).
fn along(plan: &Plan, range: [u32; 2], tolerance: f64) -> Along {
    let [from, to] = range;
    let values = (from..=to).map(f64::from).collect();
    Along { parameter: parameter(plan, "drive_frequency"), values, tolerance, unstable: false }
}

/// The curves of a plan, which must come in order.
fn follow(plan: &Plan, threads: usize) -> Vec<Curve> {
    let mut curves = Vec::new();
    let options =
        RunOptions { threads: NonZeroUsize::new(threads).expect("at least one"), ..RunOptions::default() };
    let mut sink = CsvSink::new(Layout::of(plan).names(), Vec::new());
    let mut output = RowWriter::begin(plan, Summary::default(), &mut sink).expect("memory");
    for outcome in Responses::of(plan).expect("a parameter is followed").curves(&options, 0) {
        let outcome = outcome.expect("threads");
        output.write_curve(&outcome).expect("memory");
        let Outcome::Ran(curve) = outcome else { panic!("there are no conditions") };
        curves.push(curve);
    }
    let summary = output.finish(Ok(())).expect("memory");
    assert!((0..).zip(&curves).all(|(index, curve)| curve.design.index == index), "in order");
    let rows: usize = curves.iter().map(|curve| curve.rows(plan, &Layout::of(plan)).count()).sum();
    let lines = sink.target().split(|&byte| byte == b'\n').count() - 1;
    assert_eq!((summary.rows, lines), (rows as u64, rows + 1));
    assert_eq!((summary.ran, summary.is_interrupted()), (plan.len(), false));
    curves
}

fn verdict(plan: &Plan, along: &Along, curve: &Curve) -> Verdict {
    Verdict::new(curve, along, along.parameter(plan), column(plan.rows(), "stroke_amplitude_deg"))
}

/// The bistable bands that an independent solver found in steps of 1 Hz, for the bimorph with a soft hinge.
const BISTABLE: [(u32, Option<[f64; 2]>); 9] = [
    (80, None),
    (100, Some([121.0, 121.0])),
    (120, Some([122.0, 123.0])),
    (140, Some([124.0, 125.0])),
    (160, Some([125.0, 127.0])),
    (180, Some([125.0, 129.0])),
    (200, Some([126.0, 130.0])),
    (240, Some([127.0, 133.0])),
    (280, Some([128.0, 136.0])),
];

#[test]
fn a_soft_hinge_is_bistable_where_the_reference_is() {
    let plan = bimorph(true, &BISTABLE.map(|(volts, _)| volts));
    let along = along(&plan, [114, 145], 0.1);
    let plan = plan.following(along.clone());
    for (curve, (volts, band)) in follow(&plan, 2).iter().zip(BISTABLE) {
        let verdict = verdict(&plan, &along, curve);
        println!("{volts} V: {verdict}");
        let bands: Vec<_> = verdict.bistable().collect();
        let Some([from, to]) = band else {
            assert!(bands.is_empty(), "{volts} V: {verdict}");
            assert!(verdict.to_string().starts_with("no hysteresis from"));
            continue;
        };
        assert_eq!(bands.len(), 1, "{volts} V: {verdict}");
        let [found_from, found_to] = bands[0].range;
        assert!((found_from - from).abs() <= 1.0 && (found_to - to).abs() <= 1.0, "{volts} V: {verdict}");
        // The whole frequencies in the band are those of the reference, to one.
        assert!((found_from.ceil() - from).abs() <= 1.0 && (found_to.floor() - to).abs() <= 1.0, "{verdict}");
        let BandKind::Bistable { jump: Some(jump) } = bands[0].kind else { panic!("{verdict}") };
        assert!(jump > 35.0 && jump < 62.0, "{volts} V: {verdict}");
    }
}

/// `tests/data/bimorph/variant_cases.csv`, rows `k_wh x0.5`: volts, frequency, branch, stroke (deg), mean lift (mgf).
const BRANCHES: [(u32, f64, &str, f64, f64); 3] = [
    (140, 124.0, "up", 112.982_268, 16.657_555),
    (160, 126.0, "down", 59.276_549, -1.899_288),
    (240, 130.0, "up", 126.724_628, 11.066_892),
];

/// Bands of the bimorph with a soft hinge, followed in steps of 0.02 Hz. Each band lies between two steps of 0.5 Hz.
const NARROW: [(u32, [f64; 2]); 3] =
    [(85, [118.439, 118.543]), (90, [119.154, 119.436]), (95, [119.771, 120.259])];

#[test]
fn narrow_bands_between_two_steps_are_found() {
    for step in [0.5, 1.0] {
        let plan = bimorph(true, &NARROW.map(|(volts, _)| volts));
        let parameter = parameter(&plan, "drive_frequency");
        let steps = Some([110.0, 130.0, step]);
        let (plan, along) = Along::new(plan, parameter, steps, None, false).unwrap();
        let plan = plan.following(along.clone());
        for (curve, (volts, [from, to])) in follow(&plan, 2).iter().zip(NARROW) {
            let verdict = verdict(&plan, &along, curve);
            let [band] = &verdict.bands[..] else { panic!("{volts} V, steps of {step} Hz: {verdict}") };
            assert!(
                (band.range[0] - from).abs() <= along.tolerance
                    && (band.range[1] - to).abs() <= along.tolerance,
                "{volts} V, steps of {step} Hz: {verdict}"
            );
        }
    }
}

/// The resolution without hysteresis: the widest step is the step of the grid, or the tolerance where the response is
/// steep.
#[test]
fn a_response_without_hysteresis_tells_its_resolution() {
    let plan = bimorph(true, &[80]);
    let parameter = parameter(&plan, "drive_frequency");
    let (plan, along) = Along::new(plan, parameter, Some([110.0, 130.0, 0.5]), None, false).unwrap();
    let plan = plan.following(along.clone());
    let curve = &follow(&plan, 1)[0];
    let found = verdict(&plan, &along, curve);
    assert_eq!((found.step, found.steep_step), (0.5, 0.03125));
    let text = found.to_string();
    assert!(
        text.starts_with(
            "no hysteresis from 110 to 130 Hz wider than 0.5 Hz (0.03125 Hz where the motion changes by a tenth; branches agree to "
        ),
        "{text}"
    );
    let largest: Vec<f64> =
        (0..4).map(|y| curve.up.iter().map(|step| step.row.state[y].abs()).fold(0.0, f64::max)).collect();
    for two in curve.up.windows(2) {
        let changes = (0..4).any(|y| (two[0].row.state[y] - two[1].row.state[y]).abs() > 0.11 * largest[y]);
        assert!(!changes || two[1].value - two[0].value <= along.tolerance, "{} Hz", two[0].value);
    }
}

/// At 80 V the branches are almost vertical at 117.58 Hz, and motions take hundreds of periods to settle. A motion that
/// does not settle within `max_cycles` is not a second motion.
#[test]
fn slow_motions_are_no_hysteresis() {
    let plan = bimorph(true, &[80]);
    let parameter = parameter(&plan, "drive_frequency");
    let (plan, along) = Along::new(plan, parameter, Some([117.4, 117.7, 0.02]), None, false).unwrap();
    let plan = plan.following(along.clone());
    let curve = &follow(&plan, 1)[0];
    let unsettled = curve.up.iter().chain(&curve.down).filter(|step| step.row.status == Status::Unsettled);
    assert!(unsettled.count() > 0, "the case has slow motions");
    let verdict = verdict(&plan, &along, curve);
    assert_eq!(verdict.bistable().count(), 0, "{verdict}");
}

#[test]
fn both_branches_are_those_of_the_reference() {
    let plan = bimorph(true, &BRANCHES.map(|(volts, ..)| volts));
    let along = along(&plan, [114, 145], 0.5);
    let plan = plan.following(along.clone());
    let [stroke, lift] = ["stroke_pp_deg", "lift_mean_gf"].map(|name| column(plan.rows(), name));
    for (curve, (volts, frequency, branch, degrees, milligrams)) in follow(&plan, 2).iter().zip(BRANCHES) {
        let steps = |way: &str| if way == "up" { &curve.up } else { &curve.down };
        let at = |way| steps(way).iter().find(|step| step.value == frequency).expect("a whole frequency");
        let row = &at(branch).row;
        assert_eq!((row.status, row.stable()), (Status::Periodic, Some(true)));
        assert!((row.measures[stroke] / degrees - 1.0).abs() < 1e-3, "{volts} V: {}", row.measures[stroke]);
        let found = 1e3 * row.measures[lift];
        assert!((found - milligrams).abs() < 0.02, "{volts} V: {found}");
        let other = &at(if branch == "up" { "down" } else { "up" }).row;
        assert!((other.measures[stroke] - degrees).abs() > 20.0, "the other branch is another motion");
    }
}

#[test]
fn the_published_hinge_shows_no_hysteresis() {
    let plan = bimorph(false, &[40, 80, 120, 160, 200, 240, 300]);
    let along = along(&plan, [60, 200], 0.5);
    let plan = plan.following(along.clone());
    for curve in follow(&plan, 2) {
        let verdict = verdict(&plan, &along, &curve);
        assert!(verdict.bands.is_empty() && verdict.difference < 0.05, "{:?}: {verdict}", curve.design.index);
    }
}

#[test]
fn motions_that_do_not_repeat_are_reported_as_such() {
    let plan = bimorph(true, &[180]);
    let along = along(&plan, [78, 88], 0.5);
    let plan = plan.following(along.clone());
    let curves = follow(&plan, 1);
    let verdict = verdict(&plan, &along, &curves[0]);
    let irregular = verdict.bands.iter().find(|band| matches!(band.kind, BandKind::Irregular { .. }));
    let [from, to] = irregular.expect("between 81 and 84 Hz").range;
    assert!((from - 81.0).abs() <= 2.0 && (to - 84.0).abs() <= 2.0, "{verdict}");
    assert!(verdict.to_string().contains("does not repeat every drive period from"), "{verdict}");
}

#[test]
fn curves_depend_on_their_design_alone() {
    let plan = bimorph(true, &[100, 160, 200]);
    let along = along(&plan, [118, 132], 0.1);
    let plan = plan.following(along.clone());
    let together = follow(&plan, 2);
    for (curve, other) in together.iter().zip(follow(&plan, 1)) {
        let alone = Responses::of(&plan).unwrap().curve(plan.point(curve.design.index));
        for (way, (one, two)) in
            [(&curve.up, (&alone.up, &other.up)), (&curve.down, (&alone.down, &other.down))]
        {
            assert_eq!((way.len(), way.len()), (one.len(), two.len()));
            for (step, (one, two)) in way.iter().zip(one.iter().zip(two)) {
                for same in [one, two] {
                    assert_eq!(step.value.to_bits(), same.value.to_bits());
                    assert_eq!(bits(&step.row.measures), bits(&same.row.measures));
                    assert_eq!(step.row.rhs_evals, same.row.rhs_evals);
                }
            }
        }
    }
}

#[test]
fn the_ends_of_a_band_are_located_as_closely_as_asked() {
    let plan = bimorph(true, &[160]);
    let along = along(&plan, [118, 132], 0.01);
    let plan = plan.following(along.clone());
    let curve = &follow(&plan, 1)[0];
    let values: Vec<f64> = curve.up.iter().map(|step| step.value).collect();
    assert_eq!(values, curve.down.iter().map(|step| step.value).collect::<Vec<f64>>());
    assert!(values.windows(2).all(|two| two[0] < two[1]), "rising, each once");
    let verdict = verdict(&plan, &along, curve);
    let [from, to] = verdict.bistable().next().unwrap().range;
    for (edge, outside) in [(from, false), (to, true)] {
        let index = values.iter().position(|&value| value == edge).unwrap();
        let neighbour = values[if outside { index + 1 } else { index - 1 }];
        assert!((edge - neighbour).abs() <= 0.01, "{edge} {neighbour}");
    }
}

#[test]
fn what_is_impossible_has_a_verdict_too() {
    let plan = plan("preset = \"arabagi2013-75hz\"\n[axes]\nground_link = [\"1 m\"]\n");
    let along = along(&plan, [70, 80], 0.1);
    let plan = plan.following(along.clone());
    let curve = &follow(&plan, 1)[0];
    assert!(verdict(&plan, &along, curve).to_string().starts_with("no response: "), "{:?}", curve.up[0].row);
}

/// The branches end in folds at the ends of the band, and unstable orbits join the branches. A motion near an unstable
/// orbit approaches one of the two branches.
#[test]
fn unstable_orbits_join_the_branches() {
    let plan = bimorph(true, &[100, 160, 280]);
    let along = Along { unstable: true, ..along(&plan, [114, 145], 0.1) };
    let plan = plan.following(along.clone());
    let stroke = column(plan.rows(), "stroke_pp_deg");
    for curve in follow(&plan, 2) {
        let verdict = verdict(&plan, &along, &curve);
        let [from, to] = verdict.bistable().next().unwrap().range;
        let values = || curve.unstable.iter().map(|step| step.value);
        let (lowest, highest) = (values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max));
        assert!(lowest > from - 0.1 && lowest < from + 0.02, "{lowest} {verdict}");
        assert!(highest < to + 0.1 && highest > to - 0.02, "{highest} {verdict}");
        for step in &curve.unstable {
            assert_eq!(
                (step.row.status, step.row.stable(), step.row.period),
                (Status::Unstable, Some(false), 1)
            );
            assert!(step.row.residual <= plan.solver().settle_tol && step.row.floquet_max > 1.0);
        }

        // Between the strokes of the branches everywhere.
        let stroke_at = |steps: &[Step], value: f64| {
            // Right at its end a motion may take too long to settle.
            let periodic = steps.iter().filter(|step| step.row.status == Status::Periodic);
            let strokes: Vec<[f64; 2]> =
                periodic.map(|step| [step.value, step.row.measures[stroke]]).collect();
            let above = strokes.iter().position(|[at, _]| *at >= value).unwrap();
            [above - 1, above].map(|index| strokes[index][1])
        };
        let inside = curve.unstable.iter().filter(|step| step.value > from && step.value < to);
        for step in inside.clone() {
            let here = step.row.measures[stroke];
            let [high, low] = [&curve.up, &curve.down].map(|steps| stroke_at(steps, step.value));
            assert!(here < high[0].max(high[1]) && here > low[0].min(low[1]), "{here} {high:?} {low:?}");
        }

        // Marching from the middle, off by little to either side.
        let middle = inside.clone().nth(inside.count() / 2).unwrap();
        let mut values = curve.design.values.clone();
        values[along.parameter] = middle.value;
        let ended = [0.98, 1.02].map(|factor| {
            let begin: Vec<f64> = middle.row.state.iter().map(|y| factor * y).collect();
            let row = plan
                .simulator()
                .run_point(&PointRun::new(Backend::best(), plan.solver(), &values), Some(&begin));
            assert_eq!((row.status, row.stable()), (Status::Periodic, Some(true)));
            row.measures[stroke]
        });
        assert!((ended[0] - ended[1]).abs() > 20.0, "{ended:?}");
    }
}

#[test]
fn a_curve_that_is_stopped_is_not_handed_on() {
    let plan = bimorph(false, &[100, 200]);
    // A hundred thousand steps, which would take minutes.
    let values = (0..100_000).map(|i| 60.0 + 0.001 * f64::from(i)).collect();
    let along = Along { values, ..along(&plan, [60, 61], 1e-3) };
    let plan = plan.following(along);
    let responses = Responses::of(&plan).unwrap();
    let options = RunOptions { threads: NonZeroUsize::new(2).unwrap(), ..RunOptions::default() };
    let mut sink = CsvSink::new(Layout::of(&plan).names(), Vec::new());
    let begun = std::time::Instant::now();
    let output = RowWriter::begin(&plan, Summary::default(), &mut sink).unwrap();
    let mut run = responses.curves(&options, 0);
    while let Some(batch) = run.next_batch().unwrap() {
        assert!(batch.is_empty());
        run.stop();
    }
    let summary = output.finish(Ok(())).unwrap();
    assert!(begun.elapsed().as_secs() < 5, "{:?}", begun.elapsed());
    assert_eq!((summary.done(), summary.points, summary.rows), (0, 2, 0));
    assert!(summary.is_interrupted());
    assert_eq!(sink.target().split(|&byte| byte == b'\n').count() - 1, 1, "the header alone");
}

/// Derived parameters have their values at each step of a curve. Steps with values out of range are invalid.
#[test]
fn derived_parameters_follow_the_steps_of_a_curve() {
    let grid = "preset = \"jafferis2016\"\n[params]\ndrive_voltage_pp = \"80 V\"\n[derived]\n\
                hinge_stiffness = \"preset.hinge_stiffness * (drive_frequency - 101) / 10\"\n";
    let derived = plan(grid);
    let (frequency, hinge) = (parameter(&derived, "drive_frequency"), parameter(&derived, "hinge_stiffness"));
    let refused = Along::new(derived.clone(), hinge, Some([1e-6, 2e-6, 1e-7]), None, false).err().unwrap();
    assert!(refused.to_string().contains("`hinge_stiffness` is derived"), "{refused}");
    let (derived, along) =
        Along::new(derived, frequency, Some([98.0, 114.0, 4.0]), Some(4.0), false).unwrap();
    let derived = derived.following(along.clone());
    let curve = &follow(&derived, 1)[0];
    assert_eq!(curve.invalid(), None);
    let layout = Layout::of(&derived);
    let place = layout.names().iter().position(|name| name == "hinge_stiffness").unwrap();
    let published = plan("preset = \"jafferis2016\"\n").point(0).values[hinge];
    for ((cells, row), step) in
        curve.rows(&derived, &layout).zip(curve.up.iter().chain(curve.down.iter().rev()))
    {
        let expected = published * (step.value - 101.0) / 10.0;
        let Cell::Number(found) = cells[place] else { panic!("a number") };
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} at {} Hz", step.value);
        assert_eq!(row.status == Status::Invalid, expected < 0.0, "{:?} at {} Hz", row.status, step.value);
    }
    let reason = curve.up[0].row.reason.as_deref().unwrap();
    assert!(reason.starts_with("`hinge_stiffness` is computed as -"), "{reason}");
    assert_eq!(curve.up[1].row.status, Status::Periodic);
    let text = verdict(&derived, &along, curve).to_string();
    assert!(text.contains("at 98 Hz (invalid)"), "{text}");
    // Without a possible step there is no response.
    let (never, along) = Along::new(plan(grid), frequency, Some([90.0, 100.0, 2.0]), None, false).unwrap();
    let never = never.following(along.clone());
    let curve = &follow(&never, 1)[0];
    assert!(
        verdict(&never, &along, curve)
            .to_string()
            .starts_with("no response: `hinge_stiffness` is computed as")
    );
}
