//! Distributions of the values of sampled parameters, and the quantiles of the normal distribution.

#![expect(clippy::excessive_precision, reason = "coefficients as published")]

/// A distribution of values in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// Listed values, which are equally likely.
    Among(Vec<f64>),
    /// Uniform distribution between two values.
    Uniform {
        /// Smallest value.
        from: f64,
        /// Largest value.
        to: f64,
    },
    /// Uniform distribution on a logarithmic scale between two values of the same sign.
    LogUniform {
        /// Smallest value.
        from: f64,
        /// Largest value.
        to: f64,
    },
    /// Normal distribution, truncated at finite bounds.
    Normal {
        /// Mean before truncation.
        mean: f64,
        /// Standard deviation before truncation.
        sd: f64,
        /// Smallest value, which may be minus infinity.
        from: f64,
        /// Largest value, which may be infinity.
        to: f64,
    },
}

impl Distribution {
    /// Returns the quantile of the distribution for the probability `u`. `u` must be more than 0 and less
    /// than 1.
    pub fn quantile(&self, u: f64) -> f64 {
        match self {
            Distribution::Among(values) => {
                let wanted = libm::floor(u * values.len() as f64);
                let found = values.iter().enumerate().take_while(|(place, _)| *place as f64 <= wanted).last();
                found.map_or(f64::NAN, |(_, value)| *value)
            }
            Distribution::Uniform { from, to } => from + (to - from) * u,
            Distribution::LogUniform { from, to } => from * libm::pow(to / from, u),
            Distribution::Normal { mean, sd, from, to } => {
                let (low, high) = ((from - mean) / sd, (to - mean) / sd);
                // Probabilities close to 1 lose digits, so the upper tail is mirrored.
                let z = if low > 0.0 {
                    -quantile(between(cumulative(-low), cumulative(-high), u))
                } else {
                    quantile(between(cumulative(low), cumulative(high), u))
                };
                (mean + sd * z).clamp(*from, *to)
            }
        }
    }

    /// Returns false for a truncated normal distribution whose probability between its bounds is zero in
    /// double precision.
    pub fn is_possible(&self) -> bool {
        match self {
            Distribution::Normal { mean, sd, from, to } => {
                let (low, high) = ((from - mean) / sd, (to - mean) / sd);
                cumulative(high) - cumulative(low) > 0.0 || cumulative(-low) - cumulative(-high) > 0.0
            }
            _ => true,
        }
    }
}

fn between(from: f64, to: f64, u: f64) -> f64 {
    from + (to - from) * u
}

/// Returns the probability of values below `z` in the standard normal distribution.
pub(super) fn cumulative(z: f64) -> f64 {
    0.5 * libm::erfc(-z * std::f64::consts::FRAC_1_SQRT_2)
}

/// Returns the quantile of the standard normal distribution for the probability `p`, to about 16 digits.
///
/// The algorithm is AS 241, function PPND16, of Wichura, "The percentage points of the normal distribution",
/// Applied Statistics 37, 477 (1988).
pub(crate) fn quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return q * ratio(&CENTRE, r);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    let r = libm::sqrt(-libm::log(tail));
    let size = if r <= 5.0 { ratio(&NEAR, r - 1.6) } else { ratio(&FAR, r - 5.0) };
    if q < 0.0 { -size } else { size }
}

/// Returns the quotient of two polynomials. The coefficients are in the order of rising powers of `x`.
fn ratio([above, below]: &[[f64; 8]; 2], x: f64) -> f64 {
    let polynomial = |coefficients: &[f64; 8]| coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c);
    polynomial(above) / polynomial(below)
}

/// Coefficients for probabilities `p` from 0.075 to 0.925.
const CENTRE: [[f64; 8]; 2] = [
    [
        3.387_132_872_796_366_608,
        1.331_416_678_917_843_774_5e2,
        1.971_590_950_306_551_442_7e3,
        1.373_169_376_550_946_112_5e4,
        4.592_195_393_154_987_145_7e4,
        6.726_577_092_700_870_085_3e4,
        3.343_057_558_358_812_810_5e4,
        2.509_080_928_730_122_672_7e3,
    ],
    [
        1.0,
        4.231_333_070_160_091_125_2e1,
        6.871_870_074_920_579_083e2,
        5.394_196_021_424_751_107_7e3,
        2.121_379_430_158_659_586_7e4,
        3.930_789_580_009_271_061e4,
        2.872_908_573_572_194_267_4e4,
        5.226_495_278_852_854_561e3,
    ],
];

/// Coefficients for the tails of the normal distribution, down to probabilities of about 1e-11.
const NEAR: [[f64; 8]; 2] = [
    [
        1.423_437_110_749_683_577_34,
        4.630_337_846_156_545_295_9,
        5.769_497_221_460_691_405_5,
        3.647_848_324_763_204_605_04,
        1.270_458_252_452_368_382_58,
        2.417_807_251_774_506_117_7e-1,
        2.272_384_498_926_918_458_33e-2,
        7.745_450_142_783_414_076_4e-4,
    ],
    [
        1.0,
        2.053_191_626_637_758_821_87,
        1.676_384_830_183_803_849_4,
        6.897_673_349_851_000_045_5e-1,
        1.481_039_764_274_800_745_9e-1,
        1.519_866_656_361_645_719_66e-2,
        5.475_938_084_995_344_946e-4,
        1.050_750_071_644_416_843_24e-9,
    ],
];

/// Coefficients for the far tails of the normal distribution.
const FAR: [[f64; 8]; 2] = [
    [
        6.657_904_643_501_103_777_2,
        5.463_784_911_164_114_369_9,
        1.784_826_539_917_291_335_8,
        2.965_605_718_285_048_912_3e-1,
        2.653_218_952_657_612_309_3e-2,
        1.242_660_947_388_078_438_6e-3,
        2.711_555_568_743_487_578_15e-5,
        2.010_334_399_292_288_132_65e-7,
    ],
    [
        1.0,
        5.998_322_065_558_879_376_9e-1,
        1.369_298_809_227_358_053_1e-1,
        1.487_536_129_085_061_485_25e-2,
        7.868_691_311_456_132_591e-4,
        1.846_318_317_510_054_681_8e-5,
        1.421_511_758_316_445_888_7e-7,
        2.044_263_103_389_939_785_64e-15,
    ],
];
