//! `flap test track`: stroke, pitch and rotation centre of a filmed wing.

use flap_core::simulate::Trajectory;
use flap_experiments::tracking::{LeadingEdge, pitch_from_projection, rotation_centre, strokes};
use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::record::{self, Record};

use crate::args::TrackArgs;
use crate::cmd::motion::write_file;
use crate::cmd::outputs;
use crate::console::{self, is_stdout};
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::six_digits;

pub(super) fn run(args: &TrackArgs) -> Result<Exit, Failure> {
    outputs::check_tables(Inputs::new().add("the points", &args.points), [args.out.as_deref()])?;
    let record = Record::read(&args.points)?;
    let times = record.column(&record::TIME)?;
    let roots = record.points("root")?;
    let tips = record.points("tip")?;
    let edges: Vec<LeadingEdge> =
        roots.into_iter().zip(tips).map(|(root, tip)| LeadingEdge { root, tip }).collect();
    let centre = rotation_centre(&edges)?;

    let mut motion =
        Trajectory { columns: ["time_s", "stroke_deg"].map(str::to_owned).to_vec(), rows: Vec::new() };
    for (time, stroke) in times.iter().zip(strokes(&edges)) {
        motion.rows.push(vec![*time, stroke.to_degrees()]);
    }
    if let Some(chord) = args.chord {
        motion.columns.push("pitch_deg".to_owned());
        let lower = record.points("edge")?;
        for (i, (row, (edge, point))) in motion.rows.iter_mut().zip(edges.iter().zip(lower)).enumerate() {
            let pitch = pitch_from_projection(edge.distance(point), chord);
            let pitch = pitch.map_err(|invalid| Failure::usage(format!("image {}: {invalid}", i + 1)))?;
            row.push(pitch.to_degrees());
        }
    }

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
