//! The measures that a picture shows if none is named.

use crate::table::layout;

/// The part that a measure plays in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Drawn over a parameter: a response, a hysteresis loop.
    Response,
    /// The benefit of a design: the colour of a map, the y of a scatter, the measure of a histogram or a tornado.
    Benefit,
    /// The cost of a design: the x of a scatter.
    Cost,
    /// The size of the motion: the colour of a scatter.
    Motion,
}

impl Role {
    /// The role called `name`: `response`, `benefit`, `cost` or `motion`.
    pub fn of(name: &str) -> Option<Role> {
        match name {
            "response" => Some(Role::Response),
            "benefit" => Some(Role::Benefit),
            "cost" => Some(Role::Cost),
            "motion" => Some(Role::Motion),
            _ => None,
        }
    }

    /// The measures that play this part, the preferred first.
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

/// The index in `columns` of the measure that plays a part: the first that is usual for it, else the first measure.
/// Columns of the run, such as `cycles`, are no measures, and neither are those in `taken`.
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
