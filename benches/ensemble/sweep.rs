//! The sweep: voltage and frequency of the large actuator of Ozaki and Hamaguchi.

use flap_core::num::Backend;
use flap_core::simulate::{Point, PointRun, Simulator, SolverSettings, never, preset, run_list};

const VOLTAGES: usize = 16;
const FREQUENCIES: usize = 32;
/// Number of points.
pub(crate) const POINTS: usize = VOLTAGES * FREQUENCIES;

/// The points and what runs them.
pub(crate) struct Sweep {
    simulator: &'static dyn Simulator,
    points: Vec<Vec<f64>>,
}

impl Sweep {
    /// From 40 V to 100 V and from 95 Hz to 115 Hz.
    pub(crate) fn new() -> Sweep {
        let (simulator, preset) = preset("ozaki2018-large").expect("a preset of the direct-drive model");
        let position = |name| {
            simulator.parameters().iter().position(|parameter| parameter.name == name).expect("a parameter")
        };
        let (voltage, frequency) = (position("drive_voltage_pp"), position("drive_frequency"));
        let mut points = Vec::with_capacity(POINTS);
        for i in 0..VOLTAGES {
            for j in 0..FREQUENCIES {
                let mut values = (preset.values)();
                values[voltage] = 40.0 + 60.0 * i as f64 / (VOLTAGES - 1) as f64;
                values[frequency] = 95.0 + 20.0 * j as f64 / (FREQUENCIES - 1) as f64;
                points.push(values);
            }
        }
        Sweep { simulator, points }
    }

    /// Runs it in lanes. Returns the right-hand sides evaluated.
    pub(crate) fn lanes(&self, backend: Backend) -> u64 {
        let points = self.points.iter().map(|values| Point::at_rest(0, values.clone())).collect();
        let rows = run_list(self.simulator, backend, &SolverSettings::default(), points, &never);
        rows.expect("every point has a row").iter().map(|row| row.rhs_evals).sum()
    }

    /// Runs it point by point on scalars of the backend's arithmetic class. Returns the right-hand sides evaluated.
    pub(crate) fn scalars(&self, backend: Backend) -> u64 {
        let settings = SolverSettings::default();
        self.points
            .iter()
            .map(|point| self.simulator.run_point(&PointRun::new(backend, &settings, point), None).rhs_evals)
            .sum()
    }
}

/// One backend per arithmetic class of this machine.
pub(crate) fn scalar_backends() -> Vec<Backend> {
    let mut backends = Backend::available();
    backends.dedup_by_key(|backend| backend.arithmetic());
    backends
}
