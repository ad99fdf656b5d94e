//! Derivatives of measures, as columns of rows.

/// The derivatives that rows have: of each of some measures by each of some parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gradient {
    /// Indices of the measures: the model's columns, then the plan's own.
    pub of: Vec<usize>,
    /// Indices into the model's parameter table.
    pub with_respect_to: Vec<usize>,
}

impl Gradient {
    /// The number of derivatives.
    pub fn len(&self) -> usize {
        self.of.len() * self.with_respect_to.len()
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The derivatives in the order of their columns: measure and parameter.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.of.iter().flat_map(|&of| self.with_respect_to.iter().map(move |&by| (of, by)))
    }
}

/// The name of the column with the change of the measure `of` per per cent of the parameter `by`.
///
/// ```
/// use flap_sweep::plan::gradient::column_name;
/// assert_eq!(column_name("lift_mean_mn", "hinge_stiffness"), "d_lift_mean_mn_per_pct_hinge_stiffness");
/// ```
pub fn column_name(of: &str, by: &str) -> String {
    format!("d_{of}_per_pct_{by}")
}
