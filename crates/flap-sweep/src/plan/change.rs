//! Methods that change a plan and keep the plan valid.

use std::sync::Arc;

use flap_core::parameter::Kind;
use flap_core::simulate::{Gradients, Setting, SettingKind, SolverSettings};

use super::Plan;
use super::axes::{Along, Axes, Axis, TooManyPoints, Values};
use super::formula::{Condition, Derived, OwnMeasure};
use super::gradient::{self, Gradient, NoDerivative};
use super::robot::Differences;
use super::selection::{Selection, Shard};
use super::value::Value;
use crate::derivative::Per;
use crate::notation::expression;
use crate::notation::value::{self, ValueError};

/// Error of a change that would make a plan invalid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChangeError {
    /// The parameter cannot be set or varied, because an axis already varies the parameter.
    #[error("an axis varies `{0}`")]
    Varied(String),
    /// The parameter cannot be set or varied, because a formula computes its value.
    #[error("`{0}` is derived from other parameters")]
    Derived(String),
    /// The drive frequency cannot be set or varied, because it is the resonance of each design.
    #[error("`{0}` is set to the resonance of each design")]
    Resonance(String),
    /// The parameter cannot be varied, because the search for hover changes its value.
    #[error("the search for hover changes `{0}`")]
    Input(String),
    /// The parameter does not accept the value.
    #[error("`{parameter}` does not take this value")]
    Value {
        /// Name of the parameter.
        parameter: String,
        /// Mistake in the value.
        error: Box<ValueError>,
    },
    /// The listed parameters have no value.
    #[error("these parameters have no value: {}", .0.join(", "))]
    Missing(Vec<String>),
    /// The plan would have more than [`Axes::MAX_POINTS`](super::axes::Axes::MAX_POINTS) points.
    #[error(transparent)]
    TooManyPoints(#[from] TooManyPoints),
    /// The plan has no point with this index, or the indices are not in ascending order.
    #[error("point {0} is not in the grid, or not in ascending order")]
    NoPoint(u64),
    /// Rows have no measure with this name, or the name is listed twice.
    #[error("there is no measure `{0}`, or it is listed twice")]
    NoColumn(String),
    /// Rows have no derivatives with respect to this parameter.
    #[error("`{0}` {1}")]
    NoDerivative(String, NoDerivative),
    /// The measure is a condition (true or false), not a number.
    #[error("`{0}` is true or false, and has no derivatives")]
    NoSlope(String),
    /// Rows at the resonance of each design have neither derivatives nor initial states.
    #[error("each design runs at its own resonance, so rows have neither derivatives nor states")]
    AtResonance,
    /// Rows at hover, and rows with the damping matrix, have no initial states.
    #[error("rows at hover, and rows with the damping matrix, have no states")]
    OfBody,
    /// The model does not compute motions, so rows have neither derivatives nor initial states. The error
    /// contains the reason.
    #[error("{0}")]
    NoMotions(String),
    /// The number of initial states differs from the number of points.
    #[error("{0} states for {1} points")]
    States(usize, u64),
    /// A setting of the solver is out of its range. The error contains the name of the setting.
    #[error("`{0}` is out of its range")]
    Solver(&'static str),
}

/// Returns the solver settings with the relative tolerance `rtol`. If `atol` or `accuracy` has a default
/// value, the function replaces this value by the default for the new relative tolerance.
pub fn with_rtol(settings: SolverSettings, rtol: f64) -> SolverSettings {
    let (usual, next) = (settings.with_rtol(settings.rtol), settings.with_rtol(rtol));
    let follow = |given: f64, usual: f64, next: f64| if given == usual { next } else { given };
    SolverSettings {
        rtol,
        atol: follow(settings.atol, usual.atol, next.atol),
        accuracy: follow(settings.accuracy, usual.accuracy, next.accuracy),
        ..settings
    }
}

impl Plan {
    /// Returns the plan with the given tolerances and limits of the solver.
    ///
    /// # Errors
    /// [`ChangeError::Solver`] if a setting is out of range.
    pub fn with_solver(mut self, solver: SolverSettings) -> Result<Plan, ChangeError> {
        let is_allowed = |setting: &Setting| match setting.kind {
            SettingKind::Number { below, get, .. } => get(&solver) > 0.0 && get(&solver) < below,
            SettingKind::Count { get, .. } => get(&solver) > 0,
            SettingKind::Flag { .. } => true,
        };
        if let Some(wrong) = SolverSettings::TABLE.iter().find(|setting| !is_allowed(setting)) {
            return Err(ChangeError::Solver(wrong.name));
        }
        self.space.solver = solver;
        Ok(self)
    }

    /// Returns the plan with `parameter` set to `value`: a number in SI units, or the index of an option. The new value
    /// has no standard error.
    ///
    /// # Errors
    /// - [`ChangeError::Varied`], [`ChangeError::Derived`] or [`ChangeError::Resonance`] if an axis, a
    ///   formula or the resonance determines the value.
    /// - [`ChangeError::Value`] if the parameter does not accept the value.
    pub fn with_parameter(mut self, parameter: usize, value: f64) -> Result<Plan, ChangeError> {
        self.check_free(parameter)?;
        let known = &self.parameters()[parameter];
        let value = value::of_number(known, value).map_err(|error| ChangeError::Value {
            parameter: known.name.to_owned(),
            error: Box::new(error),
        })?;
        self.space.base[parameter] = Value::Given(value);
        self.space.uncertainty.set(parameter, None);
        self.space.differences.remove(parameter);
        self.space.with_units.note(parameter, Some(false));
        Ok(self)
    }

    /// Returns the plan whose rows contain only the given measures, in the given order.
    ///
    /// `names` are names of columns of the model or of measures of the plan.
    ///
    /// # Errors
    /// [`ChangeError::NoColumn`] if there is no such column, or a column is listed twice.
    pub fn with_columns(mut self, names: &[String]) -> Result<Plan, ChangeError> {
        let known: Vec<&str> = self.measured().collect();
        let mut columns = Vec::with_capacity(names.len());
        for name in names {
            let index = known.iter().position(|known| known == name).filter(|index| !columns.contains(index));
            columns.push(index.ok_or_else(|| ChangeError::NoColumn(name.clone()))?);
        }
        self.space.output.columns = Some(columns);
        Ok(self)
    }

    /// Returns the plan whose rows contain derivatives of measures with respect to the parameters `by`, per
    /// SI unit of the parameter.
    ///
    /// The derivatives are for the measures that [`Plan::with_columns`] selected. Without a selection, the
    /// derivatives are for all measures that are numbers.
    ///
    /// # Errors
    /// - [`ChangeError::NoDerivative`] or [`ChangeError::NoSlope`] for a parameter or a measure without derivatives.
    /// - [`ChangeError::AtResonance`] if rows are computed at the resonance of each design.
    /// - [`ChangeError::NoMotions`] if the model does not compute motions.
    pub fn with_slopes(mut self, by: Vec<usize>) -> Result<Plan, ChangeError> {
        self.states_of_motions()?;
        for &parameter in &by {
            let known = &self.parameters()[parameter];
            let is_derived = self.derived().parameters().any(|derived| derived == parameter);
            let standing = self.standing(parameter);
            let is_input = self.body().is_some_and(|body| body.has_input(standing));
            gradient::check(known, is_derived, is_input, self.unset(standing))
                .map_err(|reason| ChangeError::NoDerivative(known.name.to_owned(), reason))?;
        }
        let models = self.rows().columns().len();
        let is_number = |of: usize| match of.checked_sub(models) {
            None => true,
            Some(place) => self.measures()[place].kind() == expression::Kind::Number,
        };
        let all = 0..models + self.measures().len();
        let of: Vec<usize> = match &self.output().columns {
            Some(chosen) => chosen.iter().copied().filter(|of| all.contains(of)).collect(),
            None => all.filter(|&of| is_number(of)).collect(),
        };
        if let Some(flag) = of.iter().find(|&&of| !is_number(of)) {
            return Err(ChangeError::NoSlope(self.measures()[flag - models].name.clone()));
        }
        self.space.gradient = Some(Gradient { of, with_respect_to: by, per: Per::Unit });
        Ok(self)
    }

    /// Returns the plan whose motions begin at the given states. `states` contains one state for each point,
    /// or `None` for a motion that begins at rest. In the new plan, all points are selected for computation.
    ///
    /// # Errors
    /// - [`ChangeError::States`] if the number of states differs from the number of points.
    /// - [`ChangeError::AtResonance`] or [`ChangeError::OfBody`] if rows are computed at the resonance or at
    ///   hover, or contain the damping matrix.
    /// - [`ChangeError::NoMotions`] if the model does not compute motions.
    pub fn with_initial_states(mut self, states: Vec<Option<Vec<f64>>>) -> Result<Plan, ChangeError> {
        self.check_motions()?;
        if states.len() as u64 != self.len() {
            return Err(ChangeError::States(states.len(), self.len()));
        }
        self.initial_states = states;
        self.selection = Selection::All;
        Ok(self.without_refinement())
    }

    /// Returns the plan whose rows also contain the state of the motion at the beginning of a drive period.
    /// You can use the state as the initial state of motions in a different plan.
    ///
    /// # Errors
    /// [`ChangeError::AtResonance`], [`ChangeError::OfBody`] or [`ChangeError::NoMotions`] if rows cannot
    /// contain states.
    pub fn with_states(mut self) -> Result<Plan, ChangeError> {
        self.states = self.check_motions()?;
        Ok(self)
    }

    /// Returns the names of all measures: first the columns of the model, then the measures of the plan.
    pub fn measured(&self) -> impl Iterator<Item = &str> + '_ {
        let of_model = self.rows().columns().iter().map(|column| column.name.as_str());
        of_model.chain(self.measures().iter().map(|own| own.name.as_str()))
    }

    /// Returns the plan without its preset. Parameters in `given` are set or varied later. Parameters that
    /// are not in `given` have their default values, or are computed from other parameters.
    ///
    /// # Errors
    /// [`ChangeError::Missing`] if a parameter is not in `given`, has no default, and is not computed from
    /// other parameters.
    pub fn without_preset(mut self, given: &[usize]) -> Result<Plan, ChangeError> {
        let mut missing = Vec::new();
        let parameters = self.space.robot.parameters();
        for (index, parameter) in parameters.iter().enumerate().filter(|(index, _)| !given.contains(index)) {
            match parameter.kind {
                Kind::Following(_, follows) => self.space.base[index] = Value::Follows(follows),
                Kind::Number(_) | Kind::Choice(_) if !parameter.default.is_nan() => {
                    self.space.base[index] = Value::Given(parameter.default);
                }
                Kind::Number(_) | Kind::Choice(_) => missing.push(parameter.name.to_owned()),
            }
        }
        if !missing.is_empty() {
            return Err(ChangeError::Missing(missing));
        }
        self.space.preset = "";
        Ok(self)
    }

    /// Returns the plan with an additional axis, whose values a program provides. The new axis is before all
    /// other axes.
    ///
    /// `parameters` contains the same number of values for each parameter. In the new plan, all points are
    /// selected for computation. If a value is out of range, the row of its point has the status `invalid`.
    ///
    /// # Errors
    /// - [`ChangeError::Varied`], [`ChangeError::Derived`] or [`ChangeError::Resonance`] if an axis, a
    ///   formula or the resonance determines the value of a parameter.
    /// - [`ChangeError::Input`] if the search for hover changes one of the parameters.
    /// - [`ChangeError::TooManyPoints`] if the plan would have too many points.
    pub fn crossed_with(mut self, parameters: Vec<(usize, Vec<f64>)>) -> Result<Plan, ChangeError> {
        for (place, (parameter, _)) in parameters.iter().enumerate() {
            self.check_free(*parameter)?;
            if self.body().is_some_and(|body| body.has_input(*parameter)) {
                return Err(ChangeError::Input(self.parameters()[*parameter].name.to_owned()));
            }
            if parameters[..place].iter().any(|(before, _)| before == parameter) {
                return Err(ChangeError::Varied(self.parameters()[*parameter].name.to_owned()));
            }
        }
        let parameters =
            parameters.into_iter().map(|(parameter, list)| (parameter, Values::Unchecked(list))).collect();
        self.space.axes = self.space.axes.crossed_with(Axis::new(parameters))?;
        Ok(self.with_new_axes())
    }

    /// Removes the axis that varies only `parameter`. Returns the new plan, and the values of the removed
    /// axis if there was such an axis.
    ///
    /// In the new plan, all points are selected for computation.
    pub fn without_axis(mut self, parameter: usize) -> (Plan, Option<Values>) {
        let (axes, values) = self.space.axes.without(parameter);
        self.space.axes = axes;
        (self.with_new_axes(), values)
    }

    /// Returns the plan that computes a response for each point. In a response, the parameter of `along`
    /// first rises and then falls.
    ///
    /// The plan must not have an axis of this parameter.
    pub fn following(mut self, along: Along) -> Plan {
        self.followed = Some(along);
        self
    }

    /// Returns a copy of the plan that computes only the points of one shard.
    pub fn with_shard(mut self, shard: Shard) -> Plan {
        self.selection = Selection::Shard(shard);
        self
    }

    /// Returns a copy of the plan that computes only the points in `list`. The list contains indices of
    /// points in ascending order.
    ///
    /// # Errors
    /// [`ChangeError::NoPoint`] if an index is not less than [`Plan::len`], or not larger than the previous index.
    pub fn with_points(mut self, list: Vec<u64>) -> Result<Plan, ChangeError> {
        let falls = list.windows(2).find(|two| two[0] >= two[1]).map(|two| two[1]);
        if let Some(index) = falls.or(list.last().copied().filter(|last| *last >= self.len())) {
            return Err(ChangeError::NoPoint(index));
        }
        self.selection = Selection::Listed(list);
        Ok(self)
    }

    /// Returns a copy of the plan that computes all points.
    pub fn with_all_points(mut self) -> Plan {
        self.selection = Selection::All;
        self
    }

    /// Returns a copy of the plan with additional measures after the existing measures. The rows of the new
    /// plan have no derivatives.
    pub(crate) fn with_measures(mut self, more: Vec<OwnMeasure>) -> Plan {
        self.space.measures.extend(more);
        self.space.gradient = None;
        self
    }

    /// Returns the plan with the given conditions instead of its earlier conditions.
    pub(crate) fn with_conditions(mut self, conditions: Vec<Condition>) -> Plan {
        self.space.conditions = conditions;
        self
    }

    /// Returns the plan of one point with the given values of the varied parameters. The values may be out of
    /// range.
    ///
    /// # Errors
    /// [`ChangeError::TooManyPoints`], which does not occur for one point.
    pub(crate) fn at(mut self, varied: &[(usize, f64)]) -> Result<Plan, ChangeError> {
        let values = varied.iter().map(|(parameter, value)| (*parameter, Values::Unchecked(vec![*value])));
        self.space.axes = Axes::new(vec![Axis::new(values.collect())])?;
        self.initial_states = Vec::new();
        Ok(self.with_new_axes())
    }

    /// Returns the plan of one point, in which no parameter is varied or derived. `values` contains the value
    /// of each parameter. If a value is NaN, the parameter keeps the value that it has in the plan. A changed
    /// value has no standard error.
    #[must_use]
    pub fn of_point(mut self, values: &[f64]) -> Plan {
        for (parameter, value) in values.iter().enumerate().filter(|(_, value)| !value.is_nan()) {
            if self.space.base[parameter] != Value::Given(*value) {
                self.space.base[parameter] = Value::Given(*value);
                self.space.uncertainty.set(parameter, None);
            }
        }
        self.space.axes = Axes::none();
        self.space.differences = Differences::default();
        self.space.derived = Derived::default();
        self.space.conditions = Vec::new();
        self.space.resonance = None;
        self.initial_states = Vec::new();
        self.with_new_axes()
    }

    /// Returns the plan without the search for hover and without the damping matrix. The inputs of the
    /// vehicle then have the values that the points contain.
    #[must_use]
    pub(crate) fn without_hover(mut self) -> Plan {
        self.space.body = None;
        self.with_new_axes()
    }

    /// Returns the plan with all its points selected, for use after a change of the axes. A refinement of the
    /// plan is removed, because the refinement refers to the earlier axes.
    fn with_new_axes(self) -> Plan {
        Plan { selection: Selection::All, ..self.without_refinement() }
    }

    /// Returns the plan without its refinement, and without the points that the refinement added.
    #[must_use]
    pub fn without_refinement(mut self) -> Plan {
        self.space.refine = None;
        self.added = Arc::default();
        self
    }

    /// Returns the plan with additional points at the end. Each point is a list of positions, one along each
    /// axis.
    ///
    /// # Errors
    /// [`ChangeError::NoPoint`] with the index of the first point that is outside the ranges of the axes.
    pub fn with_added(self, more: Vec<Vec<f64>>) -> Result<Plan, ChangeError> {
        if let Some(place) = more.iter().position(|positions| !self.axes().contain(positions)) {
            return Err(ChangeError::NoPoint(self.len() + place as u64));
        }
        Ok(self.with_added_unchecked(more))
    }

    /// Returns the plan with additional points at the end. Each point must be within the ranges of the axes.
    pub(crate) fn with_added_unchecked(mut self, more: Vec<Vec<f64>>) -> Plan {
        Arc::make_mut(&mut self.added).extend(more);
        self
    }

    /// Checks that motions of the plan can begin at given states, and returns the names of the state's
    /// components.
    ///
    /// # Errors
    /// [`ChangeError::AtResonance`], [`ChangeError::OfBody`] or [`ChangeError::NoMotions`] if motions cannot
    /// begin at given states.
    pub fn check_motions(&self) -> Result<Vec<String>, ChangeError> {
        let states = self.states_of_motions()?;
        if self.body().is_some() { Err(ChangeError::OfBody) } else { Ok(states) }
    }

    /// Returns the names of the state's components in the motions of the model.
    fn states_of_motions(&self) -> Result<Vec<String>, ChangeError> {
        if self.resonance().is_some() {
            return Err(ChangeError::AtResonance);
        }
        let gradients = self.simulator().gradients();
        gradients.map(Gradients::states).map_err(|error| ChangeError::NoMotions(error.to_string()))
    }

    /// Returns an error if `parameter` cannot be set or varied, because an axis, a formula or the resonance
    /// determines its value.
    fn check_free(&self, parameter: usize) -> Result<(), ChangeError> {
        let name = || self.parameters()[parameter].name.to_owned();
        if self.axes().varied().any(|varied| varied == parameter) {
            return Err(ChangeError::Varied(name()));
        }
        if self.derived().parameters().any(|derived| derived == parameter) {
            return Err(ChangeError::Derived(name()));
        }
        if self.base()[parameter] == Value::Resonance {
            return Err(ChangeError::Resonance(name()));
        }
        Ok(())
    }
}
