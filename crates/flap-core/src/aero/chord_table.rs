//! Table of the chord of a wing at eleven positions along the span.
//!
//! Use the table if no polynomial describes the chord of your wing.

use super::wing::Outline;
use crate::parameter::Invalid;
use crate::parameter::Kind::{Choice, Number};
use crate::parameter::Range::NonNegative;

/// Number of chords in the table: one chord at each tenth of the wing's length, from 0 to 100 %.
pub const STATIONS: usize = 11;

crate::choice! {
    /// Choice between the model's own chord shape and the chord table.
    pub enum Tabulated {
        /// The model computes the chord from its own chord shape.
        Off = "off",
        /// The model interpolates the chord in the table.
        On = "on",
    }
}

crate::parameters! {
    /// Chords of the wing at eleven positions along the span. Between two positions, flap interpolates the
    /// chord linearly.
    pub struct ChordTable {
        /// Selects the chord of the wing: "off" uses the chord shape of the model, and "on" uses the
        /// parameters chord_0 to chord_10.
        chord_table: Tabulated = ("", "", Choice(Tabulated::NAMES), default: 0.0),
        /// Chord at the root of the wing (0 % of its length), used if chord_table is "on".
        chord_0: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 10 % of the wing's length from the root, used if chord_table is "on".
        chord_1: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 20 % of the wing's length from the root, used if chord_table is "on".
        chord_2: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 30 % of the wing's length from the root, used if chord_table is "on".
        chord_3: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 40 % of the wing's length from the root, used if chord_table is "on".
        chord_4: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 50 % of the wing's length from the root, used if chord_table is "on".
        chord_5: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 60 % of the wing's length from the root, used if chord_table is "on".
        chord_6: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 70 % of the wing's length from the root, used if chord_table is "on".
        chord_7: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 80 % of the wing's length from the root, used if chord_table is "on".
        chord_8: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 90 % of the wing's length from the root, used if chord_table is "on".
        chord_9: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at the tip of the wing (100 % of its length), used if chord_table is "on".
        chord_10: f64 = ("m", "", Number(NonNegative), default: 0.0),
    }
}

impl ChordTable {
    /// Returns a table of the given chords (m) at 0, 10, ..., 100 % of the wing's length from the root.
    pub fn new(chord_table: Tabulated, chords: [f64; STATIONS]) -> ChordTable {
        let mut values = vec![f64::from(chord_table as u8)];
        values.extend(chords);
        ChordTable::from_values(&values)
    }

    /// Returns a chord table that is switched off, so that the model uses its own chord shape.
    pub(crate) fn off() -> ChordTable {
        ChordTable::new(Tabulated::Off, [0.0; STATIONS])
    }

    /// Returns the chords (m) at 0, 10, ..., 100 % of the wing's length from the root.
    fn chords(&self) -> Vec<f64> {
        self.to_values().split_off(1)
    }

    /// Returns true if the model computes the chord of the wing from the table.
    pub(crate) fn is_on(&self) -> bool {
        self.chord_table == Tabulated::On
    }

    /// Returns the chord (m) at the position `x`, which is 0 at the wing's root and 1 at the tip. The result
    /// is `None` if the table is switched off.
    pub(crate) fn chord(&self, x: f64) -> Option<f64> {
        if !self.is_on() {
            return None;
        }
        let chords = self.chords();
        let place = (x * (STATIONS - 1) as f64).clamp(0.0, (STATIONS - 1) as f64);
        let before = (0..STATIONS - 1).rev().find(|&station| station as f64 <= place).unwrap_or(0);
        let share = place - before as f64;
        Some(chords[before] + share * (chords[before + 1] - chords[before]))
    }

    /// Returns the mean chord (m) of the table.
    pub fn mean(&self) -> f64 {
        let chords = self.chords();
        let ends = 0.5 * (chords[0] + chords[STATIONS - 1]);
        (ends + chords[1..STATIONS - 1].iter().sum::<f64>()) / (STATIONS - 1) as f64
    }

    /// Checks that at least one chord of the table is more than zero, if the table is switched on.
    ///
    /// # Errors
    /// An error if the table is switched on and all its chords are zero.
    pub(crate) fn check(&self) -> Result<(), Invalid> {
        if self.is_on() && self.mean() <= 0.0 {
            return Err(Invalid::new(
                "chord_table is \"on\", but chord_0 to chord_10 are all zero: set them, for example with `flap device wing OUTLINE.csv`",
            ));
        }
        Ok(())
    }
}

/// Returns names and values of the parameters `chord_table` ("on") and `chord_0` to `chord_10` for a wing
/// with the given outline.
pub(crate) fn chord_table(outline: &Outline) -> Vec<(&'static str, f64)> {
    let mut parameters = vec![("chord_table", f64::from(Tabulated::On as u8))];
    for (station, parameter) in ChordTable::TABLE[1..].iter().enumerate() {
        let share = station as f64 / (STATIONS - 1) as f64;
        parameters.push((parameter.name, outline.chord(share * outline.length())));
    }
    parameters
}
