//! `flap live`: a page with sliders for parameters, and curves that change with the sliders.

use std::sync::atomic::Ordering;
use std::thread;
use std::time::Duration;

use flap_live::{LiveOptions, Server, StartError};
use flap_sweep::run::RunOptions;

use super::point;
use crate::args::LiveArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::{models, system};

/// Time between two checks whether a signal such as Ctrl-C has arrived.
const LOOK: Duration = Duration::from_millis(50);

pub(crate) fn run(args: &LiveArgs) -> Result<Exit, Failure> {
    let what = args.what.clone().or_else(|| models::presets().next().map(str::to_owned));
    let what =
        what.ok_or_else(|| Failure::usage("there are no presets: name a device file or a grid file"))?;
    let plan = point::plan(&what)?;
    if plan.resonance().is_some() {
        console::say("the page does not search for resonances: it starts at the preset's drive frequency");
    }
    let run = RunOptions::with_threads(args.threads);
    // Before the server starts: an early signal must stop it too.
    let stop = system::stop();
    let started = Server::start(plan, models::all(), &LiveOptions { port: args.port, run });
    let mut server = started.map_err(|error| match error {
        StartError::Design(mistakes) => Failure::Grid(mistakes),
        StartError::Port(..) => Failure::usage(error.to_string()).help("choose another port, or omit --port"),
        StartError::DeviceValue => Failure::usage(error.to_string()).help("write numbers in the formula"),
        StartError::System(_) => Failure::system(error.to_string()),
    })?;
    console::results(&format!("{}\n", server.address()))?;
    if !args.no_open
        && let Err(error) = open::that_detached(server.address())
    {
        console::say(&format!("no browser was opened ({error}): open the address above"));
    }
    console::say("press Ctrl-C to stop the server");
    while !stop.load(Ordering::Relaxed) {
        thread::sleep(LOOK);
    }
    server.stop();
    Ok(Exit::Done)
}
