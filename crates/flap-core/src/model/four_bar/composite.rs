//! Mass and inertias of a wing made of a membrane, a spar along it and veins across it.

use super::params::Params;
use crate::quadrature::gauss_legendre;

/// The materials of a wing: lines and surfaces without thickness, on the planform of the parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Composite {
    /// Mass per area of the membrane, which covers the whole planform (kg/m²).
    pub membrane: f64,
    /// Mass per length along the span of the spar (kg/m).
    pub spar: f64,
    /// Position of the spar in chords behind the rotation axis; negative before it.
    pub spar_position: f64,
    /// Mass per length of the veins, each of which crosses the whole chord (kg/m).
    pub vein: f64,
    /// Positions of the veins, from 0 at the wing's root to 1 at its tip.
    pub vein_positions: Vec<f64>,
}

/// A straight piece across the chord, of uniform mass, or a point if both ends are the same.
struct Piece {
    mass: f64,
    radius: f64,
    /// Depths below the rotation axis at which it begins and ends (m).
    depth: [f64; 2],
}

impl Composite {
    /// `p` with mass, centre of mass and inertias of a wing made like this, of the planform of `p`.
    ///
    /// ```text
    /// m_w = ∫dm     R = ∫r dm/m_w     β = ∫ζ dm/m_w     J_xx = ∫(ζ − β)² dm     J_zz = ∫(r − R)² dm
    /// J_yy = J_xx + J_zz     J_xz = ∫(r − R)(ζ − β) dm
    /// ```
    ///
    /// r is the distance from the stroke axis, ζ the depth below the rotation axis. The wings of both presets were
    /// made so; their parameters are rounded.
    #[must_use]
    pub fn wing(&self, p: &Params) -> Params {
        let pieces = self.pieces(p);
        let mass: f64 = pieces.iter().map(|piece| piece.mass).sum();
        let mean =
            |f: &dyn Fn(&Piece) -> f64| pieces.iter().map(|piece| piece.mass * f(piece)).sum::<f64>() / mass;
        let middle = |piece: &Piece| 0.5 * (piece.depth[0] + piece.depth[1]);
        let radius = mean(&|piece| piece.radius);
        let depth = mean(&middle);
        // A uniform line of length l adds l²/12 about its middle.
        let span = mean(&|piece| {
            let length = piece.depth[1] - piece.depth[0];
            (middle(piece) - depth) * (middle(piece) - depth) + length * length / 12.0
        });
        let chord = mean(&|piece| (piece.radius - radius) * (piece.radius - radius));
        let product = mean(&|piece| (piece.radius - radius) * (middle(piece) - depth));
        Params {
            wing_mass: mass,
            mass_centre_radius: radius,
            mass_centre_depth: depth,
            wing_inertia_span: mass * span,
            wing_inertia_normal: mass * (span + chord),
            wing_inertia_chord: mass * chord,
            wing_inertia_product: mass * product,
            ..p.clone()
        }
    }

    /// The wing in pieces: the membrane and the spar at the nodes of a rule along the span, and the veins.
    fn pieces(&self, p: &Params) -> Vec<Piece> {
        let across = |x: f64| [-p.axis_position * p.chord(x), (1.0 - p.axis_position) * p.chord(x)];
        let mut pieces = Vec::new();
        // Exact for the moments of a chord of fourth degree.
        for node in gauss_legendre(16).iter() {
            let radius = p.wing_offset + p.wing_length * node.x;
            let width = p.wing_length * node.weight;
            let spar = self.spar_position * p.chord(node.x);
            pieces.push(Piece {
                mass: self.membrane * p.chord(node.x) * width,
                radius,
                depth: across(node.x),
            });
            pieces.push(Piece { mass: self.spar * width, radius, depth: [spar, spar] });
        }
        for &x in &self.vein_positions {
            let radius = p.wing_offset + p.wing_length * x;
            pieces.push(Piece { mass: self.vein * p.chord(x), radius, depth: across(x) });
        }
        pieces
    }
}
