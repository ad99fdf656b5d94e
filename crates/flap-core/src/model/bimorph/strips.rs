//! The chord of the wing in the bimorph model. From the chord, the module computes the strips that the
//! equations need if the body moves, and integrals for circulation and added mass.

use super::params::{CentreOfPressure, Params};
use crate::aero::{AddedMass, Circulation, ObliqueStrip, RotationalForce};
use crate::body::{BodyMotion, BodyTerms};
use crate::parameter::Invalid;
use crate::quadrature::gauss_beta;

/// Number of strips. With four strips, the sums over the strips are exact if the body is at rest. The first
/// derivatives of the forces with respect to body motion are also exact.
const STRIPS: usize = 4;

crate::per_lane! {
    /// Motion of the body, and the strips of the wing.
    pub struct Moving<R> {
        /// Motion of the shoulder.
        pub motion: BodyMotion<R>,
        /// Strips of the wing. Each strip has the mean chord, because Eq. (11) gives the centre of pressure
        /// in mean chords.
        pub strips: [ObliqueStrip<R>; STRIPS],
    }
}

impl Moving<f64> {
    /// A body at rest.
    pub(super) const REST: Moving<f64> =
        Moving { motion: BodyMotion::REST, strips: [ObliqueStrip::NONE; STRIPS] };

    /// Returns the motion of the body and the strips of the wing. If `terms` is `BodyTerms::None`, the result
    /// describes a body at rest.
    ///
    /// # Errors
    /// Returns an error if the body moves and `centre_of_pressure` is "literal", or if no shape of the wing
    /// has the radii `wing_radius_1` and `wing_radius_2`.
    pub(super) fn of(p: &Params, terms: BodyTerms) -> Result<Moving<f64>, Invalid> {
        if terms == BodyTerms::None {
            return Ok(Moving::REST);
        }
        if p.centre_of_pressure == CentreOfPressure::Literal {
            return Err(Invalid::new(
                "centre_of_pressure = \"literal\" has no meaning on a moving body: set it to \"folded\" or \"directional\"",
            ));
        }
        Invalid::unless_finite(Moving { motion: p.body.motion(), strips: strips(p)? })
    }
}

/// Chord along the span as a beta distribution of r̂ = r/R (Ellington 1984).
///
/// ```text
/// c = c̄ r̂^(P−1) (1 − r̂)^(Q−1)/B(P, Q)
/// P = r̂₁ K     Q = (1 − r̂₁) K     K = r̂₁ (1 − r̂₁)/(r̂₂² − r̂₁²) − 1
/// ```
///
/// If `wing_radius_1` is not set, r̂₁ is computed from the relation r̂₂ = 0.929 r̂₁^0.732 for insect wings
/// (Ellington 1984).
struct Chord {
    length: f64,
    mean: f64,
    p: f64,
    q: f64,
}

impl Chord {
    /// # Errors
    /// Returns an error if no shape of the wing has the radii `wing_radius_1` and `wing_radius_2`.
    fn of(p: &Params) -> Result<Chord, Invalid> {
        let second = p.wing_radius_2;
        let first = p.wing_radius_1.unwrap_or_else(|| libm::pow(second / 0.929, 1.0 / 0.732));
        if !(second * second < first && first < second) {
            return Err(Invalid::new(format!(
                "no wing has wing_radius_1 = {first} and wing_radius_2 = {second}: wing_radius_1 must lie between \
                     wing_radius_2^2 and wing_radius_2"
            )));
        }
        let k = first * (1.0 - first) / (second * second - first * first) - 1.0;
        let (length, mean) = (p.wing_length, p.wing_area / p.wing_length);
        Ok(Chord { length, mean, p: first * k, q: (1.0 - first) * k })
    }

    /// Returns the mean of r̂³ along the span, weighted by the chord c.
    fn third_moment(&self) -> f64 {
        let (p, k) = (self.p, self.p + self.q);
        p * (p + 1.0) * (p + 2.0) / (k * (k + 1.0) * (k + 2.0))
    }

    /// Returns ∫ c^n r^m dr.
    ///
    /// ```text
    /// R^(m+1) c̄^n B(n (P − 1) + m + 1, n (Q − 1) + 1)/B(P, Q)^n
    /// ```
    fn integral(&self, n: i32, m: i32) -> f64 {
        let beta = |p: f64, q: f64| libm::lgamma(p) + libm::lgamma(q) - libm::lgamma(p + q);
        let power = f64::from(n);
        let (p, q) = (power * (self.p - 1.0) + f64::from(m + 1), power * (self.q - 1.0) + 1.0);
        let size = self.length.powi(m + 1) * self.mean.powi(n);
        size * libm::exp(beta(p, q) - power * beta(self.p, self.q))
    }
}

/// Constants of three forces along the wing's normal: rotational circulation, rotational drag and added mass.
type Unsteady = (Circulation<f64>, RotationalForce<f64>, AddedMass<f64>);

/// Returns the constants of the rotational circulation, of the normal force of the rotational drag, and of
/// the added mass.
///
/// # Errors
/// Returns an error if no shape of the wing has the radii `wing_radius_1` and `wing_radius_2`. Returns an
/// error if the integrals over the chord diverge at the root or the tip.
pub(super) fn unsteady(p: &Params) -> Result<Unsteady, Invalid> {
    if !p.has_sections() {
        return Ok((Circulation::NONE, RotationalForce::NONE, AddedMass::NONE));
    }
    let chord = Chord::of(p)?;
    if chord.p.min(chord.q) <= 0.75 {
        return Err(Invalid::new(
            "the chord that belongs to wing_radius_1 and wing_radius_2 is too large at the root or the tip for \
             circulation_factor, rotation_force_factor and added_mass_factor: make wing_radius_2 smaller, or wing_radius_1 closer to it",
        ));
    }
    let integral = |n, m| chord.integral(n, m);
    Ok((
        Circulation::of(p.circulation_factor, p.air_density, p.axis_position, &integral),
        RotationalForce::of(
            p.rotation_force_factor * p.drag_coefficient_max,
            p.air_density,
            p.axis_position,
            &integral,
        ),
        AddedMass::of(p.added_mass_factor * p.air_density, p.axis_position, &integral),
    ))
}

/// Returns the strips of the wing, one for each node of the Gauss rule whose weight function is the [`Chord`].
///
/// The lever arm of each strip about the stroke axis is λ r. The factor λ is chosen so that lift and drag act
/// at the distance R_cp if the body is at rest:
///
/// ```text
/// λ = R_cp r̂₂²/(R r̂₃³)     r̂₃³ = P (P + 1) (P + 2)/((P + Q) (P + Q + 1) (P + Q + 2))
/// ```
fn strips(p: &Params) -> Result<[ObliqueStrip<f64>; STRIPS], Invalid> {
    let chord = Chord::of(p)?;
    let second = p.wing_radius_2;
    let lever = p.pressure_radius * second * second / (p.wing_length * chord.third_moment());
    let dynamic = 0.5 * p.air_density * p.wing_area;
    let nodes = gauss_beta(STRIPS, chord.p, chord.q);
    Ok(core::array::from_fn(|i| {
        let radius = p.wing_length * nodes[i].x;
        ObliqueStrip {
            weight: dynamic * nodes[i].weight,
            radius,
            lever: lever * radius,
            behind: 0.0,
            chord: chord.mean,
        }
    }))
}
