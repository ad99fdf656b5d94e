//! Claims about the lift as a function of the voltage, the hinge stiffness and the stiffness of the
//! slider-crank (section VI, Figs. 9, 11, 13 to 15).

use flap_core::model::four_bar::Params;

use super::{System, bench, straightness, system_30, system_75};
use crate::claim::{Claim, about, said};
use crate::points::{Response, steps};

const LIFT: &str = "lift_mean_mn";
const STROKE: &str = "stroke_pp_deg";

pub(super) fn claims() -> Vec<Claim> {
    let mut claims = vec![voltage()];
    claims.extend(hinge());
    claims.push(surface());
    claims.extend([series(system_75), series(system_30)]);
    claims
}

/// Returns the parameters of the prototype in Figs. 13 to 15.
fn at_70_hz() -> Params {
    Params { drive_frequency: 70.0, ..Params::arabagi2013_75hz() }
}

fn voltage() -> Claim {
    let response = bench().response(&steps(20.0, 200.0, 10.0), |drive_voltage_pp| {
        Params { drive_voltage_pp, ..at_70_hz() }.to_values()
    });
    let lifts = response.column(LIFT);
    let all = straightness(&lifts);
    let upper: Vec<(f64, f64)> = lifts.iter().copied().filter(|(voltage, _)| *voltage >= 100.0).collect();
    let upper = straightness(&upper);
    let at = |voltage: f64| lifts.iter().find(|(v, _)| *v == voltage).expect("it is in the response").1;
    let exponent = (at(160.0) / at(140.0)).ln() / (160.0_f64 / 140.0).ln();
    said("VI, Fig. 13", "the lift of the 75 Hz system is linear in the drive voltage", "linear").is(
        &about(1.0, 0.01),
        all,
        format!(
            "a straight line through the lift has R² = {all:.3} from 20 to 200 V, and R² = {upper:.3} \
             from 100 to 200 V. Near 150 V, the lift of the 75 Hz system is proportional to the \
             voltage to the power of {exponent:.1}"
        ),
    )
}

fn hinge() -> Vec<Claim> {
    // Micronewton metres per radian are the paper's mN·mm.
    let response = bench().response(&steps(20.0, 120.0, 1.0), |stiffness| {
        Params { hinge_stiffness: 1e-6 * stiffness, ..at_70_hz() }.to_values()
    });
    let (lifts, strokes) = (response.column(LIFT), response.column(STROKE));
    let at = |values: &[(f64, f64)], stiffness: f64| {
        values.iter().find(|(k, _)| *k == stiffness).expect("it is in the response").1
    };
    let [l_30, l_50, l_80, l_120] = [30.0, 50.0, 80.0, 120.0].map(|stiffness| at(&lifts, stiffness));
    let [s_30, s_120] = [30.0, 120.0].map(|stiffness| at(&strokes, stiffness));
    let (best, _) = response.peak(LIFT);
    vec![
        said(
            "VI, Fig. 14",
            "the lift of the 75 Hz system falls as the hinge stiffness grows from 30 to 120 mN·mm",
            "falls",
        )
        .holds(
            l_50 < l_30
                && lifts.windows(2).filter(|pair| pair[0].0 >= best).all(|pair| pair[1].1 < pair[0].1),
            format!(
                "lift {l_30:.2}, {l_50:.2}, {l_80:.2} and {l_120:.2} mN at a hinge stiffness of 30, \
                     50, 80 and 120 mN·mm. The lift is largest at a hinge stiffness of {best:.0} mN·mm"
            ),
        ),
        said("VI, Fig. 14", "the stroke of the 75 Hz system grows as the hinge stiffness grows", "grows")
            .holds(
                s_120 > s_30,
                format!(
                    "stroke {s_30:.1}° at a hinge stiffness of 30 mN·mm, {s_120:.1}° at 120 mN·mm, peak to \
                 peak"
                ),
            ),
    ]
}

fn surface() -> Claim {
    let points: Vec<[f64; 2]> = steps(80.0, 200.0, 20.0)
        .into_iter()
        .flat_map(|voltage| steps(30.0, 100.0, 10.0).into_iter().map(move |stiffness| [voltage, stiffness]))
        .collect();
    let values = points.iter().map(|&[drive_voltage_pp, stiffness]| {
        Params { drive_voltage_pp, hinge_stiffness: 1e-6 * stiffness, ..at_70_hz() }.to_values()
    });
    let lifts: Vec<f64> = bench().settle(values.collect()).iter().map(|point| point.get(LIFT)).collect();
    let planeness = planeness(&points, &lifts);
    let [low, high] = [f64::min, f64::max].map(|of| lifts.iter().copied().fold(lifts[0], of));
    said(
        "VI, Fig. 15",
        "the lift of the 75 Hz system as a function of voltage and hinge stiffness resembles a plane",
        "a plane",
    )
    .is(
        &about(1.0, 0.01),
        planeness,
        format!("a plane through lifts from {low:.2} to {high:.2} mN has R² = {planeness:.3}"),
    )
}

/// Returns the coefficient of determination (R²) of a plane that is fitted to values on a rectangular grid.
/// The result is the sum of R² of two straight lines, one line for each direction of the grid.
fn planeness(points: &[[f64; 2]], values: &[f64]) -> f64 {
    let along = |axis: usize| {
        straightness(
            &points.iter().zip(values).map(|(point, value)| (point[axis], *value)).collect::<Vec<_>>(),
        )
    };
    along(0) + along(1)
}

/// Returns the claim about critical values of the series stiffness.
fn series(system: fn() -> System) -> Claim {
    let [soft, base, stiff] = [300.0, 1400.0, 1650.0].map(|series_stiffness| {
        let system = system();
        let response =
            System { params: Params { series_stiffness, ..system.params }, ..system }.response_from_low();
        (response.humps(STROKE)[0], response.peak(LIFT).1.get(LIFT))
    });
    said(
        "V, Figs. 9 and 11",
        format!(
            "the first stroke peak and the lift of the {} are sensitive to the slider-crank \
             stiffness k_sc from 300 to 1650 N/m",
            system().name
        ),
        "sensitive",
    )
    .holds(
        soft.0 < base.0 && base.0 < stiff.0 && soft.1 < base.1 && base.1 < stiff.1,
        format!(
            "first stroke peak at {:.1} Hz and largest lift {:.2} mN with k_sc = 300 N/m. First stroke \
             peak at {:.1} Hz and largest lift {:.2} mN with k_sc = 1400 N/m. First stroke peak at \
             {:.1} Hz and largest lift {:.2} mN with k_sc = 1650 N/m",
            soft.0, soft.1, base.0, base.1, stiff.0, stiff.1
        ),
    )
}

impl System {
    /// Returns the response from half of the lowest to 0.75 of the highest drive frequency of this robot.
    /// This frequency range contains the peak of the lift.
    fn response_from_low(self) -> Response {
        let [from, to, step] = self.range;
        System { range: [0.5 * from, 0.75 * to, step], ..self }.response()
    }
}
