//! Completion in a shell. When the user requests completion, the shell runs `flap` with the words of the
//! incomplete command line. `flap` then prints the possible completions of the last word, which are called
//! candidates.
//!
//! A completion script cannot contain the candidates, because they include the columns of files in the
//! working directory and the additional models of other programs.

use std::ffi::OsStr;
use std::path::Path;
use std::{env, process};

use clap::{Arg, Command};
use clap_complete::CompleteEnv;
use clap_complete::engine::{
    ArgValueCandidates, ArgValueCompleter, CompletionCandidate, PathCompleter, ValueCompleter as _,
};
use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::{SolverSettings, Status};
use flap_sweep::files::integrity;
use flap_sweep::grid;
use flap_sweep::plan::Robot;
use flap_sweep::resonance;
use flap_sweep::table::layout::fixed_columns;

use crate::args;
use crate::models;
use crate::statuses;

/// The environment variable with which a shell requests the possible completions of a word.
pub(crate) const VARIABLE: &str = "COMPLETE";

/// If a shell requests the possible completions of a word, prints the completions and ends the process.
pub(crate) fn answer() {
    let completion = CompleteEnv::with_factory(command).var(VARIABLE);
    match completion.try_complete(args::line(), env::current_dir().ok().as_deref()) {
        Ok(true) => process::exit(0),
        Ok(false) => {}
        Err(error) => error.exit(),
    }
}

/// Returns the clap command of `flap` with completion candidates for its arguments. The value name of an
/// argument, such as `COLUMN`, determines its candidates.
fn command() -> Command {
    with_candidates(args::command())
}

fn with_candidates(command: Command) -> Command {
    command.mut_args(completed).mut_subcommands(with_candidates)
}

/// Adds the completion candidates to an argument.
fn completed(arg: Arg) -> Arg {
    let value = arg.get_value_names().and_then(|names| names.first()).map(ToString::to_string);
    match value.as_deref().unwrap_or_default() {
        "PRESET" => arg.add(ArgValueCandidates::new(presets)),
        "MODEL|PRESET" => arg.add(ArgValueCandidates::new(models_and_presets)),
        "NAME|FILE" => arg.add(ArgValueCompleter::new(names_and_files)),
        "PRESET|FILE" => arg.add(ArgValueCompleter::new(presets_and_files)),
        "PARAMETER" => arg.add(ArgValueCandidates::new(parameters)),
        "NAME=VALUE" | "NAME=VALUE,..." => arg.add(ArgValueCompleter::new(assignments)),
        "COLUMN" | "COLUMN,..." => arg.add(ArgValueCandidates::new(columns)),
        "COLUMN=VALUE|COMPARISON" => arg.add(ArgValueCandidates::new(conditions)),
        "STATUS,..." => arg.add(ArgValueCandidates::new(statuses)),
        _ => arg,
    }
}

/// Returns a possible completion: a name with the first line of its meaning.
fn candidate(name: &str, meaning: &str) -> CompletionCandidate {
    CompletionCandidate::new(name).help(meaning.lines().next().map(|line| line.to_owned().into()))
}

fn presets() -> Vec<CompletionCandidate> {
    let presets = models::all().iter().flat_map(|model| model.presets());
    presets.map(|preset| candidate(preset.name, preset.doc)).collect()
}

fn models_and_presets() -> Vec<CompletionCandidate> {
    let models = models::all().iter().map(|model| candidate(model.name(), model.doc()));
    models.chain(presets()).collect()
}

/// Returns the candidates for `flap models`: all names that the command explains, and file names.
fn names_and_files(word: &OsStr) -> Vec<CompletionCandidate> {
    let mut found = begun(word, models_and_presets().into_iter().chain(names()).collect());
    found.extend(PathCompleter::any().complete(word));
    found
}

fn presets_and_files(word: &OsStr) -> Vec<CompletionCandidate> {
    let mut found = begun(word, presets());
    found.extend(PathCompleter::any().complete(word));
    found
}

fn statuses() -> Vec<CompletionCandidate> {
    Status::ALL.iter().map(|status| candidate(status.name(), statuses::meaning(*status))).collect()
}

/// Returns the parameters of the models that the command line mentions.
fn parameters() -> Vec<CompletionCandidate> {
    each_parameter(|parameter| vec![candidate(parameter.name, parameter.doc)])
}

/// Returns candidates for `NAME=VALUE`: parameters before the equals sign, and the named options of a
/// parameter after the equals sign.
fn assignments(word: &OsStr) -> Vec<CompletionCandidate> {
    let is_named = word.to_string_lossy().contains('=');
    let candidates = each_parameter(|parameter| match parameter.kind {
        Kind::Choice(options) if is_named => {
            options.iter().map(|option| candidate(&format!("{}={option}", parameter.name), "")).collect()
        }
        _ => vec![candidate(&format!("{}=", parameter.name), parameter.doc)],
    });
    begun(word, candidates)
}

fn each_parameter(candidates: impl Fn(&Parameter) -> Vec<CompletionCandidate>) -> Vec<CompletionCandidate> {
    let robots = mentioned_models();
    distinct(robots.iter().flat_map(|robot| robot.parameters()).flat_map(candidates))
}

/// Returns the names of the columns in the first result file on the command line.
///
/// If the command line contains no result file, returns the columns of a sweep with the models on the command
/// line.
fn columns() -> Vec<CompletionCandidate> {
    if let Some(names) = words().find_map(|word| columns_of(&word)) {
        return names.iter().map(|name| candidate(name, "")).collect();
    }
    let measures = mentioned_models().into_iter().flat_map(|robot| resonance::measures(&*robot));
    let measures = measures.map(|measure| candidate(&measure.name, &measure.doc));
    let fixed = fixed_columns().into_iter().map(|column| candidate(&column.name, &column.doc));
    distinct(measures.chain(fixed))
}

fn conditions() -> Vec<CompletionCandidate> {
    let columns = columns().into_iter();
    columns.map(|column| candidate(&format!("{}=", column.get_value().display()), "")).collect()
}

/// Returns all names that `flap models` explains.
fn names() -> Vec<CompletionCandidate> {
    let settings = SolverSettings::TABLE.iter().map(|setting| candidate(setting.name, setting.doc));
    distinct(parameters().into_iter().chain(columns()).chain(settings).chain(statuses()))
}

/// Returns the possible completions that begin with the text `word`.
fn begun(word: &OsStr, mut candidates: Vec<CompletionCandidate>) -> Vec<CompletionCandidate> {
    let word = word.to_string_lossy();
    candidates.retain(|candidate| candidate.get_value().to_string_lossy().starts_with(&*word));
    candidates
}

/// Returns the possible completions without repeated names. If several completions have the same name, the
/// function keeps the first.
fn distinct(candidates: impl Iterator<Item = CompletionCandidate>) -> Vec<CompletionCandidate> {
    let mut kept: Vec<CompletionCandidate> = Vec::new();
    for candidate in candidates {
        if kept.iter().all(|other| other.get_value() != candidate.get_value()) {
            kept.push(candidate);
        }
    }
    kept
}

/// Returns the words that the user typed after `flap` on the command line that the shell completes.
fn words() -> impl Iterator<Item = String> {
    let words = args::line().iter().map(|word| word.to_string_lossy().into_owned());
    words.skip_while(|word| word != "--").skip(2)
}

/// Returns the model of the preset, model or grid on the command line. If the command line contains no preset, model or
/// grid, returns all models.
fn mentioned_models() -> Vec<Robot> {
    let mentioned = words().find_map(|word| {
        let named = models::preset(&word).map(|(model, _)| model).or_else(|| models::by_name(&word));
        named.map(Robot::of_wing).or_else(|| robot_of_grid(&word))
    });
    mentioned.map_or_else(|| models::all().iter().copied().map(Robot::of_wing).collect(), |robot| vec![robot])
}

fn robot_of_grid(word: &str) -> Option<Robot> {
    let path = Path::new(word);
    let is_grid = path.extension().is_some_and(|ending| ending == "toml") && path.is_file();
    is_grid.then(|| grid::read(path, models::all()).ok().map(|plan| plan.robot().clone())).flatten()
}

/// Returns the columns of results, if the word is the name of a results file. The function reads only the
/// header of the file, because the shell waits for the names of the columns.
fn columns_of(word: &str) -> Option<Vec<String>> {
    let path = Path::new(word);
    let is_results = path.is_file() && path.extension().is_none_or(|ending| ending != "toml");
    is_results.then(|| integrity::names(path).ok()).flatten()
}
