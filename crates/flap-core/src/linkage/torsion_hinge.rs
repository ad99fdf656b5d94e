//! A wing hinge made of parallel torsional beams.

/// Flat beams of rectangular cross-section, twisted about their length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorsionHinge {
    /// Number of beams, N.
    pub beams: u32,
    /// Shear modulus of the beams' material (Pa), G_h.
    pub shear_modulus: f64,
    /// Beam length along the hinge axis (m), L_h.
    pub length: f64,
    /// Beam width, the larger side of the cross-section (m), w_h.
    pub width: f64,
    /// Beam thickness, the smaller side of the cross-section (m), t_h.
    pub thickness: f64,
}

impl TorsionHinge {
    /// Hinge stiffness (N·m/rad); Ozaki and Hamaguchi 2018, Eq. (41), after Roark.
    ///
    /// ```text
    /// k_w = N β G_h w_h t_h³ / L_h     β = 1/3 − 0.21 (t_h/w_h) (1 − (t_h/w_h)⁴/12)
    /// ```
    ///
    /// The formula holds for `thickness <= width`.
    ///
    /// ```
    /// use flap_core::linkage::TorsionHinge;
    /// // Two polyimide beams 25 µm thick.
    /// let hinge = TorsionHinge { beams: 2, shear_modulus: 1.1e9, length: 0.2e-3, width: 2e-3, thickness: 25e-6 };
    /// assert!((hinge.stiffness() - 1.137e-4).abs() < 1e-7);
    /// ```
    pub fn stiffness(&self) -> f64 {
        let slenderness = self.thickness / self.width;
        let fourth = slenderness * slenderness * slenderness * slenderness;
        let beta = 1.0 / 3.0 - 0.21 * slenderness * (1.0 - fourth / 12.0);
        let thickness_cubed = self.thickness * self.thickness * self.thickness;
        f64::from(self.beams) * beta * self.shear_modulus * self.width * thickness_cubed / self.length
    }
}
