//! Quadratic maps of a vehicle's mean force and torque, compared with rows and exact derivatives of the vehicle.

#![allow(clippy::unwrap_used, reason = "helpers of tests may panic as tests do")]

use std::num::NonZeroUsize;
use std::sync::LazyLock;

use flap_core::simulate::{Status, never};
use flap_sweep::plan::Plan;
use flap_sweep::run::RunOptions;
use flap_sweep::study::wrench_map::{MapInput, WrenchMap, WrenchMapError};
use flap_sweep::vehicle::control::{Input, VehicleRun};

use crate::support::{bits, plan};

const VEHICLE: &str = "\
preset = \"jafferis2016\"
[vehicle]
about = [0, 0, \"-3 mm\"]
[[vehicle.wings]]
name = \"left\"
position = [0, \"2 mm\", 0]
[[vehicle.wings]]
name = \"right\"
position = [0, \"2 mm\", 0]
mirrored = true
[params]
drive_voltage_pp = \"200 V\"
drive_frequency = \"100 Hz\"
drive_shape = \"harmonics\"
drive_second_phase = \"90 deg\"
";

/// Inputs around 200 V, 0 V, 0 V and 0. With a share of 1, the ranges are 20 V, 10 V, 20 V and 0.1 to both sides.
fn inputs(plan: &Plan, share: f64) -> Vec<MapInput> {
    let half = [
        ("amplitude", 200.0, 20.0),
        ("bias", 0.0, 10.0),
        ("amplitude_difference", 0.0, 20.0),
        ("second_harmonic", 0.0, 0.1),
    ];
    let input = |(name, centre, half): (&str, f64, f64)| {
        let input = Input::of(plan.vehicle().unwrap(), name).unwrap();
        MapInput::new(&input, centre - share * half, centre + share * half).unwrap()
    };
    half.into_iter().map(input).collect()
}

fn map(plan: &Plan, share: f64, threads: usize) -> WrenchMap {
    let options = RunOptions { threads: NonZeroUsize::new(threads).unwrap(), ..RunOptions::default() };
    let values = plan.point(0).values;
    WrenchMap::of(plan, &values, inputs(plan, share), 400, &options, |_| false).unwrap().unwrap()
}

/// The map of the whole ranges.
static MAP: LazyLock<WrenchMap> = LazyLock::new(|| map(&plan(VEHICLE), 1.0, 2));

/// A map agrees with the vehicle's force and torque at points that were not used for the fit.
#[test]
fn a_map_agrees_with_other_rows() {
    let plan = plan(VEHICLE);
    let vehicle_run =
        VehicleRun { vehicle: plan.vehicle().unwrap(), solver: plan.solver(), interrupted: &never };
    let map = &*MAP;
    assert_eq!((map.fitted, map.left_out, map.unused.len()), (320, 80, 0));
    assert!(map.r_squared.iter().all(|r_squared| *r_squared > 0.998), "{:?}", map.r_squared);
    assert!(map.warnings().is_empty(), "{:?}", map.warnings());
    let mut largest = [0.0_f64; 6];
    for index in 0..40 {
        // Multiples of irrational shares, which are no Sobol' points.
        let share = |by: f64| (f64::from(index) * by + 0.5).fract();
        let at: Vec<f64> = (map.inputs.iter())
            .zip([0.618_034, 0.414_214, 0.732_051, 0.236_068])
            .map(|(input, by)| input.from + (input.to - input.from) * share(by))
            .collect();
        let mut values = plan.point(0).values;
        for (input, value) in map.inputs.iter().zip(&at) {
            values[input.parameter] = *value;
        }
        let row = vehicle_run.row(&values, None);
        assert_eq!(row.status, Status::Periodic);
        for (place, (found, exact)) in map.evaluate(&at).iter().zip(vehicle_run.wrench(&row)).enumerate() {
            largest[place] = largest[place].max((found - exact).abs());
        }
    }
    for (place, (found, reported)) in largest.iter().zip(map.largest_error).enumerate() {
        assert!(*found < 1.5 * reported && *found > 0.2 * reported, "{place}: {found}, reported {reported}");
    }
}

/// The linear coefficients differ from exact derivatives by cubic terms, which vanish with the square of the range.
#[test]
fn linear_coefficients_are_derivatives() {
    let plan = plan(VEHICLE);
    let vehicle = plan.vehicle().unwrap();
    let vehicle_run = VehicleRun { vehicle, solver: plan.solver(), interrupted: &never };
    let names = ["amplitude", "bias", "amplitude_difference", "second_harmonic"];
    let chosen: Vec<Input> = names.iter().map(|name| Input::of(vehicle, name).unwrap()).collect();
    let exact = vehicle_run.effectiveness(&plan.point(0).values, &chosen, None).unwrap();
    let errors = |map: &WrenchMap| {
        let physical = map.physical();
        let slopes = |component: usize, input: usize| {
            // The derivative at the centre, of which only the amplitude is not zero.
            let own = physical[(component, 1 + input)];
            let mixed = physical[(component, 5 + input)] * 200.0;
            own + if input == 0 { 2.0 * mixed } else { mixed }
        };
        // Up by amplitude, pitch by bias, roll by difference, forward by second harmonic.
        [(2, 0), (4, 1), (3, 2), (0, 3)].map(|(component, input)| {
            let wanted = exact.matrix[(component, input)];
            (slopes(component, input) / wanted - 1.0).abs()
        })
    };
    let (wide, narrow) = (errors(&MAP), errors(&map(&plan, 0.25, 2)));
    for place in 0..4 {
        assert!(wide[place] < 0.05 && narrow[place] < 0.004, "{place}: {wide:?}, {narrow:?}");
        assert!(narrow[place] < 0.3 * wide[place] || narrow[place] < 1e-4, "{place}: {wide:?}, {narrow:?}");
    }
}

/// The number of threads does not change a bit.
#[test]
fn maps_have_the_same_bits_on_one_and_two_threads() {
    let one = map(&plan(VEHICLE), 1.0, 1);
    assert_eq!(bits(one.scaled.as_slice()), bits(MAP.scaled.as_slice()));
    assert_eq!(bits(&one.largest_error), bits(&MAP.largest_error));
}

/// Rows of designs that cannot exist are counted and named, and a map of too few rows is an error.
#[test]
fn rows_without_a_periodic_motion_are_counted() {
    let plan = plan(VEHICLE);
    let vehicle = plan.vehicle().unwrap();
    let input =
        |name: &str, from: f64, to: f64| MapInput::new(&Input::of(vehicle, name).unwrap(), from, to).unwrap();
    let values = plan.point(0).values;
    let of =
        |inputs: Vec<MapInput>| WrenchMap::of(&plan, &values, inputs, 200, &RunOptions::default(), |_| false);
    // A difference of more than twice the voltage needs a negative voltage on one side.
    let map = of(vec![input("amplitude_difference", -420.0, 420.0)]).unwrap().unwrap();
    let invalid = map.unused.clone();
    assert!(matches!(invalid[..], [(Status::Invalid, 5..=15)]), "{invalid:?}");
    assert_eq!(map.fitted + map.left_out + invalid[0].1, 200);
    assert!(map.warnings()[0].ends_with(&format!("{} invalid", invalid[0].1)), "{:?}", map.warnings());
    let error = of(vec![input("amplitude_difference", 420.0, 440.0)]).unwrap_err();
    assert!(matches!(error, WrenchMapError::Mistake(_)));
    let start = "none of the 200 rows are periodic, too few for 3 coefficients per component: 200 invalid (";
    assert!(error.to_string().starts_with(start), "{error}");
}

/// A stopped run gives no map.
#[test]
fn a_stopped_run_gives_no_map() {
    let plan = plan(VEHICLE);
    let values = plan.point(0).values;
    let found = WrenchMap::of(&plan, &values, inputs(&plan, 1.0), 400, &RunOptions::default(), |_| true);
    assert!(found.unwrap().is_none());
}

/// The map of a plan that searches for hover is the map of the inputs, not of the trimmed vehicle.
#[test]
fn a_map_of_a_vehicle_at_hover_follows_the_inputs() {
    let at_hover = VEHICLE.replace("about =", "total_mass = \"69 mg\"\ntrim = \"hover\"\nabout =");
    assert_eq!(map(&plan(&at_hover), 0.5, 2), map(&plan(VEHICLE), 0.5, 2));
}

/// A map that ignores formulas says so.
#[test]
fn a_map_with_constant_derived_parameters_warns() {
    let plan = plan(&format!("{VEHICLE}[derived]\nair_density = \"1.2 + 0 * drive_voltage_pp\"\n"));
    let inputs = vec![inputs(&plan, 0.2).remove(0)];
    let options = RunOptions::with_threads(NonZeroUsize::new(1));
    let map = WrenchMap::of(&plan, &plan.point(0).values, inputs, 12, &options, |_| false).unwrap().unwrap();
    assert!(map.warnings()[0].starts_with("derived parameters ([derived]) are held constant"));
}
