//! Checks the output files of a command. Each output file must differ from the input files and from the other output
//! files.

use std::path::Path;

use flap_sweep::files::disk::is_same_target;
use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::results::Format;

use crate::console::is_stdout;
use crate::failure::Failure;

/// Checks the names of CSV tables as [`check`] does, and also the endings of the names.
///
/// # Errors
///
/// `Usage` if a name has the ending of another format, and the errors of [`check`].
pub(crate) fn check_tables<'p>(
    inputs: &Inputs,
    outputs: impl IntoIterator<Item = Option<&'p Path>>,
) -> Result<(), Failure> {
    let outputs: Vec<Option<&Path>> = outputs.into_iter().collect();
    for output in outputs.iter().flatten().filter(|path| !is_stdout(path)) {
        Format::require_csv(output)?;
    }
    check(inputs, outputs)
}

/// Checks the names of output files before any computation.
///
/// # Errors
///
/// `Usage` if an output is an input or two outputs are the same file.
pub(crate) fn check<'p>(
    inputs: &Inputs,
    outputs: impl IntoIterator<Item = Option<&'p Path>>,
) -> Result<(), Failure> {
    let outputs: Vec<&Path> = outputs.into_iter().flatten().filter(|path| !is_stdout(path)).collect();
    for (number, output) in outputs.iter().enumerate() {
        inputs.protect(output)?;
        if outputs[..number].iter().any(|other| is_same_target(other, output)) {
            let message = format!("{} is the name of two outputs", output.display());
            return Err(Failure::usage(message).help("give a different file for each output"));
        }
    }
    Ok(())
}
