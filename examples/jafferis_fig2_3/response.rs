//! Amplitudes of settled motions, which are the curves of Fig. 2.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use flap_core::measure::strobe::Strobe;
use flap_core::ode::solve::solve;
use flap_core::ode::{Ode, Start, Tolerances};

use super::oscillators::{Drive, Forced, Oscillator};

const TOLERANCES: Tolerances = Tolerances { rtol: 1e-6, atol: 1e-8, max_steps: 10_000 };

/// Tolerance for settled motions: the largest change of the state from one period to the next.
const SETTLED: f64 = 1e-4;

/// Largest number of simulated periods. After this number of periods, the simulation ends even if the motion
/// has not settled.
const PATIENCE: u32 = 400;

/// Returns the frequencies at which the curves are computed, as multiples of the undamped resonance.
pub(crate) fn frequencies() -> impl Iterator<Item = f64> {
    (50..=140).map(|percent| f64::from(percent) / 100.0)
}

/// A point of a response curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Response {
    /// Frequency divided by the undamped resonance.
    pub(crate) frequency: f64,
    /// Amplitude of the stroke divided by the amplitude of the force.
    pub(crate) stroke: f64,
    /// Amplitude of the second state, which is the pitch (rad) if the oscillator has a pitch.
    pub(crate) second: f64,
}

/// Returns the response of an oscillator to a force of constant amplitude, at each frequency.
pub(crate) fn response<const N: usize>(
    oscillator: impl Oscillator<N>,
    force: f64,
    damping: f64,
) -> Vec<Response> {
    let ode = Forced(oscillator);
    frequencies()
        .map(|frequency| {
            let amplitudes = settled_amplitudes(&ode, Drive { force, frequency, damping });
            Response { frequency, stroke: amplitudes[0] / force, second: amplitudes[1] }
        })
        .collect()
}

/// Returns the amplitudes of the states after the motion has settled, so that every drive period is the same.
fn settled_amplitudes<O, const N: usize>(ode: &O, constants: Drive<f64>) -> [f64; N]
where
    O: Ode<N, Constants<f64> = Drive<f64>>,
{
    // A run starts from rest and is cut into spans of one drive period.
    let mut start = Start::new(constants, [0.0; N], TAU / constants.frequency, [1.0; N]);
    let mut strobe = Strobe::new(&start.y, &start.scale, SETTLED);
    solve::<O, f64, N>(
        ode,
        &TOLERANCES,
        &start,
        |_, _| {},
        |y| {
            if strobe.period_end(y).is_some() || strobe.cycles() == PATIENCE {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        },
    );

    // One period more, in which every step is looked at closely.
    start.y = *strobe.state();
    let (mut least, mut most) = (start.y, start.y);
    solve::<O, f64, N>(
        ode,
        &TOLERANCES,
        &start,
        |_, accepted| {
            for part in 1..=8 {
                let y = accepted.step.interpolate(accepted.h, 0.125 * f64::from(part));
                for i in 0..N {
                    least[i] = least[i].min(y[i]);
                    most[i] = most[i].max(y[i]);
                }
            }
        },
        |_| ControlFlow::Break(()),
    );
    std::array::from_fn(|i| 0.5 * (most[i] - least[i]))
}

/// Returns the points of a curve at which the stroke is larger than at the two neighbouring points.
pub(crate) fn peaks(curve: &[Response]) -> Vec<Response> {
    curve
        .windows(3)
        .filter(|three| three[1].stroke > three[0].stroke && three[1].stroke > three[2].stroke)
        .map(|three| three[1])
        .collect()
}
