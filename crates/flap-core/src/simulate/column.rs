//! The columns of a model's rows.

use crate::model::Model;

/// One measured column.
#[derive(Debug, Clone)]
pub struct Column {
    /// Name with its unit, such as `lift_mean_mn`.
    pub name: String,
    /// Unit in words as printed by `flap params`, such as `mN`.
    pub unit: &'static str,
    /// One line of meaning.
    pub doc: String,
}

/// The columns of a model: its signals' measures, then the values derived from them.
pub(super) fn columns<M: Model<N, S>, const N: usize, const S: usize>() -> Vec<Column> {
    let measured = M::SIGNALS.into_iter().flat_map(|signal| {
        signal.measures.iter().map(move |measure| Column {
            name: format!("{}_{}_{}", signal.name, measure.name(), signal.unit.suffix),
            unit: signal.unit.name,
            doc: format!("{} {}", measure.describe(), signal.doc),
        })
    });
    let derived = M::DERIVED.iter().map(|derived| Column {
        name: derived.name.to_owned(),
        unit: derived.unit,
        doc: derived.doc.to_owned(),
    });
    measured.chain(derived).collect()
}
