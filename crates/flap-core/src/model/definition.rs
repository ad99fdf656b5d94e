//! The definition of a model: everything that the rows of a sweep require.

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
    /// Name in grid files, such as `direct-drive`.
    pub name: &'static str,
    /// Description in one line: the mechanism and the paper.
    pub doc: &'static str,
    /// The parameter table. A point is one `f64` per entry, see [`Parameter`].
    pub parameters: &'a [Parameter<'a>],
    /// Published parameter sets.
    pub presets: &'static [Preset],
    /// Sign of the pitch convention, for pictures of the wing.
    ///
    /// 1 if, at a positive pitch, the trailing edge lags a wing that moves to positive stroke; −1 if it leads.
    pub pitch_sign: i8,
    /// True if the model computes the [`load`](Model::load) of the wing. Rows then contain the load if
    /// [`SolverSettings::loads`](crate::simulate::SolverSettings::loads) is set.
    pub loads: bool,
    /// Parameters that depend on a user-defined wing. `None` if the model does not support such a wing.
    pub wing: Option<WingParameters>,
}

/// Function that returns the parameters that depend on a user-defined wing, by name, in SI units.
pub type WingParameters = fn(&Wing) -> Vec<(&'static str, f64)>;

impl Description<'static> {
    /// Returns the description of a model with a pitch sign of 1, without loads and without user-defined wings.
    pub const fn new(
        name: &'static str,
        doc: &'static str,
        parameters: &'static [Parameter<'static>],
        presets: &'static [Preset],
    ) -> Description<'static> {
        Description { name, doc, parameters, presets, pitch_sign: 1, loads: false, wing: None }
    }
}

/// A column computed from the signals `S` of a periodic orbit of the model `M` with constants `C`.
///
/// Give the type a name, `type Column = Derived<MyModel, Constants<f64>, Signals>`, and begin each column with
/// `Column::new`: with `Derived::new`, the compiler cannot infer the argument types of the closure.
#[derive(Debug)]
pub struct Derived<M, C, S: SignalSet> {
    /// Column name.
    pub name: &'static str,
    /// Unit in words.
    pub unit: &'static str,
    /// Description in one line.
    pub doc: &'static str,
    /// Computes the value in `unit` from the model, the point's constants and the signals over the orbit's drive
    /// period.
    ///
    /// A signal has its mean and the quantities that its own [measures](super::Signal::measures) require. The others
    /// are NaN.
    pub value: fn(&M, &C, &S::Of<SignalCycle>) -> f64,
    /// Form of this column in the rows of a vehicle.
    pub over_wings: OverWings,
}

impl<M, C, S: SignalSet> Derived<M, C, S> {
    /// Returns a column with this name, unit, description and value.
    pub const fn new(
        name: &'static str,
        unit: &'static str,
        doc: &'static str,
        value: fn(&M, &C, &S::Of<SignalCycle>) -> f64,
    ) -> Derived<M, C, S> {
        Derived { name, unit, doc, value, over_wings: OverWings::Omitted }
    }

    /// Returns the same column with this form in the rows of a vehicle.
    #[must_use]
    pub const fn over_wings(self, over_wings: OverWings) -> Derived<M, C, S> {
        Derived { over_wings, ..self }
    }
}

/// The symmetry of a point with signals `S`: if y(t) solves its equations, so does 2 · centre − y(t + T/2).
///
/// T is the drive period. A switching function changes its sign under this map. A constant part of the drive or an
/// even harmonic breaks the symmetry, unless it only shifts the centre. The search compares the equations at two
/// states, and integrates whole periods where they differ. It does not check `second_half`: compare rows with and
/// without [`SolverSettings::symmetry`](crate::simulate::SolverSettings::symmetry).
#[derive(Clone, Copy, Debug)]
pub struct Symmetry<S: SignalSet, const N: usize> {
    /// State about which motions are mirrored.
    pub centre: [f64; N],
    /// Computes the sums of the signals over the second half of a mirrored period from the sums over the first half.
    ///
    /// Use [`Totals::negated`] for signals that change their sign, such as angles, and [`Totals::repeated`] for
    /// others, such as lift and power. `None` if the sums do not follow from the first half: then whole periods are
    /// measured.
    pub second_half: Option<SecondHalf<S>>,
}

/// Function from the sums of the signals `S` over the first half of a period to the sums over the second half.
pub type SecondHalf<S> = fn(&SignalsOf<S, Totals<f64>>) -> SignalsOf<S, Totals<f64>>;

/// An instant of a motion of N states, with inputs `I`.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a, R, I, const N: usize> {
    /// Inputs, see [`Ode::input`].
    pub input: &'a I,
    /// Side of the switching surface, see [`Ode::rhs`].
    pub side: R,
    /// States.
    pub y: &'a [R; N],
    /// Derivatives of the states.
    pub dy: &'a [R; N],
}

/// A periodically driven model with N states, whose signals are measured over a drive period.
pub trait Model<const N: usize>: Ode<N> + Clone + PartialEq + 'static {
    /// Measured signals, see [`signals!`](crate::signals).
    type Signals: SignalSet;

    /// Name, description, parameters and properties.
    const DESCRIPTION: Description<'static>;
    /// Names of the states with their units: columns of trajectories.
    const STATES: [&'static str; N];
    /// Columns computed from the signals.
    const DERIVED: &'static [Derived<Self, Self::Constants<f64>, Self::Signals>];
    /// True if the signals depend on the derivatives of the states, [`Instant::dy`]. If false, these derivatives may
    /// be NaN between the stages of a step.
    const SIGNALS_OF_SLOPES: bool = true;

    /// Returns the variant of the model for a point: the choices on which its equations branch, such as the shape of
    /// the drive.
    ///
    /// Points of equal variants share lanes.
    fn variant(&self, values: &[f64]) -> Self {
        let _ = values;
        self.clone()
    }

    /// Returns this variant with the additional terms of `other`.
    ///
    /// Terms are additional if, where they are zero, the equations equal the equations without them. Derivatives with
    /// respect to terms that are zero at a point use such a variant.
    fn with_terms_of(&self, other: &Self) -> Self {
        let _ = other;
        self.clone()
    }

    /// Returns the start of a point's run: constants, initial state, drive period, and typical sizes of the states.
    ///
    /// `values` contains one value per parameter. For the sizes see [`Start::scale`].
    ///
    /// Grid files check each value against its [`Range`](crate::parameter::Range). A program that reads values from
    /// elsewhere must check them, or this function does so with [`Invalid::unless_within`].
    ///
    /// # Errors
    /// [`Invalid`] if the combination of parameter values is impossible, or a derived constant is not finite: see
    /// [`Invalid::unless_finite`].
    fn start(&self, values: &[f64]) -> Result<Start<Self::Constants<f64>, N>, Invalid>;

    /// Returns the symmetry of a point with these constants. By default there is none, and all periods are integrated
    /// in full.
    fn symmetry(&self, c: &Self::Constants<f64>) -> Option<Symmetry<Self::Signals, N>> {
        let _ = c;
        None
    }

    /// Returns the drive of a point. The signals' harmonics refer to its phase.
    fn drive<R: Real>(c: &Self::Constants<R>) -> &DriveConstants<R>;

    /// Returns the constants of a point with another motion of the body. By default the constants do not depend on it.
    ///
    /// The constants must belong to a point with motion of the body.
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

    /// Returns the signals of a [plain](Ode::is_plain) variant, with the bits of [`Model::signals`].
    #[inline(always)]
    fn plain_signals<R: Real>(
        &self,
        c: &Self::Constants<R>,
        at: Instant<'_, R, Self::Input<R>, N>,
    ) -> SignalsOf<Self::Signals, R> {
        self.signals(c, at)
    }

    /// Replaces the means of powers by the sums of their losses over a periodic orbit, see [`SignalCycle::balance`].
    ///
    /// By default all means remain.
    fn balance_energy(cycle: &mut SignalsOf<Self::Signals, SignalCycle>) {
        let _ = cycle;
    }

    /// Returns the relative difference of two means of a power after [`Model::balance_energy`]. Only integration
    /// errors make it nonzero.
    ///
    /// Points with an audit above `accuracy` are integrated again. By default 0.
    fn energy_audit(cycle: &SignalsOf<Self::Signals, SignalCycle>) -> f64 {
        let _ = cycle;
        0.0
    }

    /// Returns the load of the air on the wing at an instant, for vehicles.
    #[inline(always)]
    fn load<R: Real>(&self, c: &Self::Constants<R>, at: Instant<'_, R, Self::Input<R>, N>) -> Load<R> {
        let _ = c;
        Load::unknown(at.side)
    }

    /// Returns the time integral of the load at the wing's shoulder (N·s, N·m·s) over a step, see [`Load::at_shoulder`]. Override
    /// it if the load jumps within steps.
    #[inline(always)]
    fn impulse<R: Lanes>(&self, c: &Self::Constants<R>, attempt: &Attempt<'_, R, N>) -> [R; 6] {
        self.impulse_of_stages(c, attempt)
    }

    /// Returns the time integral of a load that does not jump within the step, from the stages of the step.
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

    /// Returns false if measures of this variant jump within steps at times that depend on the parameters. Then they have no
    /// derivatives on fixed steps.
    fn has_slopes(&self) -> bool {
        true
    }

    /// Returns the number of parts into which each step is divided to find extrema of the signals.
    ///
    /// Choose more than one if signals change faster than the motion, which determines the steps.
    #[inline(always)]
    fn parts(&self) -> u32 {
        1
    }
}
