//! Claims that are computed from Table I without a simulation.

use flap_core::model::ExperimentModel;
use flap_core::model::bimorph::{Bimorph, Constants, Params, secant_stiffness};

use super::{constants, transmission};
use crate::claim::{Claim, about, between, closely, said};

pub(super) fn claims() -> Vec<Claim> {
    [masses(), transmissions(), lift_and_drag(), strains()].into_iter().flatten().collect()
}

fn masses() -> Vec<Claim> {
    let mass = |p: &Params| 1e6 / constants(p).inverse_m_e;
    let with_air = mass(&transmission(1.0));
    let without_air = mass(&Params { added_inertia_stroke: 0.0, ..transmission(1.0) });
    [
        (
            "effective mass at the actuator with the inertia of the wing, without the added mass of the air",
            570.0,
            without_air,
        ),
        (
            "effective mass at the actuator with the inertia of the wing and the added mass of the air",
            700.0,
            with_air,
        ),
    ]
    .map(|(statement, published, mass)| {
        said("III-A", statement, format!("~{published} mg")).is(
            &about(published, 5.0),
            mass,
            format!("effective mass {mass:.0} mg"),
        )
    })
    .into()
}

fn transmissions() -> Vec<Claim> {
    let stiffness = secant_stiffness(&constants(&transmission(1.0)), 240e-6);
    let mode = |ratio: f64| Bimorph::modes(&constants(&transmission(ratio)))[0].frequency;
    let [t_1, t_2, t_3] = [1.0, 0.8, 0.6].map(mode);
    vec![
        said(
            "II-C",
            "stiffness of the transmission at a deflection of 480 µm peak to peak, equal to the \
             stiffness of the actuator",
            "197.7 N/m",
        )
        .is(&closely(197.7, 0.05), stiffness, format!("stiffness {stiffness:.1} N/m")),
        said(
            "III-A",
            "undamped natural frequency of design T₂ divided by the natural frequency of design T₁, if \
             the resonance frequency is proportional to 1/T",
            "1.25",
        )
        .is(
            &about(1.25, 0.005),
            t_2 / t_1,
            format!(
                "ratio of the natural frequencies {:.2} (design T₁: {t_1:.1} Hz, design T₂: {t_2:.1} Hz)",
                t_2 / t_1
            ),
        ),
        said(
            "III-A",
            "undamped natural frequency of design T₃ divided by the natural frequency of design T₁, if \
             the resonance frequency is proportional to 1/T",
            "1.67",
        )
        .is(
            &about(1.0 / 0.6, 0.005),
            t_3 / t_1,
            format!(
                "ratio of the natural frequencies {:.2} (design T₁: {t_1:.1} Hz, design T₃: {t_3:.1} Hz)",
                t_3 / t_1
            ),
        ),
    ]
}

fn lift_and_drag() -> Vec<Claim> {
    let fitted = constants(&transmission(1.0));
    // The coefficients of Fig. 3.
    let drawn =
        constants(&Params { drag_coefficient_max: 3.4, drag_coefficient_min: 0.4, ..transmission(1.0) });
    let angle = angle_of_largest(|degrees| lift_to_drag(&drawn, degrees));
    let angle_fitted = angle_of_largest(|degrees| lift_to_drag(&fitted, degrees));
    let before = 0.5 * (lift_to_drag(&drawn, 45.0) + lift_to_drag(&drawn, 50.0));
    let gain = lift_to_drag(&drawn, 70.0) / before;
    let angle_lift = angle_of_largest(mean_lift);
    vec![
        said("II-A, Fig. 3", "pitch at which the ratio of lift to drag is largest", "~70°").is(
            &about(70.0, 0.5),
            angle,
            format!(
                "pitch {angle:.1}° with the drag coefficients of Fig. 3, {angle_fitted:.1}° with the \
                 fitted coefficients of Table I"
            ),
        ),
        said(
            "III-A, Fig. 3",
            "ratio of lift to drag at a pitch of 70° divided by the ratio at a pitch of 45° to \
             50°",
            "about 1.5",
        )
        .is(
            &about(1.5, 0.05),
            gain,
            format!("lift-to-drag ratio at 70° is {gain:.2} times the ratio at 45° to 50°"),
        ),
        said(
            "II-A",
            "peak pitch that gives the largest mean lift if stroke and pitch have a phase \
             difference of 90°",
            "51°",
        )
        .is(
            &closely(51.0, 0.5),
            angle_lift,
            format!("peak pitch {angle_lift:.1}° for the largest mean lift"),
        ),
    ]
}

/// Returns the lift-to-drag ratio at the pitch `degrees`.
fn lift_to_drag(c: &Constants<f64>, degrees: f64) -> f64 {
    let (sin, cos) = (2.0 * degrees).to_radians().sin_cos();
    c.b_l * sin / (c.b_1 + c.b_2 * cos)
}

/// Returns a number proportional to the mean lift of a sinusoidal stroke, ⟨cos²θ sin(2ψ_m cos θ)⟩, with the
/// peak pitch ψ_m in degrees.
fn mean_lift(degrees: f64) -> f64 {
    let n = 400;
    (0..n)
        .map(|i| (core::f64::consts::PI * (f64::from(i) + 0.5) / f64::from(n)).sin())
        .map(|speed| speed * speed * (2.0 * degrees.to_radians() * speed).sin())
        .sum()
}

/// Returns the angle (degrees, in steps of 0.01) at which the function `f` is largest.
fn angle_of_largest(f: impl Fn(f64) -> f64) -> f64 {
    let angles = (0..9000).map(|i| 0.01 * f64::from(i));
    angles.max_by(|a, b| f(*a).total_cmp(&f(*b))).expect("there are angles")
}

fn strains() -> Vec<Claim> {
    let improved = surface_strain_per_degree(&Params::jafferis2016_improved());
    let previous = surface_strain_per_degree(&transmission(1.0));
    let strain = 100.0 * improved * 92.0;
    let equal = improved * 92.0 / previous;
    let typical = 0.066e-2 / previous;
    vec![
        said(
            "Table II, IV",
            "largest strain of the actuator at a stroke of 92° peak to peak, with a transmission \
             ratio of 2666 rad/m",
            "0.079 %",
        )
        .is(
            &closely(0.079, 0.0005),
            strain,
            format!("strain {strain:.4} % at the outer faces of the piezoelectric plates"),
        ),
        said(
            "IV",
            "stroke of the previous vehicle, peak to peak, at the actuator strain that the \
             redesigned vehicle has at a stroke of 92°",
            "115°",
        )
        .is(
            &closely(115.0, 0.5),
            equal,
            format!("stroke {equal:.1}° of the previous vehicle, peak to peak"),
        ),
        said(
            "Table II, IV",
            "excess of the stroke of 115° over the typical stroke of the previous vehicle (at an \
             actuator strain of 0.066 %)",
            "15 to 25 %",
        )
        .is(
            &between(15.0, 25.0),
            100.0 * (equal / typical - 1.0),
            format!(
                "stroke of {equal:.1}° exceeds the typical stroke of {typical:.1}° by {:.1} %",
                100.0 * (equal / typical - 1.0)
            ),
        ),
    ]
}

/// Returns the peak-to-peak strain of the plates' outer faces per degree of peak-to-peak stroke.
fn surface_strain_per_degree(p: &Params) -> f64 {
    let c = constants(p);
    0.5_f64.to_radians() / c.ratio * c.strain_per_tip * c.surface_strain_ratio
}
