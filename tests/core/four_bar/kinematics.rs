//! Four-bar and slider-crank against reference vectors and central differences.

use flap_core::model::four_bar::{Constants, Params, transmission};

use super::{assert_close_to, params};
use crate::data::table;

/// Lengths of ground, input, coupler and output link (m).
const LINKS: [f64; 4] = [13.5e-3, 12.1e-3, 10e-3, 5e-3];

#[test]
fn equal_the_reference() {
    let mut largest = 0.0_f64;
    for record in table("four-bar/kinematics_vectors.csv") {
        let c = Constants::derive(&params(record.text("system"))).unwrap();
        let theta = record.number("theta");
        let motion = c.four_bar.motion(theta);
        let links = transmission(&c, theta);
        let [a, b] = [motion.a[0], motion.b[0]];
        // Sizes: what each quantity is at zero stroke, or the largest in the table where that is zero.
        for (column, actual, size) in [
            ("theta1_minus_neutral", motion.turned[0].atan2(motion.turned[1]), 0.4),
            ("theta1_p", motion.input[0], 0.4),
            ("theta1_pp", motion.input[1], 0.4),
            ("theta2", (b[1] - a[1]).atan2(b[0] - a[0]), 0.5),
            ("theta2_p", motion.coupler[0], 0.3),
            ("theta2_pp", motion.coupler[1], 0.3),
            ("delta", links.displacement, 1e-3),
            ("delta_p", links.slope, 1e-3),
            ("delta_pp", links.bend, 1e-3),
            ("G", links.inertia, 5e-10),
            ("half_dG", links.half_inertia_slope, 2e-10),
        ] {
            let expected = record.number(column);
            largest = largest.max((actual - expected).abs() / size);
            assert_close_to(actual, expected, size, 1e-12, &format!("{column} of {}", record.name));
        }
    }
    println!("largest error {largest:.1e}");
}

/// Functions of the stroke: name, derivative as flap computes it, derivative from differences, and size.
fn quantities(c: &Constants<f64>, theta: f64) -> [(&'static str, f64, f64, f64); 15] {
    let motion = c.four_bar.motion(theta);
    let links = transmission(c, theta);
    let [sin, cos] = motion.turned;
    let [[ax, ay], a_p, a_pp] = motion.a;
    let [[bx, by], b_p, b_pp] = motion.b;
    [
        ("A x", ax, a_p[0], 1e-2),
        ("A y", ay, a_p[1], 1e-2),
        ("A′ x", a_p[0], a_pp[0], 1e-2),
        ("A′ y", a_p[1], a_pp[1], 1e-2),
        ("B x", bx, b_p[0], 1e-2),
        ("B y", by, b_p[1], 1e-2),
        ("B′ x", b_p[0], b_pp[0], 1e-2),
        ("B′ y", b_p[1], b_pp[1], 1e-2),
        ("θ₁", sin.atan2(cos), motion.input[0], 1.0),
        ("θ₁′", motion.input[0], motion.input[1], 1.0),
        ("θ₂", (by - ay).atan2(bx - ax), motion.coupler[0], 1.0),
        ("θ₂′", motion.coupler[0], motion.coupler[1], 1.0),
        ("δ", links.displacement, links.slope, 1e-3),
        ("δ′", links.slope, links.bend, 1e-3),
        ("½G", 0.5 * links.inertia, links.half_inertia_slope, 1e-10),
    ]
}

/// ( )′ and ( )″ are derivatives with respect to the stroke: central differences, extrapolated.
#[test]
fn derivatives_are_those_of_the_positions() {
    let c = Constants::derive(&params("sys75")).unwrap();
    for theta in [-1.9, -1.2, -0.6, -0.1, 0.0, 0.3, 0.8, 1.2] {
        let h = 1e-3;
        let [far_below, below, above, far_above] =
            [-2.0, -1.0, 1.0, 2.0].map(|k| quantities(&c, theta + k * h));
        for (i, (what, _, derivative, size)) in quantities(&c, theta).into_iter().enumerate() {
            let near = (above[i].1 - below[i].1) / (2.0 * h);
            let far = (far_above[i].1 - far_below[i].1) / (4.0 * h);
            let expected = (4.0 * near - far) / 3.0;
            assert_close_to(derivative, expected, size, 1e-8, &format!("derivative of {what} at {theta}"));
        }
    }
}

#[test]
fn links_keep_their_lengths_all_the_way_round() {
    let c = Constants::derive(&params("sys75")).unwrap();
    for degrees in 0..360 {
        let motion = c.four_bar.motion(f64::from(degrees).to_radians());
        let [a, b] = [motion.a[0], motion.b[0]];
        let length = |x: f64, y: f64| x.hypot(y);
        let [ground, input, coupler, output] = LINKS;
        assert_close_to(length(a[0], a[1]), input, input, 1e-14, "input");
        assert_close_to(length(b[0] - a[0], b[1] - a[1]), coupler, coupler, 1e-14, "coupler");
        assert_close_to(length(b[0] - ground, b[1]), output, output, 1e-14, "output");
    }
}

#[test]
fn the_neutral_angle_is_where_the_transmission_is_stationary() {
    let c = Constants::derive(&params("sys75")).unwrap();
    assert_close_to(c.four_bar.neutral, 0.958_121_668_614_6, 1.0, 5e-14, "printed digits");
    let motion = c.four_bar.motion(0.0);
    assert!(motion.input[1].abs() < 1e-15, "{:e}", motion.input[1]);
    assert_close_to(motion.a[0][1].atan2(motion.a[0][0]), 0.869_592_203_526_5, 1.0, 1e-13, "input angle");
    assert_close_to(1.0 / motion.input[0], 2.395, 1.0, 1e-3, "gear");
    // It is a maximum.
    for theta in [-0.01, 0.01] {
        assert!(c.four_bar.motion(theta).input[0] < motion.input[0]);
    }
    let without = Constants::derive(&Params { coupler_link: 100e-3, ..params("sys75") }).unwrap_err();
    assert!(without.to_string().contains("set neutral_angle"), "{without}");
}

/// The dead points of the four-bar, where the input link turns back and the drive has no torque.
#[test]
fn dead_points_are_where_they_should_be() {
    let c = Constants::derive(&params("sys75")).unwrap();
    for degrees in [75.198_f64, -118.110] {
        let slope = |degrees: f64| c.four_bar.motion(degrees.to_radians()).input[0];
        assert!(slope(degrees - 1e-3) * slope(degrees + 1e-3) < 0.0, "{degrees}");
    }
}
