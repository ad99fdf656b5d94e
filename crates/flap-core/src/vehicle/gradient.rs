//! Derivatives of the measures of a vehicle, computed from the derivatives of the measures of its wings.

use super::layout::Vehicle;
use crate::simulate::{
    Change, Gradient, Gradients, NoSlope, PointRun, SolverSettings, Unfinished, cannot_begin,
};

impl Gradients for Vehicle {
    fn states(&self) -> Vec<String> {
        self.states.clone()
    }

    /// The vehicle's measures are linear functions of the wings' measures, except efficiency and lift over
    /// weight. The derivatives of the vehicle's measures are therefore computed as finite differences. For
    /// the finite differences, each measure of a wing is changed in proportion to the derivative of this
    /// measure.
    fn gradient(
        &self,
        run: &PointRun<'_>,
        state: &[f64],
        changes: &[Change],
    ) -> Result<Gradient, Unfinished> {
        let states = self.states.len() / self.mounts.len();
        if state.len() != self.states.len() {
            return Err(cannot_begin(state, self.states.len()).into());
        }
        let solver = SolverSettings { loads: true, ..*run.solver };
        let mut wings = Vec::new();
        let mut rhs_evals = 0;
        for wing in 0..self.mounts.len() {
            let state = &state[wing * states..(wing + 1) * states];
            let wing = self.wing_slopes(run, &solver, wing, state, changes)?;
            rhs_evals += wing.rhs_evals;
            wings.push(wing);
        }
        let here: Vec<&[f64]> = wings.iter().map(|wing| wing.measures.as_slice()).collect();
        let here = self.measures(run.values, &here);
        let slopes = changes.iter().enumerate().map(|(i, change)| {
            let moved = |values: &[f64], size: f64| {
                let measures: Vec<Vec<f64>> = wings.iter().map(|wing| wing.moved(i, size)).collect();
                let measures: Vec<&[f64]> = measures.iter().map(Vec::as_slice).collect();
                self.measures(values, &measures)
            };
            let is_one_sided =
                change.behind.iter().zip(run.values).all(|(one, other)| one.total_cmp(other).is_eq());
            let back = if is_one_sided { 0.0 } else { change.size };
            let (ahead, behind) = (moved(&change.ahead, change.size), moved(&change.behind, -back));
            let trouble = wings.iter().find_map(|wing| wing.trouble(i));
            let is_same = ahead.iter().zip(&behind).all(|(one, other)| one.total_cmp(other).is_eq());
            let nothing = is_same && wings.iter().all(|wing| wing.slopes[i].is_none());
            let slope = |j: usize| {
                if here[j].is_nan() {
                    return Err(NoSlope::Missing);
                }
                if nothing {
                    return Err(NoSlope::Zero);
                }
                let slope = (ahead[j] - behind[j]) / (change.size + back);
                match trouble {
                    Some(trouble) if slope.is_nan() => Err(trouble),
                    _ => Ok(slope),
                }
            };
            (0..here.len()).map(slope).collect()
        });
        Ok(Gradient { slopes: slopes.collect(), rhs_evals })
    }
}

/// Measures of a wing, and their derivatives with respect to each change of parameters; `None` for changes that do not
/// affect the wing.
struct WingSlopes {
    measures: Vec<f64>,
    slopes: Vec<Option<Vec<Result<f64, NoSlope>>>>,
    rhs_evals: u64,
}

impl WingSlopes {
    /// Returns the measures of the wing after a step of the given size along a change of parameters.
    fn moved(&self, change: usize, size: f64) -> Vec<f64> {
        let Some(slopes) = &self.slopes[change] else { return self.measures.clone() };
        let moved = |(measure, slope): (&f64, &Result<f64, NoSlope>)| match slope {
            Ok(slope) => measure + size * slope,
            Err(_) => f64::NAN,
        };
        self.measures.iter().zip(slopes).map(moved).collect()
    }

    /// Returns the reason why the derivative in the direction of a change is missing, or `None` if the
    /// derivative exists.
    fn trouble(&self, change: usize) -> Option<NoSlope> {
        self.slopes[change].iter().flatten().find_map(|slope| slope.err())
    }
}

impl Vehicle {
    fn wing_slopes(
        &self,
        run: &PointRun<'_>,
        solver: &SolverSettings,
        wing: usize,
        state: &[f64],
        changes: &[Change],
    ) -> Result<WingSlopes, Unfinished> {
        let motions = self.model.motions()?;
        let values = self.table.of_wing(run.values, wing)?;
        let run = PointRun { solver, values: &values, ..*run };
        let measures = motions.period(&run, state)?;
        // A side that is out of range gets infinite values, which no parameter accepts. The reason is then
        // `NoSlope::Edge`.
        let side = |side: &[f64]| {
            self.table.of_wing(side, wing).unwrap_or_else(|_| vec![f64::INFINITY; values.len()])
        };
        let own = |change: &Change| Change {
            ahead: side(&change.ahead),
            behind: side(&change.behind),
            size: change.size,
        };
        let own: Vec<Change> = changes.iter().map(own).collect();
        let concerned: Vec<Change> = own.iter().filter(|change| !change.is_none()).cloned().collect();
        let gradient = motions.gradient(&run, state, &concerned)?;
        let mut slopes = gradient.slopes.into_iter();
        let slopes = own.iter().map(|change| if change.is_none() { None } else { slopes.next() }).collect();
        Ok(WingSlopes {
            measures: measures.measures,
            slopes,
            rhs_evals: gradient.rhs_evals + measures.rhs_evals,
        })
    }
}
