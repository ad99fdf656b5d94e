use super::sobol::Sobol;
use super::*;

fn sample(method: Method, count: u64, dimensions: usize) -> SamplePoints {
    SamplePoints::new(method, 7, count, dimensions)
}

fn coordinates(sample: &SamplePoints, dimension: usize) -> Vec<f64> {
    (0..sample.count()).map(|index| sample.coordinate(index, dimension)).collect()
}

/// The expected numbers are coordinates times 2^32 from `scipy.stats.qmc.Sobol(128, scramble=False, bits=32)`
/// of SciPy 1.17.1.
#[test]
fn sobol_points_before_scrambling_are_those_of_scipy() {
    const DIMENSIONS: [usize; 6] = [1, 2, 3, 10, 64, 128];
    let cases: [(u64, [u32; 6]); 10] = [
        (0, [0, 0, 0, 0, 0, 0]),
        (1, [1 << 31; 6]),
        (2, [3_221_225_472, 1_073_741_824, 1_073_741_824, 3_221_225_472, 3_221_225_472, 1_073_741_824]),
        (3, [1_073_741_824, 3_221_225_472, 3_221_225_472, 1_073_741_824, 1_073_741_824, 3_221_225_472]),
        (4, [1_610_612_736, 1_610_612_736, 2_684_354_560, 2_684_354_560, 536_870_912, 2_684_354_560]),
        (5, [3_758_096_384, 3_758_096_384, 536_870_912, 536_870_912, 2_684_354_560, 536_870_912]),
        (6, [2_684_354_560, 536_870_912, 3_758_096_384, 1_610_612_736, 3_758_096_384, 3_758_096_384]),
        (7, [536_870_912, 2_684_354_560, 1_610_612_736, 3_758_096_384, 1_610_612_736, 1_610_612_736]),
        (1000, [943_718_400, 415_236_096, 2_227_175_424, 297_795_584, 1_916_796_928, 2_336_227_328]),
        (1023, [4_194_304, 3_233_808_384, 2_629_828_608, 3_653_238_784, 171_966_464, 3_007_315_968]),
    ];
    for (index, expected) in cases {
        let found = DIMENSIONS.map(|dimension| Sobol::new(dimension - 1, 0).plain(index));
        assert_eq!(found, expected, "point {index}");
    }
}

/// Each of 2^k equal intervals contains one of the first 2^k points, along every dimension. Each of 2^k equal
/// boxes over the first two dimensions also contains one of the first 2^k points. Scrambling preserves this
/// even distribution of the points.
#[test]
fn scrambled_sobol_points_are_as_even_as_plain_ones() {
    let sample = sample(Method::Sobol, 1 << 32, 128);
    for dimension in [0, 1, 2, 50, 127] {
        for power in [1, 4, 10] {
            let count = 1_u64 << power;
            let mut intervals: Vec<u64> =
                (0..count).map(|index| interval(sample.coordinate(index, dimension), count)).collect();
            intervals.sort_unstable();
            assert!(intervals.iter().copied().eq(0..count), "dimension {dimension}, {count} points");
        }
    }
    for (wide, high) in [(1, 64), (2, 32), (8, 8), (32, 2)] {
        let place = |index| {
            let (x, y) = (sample.coordinate(index, 0), sample.coordinate(index, 1));
            interval(x, wide) * high + interval(y, high)
        };
        let mut boxes: Vec<u64> = (0..64).map(place).collect();
        boxes.sort_unstable();
        assert!(boxes.iter().copied().eq(0..64), "{wide} by {high} boxes");
    }
}

/// The error of a mean is smaller than for random points, whose error would be 0.29 / sqrt(4096) = 0.0045.
#[test]
fn scrambled_sobol_points_integrate() {
    let sample = sample(Method::Sobol, 4096, 5);
    let product = |index| (0..5).map(|dimension| 2.0 * sample.coordinate(index, dimension)).product::<f64>();
    let mean = (0..4096).map(product).sum::<f64>() / 4096.0;
    assert!((mean - 1.0).abs() < 2e-3, "{mean}");
}

fn interval(coordinate: f64, count: u64) -> u64 {
    (0..count).rev().find(|k| coordinate >= *k as f64 / count as f64).expect("a coordinate from 0 to 1")
}

#[test]
fn each_interval_of_a_latin_hypercube_has_one_point() {
    for count in [1, 2, 3, 8, 100, 1000] {
        let sample = sample(Method::LatinHypercube, count, 3);
        for dimension in 0..3 {
            let mut intervals: Vec<u64> =
                coordinates(&sample, dimension).into_iter().map(|c| interval(c, count)).collect();
            assert!(count < 8 || !intervals.is_sorted(), "{count} points in order");
            intervals.sort_unstable();
            assert!(intervals.into_iter().eq(0..count), "{count} points, dimension {dimension}");
        }
    }
}

/// The points of a Latin hypercube are in random order: for three points, all six orders occur about equally
/// often.
#[test]
fn latin_hypercubes_are_shuffled_fairly() {
    let mut counts = std::collections::BTreeMap::new();
    for seed in 0..6000 {
        let sample = SamplePoints::new(Method::LatinHypercube, seed, 3, 1);
        let order: Vec<u64> = coordinates(&sample, 0).into_iter().map(|c| interval(c, 3)).collect();
        *counts.entry(order).or_insert(0_i32) += 1;
    }
    assert_eq!(counts.len(), 6);
    // Limit: four standard deviations.
    assert!(counts.values().all(|count| (count - 1000).abs() < 116), "{counts:?}");
}

/// The coordinates along different dimensions of a sample are not correlated.
#[test]
fn dimensions_are_independent() {
    for method in [Method::Sobol, Method::LatinHypercube, Method::Random] {
        let sample = sample(method, 4096, 3);
        for (a, b) in [(0, 1), (1, 2), (0, 2)] {
            let centred = |dimension| coordinates(&sample, dimension).into_iter().map(|c| c - 0.5);
            let covariance = centred(a).zip(centred(b)).map(|(a, b)| a * b).sum::<f64>() / 4096.0;
            assert!((covariance * 12.0).abs() < 0.06, "{method:?} {a} {b} {covariance}");
        }
    }
}

/// Samples are reproducible, and different seeds give different points.
#[test]
fn samples_are_reproducible() {
    let known = [(Method::Sobol, SOBOL), (Method::LatinHypercube, LATIN_HYPERCUBE), (Method::Random, RANDOM)];
    for (method, expected) in known {
        let found = [(0, 0), (1, 0), (99, 0), (99, 1)]
            .map(|(index, dimension)| sample(method, 100, 2).coordinate(index, dimension));
        assert_eq!(found, expected, "{method:?}");
        let other = SamplePoints::new(method, 8, 100, 2);
        assert_ne!(other.coordinate(0, 0), expected[0], "{method:?}");
    }
}

const SOBOL: [f64; 4] =
    [0.972_725_778_236_053_9, 0.363_141_780_137_084_4, 0.534_941_883_641_295_1, 0.797_871_145_769_022_4];
const LATIN_HYPERCUBE: [f64; 4] =
    [0.591_577_960_970_206_2, 0.761_679_893_627_721, 0.121_894_619_523_426_55, 0.029_991_633_794_009_535];
const RANDOM: [f64; 4] =
    [0.157_796_097_020_619_47, 0.167_989_362_772_101_3, 0.189_461_952_342_654_95, 0.999_163_379_400_953_5];

#[test]
fn the_ends_are_never_met() {
    for method in [Method::Sobol, Method::LatinHypercube, Method::Random] {
        for count in [1, 2, 1 << 32] {
            let sample = sample(method, count, 2);
            for index in (0..count).step_by(1 << 22) {
                let coordinate = sample.coordinate(index, 1);
                assert!(coordinate > 0.0 && coordinate < 1.0, "{method:?} {index} of {count}: {coordinate}");
            }
        }
    }
}

/// Returns the mean and the standard deviation of 100 000 quantiles of `distribution` at equally spaced
/// probabilities.
fn moments(distribution: &Distribution) -> (f64, f64) {
    let count = 100_000;
    let values = (0..count).map(|i| distribution.quantile((f64::from(i) + 0.5) / f64::from(count)));
    let (sum, squares) = values.fold((0.0, 0.0), |(sum, squares), v| (sum + v, squares + v * v));
    let mean = sum / f64::from(count);
    (mean, (squares / f64::from(count) - mean * mean).sqrt())
}

#[test]
fn distributions_have_their_moments() {
    let free = (f64::NEG_INFINITY, f64::INFINITY);
    let normal = |mean, sd, (from, to)| Distribution::Normal { mean, sd, from, to };
    let log_mean = 9.0 / 10.0_f64.ln();
    let log_sd = (99.0 / (2.0 * 10.0_f64.ln()) - log_mean * log_mean).sqrt();
    let root_12 = 12.0_f64.sqrt();
    let cases = [
        (Distribution::Uniform { from: -1.0, to: 3.0 }, 1.0, 4.0 / root_12),
        (Distribution::LogUniform { from: 1.0, to: 10.0 }, log_mean, log_sd),
        (Distribution::LogUniform { from: -10.0, to: -1.0 }, -log_mean, log_sd),
        (Distribution::Among(vec![1.0, 2.0, 6.0]), 3.0, (14.0_f64 / 3.0).sqrt()),
        (normal(10.0, 2.0, free), 10.0, 2.0),
        // scipy.stats.truncnorm, SciPy 1.17.1.
        (normal(10.0, 2.0, (8.0, 11.0)), 9.586_737_563_876_934, 0.831_320_056_504_095_5),
        (normal(0.0, 1.0, (4.0, 6.0)), 4.225_546_931_806_202, 0.215_771_077_395_430_2),
        (normal(5.0, 1.0, (free.0, 5.0)), 4.202_115_439_197_135, 0.602_810_274_989_086_9),
    ];
    for (distribution, mean, sd) in cases {
        let found = moments(&distribution);
        let close = (found.0 - mean).abs() < 1e-4 && (found.1 - sd).abs() < 2e-4;
        assert!(close, "{distribution:?}: {found:?}");
    }
}

/// The expected numbers are from `scipy.stats.norm.ppf` and `truncnorm.ppf` of SciPy 1.17.1.
#[test]
fn normal_quantiles() {
    let cases = [
        (1e-300, -37.047_096_299_361_2),
        (1e-20, -9.262_340_089_798_409),
        (1e-9, -5.997_807_015_007_686_5),
        (0.01, -2.326_347_874_040_840_8),
        (0.0749, -1.440_238_267_527_963_5),
        (0.075, -1.439_531_470_938_456_3),
        (0.3, -0.524_400_512_708_040_9),
        (0.5, 0.0),
        (0.7, 0.524_400_512_708_040_7),
        (0.975, 1.959_963_984_540_054),
    ];
    for (p, expected) in cases {
        let found = distribution::quantile(p);
        assert!((found - expected).abs() <= 3e-15 * f64::max(1.0, -expected), "{p}: {found}");
        assert!((distribution::cumulative(expected) / p - 1.0).abs() < 1e-12, "{p}");
    }
    let truncated = Distribution::Normal { mean: 0.0, sd: 1.0, from: 4.0, to: 6.0 };
    assert!((truncated.quantile(0.1) - 4.024_863_254_132_875).abs() < 1e-12);
}

#[test]
fn truncation_is_exact_and_noticed_when_impossible() {
    let normal = |from, to| Distribution::Normal { mean: 0.0, sd: 1.0, from, to };
    for distribution in [normal(-0.1, 0.1), normal(30.0, 31.0), normal(-31.0, -30.0)] {
        assert!(distribution.is_possible());
        let Distribution::Normal { from, to, .. } = distribution else { unreachable!() };
        for u in [1e-16, 0.3, 0.7, 1.0 - 1e-16] {
            let value = distribution.quantile(u);
            assert!(value >= from && value <= to, "{value}");
        }
    }
    assert!(!normal(50.0, 51.0).is_possible());
    assert!(!normal(-51.0, -50.0).is_possible());
}
