//! Stroke and pitch from points tracked in images of a flapping wing.
//!
//! The equations are (42) and (43) of Ozaki and Hamaguchi (2018), section 3.2. Points are in the image plane, which is
//! perpendicular to the stroke axis. Any unit of length is allowed.

use core::f64::consts::TAU;

use flap_core::parameter::Invalid;

/// Leading edge of a wing in one image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeadingEdge {
    /// Root (x, y).
    pub root: [f64; 2],
    /// Tip (x, y).
    pub tip: [f64; 2],
}

impl LeadingEdge {
    /// Returns the unit vector from the root to the tip of the leading edge. The vector is NaN if root and
    /// tip coincide.
    fn direction(&self) -> [f64; 2] {
        let [x, y] = [self.tip[0] - self.root[0], self.tip[1] - self.root[1]];
        let length = libm::hypot(x, y);
        [x / length, y / length]
    }

    /// Returns the distance of a point from the line through root and tip. The distance is positive to the
    /// right of the direction from the root to the tip. On this side, the lower edge lags while the stroke
    /// rises.
    pub fn distance(&self, point: [f64; 2]) -> f64 {
        let [x, y] = self.direction();
        y * (point[0] - self.root[0]) - x * (point[1] - self.root[1])
    }
}

/// Returns the strokes (rad) of a wing in consecutive images: the angle between the line from root to tip and the x-axis.
///
/// The first angle is between −π and π. Each further angle differs by at most π from the angle before.
pub fn strokes(edges: &[LeadingEdge]) -> Vec<f64> {
    let mut before = 0.0;
    let strokes = edges.iter().enumerate().map(|(image, edge)| {
        let [x, y] = edge.direction();
        let angle = libm::atan2(y, x);
        let turns = if image == 0 { 0.0 } else { ((before - angle) / TAU).round() };
        let stroke = angle + turns * TAU;
        if stroke.is_finite() {
            before = stroke;
        }
        stroke
    });
    strokes.collect()
}

/// Returns the pitch (rad) of a wing, Eq. (42). `distance` is the distance in the image between the lower
/// edge and the leading edge of the wing.
///
/// `chord` is the length of the chord from the leading edge to the lower edge of the wing.
///
/// ```text
/// ψ = arcsin(d/c_edge)
/// ```
///
/// The pitch has the sign of the distance. As in the models `bimorph` and `direct-drive`, the pitch is
/// positive if the lower edge lags while the stroke rises. Eq. (42) specifies no sign.
///
/// # Errors
/// An error if the distance is larger than the chord, or the chord is not a positive number.
pub fn pitch_from_projection(distance: f64, chord: f64) -> Result<f64, Invalid> {
    if !(chord.is_finite() && chord > 0.0) {
        return Err(Invalid::new(format!("the chord must be more than zero, not {chord}")));
    }
    if distance.is_nan() || distance.abs() > chord {
        return Err(Invalid::new(format!(
            "the lower edge is at a distance of {distance} from the leading edge, which is more than the chord of {chord}"
        )));
    }
    Ok(libm::asin(distance / chord))
}

/// Returns the centre of the stroke's rotation, Eq. (43): the point closest to the lines of all leading edges.
///
/// ```text
/// minimise over p: Σ |e_i × (p − p_tip,i)|²     e_i = (p_root,i − p_tip,i)/|p_root,i − p_tip,i|
/// ```
///
/// # Errors
/// An error if fewer than two leading edges are given, an edge has no direction, or all edges are parallel.
pub fn rotation_centre(edges: &[LeadingEdge]) -> Result<[f64; 2], Invalid> {
    // With the normals n_i of the lines: Σ n_i n_iᵀ p = Σ n_i n_iᵀ p_tip,i.
    let [mut xx, mut xy, mut yy, mut right_x, mut right_y] = [0.0; 5];
    for (i, edge) in edges.iter().enumerate() {
        let [x, y] = edge.direction();
        if !(x.is_finite() && y.is_finite()) {
            return Err(Invalid::new(format!("root and tip coincide in image {}", i + 1)));
        }
        let normal = [-y, x];
        let offset = normal[0] * edge.tip[0] + normal[1] * edge.tip[1];
        xx += normal[0] * normal[0];
        xy += normal[0] * normal[1];
        yy += normal[1] * normal[1];
        right_x += normal[0] * offset;
        right_y += normal[1] * offset;
    }
    if edges.len() < 2 {
        return Err(Invalid::new(format!(
            "the centre of rotation requires two images at different strokes, but the number of images is {}",
            edges.len()
        )));
    }
    let determinant = xx * yy - xy * xy;
    let count = edges.len() as f64;
    // The determinant for n lines whose directions differ by an angle of δ is about (n δ/2)².
    if determinant <= 1e-12 * count * count {
        return Err(Invalid::new(
            "the leading edges are parallel: the centre of rotation requires two images at different strokes",
        ));
    }
    Ok([(yy * right_x - xy * right_y) / determinant, (xx * right_y - xy * right_x) / determinant])
}
