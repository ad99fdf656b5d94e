//! Default measures of pictures.

use crate::table::layout;

/// Role of a measure in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Measure on the vertical axis in pictures of a response or a hysteresis loop. The horizontal axis shows
    /// a parameter.
    Response,
    /// Benefit of a design, for example lift. Pictures show the benefit as the colour of a map, or on the
    /// y-axis of a scatter plot. Histograms and tornado charts also show the benefit.
    Benefit,
    /// Cost of a design, for example power. Scatter plots show the cost on the x-axis.
    Cost,
    /// Size of the motion, for example the stroke. Scatter plots show the size of the motion as a colour.
    Motion,
}

impl Role {
    /// Returns the role called `name`, which is `response`, `benefit`, `cost` or `motion`.
    pub fn of(name: &str) -> Option<Role> {
        match name {
            "response" => Some(Role::Response),
            "benefit" => Some(Role::Benefit),
            "cost" => Some(Role::Cost),
            "motion" => Some(Role::Motion),
            _ => None,
        }
    }

    /// Returns the names of the usual measures for this role, beginning with the preferred measure.
    fn names(self) -> &'static [&'static str] {
        match self {
            Role::Response => {
                &["stroke_pp_deg", "stroke_amplitude_deg", "lift_mean_mn", "vehicle_lift_mgf", "lift_mean_gf"]
            }
            Role::Benefit => &["lift_mean_mn", "vehicle_lift_mgf", "lift_mean_gf"],
            Role::Cost => &["power_mean_mw", "strain_surface_max"],
            Role::Motion => &["stroke_pp_deg", "stroke_amplitude_deg", "pitch_pp_deg", "pitch_peak_deg"],
        }
    }
}

/// Chooses the measure for a role, and returns its index in `columns`. If `columns` contains no usual measure
/// of the role, the function chooses the first measure in `columns`.
///
/// The function never chooses a column about the computation, such as `cycles`, or a column in `taken`.
pub fn usual<'n>(role: Role, columns: &[&'n str], taken: &[&'n str]) -> Option<usize> {
    let is_free = |column: &&str| !taken.contains(column) && !layout::is_fixed(column);
    let places = |wanted: &str| columns.iter().position(|column| *column == wanted && is_free(column));
    let first = || columns.iter().position(&is_free);
    role.names().iter().find_map(|name| places(name)).or_else(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_measure_comes_first() {
        let columns = ["mass_mg", "stroke_amplitude_deg", "stroke_pp_deg", "power_mean_mw", "cycles"];
        assert_eq!(usual(Role::Response, &columns, &[]), Some(2));
        assert_eq!(usual(Role::Response, &columns, &["stroke_pp_deg"]), Some(1));
        assert_eq!(usual(Role::Cost, &columns, &[]), Some(3));
        assert_eq!(usual(Role::Benefit, &columns, &[]), Some(0), "no lift: the first measure");
        assert_eq!(usual(Role::Motion, &["cycles", "stable"], &[]), None);
        assert_eq!(usual(Role::Motion, &["lift_mean_mn"], &["lift_mean_mn"]), None);
    }

    #[test]
    fn roles_have_names() {
        for (name, role) in [
            ("response", Role::Response),
            ("benefit", Role::Benefit),
            ("cost", Role::Cost),
            ("motion", Role::Motion),
        ] {
            assert_eq!(Role::of(name), Some(role));
        }
        assert_eq!(Role::of("lift"), None);
    }
}
