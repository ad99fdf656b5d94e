//! From an orbit or a failure to a row.

use super::search::Search;
use super::simulator::{Column, Row, Status};
use crate::measure::cycle::{Totals, finish};
use crate::model::Model;
use crate::ode::{Ending, Outcome};
use crate::parameter::Invalid;

/// The columns of a model: its signals' measures, then what is derived from them.
pub(super) fn columns<M: Model<N, S>, const N: usize, const S: usize>() -> Vec<Column> {
    let measured = M::SIGNALS.into_iter().flat_map(|signal| {
        signal.measures.iter().map(move |measure| Column {
            name: format!("{}_{}_{}", signal.name, measure.name(), signal.suffix),
            unit: signal.unit,
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

/// The measures of a cycle, one per column.
pub(super) fn measures<M: Model<N, S>, const N: usize, const S: usize>(
    model: &M,
    c: &M::Constants<f64>,
    totals: &[Totals<f64>; S],
    period: f64,
) -> Vec<f64> {
    let cycle = finish(totals, period);
    let mut values = Vec::new();
    for (signal, cycle) in M::SIGNALS.iter().zip(&cycle) {
        values.extend(signal.measures.iter().map(|&measure| cycle.measure(measure) * signal.factor));
    }
    values.extend(model.derived(c, &cycle));
    values
}

/// The row of a point, unless it has an orbit that is to be measured.
pub(super) fn unmeasured<const N: usize>(search: &Search<N>) -> Option<Row> {
    let status = match (search.ending(), search.period()) {
        (Ending::Stopped, _) if search.orbit().is_some() => return None,
        (Ending::Stopped, Some(_)) => Status::Subharmonic,
        (Ending::Stopped, None) => Status::Unsettled,
        (Ending::Diverged, _) => Status::Diverged,
        (Ending::StepLimit, _) => Status::StepLimit,
    };
    Some(row(search, status))
}

/// The row of a point after its orbit's cycle has been integrated; its totals, unless that failed.
pub(super) fn measured<M: Model<N, S>, const N: usize, const S: usize>(
    search: &Search<N>,
    model: &M,
    c: &M::Constants<f64>,
    period: f64,
    totals: Option<&[Totals<f64>; S]>,
    outcome: Outcome,
) -> Row {
    let status = match outcome.ending {
        Ending::Stopped => Status::Periodic,
        Ending::Diverged => Status::Diverged,
        Ending::StepLimit => Status::StepLimit,
    };
    let mut row = row(search, status);
    row.cycles += 1;
    row.rhs_evals += outcome.rhs_evals;
    if let Some(totals) = totals {
        row.measures = measures(model, c, totals, period);
    }
    // An infinite measure is a motion that has diverged as far as numbers go. NaN is a ratio of zeros.
    if row.measures.iter().any(|measure| measure.is_infinite()) {
        row.status = Status::Diverged;
        row.measures.clear();
    }
    if row.status != Status::Periodic {
        row.period = 0;
        row.floquet_max = f64::NAN;
    }
    row
}

fn row<const N: usize>(search: &Search<N>, status: Status) -> Row {
    Row {
        status,
        measures: Vec::new(),
        cycles: search.cycles(),
        residual: search.residual(),
        period: search.period().unwrap_or(0),
        floquet_max: search.floquet_max(),
        state: search.state().map_or_else(Vec::new, |state| state.to_vec()),
        rhs_evals: search.rhs_evals(),
        reason: None,
    }
}

impl Row {
    /// The row of a point whose parameters are impossible together.
    pub fn invalid(error: Invalid) -> Row {
        Row {
            status: Status::Invalid,
            measures: Vec::new(),
            cycles: 0,
            residual: f64::NAN,
            period: 0,
            floquet_max: f64::NAN,
            state: Vec::new(),
            rhs_evals: 0,
            reason: Some(error.reason),
        }
    }
}
