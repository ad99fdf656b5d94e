//! Right-hand sides of models at the states of a reference table: every lane has the same results as scalars.

use flap_core::drive::Wave;
use flap_core::num::{Arithmetic, Backend, Kernel, Lanes, PerLane, Real, Scalar, Simd, Unfused, Vector};
use flap_core::ode::Ode;

use crate::data::Record;

/// A model that `W` voltages drive.
pub(crate) trait Driven<const W: usize>: Ode<4> {
    /// The inputs of the right-hand side under these voltages.
    fn under<R: Real>(c: &Self::Constants<R>, voltages: &[Wave<R>; W]) -> Self::Input<R>;
}

/// A state under given voltages.
pub(crate) struct Case<M: Driven<W>, const W: usize> {
    pub(crate) model: M,
    pub(crate) constants: M::Constants<f64>,
    pub(crate) voltages: [Wave<f64>; W],
    pub(crate) side: f64,
    pub(crate) y: [f64; 4],
    pub(crate) record: Record,
}

impl<M: Driven<W>, const W: usize> Case<M, W> {
    /// The derivative on scalars.
    fn slope<R: Scalar>(&self) -> [f64; 4] {
        let c = M::Constants::<R>::fill(R::new(0.0), &self.constants);
        let voltages = self.voltages.map(|v| Wave::from([v.value, v.rate, v.bend].map(R::new)));
        let u = M::under(&c, &voltages);
        self.model.rhs(&c, &u, R::new(self.side), &self.y.map(R::new)).map(R::value)
    }
}

/// Derivatives of all cases, with a different case in every lane.
struct OnLanes<'a, M: Driven<W>, const W: usize>(&'a [Case<M, W>]);

impl<M: Driven<W>, const W: usize> Kernel for OnLanes<'_, M, W> {
    type Output = Vec<[f64; 4]>;

    fn run<S: Simd>(self, simd: S) -> Vec<[f64; 4]> {
        let mut derivatives = Vec::new();
        for group in self.0.chunks(Vector::<S>::LANES) {
            let zero = Vector::<S>::splat(simd, 0.0);
            let mut c = M::Constants::<Vector<S>>::fill(zero, &group[0].constants);
            let mut voltages = [Wave::from([zero; 3]); W];
            let mut side = zero;
            let mut y = [zero; 4];
            for (lane, case) in group.iter().enumerate() {
                c.set(lane, &case.constants);
                for (voltage, one) in voltages.iter_mut().zip(case.voltages) {
                    voltage.value.set_lane(lane, one.value);
                    voltage.rate.set_lane(lane, one.rate);
                    voltage.bend.set_lane(lane, one.bend);
                }
                side.set_lane(lane, case.side);
                y.set(lane, &case.y);
            }
            let dy = group[0].model.rhs(&c, &M::under(&c, &voltages), side, &y);
            derivatives.extend((0..group.len()).map(|lane| dy.map(|d| d.lane(lane))));
        }
        derivatives
    }
}

/// Fails unless the derivatives from the lanes of every backend equal the derivatives of scalars to the last bit.
pub(crate) fn assert_lanes_equal_scalars<M: Driven<W>, const W: usize>(cases: &[Case<M, W>]) {
    for backend in Backend::available() {
        let lanes = backend.lanes();
        assert!(lanes >= 4 || backend.name() == "scalar", "{backend} has {lanes} lanes");
        let lanes = backend.dispatch(OnLanes(cases));
        assert_eq!(lanes.len(), cases.len());
        for (case, lane) in cases.iter().zip(lanes) {
            let scalar = match backend.arithmetic() {
                Arithmetic::Fused => case.slope::<f64>(),
                Arithmetic::Unfused => case.slope::<Unfused>(),
            };
            assert_eq!(lane.map(f64::to_bits), scalar.map(f64::to_bits), "{backend}, {}", case.record.name);
        }
    }
}

/// Fails unless derivatives of both arithmetic classes agree to rounding, relative to the derivative or to `floor`, if
/// `floor` is larger.
pub(crate) fn assert_classes_agree<M: Driven<W>, const W: usize>(cases: &[Case<M, W>], floor: f64) {
    for case in cases {
        let (fused, unfused) = (case.slope::<f64>(), case.slope::<Unfused>());
        for i in 0..4 {
            let error = (fused[i] - unfused[i]).abs();
            assert!(error <= 1e-11 * fused[i].abs().max(floor), "{}, {i}: {error:e}", case.record.name);
        }
    }
}
