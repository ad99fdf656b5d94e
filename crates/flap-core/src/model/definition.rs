//! The definition of a model: all that rows of a sweep need.

use super::load::Load;
use super::signal::{OverWings, SignalCycle};
use super::signals::{SignalSet, SignalsOf};
use super::totals::Totals;
use crate::aero::Wing;
use crate::drive::DriveConstants;
use crate::num::Real;
use crate::ode::{Ode, Start};
use crate::parameter::{Invalid, Parameter, Preset};

/// Name, meaning and parameters of a model.
#[derive(Clone, Copy, Debug)]
pub struct Description {
    /// Name in grid files, such as `direct-drive`.
    pub name: &'static str,
    /// One line: the mechanism, and the paper.
    pub doc: &'static str,
    /// The parameter table.
    pub parameters: &'static [Parameter<'static>],
    /// The published parameter sets.
    pub presets: &'static [Preset],
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
    /// Meaning in one line.
    pub doc: &'static str,
    /// The value in `unit`, from the model, the point's constants and the signals over the orbit's drive period. A signal
    /// has its mean, and what its own [measures](super::Signal::measures) need; the rest is NaN.
    pub value: fn(&M, &C, &S::Of<SignalCycle>) -> f64,
    /// The way in which the rows of a vehicle have it.
    pub over_wings: OverWings,
}

impl<M, C, S: SignalSet> Derived<M, C, S> {
    /// A column with this name, unit, meaning and value.
    pub const fn new(
        name: &'static str,
        unit: &'static str,
        doc: &'static str,
        value: fn(&M, &C, &S::Of<SignalCycle>) -> f64,
    ) -> Derived<M, C, S> {
        Derived { name, unit, doc, value, over_wings: OverWings::Omitted }
    }

    /// The same column, which the rows of a vehicle have in this way.
    #[must_use]
    pub const fn over_wings(self, over_wings: OverWings) -> Derived<M, C, S> {
        Derived { over_wings, ..self }
    }
}

/// The symmetry of a point with signals `S`: from half a drive period later on, its motions can go on as they began, mirrored.
/// If y(t) solves its equations, so does 2 · centre − y(t + T/2). A switching function changes its sign as well.
///
/// A constant part of the drive or an even harmonic breaks the symmetry, unless it only shifts the centre. The search compares
/// the equations at two states, and integrates whole periods where they differ. It does not check `second_half`: compare rows
/// with and without [`SolverSettings::symmetry`](crate::simulate::SolverSettings::symmetry).
#[derive(Clone, Copy, Debug)]
pub struct Symmetry<S: SignalSet, const N: usize> {
    /// The state about which motions are mirrored.
    pub centre: [f64; N],
    /// The sums of the signals over the second half of a mirrored period, from those over the first: [`Totals::negated`] of
    /// signals that change their sign, such as angles, and [`Totals::repeated`] of others, such as lift and power. `None` if they
    /// do not follow from these; then whole periods are measured.
    pub second_half: Option<SecondHalf<S>>,
}

/// Sums of the signals `S` over the second half of a period, from those over the first.
pub type SecondHalf<S> = fn(&SignalsOf<S, Totals<f64>>) -> SignalsOf<S, Totals<f64>>;

/// An instant of a motion of N states, with inputs `I`.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a, R, I, const N: usize> {
    /// The inputs, see [`Ode::input`].
    pub input: &'a I,
    /// The side of the switching surface, see [`Ode::rhs`].
    pub side: R,
    /// The states.
    pub y: &'a [R; N],
    /// Their derivatives.
    pub dy: &'a [R; N],
}

/// A periodically driven model with N states, whose signals are measured over a drive period.
pub trait Model<const N: usize>: Ode<N> + Clone + PartialEq + 'static {
    /// The measured signals, see [`signals!`](crate::signals).
    type Signals: SignalSet;

    /// Name, meaning and parameters.
    const DESCRIPTION: Description;
    /// Names of the states with their units, as trajectory columns.
    const STATES: [&'static str; N];
    /// Columns computed from the signals.
    const DERIVED: &'static [Derived<Self, Self::Constants<f64>, Self::Signals>];
    /// True if the signals depend on the derivatives of the states, [`Instant::dy`]. If not, they may be NaN between the
    /// stages of a step.
    const SIGNALS_OF_SLOPES: bool = true;
    /// 1 if the trailing edge lags a wing that moves to positive stroke at a positive pitch, -1 if it leads: pictures of the
    /// wing need it.
    const PITCH_SIGN: i8 = 1;
    /// True if the [`load`](Model::load) of the wing is known.
    const LOADS: bool = false;

    /// The model for a point: choices on which its equations branch, in all lanes alike, such as the shape of the drive.
    /// Points of equal variants share lanes.
    fn variant(&self, values: &[f64]) -> Self {
        let _ = values;
        self.clone()
    }

    /// The variant that has the most terms among those of equal choices. Its equations are those of this one where the other
    /// terms are zero, and so it serves for small changes of them.
    fn with_all_terms(&self) -> Self {
        self.clone()
    }

    /// The run of a point, given one value per parameter: constants, initial state, drive period, and a typical size of each
    /// state, see [`Start::scale`].
    ///
    /// Grid files check each value against its [`Range`](crate::parameter::Range). If a program takes values from
    /// elsewhere, it checks them itself, or this function does with [`Invalid::unless_within`].
    ///
    /// # Errors
    /// [`Invalid`] if parameters are impossible together, or a derived constant is not finite: see
    /// [`Invalid::together`] and [`Invalid::unless_finite`].
    fn start(&self, values: &[f64]) -> Result<Start<Self::Constants<f64>, N>, Invalid>;

    /// The symmetry of a point with these constants. By default there is none; then all periods are integrated to their end.
    fn symmetry(&self, c: &Self::Constants<f64>) -> Option<Symmetry<Self::Signals, N>> {
        let _ = c;
        None
    }

    /// The parameters that a wing of one's own decides, by name, in SI units; none if the model has no such wing.
    fn wing(wing: &Wing) -> Vec<(&'static str, f64)> {
        let _ = wing;
        Vec::new()
    }

    /// The drive of a point, to whose phase the signals' harmonics refer.
    fn drive<R: Real>(c: &Self::Constants<R>) -> &DriveConstants<R>;

    /// The signals at an instant, in SI units.
    fn signals<R: Real>(
        &self,
        c: &Self::Constants<R>,
        at: Instant<'_, R, Self::Input<R>, N>,
    ) -> SignalsOf<Self::Signals, R>;

    /// Replaces the means of powers by those of their losses over a periodic orbit, see [`SignalCycle::balance`].
    /// By default all means stay.
    fn balance_energy(cycle: &mut SignalsOf<Self::Signals, SignalCycle>) {
        let _ = cycle;
    }

    /// The relative difference of two means of a power after [`Model::balance_energy`], zero but for the integration's error.
    /// Points whose audit is larger than `accuracy` are integrated again. By default 0.
    fn energy_audit(cycle: &SignalsOf<Self::Signals, SignalCycle>) -> f64 {
        let _ = cycle;
        0.0
    }

    /// The load of the air on the wing at an instant, for vehicles.
    #[inline(always)]
    fn load<R: Real>(&self, c: &Self::Constants<R>, at: Instant<'_, R, Self::Input<R>, N>) -> Load<R> {
        let _ = c;
        Load::unknown(at.side)
    }

    /// Number of parts into which each step is divided to find the largest and smallest values of the signals. More than one
    /// if signals change faster than the motion, which chooses the steps.
    #[inline(always)]
    fn parts(&self) -> u32 {
        1
    }
}
