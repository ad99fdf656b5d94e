//! Claims about chirps, in which the drive frequency changes as in the measurements of the paper (Eq. 7), and
//! about the two motions with a soft hinge.

use flap_core::model::ExperimentModel;
use flap_core::model::bimorph::{Bimorph, Params};
use flap_core::num::Backend;
use flap_core::simulate::{ChirpRequest, PointRun};

use super::{bench, constants, response, transmission};
use crate::claim::{Claim, closely, said};

pub(super) fn claims() -> Vec<Claim> {
    vec![as_settled(), soft_hinge()]
}

/// Returns the design of Table I at 160 V.
fn table_1() -> Params {
    Params { drive_voltage_pp: 160.0, ..transmission(1.0) }
}

/// Returns the frequency (Hz) and the peak-to-peak stroke (degrees) of each cycle of a chirp.
fn swept(p: &Params, [from, to]: [f64; 2], rate: f64) -> Vec<(f64, f64)> {
    let bench = bench();
    let request = ChirpRequest { from, to, rate, samples_per_cycle: 0 };
    let response =
        bench.experiments().chirp(&PointRun::new(Backend::best(), &bench.solver, &p.to_values()), &request);
    let envelope = response.expect("the sweep is possible").envelope;
    let column = |name: &str| envelope.columns.iter().position(|one| one == name).expect("it is measured");
    let [frequency, stroke] = [column("frequency_hz"), column("stroke_pp_deg")];
    envelope.rows.iter().map(|row| (row[frequency], row[stroke])).collect()
}

/// Returns the frequency at which the stroke is largest, and the largest stroke.
fn largest(sweep: &[(f64, f64)]) -> (f64, f64) {
    sweep.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)).expect("a sweep has cycles")
}

fn as_settled() -> Claim {
    let p = table_1();
    let (f_up, up) = largest(&swept(&p, [1.0, 150.0], 15.0));
    let (f_down, down) = largest(&swept(&p, [160.0, 100.0], -15.0));
    let settled = response(&p, 160.0, [120.0, 135.0]);
    let (frequency, point) = settled.peak("stroke_pp_deg");
    let stroke = point.get("stroke_pp_deg");
    let farther = if (up - stroke).abs() > (down - stroke).abs() { up } else { down };
    said(
        "Eq. (7)",
        "the paper measures the largest stroke in a frequency sweep of 15 Hz/s instead of \
         settled motions (computed for T₁ at 160 V)",
        "a sweep",
    )
    .is(
        &closely(stroke, 0.0),
        farther,
        format!(
            "largest stroke of T₁ {up:.1}° at {f_up:.0} Hz with rising frequency, {down:.1}° at \
             {f_down:.0} Hz with falling frequency, {stroke:.1}° at {frequency:.0} Hz with \
             settled motions"
        ),
    )
}

/// Returns a claim about a soft hinge with half of the hinge stiffness in Table I. With the soft hinge, the
/// natural frequencies of pitch and stroke are close, and the wing has two settled motions.
fn soft_hinge() -> Claim {
    let table_1 = table_1();
    let soft = Params { hinge_stiffness: 0.5 * table_1.hinge_stiffness, ..table_1.clone() };
    let modes = Bimorph::modes(&constants(&soft));
    let (stroke, hinge) = (modes[0].frequency, modes[1].frequency);
    let apart = |p: &Params| {
        let at_126 = |sweep: &[(f64, f64)]| {
            let nearest = sweep.iter().min_by(|a, b| (a.0 - 126.0).abs().total_cmp(&(b.0 - 126.0).abs()));
            nearest.expect("a sweep has cycles").1
        };
        [at_126(&swept(p, [110.0, 130.0], 0.5)), at_126(&swept(p, [140.0, 122.0], -0.5))]
    };
    let [up, down] = apart(&soft);
    let [up_1, down_1] = apart(&table_1);
    said("III-A", "scaling of the transmission ratio fails as the natural frequencies of pitch and \
                   stroke approach each other", "not sustainable")
        .holds(
            (up - down).abs() > 10.0 && (up_1 - down_1).abs() < 1.0,
            format!(
                "with half of the hinge stiffness κ_wh, the natural frequencies of design T₁ are {hinge:.0} Hz (pitch) and {stroke:.0} Hz (stroke). \
                 With half of κ_wh at 160 V and 126 Hz, the stroke is {up:.0}° with rising frequency and {down:.0}° with falling frequency. \
                 With κ_wh of Table I at 160 V and 126 Hz, the stroke is {up_1:.0}° with rising frequency and {down_1:.0}° with falling frequency"
            ),
        )
}
