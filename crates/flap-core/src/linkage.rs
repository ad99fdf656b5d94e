//! Linkages for transmissions: slider-crank and planar four-bar linkages.
//!
//! In the planar four-bar linkage, the input link L₁ turns about the origin, and the output link L₃ turns
//! about the point (L₀, 0). The coupler L₂ connects the end A of the input link with the end B of the output
//! link. The independent variable is the stroke angle θ: the output link is at the angle ψ = ψ_n + θ.

use core::f64::consts::PI;

use crate::num::Real;

crate::per_lane! {
    /// A slider-crank linkage. At rest, the crank is perpendicular to the line on which the slider moves, and
    /// the connecting rod lies on this line.
    pub(crate) struct SliderCrank<R> {
        /// Radius of the crank L_c (m).
        pub(crate) crank: R,
        /// Length of the connecting rod L_s (m).
        pub(crate) rod: R,
    }
}

/// Displacement δ of the slider from rest (m), and the derivatives of δ with respect to the crank angle (m).
#[derive(Clone, Copy, Debug)]
pub(crate) struct SliderMotion<R> {
    /// Displacement δ of the slider.
    pub(crate) displacement: R,
    /// First derivative δ_η of the displacement with respect to the crank angle.
    pub(crate) slope: R,
    /// Second derivative δ_ηη of the displacement with respect to the crank angle.
    pub(crate) bend: R,
}

impl<R: Real> SliderCrank<R> {
    /// Returns the motion of the slider at the crank angle η, given the sine and the cosine of η.
    ///
    /// ```text
    /// e = L_c (1 − cos η)     g = √(L_s² − e²)     δ = L_c sin η + L_s − g
    /// g_η = −e e_η / g     g_ηη = −(e_η² + e e_ηη + g_η²) / g
    /// ```
    #[inline(always)]
    pub(crate) fn motion(&self, sin: R, cos: R) -> SliderMotion<R> {
        let along = self.crank * sin;
        let across = self.crank * cos;
        let e = self.crank - across;
        let g = self.rod.mul_add(self.rod, -(e * e)).sqrt();
        let inverse_g = sin.lit(1.0) / g;
        // e_η = L_c sin η, e_ηη = L_c cos η.
        let g_slope = -(e * along * inverse_g);
        let g_bend = -((along * along + e * across + g_slope * g_slope) * inverse_g);
        SliderMotion { displacement: along + self.rod - g, slope: across - g_slope, bend: -along - g_bend }
    }
}

crate::per_lane! {
    /// Dimensions of a four-bar linkage, and the positions of its links at zero stroke.
    pub struct FourBarLinkage<R> {
        /// Length of the ground link L₀ (m).
        ground: R,
        /// Length of the output link L₃ (m).
        output: R,
        /// Square of the input link's length, L₁² (m²).
        input_square: R,
        /// The value ½(L₁² − L₂²), with the length L₁ of the input link and the length L₂ of the coupler
        /// (m²).
        half_difference: R,
        /// Inverse of the square of the coupler's length, 1/L₂² (1/m²).
        inverse_coupler_square: R,
        /// Angle ψ_n of the output link at zero stroke (rad).
        pub neutral: R,
        /// Coordinate of the input link's end at zero stroke, along the ground link, divided by L₁² (1/m).
        direction_x: R,
        /// Coordinate of the input link's end at zero stroke, perpendicular to the ground link, divided by
        /// L₁² (1/m).
        direction_y: R,
    }
}

/// Positions of the links at one stroke angle θ, and the derivatives of these positions. A prime means the
/// derivative with respect to θ.
#[derive(Clone, Copy, Debug)]
pub struct FourBarMotion<R> {
    /// Position A of the input link's end (m), and its derivatives A′ and A″ with respect to the stroke
    /// angle.
    pub a: [[R; 2]; 3],
    /// Position B of the output link's end (m), and its derivatives B′ and B″ with respect to the stroke
    /// angle.
    pub b: [[R; 2]; 3],
    /// First derivative θ₁′ and second derivative θ₁″ of the input link's angle with respect to the stroke
    /// angle.
    pub input: [R; 2],
    /// First derivative θ₂′ and second derivative θ₂″ of the coupler's angle with respect to the stroke
    /// angle.
    pub coupler: [R; 2],
    /// Sine and cosine of the angle η by which the input link has turned from its direction at zero stroke.
    pub turned: [R; 2],
}

impl FourBarLinkage<f64> {
    /// Returns the four-bar linkage, given the `lengths` (m) of ground link, input link, coupler and output link.
    ///
    /// At zero stroke the output link has the angle `neutral` (rad). If the links cannot be assembled at zero
    /// stroke, the direction of the input link is NaN.
    pub(crate) fn new(lengths: [f64; 4], neutral: f64) -> FourBarLinkage<f64> {
        let [ground, input, coupler, output] = lengths;
        let mut four_bar = FourBarLinkage {
            ground,
            output,
            input_square: input * input,
            half_difference: 0.5 * (input * input - coupler * coupler),
            inverse_coupler_square: 1.0 / (coupler * coupler),
            neutral,
            direction_x: 0.0,
            direction_y: 0.0,
        };
        let [x, y] = four_bar.motion(0.0).a[0];
        four_bar.direction_x = x / four_bar.input_square;
        four_bar.direction_y = y / four_bar.input_square;
        four_bar
    }

    /// Returns the angle of the output link (rad), between 30° and 80°, at which the derivative θ₁′ is stationary (θ₁″
    /// = 0).
    ///
    /// `lengths` are in metres. The result is `None` if θ₁″ does not change its sign between 30° and 80°.
    pub(crate) fn stationary_angle(lengths: [f64; 4]) -> Option<f64> {
        let four_bar = FourBarLinkage::new(lengths, 0.0);
        let bend = |angle: f64| four_bar.motion(angle).input[1];
        root(bend, [30.0 / 180.0 * PI, 80.0 / 180.0 * PI])
    }
}

impl<R: Real> FourBarLinkage<R> {
    /// Returns the positions of the links, and their derivatives, at the stroke angle `theta` (rad).
    ///
    /// ```text
    /// B = (L₀ + L₃ cos ψ, L₃ sin ψ)     A = (P B + Q B⊥)/|B|²     P = ½(|B|² + L₁² − L₂²)     Q² = L₁²|B|² − P²
    /// w = B − A     n = A⊥     w·n = −Q
    /// θ₁′ = w·B′ / w·n     A′ = n θ₁′     θ₁″ = (|B′ − A′|² + w·(B″ + A θ₁′²)) / w·n     A″ = n θ₁″ − A θ₁′²
    /// θ₂′ = w×(B′ − A′) / L₂²     θ₂″ = w×(B″ − A″) / L₂²
    /// ```
    ///
    /// If the links cannot be assembled, all results except B, B′ and B″ are NaN.
    #[inline(always)]
    pub fn motion(&self, theta: R) -> FourBarMotion<R> {
        let (sin, cos) = (self.neutral + theta).sin_cos();
        let arm = scale(self.output, [cos, sin]);
        let b = [self.ground + arm[0], arm[1]];
        let b_p = turn(arm);
        let b_pp = scale(theta.lit(-1.0), arm);

        // Q > 0 selects one of the two assemblies: A lies to the left of the line from 0 to B.
        let square = dot(b, b);
        let p = square * 0.5 + self.half_difference;
        let q = self.input_square.mul_add(square, -(p * p)).sqrt();
        // One division for both 1/|B|² and 1/(w·n).
        let inverse = theta.lit(1.0) / (square * q);
        let a = scale(inverse * q, scale_add(q, turn(b), scale(p, b)));
        let w = sub(b, a);
        let n = turn(a);
        let inverse_wn = -(inverse * square);

        let input_p = dot(w, b_p) * inverse_wn;
        let a_p = scale(input_p, n);
        let coupler_velocity = sub(b_p, a_p);
        let centripetal = scale_add(input_p * input_p, a, b_pp);
        let input_pp = (dot(coupler_velocity, coupler_velocity) + dot(w, centripetal)) * inverse_wn;
        let a_pp = scale_add(input_pp, n, scale(-(input_p * input_p), a));

        let direction = [self.direction_x, self.direction_y];
        FourBarMotion {
            a: [a, a_p, a_pp],
            b: [b, b_p, b_pp],
            input: [input_p, input_pp],
            coupler: [
                cross(w, coupler_velocity) * self.inverse_coupler_square,
                cross(w, sub(b_pp, a_pp)) * self.inverse_coupler_square,
            ],
            turned: [cross(direction, a), dot(direction, a)],
        }
    }
}

crate::per_lane! {
    /// Inertias of the moving links of a four-bar linkage.
    pub struct LinkInertias<R> {
        /// Inertia of the input link about its pivot (kg·m²).
        pub input: R,
        /// A quarter of the coupler's mass (kg).
        pub quarter_coupler_mass: R,
        /// Inertia of the coupler about its centre of mass (kg·m²).
        pub coupler: R,
        /// Inertia of the output link about its pivot (kg·m²).
        pub output: R,
    }
}

impl<R: Real> LinkInertias<R> {
    /// Returns the inertia G of the links about the stroke axis, and G′/2 (kg·m²). G′ is the derivative of G
    /// with respect to the stroke angle. The formula of G is part of Eq. 13 of Arabagi et al. (2013).
    ///
    /// ```text
    /// G = Σ m_i |x_i′|² + Σ J_i θ_i′²     ½G′ = Σ m_i x_i′·x_i″ + Σ J_i θ_i′ θ_i″
    /// ```
    ///
    /// The links are uniform, so their centres of mass are A/2, (A + B)/2 and the middle of the output link.
    #[inline(always)]
    pub(crate) fn about_stroke(&self, motion: &FourBarMotion<R>) -> [R; 2] {
        let [_, a_p, a_pp] = motion.a;
        let [_, b_p, b_pp] = motion.b;
        let (middle_p, middle_pp) = (add(a_p, b_p), add(a_pp, b_pp));
        let [input_p, input_pp] = motion.input;
        let [coupler_p, coupler_pp] = motion.coupler;
        let inertia = self.output
            + self.input * input_p * input_p
            + self.coupler * coupler_p * coupler_p
            + self.quarter_coupler_mass * dot(middle_p, middle_p);
        let half_slope = self.input * input_p * input_pp
            + self.coupler * coupler_p * coupler_pp
            + self.quarter_coupler_mass * dot(middle_p, middle_pp);
        [inertia, half_slope]
    }
}

/// Returns the root of `f` between the two ends of `bracket`, with an error of the order of rounding errors.
/// The result is `None` if `f` has the same sign at both ends of `bracket`.
///
/// The method is regula falsi with the Illinois rule.
fn root(f: impl Fn(f64) -> f64, bracket: [f64; 2]) -> Option<f64> {
    let [mut a, mut b] = bracket;
    let (mut f_a, mut f_b) = (f(a), f(b));
    if f_a * f_b > 0.0 || !f_a.is_finite() || !f_b.is_finite() {
        return None;
    }
    let mut x = a;
    for _ in 0..100 {
        let previous = x;
        x = b - f_b * (b - a) / (f_b - f_a);
        if x == previous || f_b == 0.0 {
            break;
        }
        let f_x = f(x);
        if f_x == 0.0 {
            break;
        }
        if (f_x < 0.0) == (f_b < 0.0) {
            f_a *= 0.5;
        } else {
            (a, f_a) = (b, f_b);
        }
        (b, f_b) = (x, f_x);
    }
    Some(x)
}

// Vectors in the plane of the linkage.

/// Returns a + b.
#[inline(always)]
fn add<R: Real>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// Returns a − b.
#[inline(always)]
fn sub<R: Real>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Returns k a.
#[inline(always)]
fn scale<R: Real>(k: R, a: [R; 2]) -> [R; 2] {
    [k * a[0], k * a[1]]
}

/// Returns k a + b.
#[inline(always)]
fn scale_add<R: Real>(k: R, a: [R; 2], b: [R; 2]) -> [R; 2] {
    [k.mul_add(a[0], b[0]), k.mul_add(a[1], b[1])]
}

/// Returns the scalar product a · b.
#[inline(always)]
fn dot<R: Real>(a: [R; 2], b: [R; 2]) -> R {
    a[0].mul_add(b[0], a[1] * b[1])
}

/// Returns the component of the cross product a × b that is perpendicular to the plane of a and b.
#[inline(always)]
fn cross<R: Real>(a: [R; 2], b: [R; 2]) -> R {
    a[0].mul_add(b[1], -(a[1] * b[0]))
}

/// Returns the vector a, rotated by 90° to the left.
#[inline(always)]
fn turn<R: Real>(a: [R; 2]) -> [R; 2] {
    [-a[1], a[0]]
}
