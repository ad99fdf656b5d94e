//! Stroke and pitch of a wing from points in images, Ozaki and Hamaguchi 2018, (42), (43).

use flap_experiments::tracking::{LeadingEdge, pitch_from_projection, rotation_centre, strokes};

/// A wing that rotates about `centre`, with its root 5 mm and its tip 22 mm away from `centre`.
fn edge(centre: [f64; 2], stroke: f64) -> LeadingEdge {
    let at = |radius: f64| [centre[0] + radius * stroke.cos(), centre[1] + radius * stroke.sin()];
    LeadingEdge { root: at(5.0), tip: at(22.0) }
}

#[test]
fn a_wing_that_turns_about_a_point_has_its_centre_there() {
    let centre = [1.3, -0.4];
    let edges: Vec<_> = (0..40).map(|i| edge(centre, 0.2 * f64::from(i).sin())).collect();
    let found = rotation_centre(&edges).unwrap();
    assert!((found[0] - centre[0]).abs() < 1e-12 && (found[1] - centre[1]).abs() < 1e-13, "{found:?}");
    for (i, stroke) in strokes(&edges).into_iter().enumerate() {
        assert!((stroke - 0.2 * (i as f64).sin()).abs() < 1e-14);
    }
}

/// A wing that flaps about the negative x-axis passes ±180° without a jump.
#[test]
fn strokes_do_not_jump_by_a_turn() {
    let angles: Vec<f64> = (0..60).map(|i| 3.0 + 0.7 * (0.4 * f64::from(i)).sin()).collect();
    let edges: Vec<_> = angles.iter().map(|&angle| edge([0.0, 0.0], angle)).collect();
    for (stroke, angle) in strokes(&edges).into_iter().zip(angles) {
        assert!((stroke - angle).abs() < 1e-14, "{stroke}, not {angle}");
    }
}

/// The centre minimises the sum of squares: any other point is farther from the lines.
#[test]
fn the_centre_is_nearest_to_all_lines() {
    let edges: Vec<_> =
        (0..9).map(|i| edge([0.1 * f64::from(i % 3), 0.05 * f64::from(i)], 0.1 * f64::from(i))).collect();
    let sum = |p: [f64; 2]| edges.iter().map(|edge| edge.distance(p).powi(2)).sum::<f64>();
    let centre = rotation_centre(&edges).unwrap();
    for (dx, dy) in [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (0.0, -1e-3)] {
        assert!(sum([centre[0] + dx, centre[1] + dy]) > sum(centre));
    }
}

#[test]
fn pitch_is_the_arc_sine_of_the_projected_chord() {
    let edge = edge([0.0, 0.0], 0.3);
    for pitch in [-1.2, -0.4, 0.0, 0.7, 1.5_f64] {
        let d = 6.5 * pitch.sin();
        // A point of the lower edge, which lags if d > 0 and the stroke rises.
        let point = [15.0 * 0.3_f64.cos() + d * 0.3_f64.sin(), 15.0 * 0.3_f64.sin() - d * 0.3_f64.cos()];
        assert!((edge.distance(point) - d).abs() < 1e-13);
        assert!((pitch_from_projection(edge.distance(point), 6.5).unwrap() - pitch).abs() < 1e-13);
    }
}

#[test]
fn impossible_images_are_refused() {
    assert!(pitch_from_projection(6.6, 6.5).unwrap_err().to_string().contains("more than the chord"));
    assert!(pitch_from_projection(1.0, 0.0).is_err());
    for count in [0, 1] {
        let refused = rotation_centre(&vec![edge([0.0; 2], 0.1); count]).unwrap_err().to_string();
        assert!(refused.ends_with(&format!("the number of images is {count}")), "{refused}");
    }
    let parallel = rotation_centre(&[edge([0.0; 2], 0.1); 2]).unwrap_err().to_string();
    assert!(parallel.contains("parallel"), "{parallel}");
    let nowhere = LeadingEdge { root: [1.0, 2.0], tip: [1.0, 2.0] };
    assert!(rotation_centre(&[edge([0.0; 2], 0.1), nowhere]).unwrap_err().to_string().contains("image 2"));
}
