//! Test for a periodic motion, from the state at the end of each drive period.
//!
//! The test does not depend on the model or the waveform.

/// Length of the longest orbit that the test detects, in drive periods.
const LONGEST_PERIOD: u32 = 8;

const LONGEST: usize = LONGEST_PERIOD as usize;

/// Smallest distance between two consecutive states of a subharmonic orbit at the ends of drive periods, in
/// units of the states' typical sizes.
///
/// A motion that slowly approaches an orbit of one period also returns close to its own earlier states. The
/// smallest distance ensures that flap does not report a subharmonic orbit for a motion that approaches an
/// orbit of one period.
const SEPARATE: f64 = 1e-2;

/// The states at the ends of the most recent drive periods.
#[derive(Clone, Copy, Debug)]
pub struct Strobe<const N: usize> {
    scale: [f64; N],
    tolerance: f64,
    /// States at the ends of drive periods, in the order from the latest to the earliest state.
    states: [[f64; N]; LONGEST + 1],
    /// Entry p − 1 is the number of consecutive period ends at which the state was equal to the state p
    /// periods earlier.
    repeats: [u32; LONGEST],
    cycles: u32,
}

impl<const N: usize> Strobe<N> {
    /// Returns a strobe (a record of states at the ends of periods) that contains only the initial state.
    ///
    /// The unit of the change of a state component is its typical size in `scale`. In a motion smaller than
    /// `scale`, changes are relative to the size of the motion. If changes were not relative to the size of
    /// the motion, a motion with a very small amplitude would always count as settled. A change of the state
    /// of up to `tolerance` counts as zero.
    pub fn new(initial: &[f64; N], scale: &[f64; N], tolerance: f64) -> Strobe<N> {
        Strobe { scale: *scale, tolerance, states: [*initial; LONGEST + 1], repeats: [0; LONGEST], cycles: 0 }
    }

    /// Adds the state at the end of a period to the strobe. Returns the length of the orbit in periods, if
    /// the motion has settled.
    ///
    /// A motion has settled to an orbit of p periods if p + 1 consecutive states at period ends equal the
    /// states p periods earlier. For p > 1, the distance between consecutive states at period ends must also
    /// exceed a minimum.
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

    /// Returns the largest change of a state component over the last `periods` periods, in the units that
    /// [`Strobe::new`] describes.
    ///
    /// The result is NaN if fewer than `periods` periods have passed.
    pub fn change(&self, periods: u32) -> f64 {
        if self.cycles < periods {
            return f64::NAN;
        }
        residual(&self.states[periods as usize], &self.states[0], &self.scale)
    }

    /// Returns the latest state.
    pub fn state(&self) -> &[f64; N] {
        &self.states[0]
    }

    /// Returns the state one period before the latest state.
    pub(crate) fn before(&self) -> &[f64; N] {
        &self.states[1]
    }

    /// Returns the number of period ends at which a state was added to the strobe.
    pub fn cycles(&self) -> u32 {
        self.cycles
    }
}

/// Returns the distance of two states: the largest component of their difference, in units of the states' typical
/// sizes.
pub(crate) fn distance<const N: usize>(one: &[f64; N], other: &[f64; N], scale: &[f64; N]) -> f64 {
    (0..N).fold(0.0, |largest, i| largest.max((one[i] - other[i]).abs() / scale[i]))
}

/// Returns the change of the state over a period that begins at the state `y` and ends at the state `end`.
/// The change is the largest component of the difference, in units of the states' typical sizes.
///
/// If a motion is smaller than the typical sizes of the states, the change is relative to the size of the
/// motion.
pub(crate) fn residual<const N: usize>(y: &[f64; N], end: &[f64; N], scale: &[f64; N]) -> f64 {
    let change = distance(y, end, scale);
    let size = (0..N).fold(0.0_f64, |size, i| size.max(end[i].abs().max(y[i].abs()) / scale[i]));
    if change == 0.0 { 0.0 } else { change / size.min(1.0) }
}
