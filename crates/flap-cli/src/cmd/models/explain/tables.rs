//! Columns of tables that commands print, which are no columns of rows.

/// A kind of column, and such columns with their meanings.
type Columns = (&'static str, &'static [(&'static str, &'static str)]);

/// Columns by the command that writes them.
pub(super) const TABLES: &[Columns] = &[
    (
        "a column of chirps (`flap test chirp`)",
        &[
            ("begin_s", "beginning of the cycle, since that of the chirp"),
            ("end_s", "end of the cycle, since the beginning of the chirp"),
            ("frequency_hz", "one over the duration of the cycle"),
        ],
    ),
    (
        "a column of resonances (`flap test resonance`)",
        &[
            ("resonance", "way in which the resonance was found"),
            ("frequency_hz", "frequency of the resonance"),
            ("relative_height", "height of the peak over that of the highest"),
            ("decay_1_s", "rate at which the free motion after an impulse decays"),
            ("relative_rms", "root mean square of what the damped sine leaves over, over that of the motion"),
        ],
    ),
    (
        "a value of an impulse (`flap test impulse`)",
        &[("impulse_deg", "amplitude of the first mode alone, without damping")],
    ),
];
