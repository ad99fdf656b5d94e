//! The chord of the wing along the span, from Legendre polynomials or from a table. The module also computes
//! the shape moments of the chord. The paper does not give the shape of the chord.

use super::params::{FlowDirection, Params};
use crate::aero::{Cut, Strips, check_chords, cut, sum};
use crate::parameter::Invalid;
use crate::quadrature::gauss_legendre;

/// Number of blade elements.
///
/// With 8 elements at the nodes of the Gauss-Legendre rule, the shape moments are exact if the chord is a
/// cubic polynomial of the span. The relative difference between the settled motions with 8 and with 64
/// elements is less than 1e-5.
pub(super) const BLADES: usize = 8;

impl Params {
    /// Returns a copy of the parameters in which flap has computed some values from the chord shape. The
    /// computed values are the mean chord, the midspan chord, and the shape moments of Eqs. (22) and (33).
    #[must_use]
    pub fn with_chord_moments(self) -> Params {
        let cuts = elements(&self);
        let length = self.wing_length;
        // The mean comes from the elements, so that the moment of the chord itself is exactly 1.
        let mean = if self.chords.is_on() { sum(&cuts, |_, c| c) / length } else { self.mean_chord };
        let moment = |f: fn(f64, f64) -> f64| sum(&cuts, |r, c| f(r / length, c / mean)) / length;
        let fourth = moment(|_, c| c * c * c * c);
        Params {
            mean_chord: mean,
            midspan_chord: Some(self.chord(0.5)),
            shape_moment_03: moment(|_, c| c * c * c),
            shape_moment_04: fourth,
            shape_moment_12: moment(|r, c| r * c * c),
            shape_moment_13: moment(|r, c| r * c * c * c),
            shape_moment_21: moment(|r, c| r * r * c),
            shape_moment_22: moment(|r, c| r * r * c * c),
            shape_moment_31: moment(|r, c| r * r * r * c),
            rotation_moment: 0.25 * mean * mean * mean * mean * fourth,
            ..self
        }
    }

    /// Returns the chord (m) at the distance `span` times the wing length from the root. The chord comes from
    /// the table, or from Legendre polynomials:
    ///
    /// ```text
    /// c = c̄ (1 + a₁ P₁(z) + a₂ P₂(z) + a₃ P₃(z))     z = 2 span − 1
    /// ```
    fn chord(&self, span: f64) -> f64 {
        if let Some(chord) = self.chords.chord(span) {
            return chord;
        }
        let z = 2.0 * span - 1.0;
        let [p_1, p_2, p_3] = [z, 0.5 * (3.0 * z * z - 1.0), 0.5 * z * (5.0 * z * z - 3.0)];
        let shape =
            1.0 + self.chord_legendre_1 * p_1 + self.chord_legendre_2 * p_2 + self.chord_legendre_3 * p_3;
        self.mean_chord * shape
    }
}

/// Returns the blade elements of the wing. The velocity of each element is computed at its mid-chord. With
/// `flow_direction` = "uniform", the list of elements is empty.
pub(super) fn blades(p: &Params) -> Result<Strips<f64, BLADES>, Invalid> {
    let cuts = match p.flow_direction {
        FlowDirection::Uniform => Vec::new(),
        FlowDirection::Blade => elements(p),
    };
    check_chords(&cuts, &["chord_legendre_1", "chord_legendre_2", "chord_legendre_3"])?;
    Ok(Strips::new(&cuts, p.air_density, -0.5))
}

/// Returns the positions and sizes of the blade elements of the wing.
pub(super) fn elements(p: &Params) -> Vec<Cut> {
    cut(&gauss_legendre(BLADES), p.root_radius(), p.wing_length, |x| p.chord(x))
}
