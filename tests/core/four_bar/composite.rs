//! Mass and inertias of a wing made of a membrane, a spar along the span and veins across the wing.

use flap_core::model::four_bar::Params;
use flap_core::quadrature::gauss_legendre;

use super::params;
use crate::data::assert_close;

/// The materials of a wing: lines and surfaces without thickness, on the planform of the parameters.
struct Composite {
    /// Mass per area of the membrane, which covers the whole planform (kg/m²).
    membrane: f64,
    /// Mass per length along the span of the spar (kg/m).
    spar: f64,
    /// Position of the spar in chords behind the rotation axis; negative before the rotation axis.
    spar_position: f64,
    /// Mass per length of the veins, each of which crosses the whole chord (kg/m).
    vein: f64,
    /// Positions of the veins, from 0 at the wing's root to 1 at its tip.
    vein_positions: Vec<f64>,
}

/// A straight piece across the chord, of uniform mass, or a point if both ends are the same.
struct Piece {
    mass: f64,
    radius: f64,
    /// Depths below the rotation axis (m) of both ends of the piece.
    depth: [f64; 2],
}

impl Composite {
    /// `p` with mass, centre of mass and inertias of a wing of these materials with the planform of `p`.
    ///
    /// ```text
    /// m_w = ∫dm     R = ∫r dm/m_w     β = ∫ζ dm/m_w     J_xx = ∫(ζ − β)² dm     J_zz = ∫(r − R)² dm
    /// J_yy = J_xx + J_zz     J_xz = ∫(r − R)(ζ − β) dm
    /// ```
    ///
    /// r is the distance from the stroke axis, ζ the depth below the rotation axis. The parameters of both presets are
    /// rounded values of these integrals.
    fn wing(&self, p: &Params) -> Params {
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

/// The wings of the presets are a membrane on a spar and two veins, rounded to four digits.
#[test]
fn a_composite_wing_has_the_inertias_of_the_presets() {
    for (p, membrane, spar_position, vein) in
        [(params("sys75"), 22.98e-3, -0.09, 8.156e-5), (params("sys30"), 20.48e-3, -0.20, 7.268e-5)]
    {
        let composite =
            Composite { membrane, spar: 1.152e-4, spar_position, vein, vein_positions: vec![0.3, 0.6] };
        let wing = composite.wing(&p);
        for (name, actual, expected) in [
            ("m_w", wing.wing_mass, p.wing_mass),
            ("R", wing.mass_centre_radius, p.mass_centre_radius),
            ("beta", wing.mass_centre_depth, p.mass_centre_depth),
            ("J_xx", wing.wing_inertia_span, p.wing_inertia_span),
            ("J_yy", wing.wing_inertia_normal, p.wing_inertia_normal),
            ("J_zz", wing.wing_inertia_chord, p.wing_inertia_chord),
            ("J_xz", wing.wing_inertia_product, p.wing_inertia_product),
        ] {
            assert_close(actual, expected, 4e-4, name);
        }
    }
}
