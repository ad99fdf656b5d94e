//! A beam of bonded layers that bends as one: neutral axis, bending stiffness, mass.

/// One layer of a laminate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Thickness (m).
    pub thickness: f64,
    /// Young's modulus along the beam (Pa).
    pub modulus: f64,
    /// Density (kg/m³).
    pub density: f64,
}

/// Layers stacked from z = 0 upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laminate<const L: usize> {
    /// The layers, the lowest first.
    pub layers: [Layer; L],
}

impl<const L: usize> Laminate<L> {
    /// Heights of the layers' mid-planes (m): z_i = Σ_{j≤i} t_j − t_i/2.
    pub fn mid_planes(&self) -> [f64; L] {
        let mut top = 0.0;
        self.layers.map(|layer| {
            top += layer.thickness;
            top - 0.5 * layer.thickness
        })
    }

    /// Height of the neutral axis (m); Ozaki and Hamaguchi 2018, Eq. (8).
    ///
    /// ```text
    /// z_c = Σ Eᵢ tᵢ zᵢ / Σ Eᵢ tᵢ
    /// ```
    pub fn neutral_axis(&self) -> f64 {
        let heights = self.mid_planes();
        let mut moment = 0.0;
        let mut stiffness = 0.0;
        for (layer, z) in self.layers.iter().zip(heights) {
            moment += layer.modulus * layer.thickness * z;
            stiffness += layer.modulus * layer.thickness;
        }
        moment / stiffness
    }

    /// Bending stiffness per width (N·m); Ozaki and Hamaguchi 2018, Eq. (10).
    ///
    /// ```text
    /// S = Σ Eᵢ (tᵢ³/12 + tᵢ (zᵢ − z_c)²)
    /// ```
    pub fn bending_stiffness(&self) -> f64 {
        let neutral = self.neutral_axis();
        let mut sum = 0.0;
        for (layer, z) in self.layers.iter().zip(self.mid_planes()) {
            let t = layer.thickness;
            sum += layer.modulus * (t * t * t / 12.0 + t * (z - neutral) * (z - neutral));
        }
        sum
    }

    /// Mass per area (kg/m²): Σ ρᵢ tᵢ.
    pub fn areal_density(&self) -> f64 {
        self.layers.iter().map(|layer| layer.density * layer.thickness).sum()
    }
}
