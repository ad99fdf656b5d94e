//! The parameters of a wing of one's own.

use crate::aero::{Wing, chord_table};

/// The parameters that a wing decides. The axis is at one share of the chord all along the span: that of the areas before
/// and behind it.
pub(super) fn parameters(wing: &Wing) -> Vec<(&'static str, f64)> {
    let before = wing.outline.integral(|_, leading, _| leading);
    let mut found = vec![("wing_offset", wing.offset), ("wing_length", wing.outline.length())];
    found.extend(chord_table(&wing.outline));
    found.push(("axis_position", before / wing.area()));
    if let Some(masses) = wing.masses() {
        let [chord, product, span] = masses.about_centre();
        found.extend([
            ("wing_mass", masses.mass),
            ("mass_centre_radius", masses.radius),
            ("mass_centre_depth", masses.depth),
            ("wing_inertia_span", span),
            ("wing_inertia_normal", span + chord),
            ("wing_inertia_chord", chord),
            ("wing_inertia_product", product),
        ]);
    }
    found
}
