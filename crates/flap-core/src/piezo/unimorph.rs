//! A cantilever of one piezoelectric layer on a passive one, of uniform width.

use super::{Laminate, Layer};

/// A unimorph clamped at one end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unimorph {
    /// Length L (m).
    pub length: f64,
    /// Width w (m).
    pub width: f64,
    /// The passive layer, the lower one.
    pub shim: Layer,
    /// The piezoelectric layer.
    pub piezo: Layer,
    /// Piezoelectric coefficient d₃₁ (m/V), positive if a positive voltage bends the tip to positive δ.
    pub coefficient: f64,
    /// Permittivity of the unstressed piezoelectric layer ε (F/m).
    pub permittivity: f64,
}

/// The response of the tip of a [`Unimorph`] to force and voltage: δ = γV − F/k_a.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipResponse {
    /// Stiffness of the tip k_a (N/m).
    pub stiffness: f64,
    /// Deflection of the free tip per voltage γ (m/V).
    pub deflection: f64,
    /// Force on the blocked tip per voltage, and charge per deflection Γ (N/V = C/m).
    pub coupling: f64,
    /// Mass that moves with the tip m_eff (kg).
    pub mass: f64,
    /// Capacitance with the tip blocked C_b (F).
    pub capacitance: f64,
}

impl Unimorph {
    /// Tip stiffness, deflection, blocking force, mass and capacitance, after Smits and Choi (1991).
    ///
    /// ```text
    /// k_a = 3 S w / L³     γ = E_p d₃₁ (z_p − z_c) L² / (2S)     Γ = k_a γ     m_eff = 33/140 w L Σ ρᵢ hᵢ
    /// C_b = w L [(ε − d₃₁² E_p)/h_p + d₃₁² E_p²/(E_p h_p + E_s h_s)] + d₃₁² E_p² (z_p − z_c)² w L / (4S)
    /// ```
    pub fn tip_response(&self) -> TipResponse {
        let laminate = Laminate { layers: [self.shim, self.piezo] };
        let s = laminate.bending_stiffness();
        let arm = laminate.mid_planes()[1] - laminate.neutral_axis();
        let (l, w) = (self.length, self.width);
        // Stress per field in the clamped piezoelectric layer (N/(V·m)).
        let e = self.piezo.modulus * self.coefficient;
        let h_p = self.piezo.thickness;
        let membrane = self.piezo.modulus * h_p + self.shim.modulus * self.shim.thickness;

        let stiffness = 3.0 * s * w / (l * l * l);
        let deflection = e * arm * (l * l) / (2.0 * s);
        let clamped = (self.permittivity - e * self.coefficient) / h_p + e * e / membrane;
        TipResponse {
            stiffness,
            deflection,
            coupling: stiffness * deflection,
            mass: 33.0 / 140.0 * w * l * laminate.areal_density(),
            capacitance: w * l * (clamped + e * e * (arm * arm) / (4.0 * s)),
        }
    }
}
