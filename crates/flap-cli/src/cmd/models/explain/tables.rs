//! Columns that occur only in tables that commands print, not in the rows of a sweep.

/// A kind of column, and the names and meanings of the columns of this kind.
type Columns = (&'static str, &'static [(&'static str, &'static str)]);

/// Columns of tables that commands print, grouped by command.
pub(super) const TABLES: &[Columns] = &[
    (
        "a column of chirps (`flap test chirp`)",
        &[
            ("begin_s", "beginning of the cycle, measured from the beginning of the chirp"),
            ("end_s", "end of the cycle, measured from the beginning of the chirp"),
            ("frequency_hz", "cycles per second: one divided by the duration of the cycle"),
        ],
    ),
    (
        "a column of resonances (`flap test resonance`)",
        &[
            ("resonance", "method by which the resonance was found"),
            ("frequency_hz", "frequency of the resonance"),
            ("relative_height", "height of the peak divided by the height of the highest peak"),
            ("decay_1_s", "rate at which the free motion after an impulse decays"),
            (
                "relative_rms",
                "root mean square of the residual of the damped sine, divided by the root mean square of the motion",
            ),
        ],
    ),
    (
        "a value of an impulse (`flap test impulse`)",
        &[("impulse_deg", "amplitude that the stroke would reach in the first mode alone, without damping")],
    ),
];
