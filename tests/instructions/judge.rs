//! The limits on numbers of instructions.

use flap_core::num::Backend;
use flap_core::simulate;

use crate::counter::count;
use crate::workload::{PRESETS, Task, Work};

/// A vector occupies two registers, so that lanes take at best 2/LANES of the instructions of scalars. flap needs up to
/// a quarter more instructions, mostly for values that do not fit into the registers. With AVX2 and AVX-512, one
/// function that is not inlined costs several times this quarter.
const ALLOWANCE: f64 = 1.5;

/// Besides marching, a measurement evaluates the signals at nine states per step, which takes four to five times as
/// many instructions. A period with responses takes five right-hand sides for each right-hand side of marching.
/// Combining twenty states instead of four takes a few more instructions. The limit is for both together, per
/// right-hand side; the four-bar model has the most signals and the largest number:
const MEASURING: f64 = 3.0;

/// Counts the instructions and compares the numbers with the limits. Returns an error with the failed limits.
pub(crate) fn judge() -> Result<(), String> {
    for model in simulate::all() {
        if !model.presets().iter().any(|preset| PRESETS.contains(&preset.name)) {
            return Err(format!("the model {} has no preset in PRESETS", model.name()));
        }
    }
    let mut failures = Vec::new();
    let mut check = |what: String, ratio: f64, limit: f64| {
        println!("{what}: {ratio:.3} of the instructions, at most {limit:.3}");
        if ratio > limit {
            failures.push(format!("{what}: {ratio:.3} of the instructions, more than {limit:.3}"));
        }
    };

    let compiled_in = PRESETS.into_iter().filter(|preset| simulate::preset(preset).is_some());
    for (i, preset) in compiled_in.enumerate() {
        for (j, backend) in Backend::available().into_iter().enumerate() {
            // Models and backends share most of their source: one model with every backend, the others with the best.
            if i > 0 && j > 0 {
                continue;
            }
            let scalar = per_rhs(Work { preset, backend, task: Task::ScalarMarch })?;
            let march = per_rhs(Work { preset, backend, task: Task::March })?;
            let limit = ALLOWANCE * 2.0 / backend.lanes() as f64;
            check(format!("{preset}, {backend} lanes against scalars"), march / scalar, limit);
            if j == 0 {
                let measure = per_rhs(Work { preset, backend, task: Task::Measure })?;
                check(format!("{preset}, orbits against marching"), measure / march, MEASURING);
            }
        }
    }
    if failures.is_empty() {
        return Ok(());
    }
    Err(format!(
        "{}\nProbably some function of num, ode, measure or the model is not inlined into the lane driver: \
         look for one without #[inline(always)], or for calls in the disassembly of vectorize_{}.",
        failures.join("\n"),
        Backend::best()
    ))
}

/// Instructions per right-hand side and lane.
fn per_rhs(work: Work) -> Result<f64, String> {
    let instructions = count(&work.to_string(), &mut |_| Ok(())).map_err(|error| error.to_string())?;
    let per_rhs = instructions as f64 / work.rhs_evals() as f64;
    println!("{work}: {instructions} instructions, {per_rhs:.1} per right-hand side");
    Ok(per_rhs)
}
