//! Edges of hysteresis in the plane of two parameters.

use flap_core::drive::{DriveConstants, WaveformParameters};
use flap_core::model::{Derived, Description, Instant, Model, Unit};
use flap_core::num::Real;
use flap_core::ode::{Ode, Start};
use flap_core::parameter::Invalid;
use flap_core::parameter::Kind::Number;
use flap_core::parameter::Preset;
use flap_core::parameter::Range::Positive;
use flap_core::simulate::{Runner, Simulator, never};
use flap_sweep::plan::{Along, Plan};
use flap_sweep::study::response::{Edge, EdgeEnd, EdgeKind, EdgeMark, EdgeRange, Edges, Responses};

use crate::support::{bits, parameter, plan};

flap_core::parameters! {
    /// Parameters of a Duffing oscillator in a plane.
    pub struct Params {
        /// Drive frequency.
        drive_frequency: f64 = ("Hz", "", Number(Positive)),
        /// Magnitude of the rotating force per mass.
        drive_strength: f64 = ("rad/s^2", "F", Number(Positive)),
        /// Damping per mass.
        damping: f64 = ("1/s", "c", Number(Positive)),
        /// Natural angular frequency of small motions, squared.
        stiffness: f64 = ("1/s^2", "k", Number(Positive)),
        /// Cubic stiffness per mass.
        hardening: f64 = ("1/s^2", "h", Number(Positive)),
    }
}

flap_core::per_lane! {
    /// Constants of a point.
    pub struct Constants<R> {
        /// Rotating force per mass.
        pub drive: DriveConstants<R>,
        /// c (1/s).
        pub damping: R,
        /// k (1/s²).
        pub stiffness: R,
        /// h (1/s²).
        pub hardening: R,
    }
}

flap_core::signals! {
    /// Signals of the oscillator.
    pub struct Signals {
        stroke: (Unit::DEG, "first coordinate", [Amplitude]) principal First,
    }
}

/// A point in a plane under a force of constant magnitude that rotates with the drive frequency:
///
/// ```text
/// r̈ + c ṙ + (k + h |r|²) r = F (cos Ωt, sin Ωt)
/// ```
///
/// The circular motion with the amplitude A is an exact solution, with a = A²:
///
/// ```text
/// F² = a [(k + h a − Ω²)² + (c Ω)²]
/// ```
#[derive(Clone, PartialEq)]
struct Rotor;

impl Ode<4> for Rotor {
    type Constants<R: Real> = Constants<R>;
    type Input<R: Real> = [R; 2];

    #[inline(always)]
    fn input<R: Real>(&self, c: &Constants<R>, t: R) -> [R; 2] {
        let (sin, cos) = c.drive.phase(t).sin_cos();
        [c.drive.amplitude * cos, c.drive.amplitude * sin]
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, c: &Constants<R>, force: &[R; 2], _side: R, y: &[R; 4]) -> [R; 4] {
        let [x_1, x_2, v_1, v_2] = *y;
        let stiffness = c.stiffness + c.hardening * (x_1 * x_1 + x_2 * x_2);
        [v_1, v_2, force[0] - c.damping * v_1 - stiffness * x_1, force[1] - c.damping * v_2 - stiffness * x_2]
    }
}

impl Model<4> for Rotor {
    type Signals = Signals;

    const DESCRIPTION: Description<'static> = Description::new(
        "rotor",
        "a Duffing oscillator in a plane",
        Params::TABLE,
        &[Preset { name: "rotor", doc: "an example", values: || EXAMPLE.to_values() }],
    );
    const STATES: [&'static str; 4] = ["x_1", "x_2", "v_1", "v_2"];
    const DERIVED: &'static [Derived<Self, Constants<f64>, Signals>] = &[];

    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 4>, Invalid> {
        let Params { drive_frequency, drive_strength, damping, stiffness, hardening } =
            Params::from_values(values);
        let drive = DriveConstants::new(drive_frequency, &WaveformParameters::SINE, [0.0, drive_strength]);
        let constants = Constants { drive, damping, stiffness, hardening };
        Ok(Start::new(constants, [0.0; 4], drive.period(), [0.5; 4]))
    }

    fn drive<R: Real>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    #[inline(always)]
    fn signals<R: Real>(&self, _c: &Constants<R>, at: Instant<'_, R, [R; 2], 4>) -> Signals<R> {
        Signals { stroke: at.y[0] }
    }
}

static ROTOR: Runner<Rotor, 4> = Runner::new(Rotor);

const EXAMPLE: Params =
    Params { drive_frequency: 0.2, drive_strength: 0.12, damping: 0.1, stiffness: 1.0, hardening: 1.0 };

/// A plan of the rotor that follows its drive frequency, and the range of its force.
fn rotor(strength: f64, range: [f64; 2], step: Option<f64>) -> (Plan, EdgeRange) {
    let grid = format!("preset = \"rotor\"\n[params]\ndrive_strength = {strength}\n");
    let models: &[&'static dyn Simulator] = &[&ROTOR];
    let plan =
        flap_sweep::grid::parse("grid.toml", &grid, models).unwrap_or_else(|error| panic!("{error:?}"));
    follow(plan, [0.15, 0.26, 0.002], "drive_strength", range, step)
}

fn follow(
    plan: Plan,
    steps: [f64; 3],
    second: &str,
    range: [f64; 2],
    step: Option<f64>,
) -> (Plan, EdgeRange) {
    let (first, second) = (parameter(&plan, "drive_frequency"), parameter(&plan, second));
    let (plan, along) = Along::new(plan, first, Some(steps), None, false).expect("a range");
    let second = EdgeRange::new(&plan, &along, second, range, step).expect("a range");
    (plan.following(along), second)
}

fn edges(plan: &Plan, second: &EdgeRange) -> Edges {
    let responses = Responses::of(plan).expect("a parameter is followed");
    let curve = responses.curve(plan.point(0));
    responses.edges(&curve, second, &never)
}

fn verdict(plan: &Plan, second: &EdgeRange, edge: &Edge) -> String {
    edge.verdict(plan, plan.followed().expect("a parameter is followed"), second)
}

/// Returns the forces at the folds of the rotor at a drive frequency (Hz): dF²/da = 0.
///
/// Their squared amplitudes are the roots of 3 h² a² + 4 h d a + d² + (c Ω)², with d = k − Ω².
fn folds(frequency: f64) -> [f64; 2] {
    let Params { damping: c, stiffness: k, hardening: h, .. } = EXAMPLE;
    let omega = std::f64::consts::TAU * frequency;
    let d = k - omega * omega;
    let root = (d * d - 3.0 * (c * omega).powi(2)).sqrt();
    [-1.0, 1.0].map(|sign| {
        let a = (sign * root - 2.0 * d) / (3.0 * h);
        (a * ((d + h * a).powi(2) + (c * omega).powi(2))).sqrt()
    })
}

#[test]
fn folds_and_cusp_of_a_duffing_oscillator_are_exact() {
    let (plan, second) = rotor(0.12, [0.01, 0.2], None);
    let found = edges(&plan, &second);
    let [edge] = &found.edges[..] else { panic!("both folds are one curve: {found:?}") };
    println!("{}", verdict(&plan, &second, edge));
    assert_eq!((edge.kind, found.missed.len()), (EdgeKind::Fold, 0));
    assert!(edge.ends.iter().all(|end| matches!(end, EdgeEnd::Range(_))), "{:?}", edge.ends);
    assert!(edge.points.len() > 30);
    let mut largest = 0.0_f64;
    for point in &edge.points {
        let [frequency, force] = point.values;
        if point.mark.is_some() {
            continue;
        }
        let nearest = folds(frequency).map(|exact| (force - exact).abs()).into_iter().fold(1.0, f64::min);
        assert!(nearest < 1e-7, "{frequency} Hz, {force}: {nearest:e}");
        largest = largest.max(nearest);
        assert!((point.floquet_max - 1.0).abs() < 1e-5, "{}", point.floquet_max);
    }

    println!("largest error of the force: {largest:e}");
    // Both roots are one: d² = 3 (c Ω)².
    let Params { damping: c, stiffness: k, hardening: h, .. } = EXAMPLE;
    let root = 3.0_f64.sqrt();
    let omega = 0.5 * (root * c + (3.0 * c * c + 4.0 * k).sqrt());
    let force = (8.0 * root / 9.0 * (c * omega).powi(3) / h).sqrt();
    let cusps: Vec<_> = edge.points.iter().filter(|point| point.mark == Some(EdgeMark::Cusp)).collect();
    let [cusp] = &cusps[..] else { panic!("{} cusps", cusps.len()) };
    let [found_frequency, found_force] = cusp.values;
    let frequency = omega / std::f64::consts::TAU;
    println!("cusp at {frequency} Hz, {force}: {} {}", found_frequency - frequency, found_force - force);
    assert!((found_frequency - frequency).abs() < 1e-7, "{found_frequency} {frequency}");
    assert!((found_force - force).abs() < 1e-7, "{found_force} {force}");
    let amplitude = (2.0 * root * c * omega / (3.0 * h)).sqrt();
    assert!((cusp.measures[0].to_radians() - amplitude).abs() < 1e-4, "{} {amplitude}", cusp.measures[0]);
    assert!(
        verdict(&plan, &second, edge)
            .ends_with("; hysteresis begins at 0.0446735 rad/s², 0.173534 Hz (cusp)")
    );
}

#[test]
fn points_are_at_the_steps_that_were_requested() {
    let (plan, second) = rotor(0.12, [0.04, 0.16], Some(0.02));
    let found = edges(&plan, &second);
    let points = &found.edges[0].points;
    let forces: Vec<f64> = points.iter().map(|point| (1e6 * point.values[1]).round() / 1e6).collect();
    let cusp = points.iter().position(|point| point.mark == Some(EdgeMark::Cusp)).expect("a cusp");
    let mut expected = vec![0.16, 0.14, 0.12, 0.1, 0.08, 0.06];
    assert_eq!(forces[..cusp], expected);
    expected.reverse();
    assert_eq!(forces[cusp + 1..], expected);
    for point in points.iter().filter(|point| point.mark.is_none()) {
        let [frequency, force] = point.values;
        assert!(folds(frequency).iter().any(|exact| (force - exact).abs() < 1e-6), "{frequency} {force}");
    }
}

#[test]
fn a_design_without_a_band_has_no_edge() {
    let (plan, second) = rotor(0.03, [0.01, 0.2], None);
    let found = edges(&plan, &second);
    assert_eq!((found.edges.len(), found.missed.len()), (0, 0));
}

/// The bimorph with half its hinge stiffness, which has one band from 110 to 140 Hz.
fn bimorph(range: [f64; 2], step: Option<f64>) -> (Plan, EdgeRange) {
    let grid = "preset = \"jafferis2016\"\n[params]\nhinge_stiffness = \"0.7486 uN*m/rad\"\n\
                drive_voltage_pp = \"160 V\"\n";
    follow(plan(grid), [110.0, 140.0, 1.0], "drive_voltage_pp", range, step)
}

/// Ends of the bands that `flap respond` finds at single voltages, with their largest error (Hz).
///
/// The first three bands are followed in steps of 0.02 Hz, the other bands in steps of 1 Hz with a tolerance of 1/16
/// Hz.
const BANDS: [(f64, [f64; 2], f64); 8] = [
    (85.0, [118.439, 118.543], 0.002),
    (90.0, [119.154, 119.436], 0.002),
    (95.0, [119.771, 120.259], 0.002),
    (100.0, [120.375, 121.0], 0.0625),
    (140.0, [123.25, 125.75], 0.0625),
    (160.0, [124.25, 127.625], 0.0625),
    (200.0, [125.6875, 130.875], 0.0625),
    (280.0, [127.3125, 136.1875], 0.0625),
];

#[test]
fn the_edge_of_a_bimorph_contains_the_ends_of_its_bands() {
    let (plan, second) = bimorph([60.0, 300.0], Some(5.0));
    let found = edges(&plan, &second);
    let [edge] = &found.edges[..] else { panic!("{found:?}") };
    println!("{}", verdict(&plan, &second, edge));
    for (volts, band, tolerance) in BANDS {
        let at: Vec<f64> = edge
            .points
            .iter()
            .filter(|point| point.values[1] == volts)
            .map(|point| point.values[0])
            .collect();
        let [high, low] = at[..] else { panic!("{volts} V: {at:?}") };
        // The last value in a band is inside of the edge, and the next value is outside.
        let inside = [band[0] - low, high - band[1]];
        println!("{volts} V: {low} to {high} Hz, {inside:?} inside");
        assert!(
            inside.iter().all(|inside| (-1e-3..tolerance + 1e-3).contains(inside)),
            "{volts} V: {inside:?}"
        );
    }
    let cusps: Vec<_> = edge.points.iter().filter(|point| point.mark == Some(EdgeMark::Cusp)).collect();
    let [cusp] = &cusps[..] else { panic!("{} cusps", cusps.len()) };
    assert!(cusp.values[1] > 80.0 && cusp.values[1] < 85.0, "no band at 80 V, and a band at 85 V");
}

/// The soft bimorph flutters between the frequencies of a torus, from 65 to 80 Hz at 240 V.
#[test]
fn the_edge_of_flutter_is_a_torus() {
    let grid = "preset = \"jafferis2016\"\n[params]\nhinge_stiffness = \"0.7486 uN*m/rad\"\n\
                drive_voltage_pp = \"240 V\"\n";
    let (plan, second) =
        follow(plan(grid), [60.0, 100.0, 1.0], "drive_voltage_pp", [100.0, 250.0], Some(60.0));
    let found = edges(&plan, &second);
    let [edge] = &found.edges[..] else { panic!("{found:?}") };
    println!("{}", verdict(&plan, &second, edge));
    assert_eq!(edge.kind, EdgeKind::Torus);
    let mut turns = Vec::new();
    for point in &edge.points {
        let [frequency, volts] = point.values;
        assert!((point.floquet_max - 1.0).abs() < 1e-5, "{}", point.floquet_max);
        turns.extend(point.mark.map(|mark| (mark, frequency, volts)));
        // Bands in steps of 1 Hz.
        let band = match volts {
            240.0 => [65.0, 80.0],
            _ => continue,
        };
        assert!(band.iter().any(|end| (frequency - end).abs() < 1.0), "{volts} V: {frequency} Hz");
    }
    let [(mark, frequency, volts)] = turns[..] else { panic!("{turns:?}") };
    assert!(mark == EdgeMark::Turn && volts > 160.0 && volts < 180.0, "{volts} V");
    assert!(frequency > 80.0 && frequency < 85.0, "{frequency} Hz");
}

#[test]
fn edges_have_the_same_bits_again() {
    let (plan, second) = bimorph([100.0, 200.0], None);
    let [one, two] = [edges(&plan, &second), edges(&plan, &second)];
    assert_eq!(one.edges.len(), 2, "the cusp is outside of the range");
    for (one, two) in one.edges.iter().zip(&two.edges) {
        assert_eq!(one.points.len(), two.points.len());
        for (one, two) in one.points.iter().zip(&two.points) {
            assert_eq!((bits(&one.values), bits(&one.measures)), (bits(&two.values), bits(&two.measures)));
        }
        assert!(one.points.iter().all(|point| (100.0..=200.0).contains(&point.values[1])));
    }
}

/// The design has 160 V, which is the lower end of the range.
#[test]
fn an_edge_that_begins_at_the_end_of_the_range_has_no_point_twice() {
    let (plan, second) = bimorph([160.0, 200.0], None);
    let found = edges(&plan, &second);
    assert!(!found.edges.is_empty());
    for edge in &found.edges {
        let values: Vec<[u64; 2]> = edge.points.iter().map(|point| point.values.map(f64::to_bits)).collect();
        assert!(
            values.windows(2).all(|two| two[0] != two[1]),
            "{:?}",
            edge.points.iter().map(|point| point.values).collect::<Vec<_>>()
        );
    }
}

#[test]
fn ranges_without_meaning_are_refused() {
    let (plan, _) = bimorph([60.0, 300.0], None);
    let along = plan.followed().expect("a parameter is followed").clone();
    let refused = |name: &str, range, step| {
        EdgeRange::new(&plan, &along, parameter(&plan, name), range, step).expect_err(name).message
    };
    assert_eq!(refused("drive_frequency", [1.0, 2.0], None), "`drive_frequency` is the followed parameter");
    assert_eq!(
        refused("drive_voltage_pp", [200.0, 300.0], None),
        "`drive_voltage_pp` is 160 V, and its range is 200 V to 300 V"
    );
    for step in [0.0, 1e-3] {
        assert_eq!(
            refused("drive_voltage_pp", [100.0, 300.0], Some(step)),
            "the step of `drive_voltage_pp` must be more than zero, and not too short"
        );
    }
}
