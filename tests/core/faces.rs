//! A model that has only rows, lists of points, and the texts of errors.

use flap_core::model::Description;
use flap_core::num::Backend;
use flap_core::simulate::{
    ChirpRequest, Column, Jobs, Point, PointRun, Row, Rows, Simulator, SolverSettings, TrajectoryRequest,
    Unfinished, never, preset, run_list,
};

/// A model whose rows are all invalid, in the reverse order of the points.
struct Backwards;

impl Rows for Backwards {
    fn columns(&self) -> &[Column] {
        &[]
    }

    fn run(&self, _: Backend, _: &SolverSettings, jobs: &mut dyn Jobs) {
        let mut points = Vec::new();
        while let Some(point) = jobs.next(true) {
            points.push(point);
        }
        while let Some(point) = points.pop() {
            // A point without values is lost.
            if !point.values.is_empty() {
                jobs.done(point.index, Row::invalid(point.values[0]));
            }
        }
    }

    fn run_point(&self, run: &PointRun<'_>, _: Option<&[f64]>) -> Row {
        Row::invalid(run.values[0])
    }
}

impl Simulator for Backwards {
    fn description(&self) -> Description<'_> {
        Description::new("backwards", "", &[], &[])
    }
}

const SOLVER: SolverSettings = SolverSettings::DEFAULT;

#[test]
fn a_model_with_rows_alone_says_so() {
    let motions = Backwards.motions().err().unwrap();
    assert_eq!(motions.to_string(), "the model backwards computes rows, but no single motions");
    let experiments = Backwards.experiments().err().unwrap();
    let text = "the model backwards supports no chirps, impulses, imposed motions or natural frequencies";
    assert_eq!(experiments.to_string(), text);

    let set = Backend::best();
    let row = Backwards.run_point(&PointRun::new(set, &SOLVER, &[2.0]), None);
    assert_eq!(row.reason.as_deref(), Some("2"));
}

#[test]
fn rows_of_a_list_are_in_the_order_of_its_points() {
    let set = Backend::best();
    let points = |values: &[f64]| values.iter().map(|&value| Point::at_rest(9, vec![value])).collect();
    let rows = run_list(&Backwards, set, &SOLVER, points(&[3.0, 1.0, 2.0]), &never).unwrap();
    let reasons: Vec<&str> = rows.iter().map(|row| row.reason.as_deref().unwrap()).collect();
    assert_eq!(reasons, ["3", "1", "2"]);
    assert_eq!(run_list(&Backwards, set, &SOLVER, Vec::new(), &never), Ok(Vec::new()));
}

#[test]
fn a_list_with_a_point_without_row_is_unfinished() {
    let set = Backend::best();
    let points = vec![Point::at_rest(0, vec![1.0]), Point::at_rest(1, Vec::new())];
    assert_eq!(run_list(&Backwards, set, &SOLVER, points.clone(), &never), Err(Unfinished::Interrupted));
    assert_eq!(run_list(&Backwards, set, &SOLVER, points, &|| true), Err(Unfinished::Interrupted));
}

#[test]
fn motions_that_are_not_followed_say_why() {
    let (model, preset) = preset("ozaki2018-small").unwrap();
    let (set, values) = (Backend::best(), (preset.values)());

    let short = SolverSettings { max_steps: 3, ..SOLVER };
    let request = TrajectoryRequest { cycles: 1, samples_per_cycle: 1, settled: false };
    let motion = model.motions().unwrap().trajectory(&PointRun::new(set, &short, &values), &request);
    let text = "the motion needs more than max_steps steps in a drive period";
    assert_eq!(motion.unwrap_err().to_string(), text);

    let hasty = SolverSettings { max_cycles: 2, ..SOLVER };
    let request = TrajectoryRequest { settled: true, ..request };
    let motion = model.motions().unwrap().trajectory(&PointRun::new(set, &hasty, &values), &request);
    let text = "the motion does not settle on an orbit of one drive period (status unsettled, 2 cycles); sample it from \
                rest instead";
    assert_eq!(motion.unwrap_err().to_string(), text);

    // A frequency that falls by 0.5 Hz/s or more reaches zero within the last cycle at 1 Hz.
    for rate in [1.0, -0.5, -200.0] {
        let request = ChirpRequest { from: 2.0, to: 1.0, rate, samples_per_cycle: 0 };
        let response = model.experiments().unwrap().chirp(&PointRun::new(set, &SOLVER, &values), &request);
        assert_eq!(
            response.unwrap_err().to_string(),
            format!(
                "a chirp from 2 Hz cannot reach 1 Hz at {rate} Hz/s: frequencies must be more than zero, and the rate must \
                 have the sign of the change and be more than -0.5 Hz/s"
            )
        );
    }

    let begin = [0.0; 3];
    let period = model.motions().unwrap().period(&PointRun::new(set, &SOLVER, &values), &begin);
    let error = period.unwrap_err();
    assert_eq!(
        error.to_string(),
        "the motion cannot begin at [0.0, 0.0, 0.0]: a state consists of 4 finite numbers"
    );
}

#[test]
fn a_motion_goes_on_from_the_state_in_which_another_ends() {
    for name in ["jafferis2016", "ozaki2018-small", "arabagi2013-75hz"] {
        let (model, preset) = preset(name).unwrap();
        let values = (preset.values)();
        let run = PointRun::new(Backend::best(), &SOLVER, &values);
        let motions = model.motions().unwrap();
        let request = TrajectoryRequest { cycles: 2, samples_per_cycle: 4, settled: false };
        let whole = motions.trajectory(&run, &request).unwrap();
        let states = motions.states();
        assert_eq!(&whole.columns[1..=states.len()], states);
        assert_eq!(motions.meanings().len(), whole.columns.len());

        let half = TrajectoryRequest { cycles: 1, ..request };
        let first = motions.trajectory(&run, &half).unwrap();
        let begin = &first.rows[4][1..=states.len()];
        let second = motions.trajectory_from(&run, Some(begin), &half).unwrap();
        // The step size starts anew, within the tolerance.
        for (a, b) in second.rows[4][1..=states.len()].iter().zip(&whole.rows[8][1..=states.len()]) {
            assert!((a - b).abs() <= 1e-4 * b.abs().max(1e-3), "{name}: {a} {b}");
        }
        let error = motions.trajectory_from(&run, Some(&begin[1..]), &half).unwrap_err();
        assert!(error.to_string().contains("a state consists of 4 finite numbers"), "{error}");
    }
}
