//! Strips of the wing of the four-bar model, and the constants of the motion of the body.

use core::f64::consts::FRAC_PI_4;

use super::params::{Arms, Params, Quadrature, STRIPS};
use crate::aero::{Cut, check_chords, cut, sum};
use crate::body::{BodyMotion, BodyTerms};
use crate::parameter::Invalid;
use crate::quadrature::{gauss_legendre, midpoints};

/// Returns the positions and sizes of the strips of the wing.
pub(super) fn strips(p: &Params) -> Result<Vec<Cut>, Invalid> {
    Invalid::unless_within("strips", p.strips, STRIPS)?;
    p.chords.check()?;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked to be a small whole number"
    )]
    let count = p.strips as usize;
    let nodes = match p.quadrature {
        Quadrature::Gauss => gauss_legendre(count),
        Quadrature::Midpoint => midpoints(count),
    };
    let cuts = cut(&nodes, p.wing_offset, p.wing_length, |x| p.chord(x));
    let terms = &["chord_term_0", "chord_term_1", "chord_term_2", "chord_term_3", "chord_term_4"];
    check_chords(&cuts, terms)?;
    Ok(cuts)
}

/// Returns two lengths in chords: the distance κ from the rotation axis to the mid-chord in Eq. (8), and the offset χ₀
/// in Eq. (17).
pub(super) fn arms(p: &Params) -> [f64; 2] {
    match p.arms {
        Arms::Printed => [0.5, 0.0],
        Arms::Axis => [0.5 - p.axis_position, p.axis_position],
    }
}

crate::per_lane! {
    /// Motion of the body, and the constants of the wing that the equations need if the body moves.
    pub struct Moving<R> {
        /// Motion of the shoulder.
        pub motion: BodyMotion<R>,
        /// Distance κ of the mid-chord behind the rotation axis in Eq. (8) (chords).
        pub behind: R,
        /// Added mass of the wing, Σ π/4 ρ c²Δr (kg).
        pub added: R,
    }
}

impl Moving<f64> {
    /// A body at rest.
    pub(super) const REST: Moving<f64> = Moving { motion: BodyMotion::REST, behind: 0.0, added: 0.0 };

    /// Returns the motion of the body, and the constants of the wing that the equations need if the body
    /// moves. If `terms` is `BodyTerms::None`, the result describes a body at rest.
    pub(super) fn of(p: &Params, terms: BodyTerms) -> Result<Moving<f64>, Invalid> {
        if terms == BodyTerms::None {
            return Ok(Moving::REST);
        }
        let added = FRAC_PI_4 * p.air_density * sum(&strips(p)?, |_, c| c * c);
        Invalid::unless_finite(Moving { motion: p.body.motion(), behind: arms(p)[0], added })
    }
}
