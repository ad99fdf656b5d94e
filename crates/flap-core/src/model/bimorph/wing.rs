//! The parameters of a wing of one's own.

use crate::aero::Wing;

/// The parameters that a wing decides.
///
/// Centres of pressure are those of blade elements: the presets have them times factors fitted to one vehicle.
pub(super) fn parameters(wing: &Wing) -> Vec<(&'static str, f64)> {
    let length = wing.offset + wing.outline.length();
    let (area, width) = (wing.area(), wing.outline.width());
    let mut found = vec![
        ("wing_length", length),
        ("wing_area", area),
        ("wing_radius_2", (wing.area_moment(2) / area).sqrt() / length),
        ("wing_width", width),
        ("wing_width_2", (wing.width_moment(2) / area).sqrt() / width),
        ("added_inertia_stroke", wing.added_inertia()),
        ("pressure_radius", wing.area_moment(3) / wing.area_moment(2)),
        ("rotation_pressure_width", wing.width_moment(3) / wing.width_moment(2)),
    ];
    if let Some(masses) = wing.masses() {
        found.extend([
            ("wing_inertia_stroke", masses.rr),
            ("wing_inertia_hinge", masses.zz),
            ("wing_inertia_product", masses.rz),
        ]);
    }
    found
}
