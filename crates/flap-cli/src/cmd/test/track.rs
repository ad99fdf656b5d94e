//! `flap test track`: stroke, pitch and rotation centre of a filmed wing.

use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::record::Record;

use crate::args::TrackArgs;
use crate::cmd::motion::write_file;
use crate::cmd::outputs;
use crate::console::{self, is_stdout};
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::six_digits;

pub(super) fn run(args: &TrackArgs) -> Result<Exit, Failure> {
    outputs::check_tables(Inputs::new().add("the points", &args.points), [args.out.as_deref()])?;
    let (motion, centre) = Record::read(&args.points)?.tracked(args.chord)?;
    let found = format!("rotation centre at x = {}, y = {}", six_digits(centre[0]), six_digits(centre[1]));
    if let Some(path) = args.out.as_deref().filter(|path| !is_stdout(path)) {
        write_file(&motion, path, args.overwrite.force, "image")?;
        console::results(&(found + "\n"))?;
    } else {
        console::say(&found);
        print::motion(args.format, &motion)?;
    }
    Ok(Exit::Done)
}
