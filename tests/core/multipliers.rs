//! Spectral radii of monodromy matrices.

use flap_core::measure::multipliers::{spectral_radius, spectral_radius_by_powers};

fn assert_radius<const N: usize>(matrix: [[f64; N]; N], radius: f64) {
    for found in [spectral_radius(&matrix), spectral_radius_by_powers(&matrix)] {
        assert!((found - radius).abs() <= 1e-13 * radius, "{found} for {matrix:?}, not {radius}");
    }
}

#[test]
fn spectral_radius_of_known_matrices() {
    assert_radius([[0.5, 100.0], [0.0, -0.25]], 0.5);
    assert_radius([[-0.7, 0.0], [0.0, 0.7]], 0.7);
    // Complex pair 0.3 ± 0.4 i.
    assert_radius([[0.3, -0.4], [0.4, 0.3]], 0.5);
    // A double eigenvalue with one eigenvector.
    assert_radius([[0.9, 1.0], [0.0, 0.9]], 0.9);
    assert_radius([[0.0, 1.0], [0.0, 0.0]], 0.0);
    assert_radius([[0.0; 3]; 3], 0.0);
    assert_radius([[1e-200, 0.0], [0.0, 1e-250]], 1e-200);
    assert_radius([[1e200, 0.0], [0.0, 1e250]], 1e250);
}

#[test]
fn spectral_radius_of_a_matrix_for_which_the_qr_iteration_does_not_end() {
    // Of a wing of the small direct-drive type with three times the hinge stiffness.
    let matrix = [
        [0.716829871620778, -0.06433805565737562, 0.2709486576858242, -0.006971521642095943],
        [-0.47697096305704617, -0.07505796002278277, 0.02053453321083217, 0.08772767623270193],
        [-0.20975383030676636, -0.06096919247467027, 0.7073329173684636, -0.07152471565387758],
        [-0.3118221469593069, -0.4016506098467258, -0.49818152982218755, -0.11190367309843476],
    ];
    assert_radius(matrix, 0.775_618_305_047_727_9);
}

#[test]
fn spectral_radius_without_a_value() {
    assert!(spectral_radius(&[[f64::NAN, 0.0], [0.0, 0.5]]).is_nan());
    assert!(spectral_radius(&[[f64::INFINITY, 0.0], [0.0, 0.5]]).is_infinite());
}
