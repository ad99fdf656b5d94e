//! `flap sweep` over designs with motions that never repeat, or repeat only after several drive periods.

use crate::support::Folder;

/// The bimorph with half the stiffness of its hinge, as in `examples/jafferis_soft_hinge.toml`.
const SOFT_HINGE: &str = r#"
preset = "jafferis2016"

[params]
hinge_stiffness = "0.7486 uN*m/rad"

[[zip]]
drive_voltage_pp = [160, 160, 160, 220, 240, 240, 240, 240, 240]
drive_frequency = [83, 85, 87, 75, 60, 67.5, 70, 72, 90]

[solver]
rtol = 1e-7
settle_tol = 1e-4
max_cycles = 500

[output]
columns = ["stroke_pp_deg", "vehicle_lift_mgf", "cycles", "residual", "period", "floquet_max", "stable", "error_estimate", "rhs_evals"]
"#;

/// The periods equal the periods of an independent integration (the classical fourth-order method with 2000 steps in a
/// drive period). At 160 V the periods agree to rounding, also from other initial states than rest. Unsettled motions
/// do not repeat within four periods.
#[test]
fn motions_that_do_not_repeat_every_drive_period_have_no_numbers() {
    let folder = Folder::with_grid(SOFT_HINGE);
    let ended = folder.ends(0, "sweep --grid grid.toml --out -");
    ended.says("5 periodic, 2 subharmonic, 2 unsettled in ");

    let expected = [
        // Slow is not irregular: at 160 V motions decay by 3 % a cycle only, but they settle.
        (160.0, 83.0, "periodic", "1"),
        (160.0, 85.0, "periodic", "1"),
        (160.0, 87.0, "periodic", "1"),
        (220.0, 75.0, "subharmonic", "2"),
        (240.0, 60.0, "periodic", "1"),
        (240.0, 67.5, "subharmonic", "3"),
        (240.0, 70.0, "unsettled", "0"),
        (240.0, 72.0, "unsettled", "0"),
        (240.0, 90.0, "periodic", "1"),
    ];
    let mut rows = ended.stdout.lines();
    let header = "point,drive_voltage_pp,drive_frequency,status,stroke_pp_deg,vehicle_lift_mgf,cycles,residual,period,floquet_max,stable,error_estimate,rhs_evals";
    assert_eq!(rows.next(), Some(header));
    for (volts, hertz, status, period) in expected {
        let row = rows.next().unwrap();
        let cells: Vec<&str> = row.split(',').collect();
        let number = |i: usize| cells[i].parse::<f64>().unwrap();
        assert_eq!([number(1), number(2)], [volts, hertz], "{row}");
        assert_eq!([cells[3], cells[8]], [status, period], "{row}");
        if status == "periodic" {
            assert!(number(4) > 70.0 && number(5).is_finite(), "{row}");
        } else {
            assert_eq!([cells[4], cells[5]], ["", ""], "{row}");
        }
        // What came of the run is always said.
        assert!(number(6) > 10.0 && number(7) > 0.0 && number(12) > 1000.0, "{row}");
    }
    assert_eq!(rows.next(), None);
    assert!(!ended.stdout.contains("NaN") && !ended.stdout.contains("inf"));
}

#[test]
fn strict_counts_subharmonics_too() {
    let grid = "preset = \"jafferis2016\"\n[params]\nhinge_stiffness = 0.7486e-6\ndrive_voltage_pp = 240\n\
                drive_frequency = 67.5\n[solver]\nsettle_tol = 1e-4\n";
    let folder = Folder::with_grid(grid);
    folder.ends(1, "sweep --grid grid.toml --strict");
    assert!(folder.read("grid.csv").contains("\n0,subharmonic,,"), "{}", folder.read("grid.csv"));
}
