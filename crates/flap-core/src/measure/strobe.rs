//! Decides when a run has become periodic, from its state at the end of each drive period alone.
//!
//! It knows no model and no waveform, so a new model needs no change here.

/// Longest orbit that is looked for, in drive periods.
pub const LONGEST_PERIOD: usize = 4;

/// Strobed states closer together than this, in units of their typical size, are not the separate points of
/// a subharmonic: a run that spirals slowly into a period-1 orbit passes near itself too.
const SEPARATE: f64 = 1e-2;

/// The state at the ends of the last few drive periods.
#[derive(Clone, Copy, Debug)]
pub struct Strobe<const N: usize> {
    scale: [f64; N],
    tolerance: f64,
    /// The latest state first; then those 1, 2, … periods ago.
    states: [[f64; N]; LONGEST_PERIOD + 1],
    /// For how many period ends in a row the state has been what it was 1, 2, … periods ago.
    repeats: [u32; LONGEST_PERIOD],
    cycles: u32,
}

impl<const N: usize> Strobe<N> {
    /// A strobe that has seen the initial state only.
    ///
    /// Changes of a component count in units of its `scale`; below `tolerance` they count as none.
    pub fn new(initial: &[f64; N], scale: &[f64; N], tolerance: f64) -> Strobe<N> {
        Strobe {
            scale: *scale,
            tolerance,
            states: [*initial; LONGEST_PERIOD + 1],
            repeats: [0; LONGEST_PERIOD],
            cycles: 0,
        }
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
        for p in 1..=LONGEST_PERIOD {
            let returned = self.cycles as usize >= p && self.change(p) < self.tolerance;
            let apart = p == 1 || self.change(1) > SEPARATE;
            self.repeats[p - 1] = if returned && apart { self.repeats[p - 1] + 1 } else { 0 };
        }
        (1..=LONGEST_PERIOD).find(|&p| self.repeats[p - 1] as usize > p).map(|p| p as u32)
    }

    /// Largest change of a component over the last `periods` periods, in units of its scale.
    /// NaN before that many periods have passed.
    pub fn change(&self, periods: usize) -> f64 {
        if (self.cycles as usize) < periods {
            return f64::NAN;
        }
        let mut largest = 0.0_f64;
        for i in 0..N {
            largest = largest.max((self.states[0][i] - self.states[periods][i]).abs() / self.scale[i]);
        }
        largest
    }

    /// The latest state.
    pub fn state(&self) -> &[f64; N] {
        &self.states[0]
    }

    /// Periods seen.
    pub fn cycles(&self) -> u32 {
        self.cycles
    }
}
