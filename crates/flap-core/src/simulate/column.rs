//! The columns of a model's rows.

use crate::model::{Model, OverWings, SignalSet};

/// One measured column.
#[derive(Debug, Clone)]
pub struct Column {
    /// Name with its unit, such as `lift_mean_mn`.
    pub name: String,
    /// Unit in words as printed by `flap params`, such as `mN`.
    pub unit: &'static str,
    /// One line of meaning.
    pub doc: String,
    /// The way in which the rows of a vehicle have it.
    pub over_wings: OverWings,
}

/// The columns of a model: its signals' measures, then the values derived from them.
pub(super) fn columns<M: Model<N>, const N: usize>() -> Vec<Column> {
    let measured = M::Signals::TABLE.iter().flat_map(|signal| {
        signal.measures.iter().map(move |measure| Column {
            name: format!("{}_{}_{}", signal.name, measure.name(), signal.unit.suffix),
            unit: signal.unit.name,
            doc: format!("{} {}", measure.describe(), signal.doc),
            over_wings: signal.over_wings(*measure),
        })
    });
    let derived = M::DERIVED.iter().map(|derived| Column {
        name: derived.name.to_owned(),
        unit: derived.unit,
        doc: derived.doc.to_owned(),
        over_wings: derived.over_wings,
    });
    measured.chain(derived).collect()
}
