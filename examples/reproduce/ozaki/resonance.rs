//! Claims about resonance frequencies (section 4.2 and Figs. 9 and 10).

use super::{Type, bench, large, small};
use crate::claim::{Claim, about, closely, said};

/// Sizes of impulses (rad). The size of an impulse is the stroke amplitude that the impulse would cause if
/// the motion had only the first mode and no damping.
const IMPULSES: [f64; 3] = [0.3, 0.5, 0.8];
/// Index of the impulse after which the first stroke peak of the large actuator is nearest to 20 deg.
const MIDDLE: usize = 1;
/// Number of periods of the first mode, counted from the impulse, to which the damped sine is fitted.
const WINDOW: u32 = 4;
/// Numbers of periods of the first mode in fits over more than [`WINDOW`] periods. Fits over more periods
/// show how the fitted frequency depends on the number of periods.
const LONGER: [u32; 2] = [5, 10];

/// A published frequency (Hz), as a number and as the text that the page shows.
pub(super) struct Published {
    shown: &'static str,
    frequency: f64,
}

pub(super) const SMALL: Published = Published { shown: "209 Hz (208.5 Hz)", frequency: 208.5 };
pub(super) const LARGE: Published = Published { shown: "109 Hz (109.0 Hz)", frequency: 109.0 };
const SMALL_MEASURED: Published = Published { shown: "210 Hz", frequency: 210.0 };
const LARGE_MEASURED: Published = Published { shown: "105 Hz", frequency: 105.0 };

/// Returns claims about frequencies that the paper calculates from the motion after an impulse.
pub(super) fn calculated() -> Vec<Claim> {
    let [small, large] = [small(), large()];
    let mut claims = by_size(&small, &SMALL);
    claims.extend(by_size(&large, &LARGE));
    let ratios = IMPULSES.map(|impulse| fitted(&small, impulse, WINDOW) / fitted(&large, impulse, WINDOW));
    claims.push(
        said(
            "4.2",
            "resonance frequency of the small type divided by the resonance frequency of the \
             large type",
            "roughly 2",
        )
        .is(
            &about(2.0, 0.05),
            ratios[MIDDLE],
            format!(
                "ratio of the resonance frequencies {:.2} with an impulse of 0.5 rad, {:.2} with 0.3 rad, \
                 {:.2} with 0.8 rad, {:.2} for small motions",
                ratios[MIDDLE],
                ratios[0],
                ratios[2],
                mode(&small) / mode(&large)
            ),
        ),
    );
    claims
}

/// Returns one claim for each size of the impulse.
fn by_size(actuator: &Type, published: &Published) -> Vec<Claim> {
    let claim = |impulse: f64| {
        let swing = bench().swing(&actuator.params.to_values(), impulse, WINDOW);
        let [five, ten] = LONGER.map(|window| fitted(actuator, impulse, window));
        let what = format!(
            "calculated resonance frequency of the {} type after an impulse of {impulse:.1} rad",
            actuator.name
        );
        said("4.2, Fig. 10", what, published.shown).is(
            &closely(published.frequency, 0.5),
            swing.fit.frequency,
            format!(
                "resonance frequency of the {} type {:.1} Hz (first stroke peak {:.1}°, residual of the fit \
                 {:.0} %). Fits of 5 and 10 periods give resonance frequencies of {five:.1} and {ten:.1} Hz",
                actuator.name,
                swing.fit.frequency,
                swing.first_peak,
                100.0 * swing.fit.relative_rms
            ),
        )
    };
    IMPULSES.map(claim).into()
}

/// Returns a claim about the impulse of 0.5 rad. The text of the claim also contains the frequencies after
/// impulses of 0.3 and 0.8 rad.
pub(super) fn after_an_impulse(hypothesis: &str, actuator: &Type, published: &Published) -> Claim {
    let [weak, middle, strong] = IMPULSES.map(|impulse| fitted(actuator, impulse, WINDOW));
    said(
        "4.2, Fig. 10",
        format!(
            "calculated resonance frequency of the {} type after an impulse of 0.5 \
             rad{hypothesis}",
            actuator.name
        ),
        published.shown,
    )
    .is(
        &closely(published.frequency, 0.5),
        middle,
        format!(
            "resonance frequency of the {} type {middle:.1} Hz with an impulse of 0.5 rad, {weak:.1} Hz \
             with 0.3 rad, {strong:.1} Hz with 0.8 rad. For small motions, the resonance frequency is {:.1} Hz",
            actuator.name,
            mode(actuator)
        ),
    )
}

/// Returns the frequency (Hz) of the damped sine that is fitted to the stroke after an impulse.
fn fitted(actuator: &Type, impulse: f64, window: u32) -> f64 {
    bench().swing(&actuator.params.to_values(), impulse, window).fit.frequency
}

/// Returns the natural frequency of the first mode in small motions (Hz).
fn mode(actuator: &Type) -> f64 {
    let modes = bench().experiments().modes(&actuator.params.to_values());
    modes.expect("published parameters are possible")[0].frequency
}

/// Returns claims about measured drive frequencies at which the stroke is largest.
pub(super) fn driven() -> Vec<Claim> {
    vec![
        largest_stroke_of_small("", &small(), [190.0, 202.0]),
        largest_stroke_of_large("", &large(), [100.0, 115.0]),
    ]
}

pub(super) fn largest_stroke_of_small(hypothesis: &str, actuator: &Type, range: [f64; 2]) -> Claim {
    largest_stroke(hypothesis, actuator, range, &SMALL_MEASURED)
}

pub(super) fn largest_stroke_of_large(hypothesis: &str, actuator: &Type, range: [f64; 2]) -> Claim {
    largest_stroke(hypothesis, actuator, range, &LARGE_MEASURED)
}

/// Returns a claim about the drive frequency, within `range`, at which the stroke is largest. The voltage of
/// the measurement is unknown, so the published frequency is compared with the range between the peak
/// frequencies at two voltages.
fn largest_stroke(hypothesis: &str, actuator: &Type, range: [f64; 2], published: &Published) -> Claim {
    let [low, high] = actuator.voltages.map(|v_0| {
        let (peak, _) = actuator.response(v_0, range).peak("stroke_amplitude_deg");
        assert!(range[0] < peak && peak < range[1], "a peak at {peak} Hz may lie outside {range:?}");
        peak
    });
    let [v_low, v_high] = actuator.voltages;
    said(
        "4.2, Fig. 10",
        format!(
            "measured drive frequency at which the stroke of the {} type is largest{hypothesis}",
            actuator.name
        ),
        published.shown,
    )
    .is(
        &closely(published.frequency, 0.5),
        published.frequency.clamp(low.min(high), low.max(high)),
        format!(
            "largest stroke of the {} type at {low:.1} Hz with {v_low:.0} V, at {high:.1} Hz with {v_high:.0} \
             V",
            actuator.name
        ),
    )
}
