//! The bimorph model against independent references, its own conservation laws, and the paper's text.

mod actuator;
mod equations;
mod lanes;
mod orbit;
mod paper;
mod physics;
mod steady;
mod transient;
mod variants;

use flap_core::drive::Wave;
use flap_core::model::bimorph::{Constants, Params, Plate, plates};
use flap_core::num::{Backend, Real};
use flap_core::simulate::{PointRun, Row, Simulator, SolverSettings, Status, by_name};

use crate::by_name::named;
use crate::data::Record;

fn model() -> &'static dyn Simulator {
    by_name("bimorph").unwrap()
}

/// The parameters of a set in the reference tables.
pub(crate) fn params(set: &str) -> Params {
    let scaled = |factor| Params::jafferis2016().with_transmission_scaled(factor);
    let sets = [Params::jafferis2016(), scaled(0.8), scaled(0.6), Params::jafferis2016_improved()];
    named(set, &["T1", "T2", "T3", "RD"], &sets)
}

/// The plates with given voltages. Each voltage is the wave of a drive without a constant part.
pub(crate) fn plates_under<R: Real>(c: &Constants<R>, [first, second]: [Wave<R>; 2]) -> [Plate<R>; 2] {
    let (zero, one) = (c.b.lit(0.0), c.b.lit(1.0));
    let mut c = *c;
    (c.drive.bias, c.drive.amplitude, c.half_offset) = (zero, one, zero);
    c.transition = [(c.a_3 * c.field_0).exp(); 2];
    c.transition_swing = c.a_3 * c.field_per_volt;
    let opposite = Wave { value: -first.value, rate: -first.rate, bend: -first.bend };
    [plates(&c, &opposite)[0], plates(&c, &second)[1]]
}

/// `p` driven at the voltage and frequency of a reference row.
pub(crate) fn driven(p: &Params, record: &Record) -> Params {
    Params { drive_voltage_pp: record.number("Vpp_V"), drive_frequency: record.number("f_Hz"), ..p.clone() }
}

/// The settled row of a point.
///
/// The equations have kinks at which a wing's velocities change sign. At these kinks, the integration error changes the
/// step sizes irregularly. The state at the ends of cycles therefore jitters. The function returns the row with the
/// smallest tolerance that the point meets despite the jitter.
fn settled(params: &Params, rtol: f64) -> Row {
    settled_with(params, &SolverSettings::default().with_rtol(rtol))
}

/// [`settled`] with other settings.
fn settled_with(params: &Params, solver: &SolverSettings) -> Row {
    let mut last = None;
    for settle_tol in [1.0, 10.0, 100.0, 1000.0].map(|factor| factor * solver.rtol) {
        let solver = SolverSettings { settle_tol, ..*solver };
        let row = model().run_point(&PointRun::new(Backend::best(), &solver, &params.to_values()), None);
        if row.status == Status::Periodic {
            return row;
        }
        println!(
            "{} V, {} Hz, {} rad/m: not settled to {settle_tol:.0e}, but to {:.1e}",
            params.drive_voltage_pp, params.drive_frequency, params.transmission_ratio, row.residual
        );
        last = Some(row);
    }
    panic!("{:?}", last.unwrap())
}

fn measure(row: &Row, column: &str) -> f64 {
    let index = model().columns().iter().position(|c| c.name == column);
    row.measures[index.unwrap_or_else(|| panic!("no column {column}"))]
}
