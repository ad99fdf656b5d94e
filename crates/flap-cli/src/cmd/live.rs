//! `flap live`: a page on which curves follow the parameters.

use std::sync::atomic::Ordering;
use std::thread;
use std::time::Duration;

use flap_live::{LiveOptions, Server, StartError};
use flap_sweep::run::RunOptions;

use super::point;
use crate::args::LiveArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::{models, signals};

/// Time between two looks for a signal.
const LOOK: Duration = Duration::from_millis(50);

pub(crate) fn run(args: &LiveArgs) -> Result<Exit, Failure> {
    let what = args.what.clone().or_else(|| models::presets().next().map(str::to_owned));
    let what = what.ok_or_else(|| Failure::usage("there are no presets: name a file"))?;
    let plan = point::plan(&what)?;
    if plan.resonance().is_some() {
        console::say(
            "the page has one drive frequency, not a resonance of each design: it begins with the preset's",
        );
    }
    let default = RunOptions::default();
    let run = RunOptions { threads: args.threads.unwrap_or(default.threads), ..default };
    // Before the server: a signal that comes early must end it too.
    let stop = signals::stop();
    let started = Server::start(plan, models::all(), &LiveOptions { port: args.port, run });
    let mut server = started.map_err(|error| match error {
        StartError::Design(mistakes) => Failure::Grid(mistakes),
        StartError::Port(..) => {
            Failure::usage(error.to_string()).help("name another port, or leave --port out")
        }
        StartError::System(_) => Failure::System(error.to_string(), Vec::new()),
    })?;
    console::results(&format!("{}\n", server.address()))?;
    if !args.no_open
        && let Err(error) = open::that_detached(server.address())
    {
        console::say(&format!("no browser opens ({error}): open the address above"));
    }
    console::say("Ctrl-C ends it");
    while !stop.load(Ordering::Relaxed) {
        thread::sleep(LOOK);
    }
    server.stop();
    Ok(Exit::Done)
}
