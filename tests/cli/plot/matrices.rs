//! Pictures of the effects of inputs on the force and torque of a vehicle.

use std::fs;

use super::drawn::drawn;
use super::refused;
use crate::support::Folder;

const MATRIX: &str = "\
input,unit,value,force_forward_mn,force_left_mn,force_up_mn,torque_roll_unm,torque_pitch_unm,torque_yaw_unm
mean,,,0.0,0.0,0.9,0.0,0.0,0.0
amplitude,V,200.0,1e-9,0.0,0.0112345,0.0,-0.0040001,0.0
bias,V,0.0,0.00085,0.0,0.0,0.0,-0.025,0.0
second_harmonic_difference,,0.0,0.0,0.0,0.0,0.0,0.0,5.3676
";

#[test]
fn a_matrix_has_its_numbers_in_cells() {
    let folder = Folder::new();
    fs::write(folder.path("matrix.csv"), MATRIX).unwrap();
    let picture = drawn(&folder, "matrix.csv");
    picture
        .says("matrix in out.svg")
        .has(&["Amplitude, per V", "Bias, per V", "forward", "left", "up", "roll", "pitch", "yaw"])
        .has(&["0.0112", "−0.004", "−0.025", "5.37", "≈0", "0"])
        .has(&["Share of the input&apos;s largest change"])
        // The cells, 64 slices and the zero of the colour bar, background, clip and frame.
        .counts("<rect", 18 + 64 + 1 + 3);
    assert!(!picture.texts().contains(&"mean".to_owned()));
}

#[test]
fn what_is_no_matrix_is_told() {
    let folder = super::folder();
    let ended = refused(&folder, &["sweep.csv", "--kind", "matrix"]);
    ended.says("as `flap vehicle --format csv` writes them");
}

/// In a narrow picture, names and numbers of the cells would overlap.
#[test]
fn a_narrow_matrix_is_refused() {
    let folder = Folder::new();
    fs::write(folder.path("matrix.csv"), MATRIX).unwrap();
    refused(&folder, &["matrix.csv", "--size", "84x60mm"])
        .says("the picture is too narrow for the matrix: it must be ");
    folder.ends(0, "plot matrix.csv --size 178x80mm");
}
