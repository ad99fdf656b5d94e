//! `flap live`.

use std::num::NonZeroUsize;

use super::values::threads;

#[derive(clap::Args)]
#[command(after_help = LIVE_HELP)]
pub(crate) struct LiveArgs {
    /// Preset, device file or grid file; `-` reads a grid from stdin [default: the first preset]
    #[arg(value_name = "PRESET|FILE")]
    pub(crate) what: Option<String>,

    /// Port of the server [default: a free port]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub(crate) port: u16,

    /// Print the address without opening a browser
    #[arg(long)]
    pub(crate) no_open: bool,

    /// Number of worker threads; the number does not change the rows [default: one thread per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = threads)]
    pub(crate) threads: Option<NonZeroUsize>,
}

const LIVE_HELP: &str = "\
flap starts a web server on this machine and prints the address of the live page. The address contains a secret token. \
Anyone with the address can make the server compute rows, so do not share the address. The server listens only on \
127.0.0.1, reads only the file that you name, and writes no files. Ctrl-C stops the server.

Examples:
  flap live jafferis2016
  flap live mybee.toml
  flap live sweep.toml --no-open --port 8123
  ssh -L 8123:127.0.0.1:8123 server flap live mybee.toml --no-open --port 8123     (flap runs on `server`; open the address here)";
