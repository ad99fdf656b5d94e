//! The best design within the axes of a plan.

#![allow(clippy::unwrap_used, reason = "helpers of tests may panic as tests do")]

use std::num::NonZeroUsize;

use flap_core::simulate;
use flap_sweep::grid;
use flap_sweep::plan::Plan;
use flap_sweep::run::{Outcome, RunOptions, rows};
use flap_sweep::study::optimum::{
    Aim, Edge, Goal, Optimum, Problem, ProblemPart, Settings, Status, front, optimise,
};

/// A robot whose hinge, frequency and voltage can be chosen.
const ROBOT: &str = r#"
preset = "jafferis2016-improved"

[params]
drive_voltage_pp = "230 V"

[axes]
hinge_stiffness = { from = "1 uN*m/rad", to = "4 uN*m/rad", n = 4 }
drive_frequency = { from = "100 Hz", to = "200 Hz", n = 5 }
"#;

const STRAIN: &str = "strain_surface_max < 0.075 %";

fn plan(text: &str) -> Plan {
    grid::parse("grid", text, simulate::all()).unwrap()
}

fn problem(text: &str, goal: &str, aim: Aim, conditions: &[&str]) -> Problem {
    let conditions: Vec<String> = conditions.iter().map(|condition| (*condition).to_owned()).collect();
    Problem::new(plan(text), goal, aim, &conditions).unwrap()
}

fn solved(problem: &Problem) -> Optimum {
    optimise(problem, &Settings::default(), &|_, _| false).unwrap().unwrap()
}

fn best(text: &str, goal: &str, conditions: &[&str]) -> Optimum {
    solved(&problem(text, goal, Aim::Largest, conditions))
}

fn measure(problem: &Problem, best: &Optimum, name: &str) -> f64 {
    let columns = problem.plan().rows().columns();
    best.row.measures[columns.iter().position(|column| column.name == name).unwrap()]
}

fn is_close(one: f64, other: f64, tolerance: f64) -> bool {
    (one - other).abs() <= tolerance * other.abs()
}

#[test]
fn an_optimum_is_that_of_a_fine_grid() {
    let problem = problem(ROBOT, "vehicle_lift_mgf", Aim::Largest, &["stroke_pp_deg < 100 deg", STRAIN]);
    let best = solved(&problem);
    let fine = plan(&ROBOT.replace("n = 4", "n = 41").replace("n = 5", "n = 41"));
    let place = |name: &str| fine.rows().columns().iter().position(|column| column.name == name).unwrap();
    let [lift, stroke, strain] = ["vehicle_lift_mgf", "stroke_pp_deg", "strain_surface_max"].map(place);
    let mut largest = 0.0_f64;
    for outcome in rows(&fine, &RunOptions::default(), 0) {
        let Outcome::Ran(row) = outcome.unwrap() else { continue };
        if !row.measures.is_empty() && row.measures[stroke] < 100.0 && row.measures[strain] < 0.000_75 {
            largest = largest.max(row.measures[lift]);
        }
    }
    assert_eq!(best.status, Status::Optimal, "{best:?}");
    assert!(best.goal >= largest && best.goal < 1.01 * largest, "{} and {largest}", best.goal);
    assert!(best.rows < fine.len() / 4, "{} rows", best.rows);
    assert!(measure(&problem, &best, "strain_surface_max") < 0.000_75);
    assert_eq!(best.optima[0].starts, best.starts, "{:?}", best.optima);
}

/// With V = 100 V · L and f = 50 Hz · L, the product is 5000 L² V·Hz, for the limit L.
#[test]
fn an_optimum_and_its_multiplier_are_those_of_a_formula() {
    let text = r#"
        preset = "ozaki2018-large"
        [axes]
        drive_voltage_pp = { from = "40 V", to = "120 V", n = 3 }
        drive_frequency = { from = "60 Hz", to = "105 Hz", n = 3, scale = "log" }
    "#;
    let sum = "drive_voltage_pp / 100 V + drive_frequency / 50 < 3.6";
    let refused =
        Problem::new(plan(text), "drive_voltage_pp", Aim::Largest, &[sum.to_owned()]).err().unwrap();
    assert_eq!(
        (refused.part, refused.message.as_str()),
        (ProblemPart::Condition(0), "`100 V` is not compared with a column")
    );
    let best =
        best(text, "drive_voltage_pp * drive_frequency", &[&sum.replace(" V", "").replace("3.6", "1.8")]);
    let value = |number: usize| best.varied[number].1;
    assert_eq!(best.status, Status::Optimal);
    // The frequency is at its smallest value: V = 100 V · (1.8 - 60/50) = 60 V.
    assert!(is_close(value(0), 60.0, 1e-4) && value(1) == 60.0, "{:?}", best.varied);
    assert!(is_close(best.goal, 3600.0, 1e-4));
    assert_eq!(best.at_end, [(best.varied[1].0, [60.0, 105.0])]);
    let limit = best.active.iter().find(|active| active.edge == Edge::Limit).unwrap();
    // d(V f)/dL = 100 V · 60 Hz.
    assert!(is_close(limit.per_unit, 6000.0, 1e-3) && is_close(limit.percent, 3.0, 1e-3), "{limit:?}");
    let bound = best.active.iter().find(|active| active.edge == Edge::Smallest).unwrap();
    // With V = 100 V · (1.8 - f / 50): d(V f)/df = 100 V · (1.8 - 2 f / 50) = -60 V.
    assert!(is_close(bound.per_unit, -60.0, 1e-3), "{bound:?}");
    assert_eq!(bound.name, "drive_frequency");
}

/// The goal is zero at the best design, so the goal has no typical size for its changes near the best design.
#[test]
fn a_goal_may_be_zero_at_the_optimum() {
    let text = r#"
        preset = "jafferis2016"
        [axes]
        hinge_stiffness = { from = "1.5 uN*m/rad", to = "6 uN*m/rad", n = 5 }
    "#;
    let problem = problem(text, "(pitch_amplitude_deg - 60)^2", Aim::Smallest, &[]);
    let best = solved(&problem);
    assert_eq!(best.status, Status::Optimal);
    // The other optimum is the largest stiffness.
    let almost_zero = best.optima.iter().filter(|optimum| optimum.goal < 1.0);
    assert_eq!(almost_zero.map(|optimum| optimum.starts).collect::<Vec<_>>(), [4], "{:?}", best.optima);
    assert!((measure(&problem, &best, "pitch_amplitude_deg") - 60.0).abs() < 1e-2, "{best:?}");
}

#[test]
fn multipliers_are_those_of_problems_with_other_limits() {
    let limit = |strain: f64| format!("strain_surface_max < {strain}");
    let at = |strain: f64| best(ROBOT, "lift_mean_mn", &[&limit(strain), "drive_frequency > 110 Hz"]);
    let here = at(0.000_75);
    let [less, more] = [0.000_745, 0.000_755].map(|strain| at(strain).goal);
    let [active] = &here.active[..] else { panic!("{:?}", here.active) };
    assert_eq!(
        (active.edge, active.name.as_str(), active.limit),
        (Edge::Limit, "strain_surface_max < 0.00075", 0.000_75)
    );
    let slope = (more - less) / 1e-5;
    assert!(is_close(active.per_unit, slope, 0.02), "{} and {slope}", active.per_unit);
    assert!(is_close(active.percent, slope * 0.000_75 / here.goal, 0.02));
    let words = active.sentence("lift_mean_mn");
    assert!(words.starts_with("1 % more of the limit in `strain_surface_max < 0.00075` gives 0."), "{words}");
    assert!(words.ends_with(" % more lift_mean_mn"), "{words}");
}

/// The same limit as an option and as a condition of the grid.
#[test]
fn conditions_of_the_grid_are_limits() {
    let option = best(ROBOT, "lift_mean_mn", &["drive_frequency < 140 Hz"]);
    let grid = format!("{ROBOT}\n[where]\nslow = \"140 > drive_frequency\"\n");
    let of_grid = best(&grid, "lift_mean_mn", &[]);
    assert!(is_close(option.goal, of_grid.goal, 1e-6));
    let multiplier =
        |best: &Optimum| best.active.iter().find(|active| active.edge == Edge::Limit).unwrap().per_unit;
    assert!(is_close(multiplier(&option), multiplier(&of_grid), 1e-3));
    assert_eq!(of_grid.limits[0].text, "slow");
}

#[test]
fn an_answer_is_the_same_for_any_number_of_threads() {
    let problem = problem(ROBOT, "lift_mean_mn", Aim::Largest, &[STRAIN]);
    let answers = [1, 4].map(|threads| {
        let run = RunOptions { threads: NonZeroUsize::new(threads).unwrap(), ..RunOptions::default() };
        let answer = optimise(&problem, &Settings { run, ..Settings::default() }, &|_, _| false);
        format!("{:?}", answer.unwrap().unwrap())
    });
    assert_eq!(answers[0], answers[1]);
}

#[test]
fn without_a_feasible_design_the_limits_are_exceeded_least() {
    let conditions = ["stroke_pp_deg < 40 deg", "lift_mean_mn > 1.2 mN"];
    let problem = problem(ROBOT, "lift_mean_mn", Aim::Largest, &conditions);
    let best = solved(&problem);
    assert_eq!(best.status, Status::Infeasible);
    assert!(!best.is_feasible() && best.active.is_empty());
    let excess: Vec<f64> = best.limits.iter().map(|limit| limit.excess).collect();
    assert!(excess[0] > 0.1 && is_close(excess[0], excess[1], 1e-3), "both by the same share: {excess:?}");
    // No point of a grid exceeds both by less.
    let fine = plan(&ROBOT.replace("n = 4", "n = 13").replace("n = 5", "n = 21"));
    let place = |name: &str| fine.rows().columns().iter().position(|column| column.name == name).unwrap();
    let [lift, stroke] = ["lift_mean_mn", "stroke_pp_deg"].map(place);
    for outcome in rows(&fine, &RunOptions::default(), 0) {
        let Outcome::Ran(row) = outcome.unwrap() else { continue };
        if !row.measures.is_empty() {
            let over = (row.measures[stroke] / 40.0 - 1.0).max(1.0 - row.measures[lift] / 1.2);
            assert!(over > excess[0] - 1e-4, "{over}");
        }
    }
}

#[test]
fn choices_and_parameters_that_move_together_are_tried_one_by_one() {
    let text = r#"
        preset = "ozaki2018-large"
        [axes]
        drive_shape = ["square", "sine"]
        drive_frequency = { from = "100 Hz", to = "120 Hz", n = 3 }
        [[zip]]
        wing_length = ["31 mm", "32.4 mm"]
        wing_mass = ["3.9 mg", "4.09 mg"]
    "#;
    let problem = problem(text, "lift_mean_mn", Aim::Largest, &["stroke_pp_deg < 60 deg"]);
    let best = solved(&problem);
    assert_eq!(best.status, Status::Optimal, "{best:?}");
    let parameters = problem.plan().parameters();
    let value = |best: &[(usize, f64)], name: &str| {
        best.iter().find(|(index, _)| parameters[*index].name == name).unwrap().1
    };
    for other in &best.optima {
        assert!([0.031, 0.0324].contains(&value(&other.varied, "wing_length")));
        let mass = if value(&other.varied, "wing_length") == 0.031 { 3.9e-6 } else { 4.09e-6 };
        assert_eq!(value(&other.varied, "wing_mass"), mass);
    }
    let choices: std::collections::BTreeSet<String> = best
        .optima
        .iter()
        .map(|other| {
            format!("{} {}", value(&other.varied, "drive_shape"), value(&other.varied, "wing_length"))
        })
        .collect();
    assert_eq!(choices.len(), 4, "every choice has a start: {choices:?}");
    assert!(best.optima.iter().all(|other| other.goal <= best.goal || !other.is_feasible));
}

/// Over the drive frequency, the exact optimum equals the optimum of designs at the resonance of the lift.
#[test]
fn designs_at_their_resonance_have_optima_without_derivatives() {
    let text = ROBOT.replace("drive_frequency = {", "# ").replace(
        "\"230 V\"",
        "\"230 V\"\ndrive_frequency = \"resonance\"\n\n[resonance]\nof = \"lift\"\nfrom = \"100 Hz\"\nto = \"200 Hz\"",
    );
    let at_resonance = problem(&text, "lift_mean_mn", Aim::Largest, &[]);
    assert!(!at_resonance.has_slopes());
    let settings = Settings { starts: NonZeroUsize::MIN, ..Settings::default() };
    let found = optimise(&at_resonance, &settings, &|_, _| false).unwrap().unwrap();
    assert!(found.is_polished);
    let exact = best(ROBOT, "lift_mean_mn", &[]);
    assert!(is_close(found.goal, exact.goal, 1e-3), "{} and {}", found.goal, exact.goal);
    let frequency = problem(ROBOT, "lift_mean_mn", Aim::Largest, &[])
        .plan()
        .parameters()
        .iter()
        .position(|parameter| parameter.name == "drive_frequency")
        .unwrap();
    assert_eq!(found.values[frequency], measure(&at_resonance, &found, "resonance_hz"));
}

/// The goal has a kink at its optimum, so that no derivatives confirm it. A pattern search finds it.
#[test]
fn an_optimum_at_a_kink_is_found() {
    let problem = problem(ROBOT, "abs(stroke_pp_deg - 80)", Aim::Smallest, &[STRAIN]);
    let best = solved(&problem);
    assert!(best.goal < 1e-3, "{}", best.goal);
    assert!((measure(&problem, &best, "stroke_pp_deg") - 80.0).abs() < 1e-3);
    assert!(best.is_feasible());
}

#[test]
fn large_grids_are_sampled() {
    let text = ROBOT.replace("n = 4", "n = 400").replace("n = 5", "n = 500");
    let problem = problem(&text, "lift_mean_mn", Aim::Largest, &[STRAIN]);
    let settings = Settings { points: 60, ..Settings::default() };
    let found = optimise(&problem, &settings, &|_, _| false).unwrap().unwrap();
    assert_eq!((found.points, found.computed), (200_000, 60));
    assert!(is_close(found.goal, best(ROBOT, "lift_mean_mn", &[STRAIN]).goal, 1e-4));
}

/// Each point of a front is the optimum for its limit.
#[test]
fn a_front_has_optima_under_limits() {
    let goals = [
        Goal { text: "lift_mean_mn", aim: Aim::Largest },
        Goal { text: "power_mean_mw", aim: Aim::Smallest },
    ];
    let conditions = ["lift_mean_mn > 0.5 mN".to_owned()];
    let found = front(&plan(ROBOT), goals, &conditions, 5, &Settings::default(), &|_, _| false);
    let points = found.unwrap().unwrap().points;
    assert_eq!(points.len(), 5);
    for two in points.windows(2) {
        let steps = [0, 1].map(|goal| two[1].goals[goal] - two[0].goals[goal]);
        assert!(steps[0] < 0.0 && steps[1] < 0.0, "each costs some of the other: {steps:?}");
    }
    assert!(is_close(points[0].goals[0], best(ROBOT, "lift_mean_mn", &[]).goal, 1e-5));
    let least = solved(&problem(ROBOT, "power_mean_mw", Aim::Smallest, &["lift_mean_mn > 0.5 mN"]));
    assert!(is_close(points[4].goals[1], least.goal, 1e-6));
    let limit = format!("power_mean_mw < {}", points[2].goals[1]);
    assert!(is_close(points[2].goals[0], best(ROBOT, "lift_mean_mn", &[&limit]).goal, 1e-4));
}

/// Among the designs with the best value of the second goal, the last point has the best value of the first goal.
#[test]
fn the_last_point_of_a_front_is_not_dominated() {
    let goals = [
        Goal { text: "lift_mean_mn", aim: Aim::Largest },
        Goal { text: "hinge_stiffness", aim: Aim::Smallest },
    ];
    let found = front(&plan(ROBOT), goals, &[], 3, &Settings::default(), &|_, _| false);
    let last = found.unwrap().unwrap().points.pop().unwrap();
    let softest = ROBOT.replace("{ from = \"1 uN*m/rad\", to = \"4 uN*m/rad\", n = 4 }", "[\"1 uN*m/rad\"]");
    assert!(is_close(last.goals[1], 1e-6, 1e-9), "{:?}", last.goals);
    assert!(is_close(last.goals[0], best(&softest, "lift_mean_mn", &[]).goal, 1e-4), "{:?}", last.goals);
}

/// A lower end of −20 V grows by 1 % if it becomes −20.2 V.
#[test]
fn percents_of_negative_limits_have_the_right_sign() {
    let text = r#"
        preset = "jafferis2016"
        [axes]
        drive_offset = { from = "-20 V", to = "-10 V", n = 3 }
    "#;
    let best = best(text, "-drive_offset", &[]);
    assert!(is_close(best.goal, 20.0, 1e-6) && best.active.len() == 1, "{best:?}");
    assert!(is_close(best.active[0].percent, 1.0, 1e-3), "{:?}", best.active);
}

#[test]
fn a_search_can_be_stopped() {
    let problem = problem(ROBOT, "lift_mean_mn", Aim::Largest, &[STRAIN]);
    for most in [0, 20] {
        let found = optimise(&problem, &Settings::default(), &|done, _| done >= most).unwrap();
        assert!(found.is_none());
    }
}

#[test]
fn mistakes_have_a_place_and_help() {
    let refused = |goal: &str, conditions: &[&str]| {
        let conditions: Vec<String> = conditions.iter().map(|condition| (*condition).to_owned()).collect();
        let error = Problem::new(plan(ROBOT), goal, Aim::Largest, &conditions).err().unwrap();
        (error.part, error.message, error.help.unwrap_or_default())
    };
    let told = |part: ProblemPart, message: &str, help: &str| (part, message.to_owned(), help.to_owned());
    assert_eq!(
        refused("lift_mean", &[]),
        told(ProblemPart::Goal, "unknown name `lift_mean`", "did you mean `lift_mean_mn`?")
    );
    assert_eq!(
        refused("lift_mean_mn", &["stroke_pp_deg < 90 deg or lift_mean_mn > 1"]),
        told(
            ProblemPart::Condition(0),
            "a condition on measures consists of comparisons with <, <=, > or >=, joined with `and`",
            "only conditions on parameters alone can contain `or`, `not`, == or !="
        )
    );
    assert_eq!(
        refused("lift_mean_mn", &["lift_mean_mn > 0", "stroke_pp_deg < 90 V"]).0,
        ProblemPart::Condition(1)
    );
    let preset = "preset = \"jafferis2016\"\n";
    let error = Problem::new(plan(preset), "lift_mean_mn", Aim::Largest, &[]).err().unwrap();
    assert_eq!((error.part, error.message.as_str()), (ProblemPart::Plan, "the grid varies no parameter"));
    let builds = format!(
        "{preset}[sample]\nmethod = \"sobol\"\nn = 8\n[sample.parameters]\nforce_factor = {{ relative_sd = \"5 %\" }}\n"
    );
    let error = Problem::new(plan(&builds), "lift_mean_mn", Aim::Largest, &[]).err().unwrap();
    assert_eq!(error.message, "the distribution of `force_factor` has no smallest and largest value");
}
