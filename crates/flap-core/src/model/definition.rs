//! The definition of a model: the data and the functions that flap needs to compute the rows of a sweep.

use super::load::Load;
use super::signal::{OverWings, SignalCycle};
use super::signals::{SignalSet, SignalsOf};
use super::totals::Totals;
use crate::aero::Wing;
use crate::body::BodyMotion;
use crate::drive::DriveConstants;
use crate::num::{Lanes, Real};
use crate::ode::step::Attempt;
use crate::ode::{Ode, Start, input};
use crate::parameter::{Invalid, Parameter, Preset};

/// Name, description, parameters and properties of a model.
#[derive(Clone, Copy, Debug)]
pub struct Description<'a> {
    /// Name of the model in grid files, such as `direct-drive`.
    pub name: &'static str,
    /// Description of the model in one line: the mechanism and the paper.
    pub doc: &'static str,
    /// The parameter table. A point consists of one `f64` for each parameter in the parameter table (see
    /// [`Parameter`]).
    pub parameters: &'a [Parameter<'a>],
    /// Published parameter sets.
    pub presets: &'static [Preset],
    /// Sign convention of the pitch, which flap uses in pictures of the wing.
    ///
    /// The sign is 1 if the trailing edge lags behind the leading edge at a positive pitch, while the stroke
    /// angle increases. The sign is −1 if the trailing edge leads at a positive pitch.
    pub pitch_sign: i8,
    /// True if the model implements [`Model::load`], which computes the aerodynamic force and moment on the
    /// wing. If [`SolverSettings::loads`](crate::simulate::SolverSettings::loads) is set, the rows contain
    /// the aerodynamic force and moment.
    pub loads: bool,
    /// Function that computes the parameters of a user-defined wing. The value is `None` if the model does
    /// not support user-defined wings.
    pub wing: Option<WingParameters>,
}

/// Function that returns the parameters that depend on a user-defined wing: pairs of a name and a value in SI
/// units.
pub type WingParameters = fn(&Wing) -> Vec<(&'static str, f64)>;

impl Description<'static> {
    /// Returns the description of a model. The pitch sign is 1, and the model supports neither loads nor
    /// user-defined wings.
    pub const fn new(
        name: &'static str,
        doc: &'static str,
        parameters: &'static [Parameter<'static>],
        presets: &'static [Preset],
    ) -> Description<'static> {
        Description { name, doc, parameters, presets, pitch_sign: 1, loads: false, wing: None }
    }
}

/// A column that flap computes from the signals of a periodic orbit. `M` is the type of the model, `C` is the
/// type of its constants, and `S` is its set of signals.
///
/// Define `type Column = Derived<MyModel, Constants<f64>, Signals>`, and create each column with
/// `Column::new`. With `Derived::new`, the compiler cannot infer the argument types of the closure.
#[derive(Debug)]
pub struct Derived<M, C, S: SignalSet> {
    /// Column name.
    pub name: &'static str,
    /// Unit in words.
    pub unit: &'static str,
    /// Description in one line.
    pub doc: &'static str,
    /// Function that returns the value of the column in the unit `unit`. The arguments are the model, the
    /// constants of the point, and the signals over a drive period of the orbit.
    ///
    /// The signals contain the mean of each signal, and the quantities that the
    /// [measures](super::Signal::measures) of the signal require. If no measure requires a quantity of a
    /// signal, the quantity is NaN.
    pub value: fn(&M, &C, &S::Of<SignalCycle>) -> f64,
    /// The columns that replace this column in the rows of a vehicle: one sum, one column per wing, or no
    /// column.
    pub over_wings: OverWings,
}

impl<M, C, S: SignalSet> Derived<M, C, S> {
    /// Returns a column with the given name, unit, description and function. The rows of a vehicle do not
    /// contain the column.
    pub const fn new(
        name: &'static str,
        unit: &'static str,
        doc: &'static str,
        value: fn(&M, &C, &S::Of<SignalCycle>) -> f64,
    ) -> Derived<M, C, S> {
        Derived { name, unit, doc, value, over_wings: OverWings::Omitted }
    }

    /// Returns a copy of the column with the setting `over_wings` for the rows of a vehicle.
    #[must_use]
    pub const fn over_wings(self, over_wings: OverWings) -> Derived<M, C, S> {
        Derived { over_wings, ..self }
    }
}

/// The symmetry of the equations of a point. If y(t) is a solution, 2 · centre − y(t + T/2) is also a
/// solution, where T is the drive period.
///
/// A switching function must have opposite signs for a solution and for its mirror image. A constant part of
/// the drive breaks the symmetry, unless the constant part only shifts the centre of the symmetry. An even
/// harmonic of the drive also breaks the symmetry. The search for an orbit tests the symmetry: it compares
/// the equations at a state and at the mirror image of this state. If the equations are not symmetric, the
/// search integrates whole periods. flap does not check the function `second_half`. To test `second_half`,
/// compare rows with and without [`SolverSettings::symmetry`](crate::simulate::SolverSettings::symmetry).
#[derive(Clone, Copy, Debug)]
pub struct Symmetry<S: SignalSet, const N: usize> {
    /// State at the centre of the mirror symmetry.
    pub centre: [f64; N],
    /// Function that computes the [`Totals`] of the signals over the second half of a symmetric period from
    /// the [`Totals`] over the first half.
    ///
    /// Use [`Totals::negated`] for signals with opposite signs in the two halves of a period, such as angles.
    /// Use [`Totals::repeated`] for signals that are equal in the two halves, such as lift and power. The
    /// value is `None` if the first half does not determine the integrals and extrema over the second half.
    /// If the value is `None`, flap integrates whole periods to compute the measures.
    pub second_half: Option<SecondHalf<S>>,
}

/// Function that receives the [`Totals`] of the signals `S` over the first half of a period, and returns the
/// [`Totals`] over the second half.
pub type SecondHalf<S> = fn(&SignalsOf<S, Totals<f64>>) -> SignalsOf<S, Totals<f64>>;

/// States, derivatives and inputs of a model at one instant of a motion. The model has N states and inputs of
/// the type `I`.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a, R, I, const N: usize> {
    /// Inputs, see [`Ode::input`].
    pub input: &'a I,
    /// Side of the switching surface on which the state lies: +1 or −1, see [`Ode::rhs`].
    pub side: R,
    /// States.
    pub y: &'a [R; N],
    /// Derivatives of the states.
    pub dy: &'a [R; N],
}

/// A periodically driven model with N states. flap measures the signals of the model over a drive period.
pub trait Model<const N: usize>: Ode<N> + Clone + PartialEq + 'static {
    /// Measured signals, see [`signals!`](crate::signals).
    type Signals: SignalSet;

    /// Name, description, parameters and properties of the model.
    const DESCRIPTION: Description<'static>;
    /// Names of the columns in trajectories that contain the states, for example `pitch_rad`.
    const STATES: [&'static str; N];
    /// Columns that are computed from the signals.
    const DERIVED: &'static [Derived<Self, Self::Constants<f64>, Self::Signals>];
    /// True if the signals depend on the derivatives of the states, [`Instant::dy`]. If the constant is
    /// false, [`Instant::dy`] may be NaN at times between the stages of a step.
    const SIGNALS_OF_SLOPES: bool = true;

    /// Returns the variant of the model for a point. A variant contains the options that select the form of
    /// the equations, such as the shape of the drive.
    ///
    /// flap integrates points with equal variants together, in one group of lanes.
    fn variant(&self, values: &[f64]) -> Self {
        let _ = values;
        self.clone()
    }

    /// Returns a copy of this variant whose equations also contain the additional terms of the variant
    /// `other`.
    ///
    /// A term is additional if the equations with the term at zero equal the equations without the term. If
    /// the parameter of an additional term is zero at a point, the variant of the point omits the term. To
    /// compute the derivative with respect to this parameter, flap uses a variant that contains the term.
    fn with_terms_of(&self, other: &Self) -> Self {
        let _ = other;
        self.clone()
    }

    /// Returns the data with which the simulation of a point starts: constants, initial state, drive period,
    /// and typical sizes of the states.
    ///
    /// `values` contains one value per parameter. [`Start::scale`] describes the typical sizes.
    ///
    /// If the values come from a grid file, flap has checked each value against the
    /// [`Range`](crate::parameter::Range) of its parameter. If your program reads values from another source,
    /// check the values in your program, or in this function with [`Invalid::unless_within`].
    ///
    /// # Errors
    /// Returns [`Invalid`] if the combination of parameter values is impossible, or if a derived constant is
    /// not finite (see [`Invalid::unless_finite`]).
    fn start(&self, values: &[f64]) -> Result<Start<Self::Constants<f64>, N>, Invalid>;

    /// Returns the symmetry of the equations with the constants `c`. By default, the equations have no
    /// symmetry, and flap integrates whole periods.
    fn symmetry(&self, c: &Self::Constants<f64>) -> Option<Symmetry<Self::Signals, N>> {
        let _ = c;
        None
    }

    /// Returns the drive of a point. The phases of the signals' harmonics are relative to the phase of the
    /// drive.
    fn drive<R: Real>(c: &Self::Constants<R>) -> &DriveConstants<R>;

    /// Returns a copy of the constants for the body motion `motion`. By default, the constants do not depend
    /// on the motion of the body.
    ///
    /// The constants `c` must be the constants of a point whose body moves.
    fn with_motion(c: &Self::Constants<f64>, motion: BodyMotion<f64>) -> Self::Constants<f64> {
        let _ = motion;
        *c
    }

    /// Returns the signals at an instant, in SI units.
    fn signals<R: Real>(
        &self,
        c: &Self::Constants<R>,
        at: Instant<'_, R, Self::Input<R>, N>,
    ) -> SignalsOf<Self::Signals, R>;

    /// Returns the signals of a variant for which [`Ode::is_plain`] is true. The results of this function
    /// must be bit-identical to the results of [`Model::signals`].
    #[inline(always)]
    fn plain_signals<R: Real>(
        &self,
        c: &Self::Constants<R>,
        at: Instant<'_, R, Self::Input<R>, N>,
    ) -> SignalsOf<Self::Signals, R> {
        self.signals(c, at)
    }

    /// Replaces the mean powers of a periodic orbit by the sums of the mean losses (see
    /// [`SignalCycle::balance`]).
    ///
    /// By default, the function changes no mean power.
    fn balance_energy(cycle: &mut SignalsOf<Self::Signals, SignalCycle>) {
        let _ = cycle;
    }

    /// Returns the relative difference between two computations of the same mean power, after
    /// [`Model::balance_energy`]. An integration without numerical errors would give two equal mean powers.
    ///
    /// If the energy audit exceeds the solver setting `accuracy`, flap integrates the point again. The
    /// default is 0.
    fn energy_audit(cycle: &SignalsOf<Self::Signals, SignalCycle>) -> f64 {
        let _ = cycle;
        0.0
    }

    /// Returns the aerodynamic force and moment on the wing at one instant. The forces and torques of a
    /// vehicle are computed from the loads of its wings.
    #[inline(always)]
    fn load<R: Real>(&self, c: &Self::Constants<R>, at: Instant<'_, R, Self::Input<R>, N>) -> Load<R> {
        let _ = c;
        Load::unknown(at.side)
    }

    /// Returns the time integral of the load at the wing's shoulder (N·s, N·m·s) over a step, see
    /// [`Load::at_shoulder`]. Override this function if the load of your model jumps within steps.
    #[inline(always)]
    fn impulse<R: Lanes>(&self, c: &Self::Constants<R>, attempt: &Attempt<'_, R, N>) -> [R; 6] {
        self.impulse_of_stages(c, attempt)
    }

    /// Returns the time integral of the load over a step, computed from the stages of the step. The result is
    /// accurate only if the load does not jump within the step.
    #[inline(always)]
    fn impulse_of_stages<R: Lanes>(&self, c: &Self::Constants<R>, attempt: &Attempt<'_, R, N>) -> [R; 6] {
        let Attempt { side, step, .. } = *attempt;
        attempt.integral(
            #[inline(always)]
            |stage, at| {
                let input = input(self, c, at);
                let instant = Instant { input: &input, side, y: &step.y[stage], dy: &step.k[stage] };
                self.load(c, instant).at_shoulder()
            },
        )
    }

    /// Returns false if loads or signals of this variant jump within steps, at times that depend on the
    /// parameters. If loads or signals jump within steps, flap cannot differentiate the measures while it
    /// keeps the integration steps fixed.
    fn has_slopes(&self) -> bool {
        true
    }

    /// Returns the number of parts into which each integration step is divided to find extrema of the
    /// signals.
    ///
    /// The size of the integration steps depends only on the motion. Return a number of parts above 1 if
    /// signals change faster than the motion.
    #[inline(always)]
    fn parts(&self) -> u32 {
        1
    }
}
