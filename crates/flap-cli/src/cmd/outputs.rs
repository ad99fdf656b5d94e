//! Checks the names of a command's output files. Each output file must differ from all input files and from
//! all other output files.

use std::path::Path;

use flap_sweep::files::disk::is_same_target;
use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::results::Format;

use crate::console::is_stdout;
use crate::failure::Failure;

/// Checks the names of output files for CSV tables. The function makes the checks of [`check`], and also
/// checks the endings of the names.
///
/// # Errors
///
/// `Usage` if the ending of a name is not an ending of CSV files, and the errors of [`check`].
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

/// Checks the names of output files. Commands call this function before any computation.
///
/// # Errors
///
/// `Usage` if an output file is also an input file, or if two outputs are the same file.
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
