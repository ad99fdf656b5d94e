//! Arguments of `flap generate completions`, `flap generate man` and `flap generate schema`.

use std::path::PathBuf;

use clap::Subcommand;
use clap_complete::Shell;

use super::options::OverwriteArgs;

#[derive(Subcommand)]
pub(crate) enum GenerateCommand {
    /// Print a script with which a shell completes commands and options
    Completions(CompletionsArgs),
    /// Write manual pages, one per command
    Man(ManArgs),
    /// Print a JSON schema of grid files, with which editors complete keys
    Schema(SchemaArgs),
}

#[derive(clap::Args)]
#[command(after_help = COMPLETIONS_HELP)]
pub(crate) struct CompletionsArgs {
    /// Shell for which flap prints the completion script
    #[arg(value_name = "SHELL")]
    pub(crate) shell: Shell,
}

const COMPLETIONS_HELP: &str = "\
Examples:
  flap generate completions bash > ~/.local/share/bash-completion/completions/flap
  source <(flap generate completions zsh)               (in ~/.zshrc, after compinit)
  flap generate completions fish > ~/.config/fish/completions/flap.fish
  flap generate completions powershell >> $PROFILE";

#[derive(clap::Args)]
#[command(after_help = "Example:\n  flap generate man ~/.local/share/man/man1")]
pub(crate) struct ManArgs {
    /// Folder for the manual pages
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: PathBuf,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,
}

#[derive(clap::Args)]
#[command(
    after_help = "Example:\n  flap generate schema > flap.schema.json     (and #:schema ./flap.schema.json as the first line of a grid)"
)]
pub(crate) struct SchemaArgs {
    /// Include only the parameters of the model of PRESET, with the values of PRESET as defaults
    #[arg(long, value_name = "PRESET")]
    pub(crate) preset: Option<String>,
}
