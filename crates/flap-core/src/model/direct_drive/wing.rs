//! The parameters of a wing of one's own.

use crate::aero::{Wing, chord_table};

/// The parameters that a wing decides. The model takes the hinge's axis for the leading edge.
pub(super) fn parameters(wing: &Wing) -> Vec<(&'static str, f64)> {
    let mut found = vec![("wing_length", wing.outline.length()), ("wing_offset", wing.offset)];
    found.extend(chord_table(&wing.outline));
    if let Some(masses) = wing.masses() {
        let [chord, product, span] = masses.about_centre();
        found.extend([
            ("wing_mass", masses.mass),
            ("mass_centre_span", masses.radius - wing.offset),
            // Positive towards the leading edge.
            ("mass_centre_chord", -masses.depth),
            ("wing_inertia_span", span),
            ("wing_inertia_chord", chord),
            ("wing_inertia_product", -product),
        ]);
    }
    found
}
