//! Elementary functions against the C library's, and lanes against scalars.

use flap_core::num::{Arithmetic, Backend, Kernel, Lanes, Real, Simd, Unfused, Vector};

/// Arguments that cover quadrants, signs, exponents and both sides of rounding boundaries.
fn arguments(from: f64, to: f64) -> Vec<f64> {
    let n = 20_000;
    (0..=n).map(|i| from + (to - from) * f64::from(i) / f64::from(n)).collect()
}

#[test]
fn sine_and_cosine_are_accurate_to_1e_15() {
    for x in arguments(-20.0, 20.0).into_iter().chain(arguments(-1e6, 1e6)) {
        let (sin, cos) = Real::sin_cos(x);
        assert!((sin - f64::sin(x)).abs() < 4e-16, "sin {x}: {sin}");
        assert!((cos - f64::cos(x)).abs() < 4e-16, "cos {x}: {cos}");
        assert_eq!(Real::sin(x), sin, "sin {x} alone");
        let (unfused, _) = Unfused(x).sin_cos();
        assert!((unfused.0 - f64::sin(x)).abs() < 5e-16, "sin {x} without fused multiply-add: {}", unfused.0);
    }
}

#[test]
fn sine_and_cosine_are_exact_at_zero() {
    assert_eq!(Real::sin_cos(0.0_f64), (0.0, 1.0));
}

#[test]
fn exponential_and_logarithm_are_accurate_to_a_few_roundings() {
    for x in arguments(-700.0, 700.0).into_iter().chain(arguments(-1.0, 1.0)) {
        let (actual, expected) = (Real::exp(x), f64::exp(x));
        assert!((actual / expected - 1.0).abs() < 6e-16, "exp {x}: {actual} is not {expected}");
    }
    for x in arguments(1e-3, 3.0).into_iter().chain(arguments(1.0, 1e9)).chain([1e-300, 1e300]) {
        let (actual, expected) = (Real::ln(x), f64::ln(x));
        assert!((actual - expected).abs() <= 3e-16 * expected.abs(), "ln {x}: {actual} is not {expected}");
    }
    assert_eq!(Real::ln(1.0_f64), 0.0);
}

/// Near zero, the errors are relative to the small value of e^x − 1 or ln(1 + x).
#[test]
fn exponential_less_one_and_logarithm_of_one_more_are_accurate_near_zero() {
    let small = (0..280).map(|i| 10.0_f64.powi(-i));
    let both_signs = small.flat_map(|x| [x, -x]);
    for x in both_signs.chain(arguments(-1.0, 1.0)).chain(arguments(-700.0, 700.0)) {
        let (actual, expected) = (Real::exp_m1(x), f64::exp_m1(x));
        assert!(
            (actual - expected).abs() <= 6e-16 * expected.abs(),
            "exp_m1 {x}: {actual} is not {expected}"
        );
        let x = if x > -0.999 { x } else { -0.001 * x };
        let (actual, expected) = (Real::ln_1p(x), f64::ln_1p(x));
        assert!((actual - expected).abs() <= 6e-16 * expected.abs(), "ln_1p {x}: {actual} is not {expected}");
    }
    assert_eq!((Real::exp_m1(0.0_f64), Real::ln_1p(0.0_f64)), (0.0, 0.0));
    let large = [1e3, 1e15, 1e17, 1e300];
    assert!(large.iter().all(|&x| (Real::ln_1p(x) / f64::ln_1p(x) - 1.0).abs() < 4e-16));
}

/// Returns the largest value. All values must be finite.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.inspect(|value| assert!(value.is_finite())).fold(0.0, f64::max)
}

fn linear_log2<R: Lanes>(x: R) -> R {
    x.linear_log2()
}

/// The errors of the step-size controller can have any magnitude.
#[test]
fn linear_logarithm_is_as_accurate_as_documented() {
    let mantissas = arguments(1.0, 2.0);
    let numbers = (-1022..=1022).flat_map(|k| mantissas.iter().step_by(97).map(move |m| m * 2.0_f64.powi(k)));
    let error = |x: f64| {
        let [fused, unfused] = [linear_log2(x), linear_log2(Unfused(x)).0];
        (fused - libm::log2(x)).abs().max((unfused - libm::log2(x)).abs())
    };
    let worst = largest(numbers.chain(mantissas.iter().copied()).map(error));
    assert!((0.086..0.0861).contains(&worst), "{worst}");
    for k in -1022..=1023 {
        let x = 2.0_f64.powi(k);
        assert_eq!([linear_log2(x), linear_log2(Unfused(x)).0], [f64::from(k); 2], "2^{k}");
    }
    assert_eq!(linear_log2(0.0), -1023.0);
    assert!([f64::NAN, f64::INFINITY].iter().all(|&x| (1024.0..=1025.0).contains(&linear_log2(x))));
}

#[test]
fn rough_power_of_two_is_as_accurate_as_documented() {
    let error = |x: f64| {
        let [fused, unfused] = [x.rough_exp2(), Unfused(x).rough_exp2().0];
        (fused / libm::exp2(x) - 1.0).abs().max((unfused / libm::exp2(x) - 1.0).abs())
    };
    let worst = largest(arguments(-700.0, 700.0).into_iter().chain(arguments(-3.0, 4.0)).map(error));
    assert!((1.98e-3..2.0e-3).contains(&worst), "{worst}");
    for k in -700..=700 {
        let x = f64::from(k);
        assert_eq!([x.rough_exp2(), Unfused(x).rough_exp2().0], [2.0_f64.powi(k); 2], "2^{k}");
    }
}

/// The tolerances of the error norm can have any magnitude.
#[test]
fn rough_reciprocal_is_as_accurate_as_documented() {
    let mantissas = arguments(1.0, 2.0);
    let numbers = (-1022..=1021).flat_map(|k| mantissas.iter().step_by(97).map(move |m| m * 2.0_f64.powi(k)));
    let error = |x: f64| {
        let [fused, unfused] = [x.rough_reciprocal(), Unfused(x).rough_reciprocal().0];
        (fused * x - 1.0).abs().max((unfused * x - 1.0).abs())
    };
    let worst = largest(numbers.chain(mantissas.iter().copied()).map(error));
    assert!((1.73e-3..1.74e-3).contains(&worst), "{worst}");
}

#[test]
fn rounding_to_eighths_is_to_the_nearest_and_to_the_even_one_of_two() {
    for x in arguments(-20.5, 20.5).into_iter().chain([1.0 / 16.0, 3.0 / 16.0, -5.0 / 16.0, 1e14]) {
        assert_eq!(x.round_to_eighths(), (x * 8.0).round_ties_even() / 8.0, "{x}");
    }
}

#[test]
fn rounding_is_to_the_nearest_whole_number_and_to_the_even_one_of_two() {
    for x in arguments(-20.5, 20.5).into_iter().chain([0.5, 1.5, -2.5, 1e15, -1e15]) {
        assert_eq!(Real::round_ties_even(x), f64::round_ties_even(x), "{x}");
    }
}

/// Every operation a model or the integrator uses, on one value per lane.
#[inline(always)]
fn everything<R: Lanes>(x: R) -> [R; 18] {
    let (sin, cos) = x.sin_cos();
    let positive = x.abs() + 0.1;
    let (exponent, mantissa) = positive.exponent_and_mantissa();
    [
        sin,
        cos,
        x.exp(),
        positive.ln(),
        x.exp_m1(),
        positive.ln_1p(),
        positive.sqrt(),
        x.mul_add(sin, cos),
        x.copysign(sin),
        x.min(cos),
        x.max(cos),
        R::select(x.lt(sin), x, cos) / positive,
        exponent,
        mantissa,
        mantissa.times_power_of_two(exponent),
        positive.linear_log2(),
        positive.rough_reciprocal(),
        (-x - 0.25) * (x * 3.0 + sin) - x.lit(0.7),
    ]
}

struct OnLanes<'a>(&'a [f64]);

impl Kernel for OnLanes<'_> {
    type Output = Vec<[f64; 18]>;

    fn run<S: Simd>(self, simd: S) -> Vec<[f64; 18]> {
        on_lanes(simd, self.0, everything)
    }
}

/// The results of a function of many numbers, by the lanes of `simd`.
fn on_lanes<S: Simd, const N: usize>(
    simd: S,
    numbers: &[f64],
    function: impl Fn(Vector<S>) -> [Vector<S>; N],
) -> Vec<[f64; N]> {
    let mut results = Vec::new();
    for group in numbers.chunks(Vector::<S>::LANES) {
        let mut x = Vector::<S>::splat(simd, 0.0);
        for (lane, &value) in group.iter().enumerate() {
            x.set_lane(lane, value);
        }
        let values = function(x);
        results.extend((0..group.len()).map(|lane| values.map(|v| v.lane(lane))));
    }
    results
}

/// Exponentials and logarithms, in the order of [`std_exponentials`].
struct Exponentials<'a>(&'a [f64]);

impl Kernel for Exponentials<'_> {
    type Output = Vec<[f64; 4]>;

    fn run<S: Simd>(self, simd: S) -> Vec<[f64; 4]> {
        on_lanes(simd, self.0, |x| [x.exp(), x.exp_m1(), x.ln(), x.ln_1p()])
    }
}

/// The values of the standard library, with subnormal numbers as zero. The logarithm of a negative number is NaN.
fn std_exponentials(x: f64) -> [f64; 4] {
    let flushed = |number: f64| if number.is_subnormal() { 0.0 } else { number };
    let ln = if x.is_subnormal() && x > 0.0 { f64::NEG_INFINITY } else { x.ln() };
    [flushed(x.exp()), x.exp_m1(), ln, x.ln_1p()]
}

/// Every binary exponent with both signs, and both sides of each limit.
fn all_magnitudes() -> Vec<f64> {
    let limits = [
        709.0,
        709.436_139_303_1,
        709.782_712_893_384,
        -708.396_418_532_264_1,
        -745.2,
        -40.0,
        -1.0,
        1.0,
        0.5,
    ];
    let around = limits.into_iter().flat_map(|limit: f64| {
        let (mut up, mut down) = (limit, limit);
        (0..40).flat_map(move |_| {
            (up, down) = (up.next_up(), down.next_down());
            [limit, up, down]
        })
    });
    let powers = (-1074..=1023).flat_map(|k| [1.0, 1.37, 1.999].map(|m| m * libm::exp2(f64::from(k))));
    let edges = [
        0.0,
        f64::MIN_POSITIVE,
        f64::MIN_POSITIVE.next_down(),
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
        720.0,
        760.0,
        800.0,
    ];
    let positive = powers.chain(edges).chain(arguments(0.0, 800.0));
    positive.flat_map(|x| [x, -x]).chain(around).chain([f64::from_bits(0x7ff8_0000_0000_0abc)]).collect()
}

#[test]
fn exponentials_and_logarithms_of_any_number_are_those_of_the_standard_library() {
    let numbers = all_magnitudes();
    for backend in Backend::available() {
        for (&x, found) in numbers.iter().zip(backend.dispatch(Exponentials(&numbers))) {
            for ((name, found), expected) in
                ["exp", "exp_m1", "ln", "ln_1p"].into_iter().zip(found).zip(std_exponentials(x))
            {
                // Of a subnormal result the last bit may be lost.
                let close = (found - expected).abs() <= 7e-16 * expected.abs() + f64::from_bits(1);
                assert!(
                    found == expected || close || found.is_nan() && expected.is_nan(),
                    "{name} of {x:e} with {backend}: {found:e} is not {expected:e}"
                );
            }
        }
    }
}

/// Models call the unchecked functions with arguments that are always normal numbers.
#[test]
fn unchecked_exponentials_and_logarithms_have_the_same_bits() {
    for x in arguments(-700.0, 700.0).into_iter().chain(arguments(-1.0, 1.0)) {
        assert_eq!(x.exp_of_ordinary().to_bits(), Real::exp(x).to_bits(), "exp {x}");
        assert_eq!(x.exp_m1_of_ordinary(), Real::exp_m1(x), "exp_m1 {x}");
        assert_eq!(x.exp().ln_of_normal().to_bits(), Real::ln(x.exp()).to_bits(), "ln {x}");
        assert_eq!(x.abs().ln_1p_of_normal().to_bits(), Real::ln_1p(x.abs()).to_bits(), "ln_1p {x}");
    }
}

#[test]
fn lanes_equal_scalars_bit_for_bit() {
    let x = arguments(-30.0, 30.0);
    for backend in Backend::available() {
        for (&x, lane) in x.iter().zip(backend.dispatch(OnLanes(&x))) {
            let scalar = match backend.arithmetic() {
                Arithmetic::Fused => everything(x),
                Arithmetic::Unfused => everything(Unfused(x)).map(|v| v.0),
            };
            assert_eq!(lane.map(f64::to_bits), scalar.map(f64::to_bits), "{backend} at {x}");
        }
    }
}

struct Masks;

impl Kernel for Masks {
    type Output = ();

    fn run<S: Simd>(self, simd: S) {
        let lanes = Vector::<S>::LANES;
        let all = (1_u64 << lanes) - 1;
        for bits in [0, 1, all, 0b1010_1010_1010_1010 & all, 1 << (lanes - 1)] {
            let mask = Vector::<S>::mask(simd, bits);
            assert_eq!(Vector::<S>::bits(mask), bits);
            let even = Vector::<S>::mask(simd, 0x5555 & all);
            assert_eq!(Vector::<S>::bits(mask & even), bits & 0x5555);
            assert_eq!(Vector::<S>::bits(mask | even), bits | (0x5555 & all));
            assert_eq!(Vector::<S>::bits(!mask), !bits & all);
            let [yes, no] = [1.0, 2.0].map(|c| Vector::<S>::splat(simd, c));
            let chosen = Vector::<S>::select(mask, yes, no);
            for lane in 0..lanes {
                assert_eq!(chosen.lane(lane), if bits >> lane & 1 == 1 { 1.0 } else { 2.0 });
            }
        }
    }
}

#[test]
fn masks_hold_one_bit_per_lane() {
    for backend in Backend::available() {
        backend.dispatch(Masks);
    }
}

#[test]
fn comparisons_with_nan_are_false() {
    assert!(!Real::lt(f64::NAN, 1.0) && !Real::lt(1.0, f64::NAN));
    assert_eq!(Real::min(f64::NAN, 1.0), 1.0);
    assert_eq!(Real::max(f64::NAN, 1.0), 1.0);
}

#[test]
fn instruction_sets_are_found_by_name() {
    let best = Backend::best();
    assert_eq!(Backend::by_name(best.name()).map(Backend::name), Some(best.name()));
    assert!(Backend::by_name("abacus").is_none());
    let names: Vec<_> = Backend::available().into_iter().map(Backend::name).collect();
    assert_eq!(names[0], best.name());
}
