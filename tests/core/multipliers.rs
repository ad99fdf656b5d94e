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
        [
            0.716_829_871_620_778,
            -0.064_338_055_657_375_62,
            0.270_948_657_685_824_2,
            -0.006_971_521_642_095_943,
        ],
        [
            -0.476_970_963_057_046_17,
            -0.075_057_960_022_782_77,
            0.020_534_533_210_832_17,
            0.087_727_676_232_701_93,
        ],
        [
            -0.209_753_830_306_766_36,
            -0.060_969_192_474_670_27,
            0.707_332_917_368_463_6,
            -0.071_524_715_653_877_58,
        ],
        [
            -0.311_822_146_959_306_9,
            -0.401_650_609_846_725_8,
            -0.498_181_529_822_187_55,
            -0.111_903_673_098_434_76,
        ],
    ];
    assert_radius(matrix, 0.775_618_305_047_727_9);
}

#[test]
fn spectral_radius_without_a_value() {
    assert!(spectral_radius(&[[f64::NAN, 0.0], [0.0, 0.5]]).is_nan());
    assert!(spectral_radius(&[[f64::INFINITY, 0.0], [0.0, 0.5]]).is_infinite());
}
