//! The timed loops, generic over lanes and compiled for the instructions they are to use.

use core::hint::black_box;
use core::time::Duration;
use std::time::Instant;

use flap_core::model::Model;
use flap_core::model::bimorph::Bimorph;
use flap_core::model::direct_drive::{DirectDrive, FlowDirection};
use flap_core::model::four_bar::FourBar;
use flap_core::num::{Arithmetic, Kernel, Lanes, OneLane, PerLane, Simd, Unfused, Vector};
use flap_core::ode::Ode;
use flap_core::ode::norm::error_squared;
use flap_core::ode::step::Step;
use flap_core::simulate::preset;

const BIMORPH: Bimorph = Bimorph::SINE;
const DIRECT_DRIVE: DirectDrive = DirectDrive::SINE;
const DIRECT_DRIVE_BLADES: DirectDrive = DirectDrive { flow: FlowDirection::Blade, ..DirectDrive::SINE };
const FOUR_BAR: FourBar = FourBar::SINE;

/// Function values per iteration.
pub(crate) const VALUES: usize = 1024;

/// A piece of work that is timed.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Work {
    /// Sines and cosines of [`VALUES`] numbers.
    SinCos,
    /// Exponentials of [`VALUES`] numbers.
    Exp,
    /// Logarithms of [`VALUES`] numbers.
    Ln,
    /// One right-hand side with its inputs.
    Rhs(Equations),
    /// One step of the direct-drive model and the norm of its error.
    Step,
}

/// Whose right-hand side.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Equations {
    Bimorph,
    DirectDrive,
    /// With a direction of flow for each blade element.
    DirectDriveBlades,
    FourBar,
}

impl Equations {
    pub(crate) const ALL: [Equations; 4] =
        [Equations::Bimorph, Equations::DirectDrive, Equations::DirectDriveBlades, Equations::FourBar];
}

impl Work {
    /// The name in reports.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Work::SinCos => "sin_cos",
            Work::Exp => "exp",
            Work::Ln => "ln",
            Work::Rhs(Equations::Bimorph) => "rhs-bimorph",
            Work::Rhs(Equations::DirectDrive) => "rhs-direct-drive",
            Work::Rhs(Equations::DirectDriveBlades) => "rhs-direct-drive-blades",
            Work::Rhs(Equations::FourBar) => "rhs-four-bar",
            Work::Step => "step",
        }
    }

    /// True for an elementary function of [`VALUES`] numbers.
    pub(crate) fn is_function(self) -> bool {
        matches!(self, Work::SinCos | Work::Exp | Work::Ln)
    }
}

/// The numbers that a piece of work computes with.
#[derive(Clone, Copy)]
pub(crate) enum Numbers {
    Lanes,
    /// Of one class, in a function with the instructions enabled.
    Scalars(Arithmetic),
}

/// Iterations of a piece of work. Results in their time.
#[derive(Clone, Copy)]
pub(crate) struct Timed {
    pub(crate) work: Work,
    pub(crate) numbers: Numbers,
    pub(crate) iterations: u64,
}

impl Kernel for Timed {
    type Output = Duration;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Duration {
        let Timed { work, numbers, iterations } = self;
        match numbers {
            Numbers::Lanes => time::<Vector<S>>(simd, work, iterations),
            Numbers::Scalars(Arithmetic::Fused) => time::<f64>(OneLane::new(), work, iterations),
            Numbers::Scalars(Arithmetic::Unfused) => time::<Unfused>(OneLane::new(), work, iterations),
        }
    }
}

#[inline(always)]
fn time<R: Lanes>(token: R::Token, work: Work, iterations: u64) -> Duration {
    match work {
        Work::SinCos => time_function(&values::<R>(token, -10.0, 10.0), iterations, R::sin_cos),
        Work::Exp => time_function(&values::<R>(token, -10.0, 10.0), iterations, R::exp),
        Work::Ln => time_function(&values::<R>(token, 1e-3, 10.0), iterations, R::ln),
        Work::Rhs(Equations::Bimorph) => time_rhs::<R, _>(token, &BIMORPH, "jafferis2016", iterations),
        Work::Rhs(Equations::DirectDrive) => {
            time_rhs::<R, _>(token, &DIRECT_DRIVE, "ozaki2018-large", iterations)
        }
        Work::Rhs(Equations::DirectDriveBlades) => {
            time_rhs::<R, _>(token, &DIRECT_DRIVE_BLADES, "ozaki2018-large", iterations)
        }
        Work::Rhs(Equations::FourBar) => time_rhs::<R, _>(token, &FOUR_BAR, "arabagi2013-75hz", iterations),
        Work::Step => {
            let model = &DIRECT_DRIVE;
            let Scene { c, h, side, y, atol } = scene::<R, _>(token, model, "ozaki2018-large");
            let k1 = model.rhs(&c, &model.input(&c, h), side, &y);
            let mut step = Step::new(y, k1);
            let begin = Instant::now();
            for _ in 0..iterations {
                step.attempt(model, &c, black_box(h), h, side);
                let error = error_squared(&step.error, [&y, &step.y[6]], &atol, h.lit(1e-6));
                black_box((&step, error));
            }
            begin.elapsed()
        }
    }
}

/// Times `function`, which must be `#[inline(always)]` to be compiled for the lanes' instructions.
#[inline(always)]
fn time_function<R: Lanes, T>(values: &[R], iterations: u64, function: impl Fn(R) -> T) -> Duration {
    let begin = Instant::now();
    for _ in 0..iterations {
        for &x in black_box(values) {
            black_box(function(x));
        }
    }
    begin.elapsed()
}

#[inline(always)]
fn time_rhs<R: Lanes, M: Model<4>>(token: R::Token, model: &M, preset: &str, iterations: u64) -> Duration {
    let Scene { c, h, side, y, .. } = scene::<R, M>(token, model, preset);
    let begin = Instant::now();
    for _ in 0..iterations {
        let (t, y) = black_box((h, y));
        black_box(model.rhs(&c, &model.input(&c, t), side, &y));
    }
    begin.elapsed()
}

/// [`VALUES`] numbers from `low` to `high`.
#[inline(always)]
fn values<R: Lanes>(token: R::Token, low: f64, high: f64) -> Vec<R> {
    let mut values = vec![R::splat(token, 0.0); VALUES / R::LANES];
    for i in 0..VALUES {
        let value = low + (high - low) * i as f64 / (VALUES - 1) as f64;
        values[i / R::LANES].set_lane(i % R::LANES, value);
    }
    values
}

/// A state in mid-stroke, with what goes with it.
struct Scene<R, C> {
    c: C,
    h: R,
    side: R,
    y: [R; 4],
    atol: [R; 4],
}

#[inline(always)]
fn scene<R: Lanes, M: Model<4>>(token: R::Token, model: &M, published: &str) -> Scene<R, M::Constants<R>> {
    let (_, published) = preset(published).expect("a preset");
    let start = model.start(&(published.values)()).expect("published parameters are possible");
    let side = R::splat(token, 1.0);
    let mut y = [side; 4];
    let mut atol = [side; 4];
    for i in 0..4 {
        y[i] = side.lit(start.scale[i]);
        atol[i] = side.lit(start.scale[i] * 1e-8);
    }
    Scene {
        c: M::Constants::<R>::fill(side, &start.constants),
        h: side.lit(start.span * 0.02),
        side,
        y,
        atol,
    }
}
