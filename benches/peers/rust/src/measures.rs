//! Measures of a motion from equally spaced samples, as users of the libraries take them.

use crate::model::{LIFT, PRESSURE, SCALE};

/// max |x| (m), max |ψ| (rad) and mean lift (N) of the measured periods, both ends of which are sampled.
pub fn measures(samples: &[[f64; 4]]) -> [f64; 3] {
    let last = samples.len() - 1;
    let (mut tip, mut psi, mut lift) = (Peak::default(), Peak::default(), 0.0);
    for (index, y) in samples.iter().enumerate() {
        tip.add(y[0]);
        psi.add(y[2]);
        let v = y[1] * SCALE[1];
        let ends = if index == 0 || index == last { 0.5 } else { 1.0 }; // trapezoidal rule
        lift += ends * v * v.abs() * (2.0 * y[2]).sin();
    }
    [tip.highest * SCALE[0], psi.highest, LIFT * PRESSURE * lift / last as f64]
}

/// The largest magnitude of what is sampled, with a parabola through the three samples around it.
#[derive(Default)]
struct Peak {
    highest: f64,
    before: f64,
    last: f64,
    taken: usize,
}

impl Peak {
    fn add(&mut self, value: f64) {
        let next = value.abs();
        let bend = self.before - 2.0 * self.last + next;
        if self.taken >= 2 && self.last >= self.before && self.last >= next && bend < 0.0 {
            let slope = self.before - next;
            self.highest = self.highest.max(self.last - slope * slope / (8.0 * bend));
        }
        self.highest = self.highest.max(next);
        (self.before, self.last) = (self.last, next);
        self.taken += 1;
    }
}
