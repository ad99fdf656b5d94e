//! A user-defined wing: integrals over its outline and its mass.

use crate::parameter::Invalid;
use crate::quadrature::gauss_legendre;

/// Positions of the leading edge and the trailing edge of a wing at one distance from the root. All lengths
/// are in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Distance from the root along the span.
    pub span: f64,
    /// Distance of the leading edge ahead of the hinge's axis. The distance is negative if the leading edge
    /// is behind the axis.
    pub leading: f64,
    /// Distance of the trailing edge behind the hinge's axis.
    pub trailing: f64,
}

/// The outline of a wing. The edges are straight lines between adjacent stations, which are positions along
/// the span.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    stations: Vec<Station>,
}

/// The material of a wing: a membrane of uniform areal density and a spar along the leading edge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Material {
    /// Areal density of the membrane (kg/m²).
    pub membrane: f64,
    /// Mass of the spar per length (kg/m).
    pub spar: f64,
    /// Mass of the whole wing (kg), if the wing was weighed. flap scales the computed masses of membrane and
    /// spar so that their sum is the weighed mass.
    pub weighed: Option<f64>,
}

/// A wing and the density of the air around it.
#[derive(Clone, Debug, PartialEq)]
pub struct Wing {
    /// Outline of the wing.
    pub outline: Outline,
    /// Distance from the stroke axis to the root of the wing (m).
    pub offset: f64,
    /// Material of the wing, if the material is known.
    pub material: Option<Material>,
    /// Density of the air (kg/m³).
    pub air_density: f64,
}

/// Mass and moments of mass of a wing. r is the distance from the stroke axis, and z is the distance behind
/// the hinge's axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Masses {
    /// Mass ∫ dm (kg).
    pub mass: f64,
    /// Distance of the centre of mass from the stroke axis (m).
    pub radius: f64,
    /// Distance of the centre of mass behind the hinge's axis (m).
    pub depth: f64,
    /// Second moment of mass about the stroke axis, ∫ r² dm (kg·m²).
    pub rr: f64,
    /// Product of inertia ∫ r z dm (kg·m²).
    pub rz: f64,
    /// Second moment of mass about the hinge's axis, ∫ z² dm (kg·m²).
    pub zz: f64,
}

impl Masses {
    /// Returns the second moments of mass about the centre of mass, which is at r = R and z = Z (kg·m²):
    ///
    /// ```text
    /// [∫ (r − R)² dm, ∫ (r − R)(z − Z) dm, ∫ (z − Z)² dm]
    /// ```
    pub(crate) fn about_centre(&self) -> [f64; 3] {
        let Masses { mass, radius, depth, rr, rz, zz } = *self;
        [rr - mass * radius * radius, rz - mass * radius * depth, zz - mass * depth * depth]
    }
}

impl Outline {
    /// Returns the outline whose edges pass through the points in `stations`. The stations must be in the
    /// order of increasing distance from the root.
    ///
    /// # Errors
    /// An error in these cases:
    ///
    /// - The outline has fewer than two stations.
    /// - The first station is not at the root of the wing.
    /// - The distances of the stations from the root do not increase.
    /// - A chord is negative, or the area of the wing is zero.
    pub fn new(stations: Vec<Station>) -> Result<Outline, Invalid> {
        let [first, .., _] = stations[..] else {
            let message = format!("an outline has at least two stations, not {}", stations.len());
            return Err(Invalid::new(message));
        };
        if first.span != 0.0 {
            return Err(Invalid::new(format!(
                "the first station is at {} m along the span: an outline begins at 0, the wing's root",
                first.span
            )));
        }
        if let Some(i) = (1..stations.len()).find(|&i| stations[i].span <= stations[i - 1].span) {
            return Err(Invalid::new(format!(
                "station {} is not farther out than the station before",
                i + 1
            )));
        }
        if let Some(i) = stations.iter().position(|station| station.leading + station.trailing < 0.0) {
            return Err(Invalid::new(format!(
                "the chord is negative at station {}: its trailing edge is ahead of its leading edge",
                i + 1
            )));
        }
        let outline = Outline { stations };
        if outline.integral(|_, leading, trailing| leading + trailing) > 0.0 {
            Ok(outline)
        } else {
            Err(Invalid::new("the wing has no area"))
        }
    }

    /// Returns the distance from the root to the tip of the wing (m).
    pub fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1].span
    }

    /// Returns the distance of the leading edge ahead of the hinge's axis, and the distance of the trailing
    /// edge behind this axis (m). `span` is the distance from the root (m).
    fn edges(&self, span: f64) -> [f64; 2] {
        let after = self.stations.partition_point(|station| station.span <= span);
        let after = after.clamp(1, self.stations.len() - 1);
        let [a, b] = [self.stations[after - 1], self.stations[after]];
        let share = (span - a.span) / (b.span - a.span);
        [a.leading + share * (b.leading - a.leading), a.trailing + share * (b.trailing - a.trailing)]
    }

    /// Returns the chord (m) at a distance from the root (m).
    pub(crate) fn chord(&self, span: f64) -> f64 {
        self.edges(span).iter().sum()
    }

    /// Returns the largest distance between the hinge's axis and the outline (m).
    pub fn width(&self) -> f64 {
        self.stations
            .iter()
            .map(|station| station.leading.abs().max(station.trailing.abs()))
            .fold(0.0, f64::max)
    }

    /// Returns the integral of f(span, leading, trailing) along the span of the wing. The result is exact if
    /// f is a polynomial of degree 11 or less on each straight piece of the outline.
    pub(crate) fn integral(&self, f: impl Fn(f64, f64, f64) -> f64) -> f64 {
        self.lengths(|span, leading, trailing, _| f(span, leading, trailing))
    }

    /// Returns the integral of f(span, leading, trailing, edge) along the span of the wing. `edge` is the
    /// length of the leading edge per length of span.
    fn lengths(&self, f: impl Fn(f64, f64, f64, f64) -> f64) -> f64 {
        let rule = gauss_legendre(6);
        let piece = |ends: &[Station]| {
            let [a, b] = [ends[0], ends[1]];
            let width = b.span - a.span;
            let edge = ((b.leading - a.leading) / width).hypot(1.0);
            let at = |share: f64, one: f64, other: f64| one + share * (other - one);
            let value = |x: f64| {
                f(at(x, a.span, b.span), at(x, a.leading, b.leading), at(x, a.trailing, b.trailing), edge)
            };
            width * rule.iter().map(|node| node.weight * value(node.x)).sum::<f64>()
        };
        self.stations.windows(2).map(piece).sum()
    }
}

impl Wing {
    /// Returns the area of the wing (m²).
    pub fn area(&self) -> f64 {
        self.outline.integral(|_, leading, trailing| leading + trailing)
    }

    /// Returns the moment of area ∫ rⁿ c dr (m^(n+2)), where r is the distance from the stroke axis and c is
    /// the chord.
    pub(crate) fn area_moment(&self, power: i32) -> f64 {
        self.outline
            .integral(|span, leading, trailing| (self.offset + span).powi(power) * (leading + trailing))
    }

    /// Returns the moment of area ∫∫ |z|ⁿ dA (m^(n+2)), where z is the distance from the hinge's axis.
    pub(crate) fn width_moment(&self, power: i32) -> f64 {
        let one_side = |edge: f64| edge.signum() * edge.abs().powi(power + 1) / f64::from(power + 1);
        self.outline.integral(|_, leading, trailing| one_side(leading) + one_side(trailing))
    }

    /// Returns the added inertia about the stroke axis (kg·m²), by strip theory: ∫ π/4 ρ c² r² dr.
    pub(crate) fn added_inertia(&self) -> f64 {
        let strips = self.outline.integral(|span, leading, trailing| {
            let (chord, radius) = (leading + trailing, self.offset + span);
            chord * chord * radius * radius
        });
        core::f64::consts::FRAC_PI_4 * self.air_density * strips
    }

    /// Returns mass and moments of mass of the wing. The result is `None` if the material of the wing is not
    /// known.
    pub fn masses(&self) -> Option<Masses> {
        let Material { membrane, spar, weighed } = self.material?;
        // Integrand per span: the membrane between the edges, and the spar on the leading edge.
        let moment = |power_r: i32, power_z: i32| {
            self.outline.lengths(|span, leading, trailing, edge| {
                let n = power_z + 1;
                let sheet = (trailing.powi(n) - (-leading).powi(n)) / f64::from(n);
                let line = edge * (-leading).powi(power_z);
                (self.offset + span).powi(power_r) * (membrane * sheet + spar * line)
            })
        };
        let scale = weighed.map_or(1.0, |weighed| weighed / moment(0, 0));
        let mass = scale * moment(0, 0);
        Some(Masses {
            mass,
            radius: scale * moment(1, 0) / mass,
            depth: scale * moment(0, 1) / mass,
            rr: scale * moment(2, 0),
            rz: scale * moment(1, 1),
            zz: scale * moment(0, 2),
        })
    }
}
