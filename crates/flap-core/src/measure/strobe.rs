//! Decides when a run has become periodic, from its state at the end of each drive period alone.
//!
//! It knows no model and no waveform, so a new model needs no change here.

/// Longest orbit that is looked for, in drive periods.
const LONGEST_PERIOD: u32 = 8;

const LONGEST: usize = LONGEST_PERIOD as usize;

/// Strobed states closer together than this, in units of their typical size, are not the separate points of
/// a subharmonic: a run that spirals slowly into a period-1 orbit passes near itself too.
const SEPARATE: f64 = 1e-2;

/// The state at the ends of the last few drive periods.
#[derive(Clone, Copy, Debug)]
pub struct Strobe<const N: usize> {
    scale: [f64; N],
    tolerance: f64,
    /// The latest state first; then those 1, 2, … periods ago.
    states: [[f64; N]; LONGEST + 1],
    /// Numbers of period ends in a row at which the state equalled that of 1, 2, … periods ago.
    repeats: [u32; LONGEST],
    cycles: u32,
}

impl<const N: usize> Strobe<N> {
    /// A strobe that has seen the initial state only.
    ///
    /// Changes of a component count in units of its `scale`, but in a motion smaller than its scales relative to
    /// the motion's own size: a wing that hardly moves is not for that reason settled. A change up to
    /// `tolerance` counts as none.
    pub fn new(initial: &[f64; N], scale: &[f64; N], tolerance: f64) -> Strobe<N> {
        Strobe { scale: *scale, tolerance, states: [*initial; LONGEST + 1], repeats: [0; LONGEST], cycles: 0 }
    }

    /// Takes the state at the end of a period. Returns the orbit's length in periods once it has settled.
    ///
    /// An orbit of p periods has settled when p + 1 period ends in a row brought the state back to where it
    /// was p periods before: every point of the orbit has then returned. For p > 1 the points must also lie
    /// apart.
    pub fn period_end(&mut self, y: &[f64; N]) -> Option<u32> {
        self.states.rotate_right(1);
        self.states[0] = *y;
        self.cycles += 1;
        let separate = self.change(1) > SEPARATE;
        let mut settled = None;
        for period in (1..=LONGEST_PERIOD).rev() {
            let returned = self.cycles >= period && self.change(period) <= self.tolerance;
            let counts = returned && (period == 1 || separate);
            let repeats = &mut self.repeats[period as usize - 1];
            *repeats = if counts { *repeats + 1 } else { 0 };
            if *repeats > period {
                settled = Some(period);
            }
        }
        settled
    }

    /// Largest change of a component over the last `periods` periods, in the units of [`Strobe::new`].
    /// NaN before that many periods have passed.
    pub fn change(&self, periods: u32) -> f64 {
        if self.cycles < periods {
            return f64::NAN;
        }
        let before = &self.states[periods as usize];
        let mut change = 0.0_f64;
        let mut size = 0.0_f64;
        for i in 0..N {
            change = change.max((self.states[0][i] - before[i]).abs() / self.scale[i]);
            size = size.max(self.states[0][i].abs().max(before[i].abs()) / self.scale[i]);
        }
        if change == 0.0 { 0.0 } else { change / size.min(1.0) }
    }

    /// The latest state.
    pub fn state(&self) -> &[f64; N] {
        &self.states[0]
    }

    /// The state a period before the latest.
    pub(crate) fn before(&self) -> &[f64; N] {
        &self.states[1]
    }

    /// Periods seen.
    pub fn cycles(&self) -> u32 {
        self.cycles
    }
}
