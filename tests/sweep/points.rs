//! A plan computes a point from its index. Its points must equal the points of nested loops over the axes.

use proptest::prelude::*;

use crate::fake::{index, plan};

/// One axis as text, and its expected values.
#[derive(Clone, Debug)]
struct Case {
    text: String,
    values: Vec<f64>,
}

/// A list or a range of any kind, for a parameter that can have any positive number.
fn values() -> impl Strategy<Value = Case> {
    let list = prop::collection::vec(0.1..100.0_f64, 1..5)
        .prop_map(|values| Case { text: format!("{values:?}"), values });
    let ends = (1.0..50.0_f64, 51.0..100.0_f64, any::<bool>());
    let ends = ends.prop_map(|(low, high, up)| if up { (low, high) } else { (high, low) });
    let linear = (ends.clone(), 2..5_u32).prop_map(|((from, to), n)| Case {
        text: format!("{{ from = {from:?}, to = {to:?}, n = {n} }}"),
        values: (0..n).map(|i| from + (to - from) * f64::from(i) / f64::from(n - 1)).collect(),
    });
    let log = (ends.clone(), 2..5_u32).prop_map(|((from, to), n)| Case {
        text: format!("{{ from = {from:?}, to = {to:?}, n = {n}, scale = \"log\" }}"),
        values: (0..n).map(|i| from * (to / from).powf(f64::from(i) / f64::from(n - 1))).collect(),
    });
    let step = (ends, 0.2..2.0_f64).prop_map(|((from, to), fraction)| {
        let step = (to - from) * fraction;
        let values = (0..10).map(|i| from + step * f64::from(i));
        Case {
            text: format!("{{ from = {from:?}, to = {to:?}, step = {step:?} }}"),
            values: values
                .take_while(|value| (value - from).abs() <= (to - from).abs() * (1.0 + 1e-12))
                .collect(),
        }
    });
    prop_oneof![list, linear, log, step]
}

/// An axis of options, with the indices of the options.
fn options() -> impl Strategy<Value = Case> {
    prop::collection::vec(prop_oneof![Just(0.0), Just(1.0)], 1..4).prop_map(|values| Case {
        text: format!(
            "{:?}",
            values.iter().map(|v| if *v == 0.0 { "printed" } else { "axis" }).collect::<Vec<_>>()
        ),
        values,
    })
}

proptest! {
    #[test]
    fn points_are_those_of_nested_loops(
        area in values(),
        first in prop::collection::vec(0.1..100.0_f64, 3),
        second in prop::collection::vec(0.1..100.0_f64, 3),
        arms in options(),
        frequency in values(),
    ) {
        let plan = plan(&format!(
            "preset = \"fly\"\nparams.plate_width = 7\n[axes]\nwing_area = {}\narms = {}\n\
             [[zip]]\nstroke_offset = {first:?}\nhinge_position = {second:?}\n\
             [[zip]]\ndrive_frequency = {}\n",
            area.text, arms.text, frequency.text
        ));
        let names = ["wing_area", "arms", "stroke_offset", "hinge_position", "drive_frequency", "plate_width"];
        let mut number = 0;
        for area in &area.values {
            for arms in &arms.values {
                for (first, second) in first.iter().zip(&second) {
                    for frequency in &frequency.values {
                        let point = plan.point(number);
                        prop_assert_eq!(point.index, number);
                        let expected = [*area, *arms, *first, *second, *frequency, 7.0];
                        for (name, expected) in names.iter().zip(expected) {
                            let value = point.values[index(name)];
                            prop_assert!((value - expected).abs() <= 1e-12, "{} {}", name, value);
                        }
                        number += 1;
                    }
                }
            }
        }
        prop_assert_eq!(plan.len(), number);
    }

    /// A sample acts as an additional axis: the points of the sample are the same with and without other axes. Derived
    /// values are computed at each point.
    #[test]
    fn samples_cross_with_axes_and_derived_values_follow(
        method in prop_oneof![Just("sobol"), Just("latin-hypercube"), Just("random")],
        n in 1..9_u64,
        seed in 0..1000_u32,
        frequency in values(),
        sample_first in any::<bool>(),
    ) {
        let sample = format!(
            "[sample]\nmethod = \"{method}\"\nn = {n}\nseed = {seed}\n[sample.parameters]\n\
             plate_width = {{ from = 1, to = 2 }}\nhinge_position = {{ mean = 0.5, sd = 0.01 }}\n"
        );
        let axes = format!("[axes]\ndrive_frequency = {}\n", frequency.text);
        let alone = plan(&format!("preset = \"fly\"\n{sample}"));
        let parts = if sample_first { [&sample, &axes] } else { [&axes, &sample] };
        let derived = "[derived]\nwing_area = \"plate_width * drive_frequency\"\n";
        let crossed = plan(&format!("preset = \"fly\"\n{}{}{derived}", parts[0], parts[1]));
        let axis = frequency.values.len() as u64;
        prop_assert_eq!((alone.len(), crossed.len()), (n, n * axis));
        for number in 0..crossed.len() {
            let (drawn, along) =
                if sample_first { (number / axis, number % axis) } else { (number % n, number / n) };
            let (point, expected) = (crossed.point(number), alone.point(drawn));
            for name in ["plate_width", "hinge_position"] {
                prop_assert_eq!(point.values[index(name)].to_bits(), expected.values[index(name)].to_bits());
            }
            let hertz = point.values[index("drive_frequency")];
            prop_assert!((hertz - frequency.values[usize::try_from(along).expect("few")]).abs() <= 1e-12);
            let area = point.values[index("plate_width")] * hertz;
            prop_assert_eq!(point.values[index("wing_area")].to_bits(), area.to_bits());
        }
    }
}

/// Sums near zero have no digits left: zero is exactly zero, for conditions such as `hinge_position >= 0`.
#[test]
fn zero_is_zero_on_an_axis() {
    for range in ["step = 0.001", "n = 12"] {
        let text =
            format!("preset = \"fly\"\n[axes]\nhinge_position = {{ from = -0.01, to = 0.001, {range} }}\n");
        let plan = plan(&text);
        let values: Vec<f64> =
            (0..12).map(|point| plan.point(point).values[index("hinge_position")]).collect();
        assert_eq!(values[9..], [-0.001, 0.0, 0.001], "{range}");
    }
}
