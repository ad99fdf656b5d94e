//! The chord of a wing as a table.
//!
//! Use the table if no polynomial describes the chord of your wing.

use super::wing::Outline;
use crate::parameter::Invalid;
use crate::parameter::Kind::{Choice, Number};
use crate::parameter::Range::NonNegative;

/// Stations of the table: at 0, 10, ... 100 % of the wing's length.
pub const STATIONS: usize = 11;

crate::choice! {
    /// Source of the chord of the wing.
    pub enum Tabulated {
        /// The model computes the chord from its own chord shape.
        Off = "off",
        /// The model interpolates the chord in the table.
        On = "on",
    }
}

crate::parameters! {
    /// Chords at stations along the span, interpolated linearly in between.
    pub struct ChordTable {
        /// Source of the chord of the wing: the chord shape of the model ("off"), or the table chord_0 to chord_10
        /// ("on").
        chord_table: Tabulated = ("", "", Choice(Tabulated::NAMES), default: 0.0),
        /// Chord at 0 % of the length of the wing, the root, for chord_table = "on".
        chord_0: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 10 % of the length of the wing, for chord_table = "on".
        chord_1: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 20 % of the length of the wing, for chord_table = "on".
        chord_2: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 30 % of the length of the wing, for chord_table = "on".
        chord_3: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 40 % of the length of the wing, for chord_table = "on".
        chord_4: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 50 % of the length of the wing, for chord_table = "on".
        chord_5: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 60 % of the length of the wing, for chord_table = "on".
        chord_6: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 70 % of the length of the wing, for chord_table = "on".
        chord_7: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 80 % of the length of the wing, for chord_table = "on".
        chord_8: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 90 % of the length of the wing, for chord_table = "on".
        chord_9: f64 = ("m", "", Number(NonNegative), default: 0.0),
        /// Chord at 100 % of the length of the wing, the tip, for chord_table = "on".
        chord_10: f64 = ("m", "", Number(NonNegative), default: 0.0),
    }
}

impl ChordTable {
    /// Returns a table of chords (m), one per station from root to tip.
    pub fn new(chord_table: Tabulated, chords: [f64; STATIONS]) -> ChordTable {
        let mut values = vec![f64::from(chord_table as u8)];
        values.extend(chords);
        ChordTable::from_values(&values)
    }

    /// Returns a chord table that the model does not use.
    pub(crate) fn off() -> ChordTable {
        ChordTable::new(Tabulated::Off, [0.0; STATIONS])
    }

    /// Returns the chords at the stations (m).
    fn chords(&self) -> Vec<f64> {
        self.to_values().split_off(1)
    }

    /// Returns true if the model reads its chord from the table.
    pub(crate) fn is_on(&self) -> bool {
        self.chord_table == Tabulated::On
    }

    /// Returns the chord (m) at `x`, from 0 at the wing's root to 1 at its tip; `None` if the table is off.
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

    /// Checks that the table contains a chord.
    ///
    /// # Errors
    /// An error if the table is on and all its chords are zero.
    pub(crate) fn check(&self) -> Result<(), Invalid> {
        if self.is_on() && self.mean() <= 0.0 {
            return Err(Invalid::new(
                "chord_table is \"on\", but chord_0 to chord_10 are all zero: set them, for example with `flap device wing OUTLINE.csv`",
            ));
        }
        Ok(())
    }
}

/// Returns the parameters of the chord table for the outline of a wing, with `chord_table` set to "on".
pub(crate) fn chord_table(outline: &Outline) -> Vec<(&'static str, f64)> {
    let mut parameters = vec![("chord_table", f64::from(Tabulated::On as u8))];
    for (station, parameter) in ChordTable::TABLE[1..].iter().enumerate() {
        let share = station as f64 / (STATIONS - 1) as f64;
        parameters.push((parameter.name, outline.chord(share * outline.length())));
    }
    parameters
}
