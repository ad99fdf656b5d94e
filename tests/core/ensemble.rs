//! Lanes against scalars: the rows have the same bits, for any points in the other lanes.

use std::sync::LazyLock;

use flap_core::drive::{Shape, WaveformParameters};
use flap_core::model::direct_drive::{FlowDirection, Params};
use flap_core::num::Backend;
use flap_core::simulate::{Row, Simulator, SolverSettings, Status, by_name};
use proptest::prelude::*;

use crate::rows::{self, QUICK, bits};

fn model() -> &'static dyn Simulator {
    by_name("direct-drive").unwrap()
}

/// Points that settle fast, slowly or never, points whose motion diverges, and impossible points, in a fixed irregular
/// order.
fn mixed_points() -> Vec<Vec<f64>> {
    let mut points = Vec::new();
    for i in 0..150 {
        let i = f64::from(i);
        let small = Params { drive_frequency: 185.0 + (7.3 * i) % 35.0, ..Params::ozaki2018_small() };
        let large = Params {
            drive_voltage_pp: 40.0 + (11.7 * i) % 60.0,
            drive_frequency: 95.0 + (3.1 * i) % 25.0,
            ..Params::ozaki2018_large()
        };
        points.push(match points.len() % 10 {
            3 => Params { wing_inertia_product: 1e-8, ..large },
            6 => Params { flow_direction: FlowDirection::Blade, ..large },
            5 => Params { drive_voltage_pp: 1e160, ..large },
            7 => Params { pressure_offset: -3.0, rotation_drag: 0.0, ..large },
            8 => Params { air_density: 1e-4, ..large },
            9 => Params { waveform: WaveformParameters::new(Shape::Square), ..large },
            0 | 2 | 4 => small,
            _ => large,
        });
    }
    points.iter().map(Params::to_values).collect()
}

/// The rows of the mixed points.
static ROWS: LazyLock<Vec<Row>> =
    LazyLock::new(|| rows::of(model(), &mixed_points(), Backend::best(), &QUICK));

#[test]
fn rows_equal_the_scalar_path_bit_for_bit() {
    rows::assert_lanes_equal_scalars(model(), &mixed_points(), &QUICK);
}

#[test]
fn the_mixture_contains_every_kind_of_failure() {
    let rows = &*ROWS;
    for status in [Status::Periodic, Status::Unsettled, Status::Diverged, Status::Invalid] {
        assert!(rows.iter().any(|row| row.status == status), "no row is {}", status.name());
    }
    for row in rows {
        let measured = row.status == Status::Periodic;
        assert_eq!(row.measures.len(), if measured { model().columns().len() } else { 0 });
        assert!(
            row.measures
                .iter()
                .zip(model().columns())
                .all(|(m, c)| m.is_finite() || c.name == "hinge_strain_max"),
            "{row:?}"
        );
        assert_eq!(row.reason.is_some(), row.status == Status::Invalid);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    /// Other points, their order and their number do not change a row.
    #[test]
    fn a_row_depends_on_its_point_alone(chosen in prop::collection::vec(0..150_usize, 1..70)) {
        let points = mixed_points();
        let few: Vec<_> = chosen.iter().map(|&i| points[i].clone()).collect();
        let some = rows::of(model(), &few, Backend::best(), &QUICK);
        for (row, &i) in some.iter().zip(&chosen) {
            prop_assert_eq!(bits(row), bits(&ROWS[i]));
        }
    }
}

#[test]
fn no_points_give_no_rows() {
    assert!(rows::of(model(), &[], Backend::best(), &QUICK).is_empty());
}

#[test]
fn step_limit_is_a_status() {
    let solver = SolverSettings { max_steps: 5, ..QUICK };
    let rows = rows::of(model(), &vec![Params::ozaki2018_large().to_values(); 3], Backend::best(), &solver);
    assert!(rows.iter().all(|row| row.status == Status::StepLimit && row.period == 0));
    assert!(rows[0].residual.is_nan() && rows[0].cycles == 0);
}
