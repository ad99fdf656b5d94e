//! `flap vehicle`: control matrix, trims, the linear model about hover, and flight of a vehicle.

mod fly;
mod hover;
mod parts;
mod wrench_map;

use std::fmt::Write as _;

use flap_core::simulate::{NoSlope, never};
use flap_core::vehicle::MassProperties;
use flap_sweep::files::linear_model::LinearModel;
use flap_sweep::notation::text;
use flap_sweep::study::inputs;
use flap_sweep::vehicle::control::{COMPONENTS, ControlError, Effectiveness, Input, VehicleRun};
use flap_sweep::vehicle::hover::damping;
use flap_sweep::vehicle::trim::{self, Target};

use self::parts::{HEADINGS, refused, tidy, title};
use super::point::{self, Chosen};
use crate::args::{HOVER, OutputFormat, VehicleArgs};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::{Table, six_digits};

/// Each combination of inputs has two singular vectors of length 1. The tables leave out inputs, forces and
/// torques whose entry in a singular vector is smaller than this number. For one input, the tables leave out
/// forces and torques whose change is smaller than this fraction of the input's largest change.
const SMALL: f64 = 0.1;

/// flap leaves out a combination of inputs whose singular value is smaller than this fraction of the largest
/// singular value.
const NO_EFFECT: f64 = 1e-9;

pub(crate) fn run(args: &VehicleArgs) -> Result<Exit, Failure> {
    let mut chosen = Chosen::new(&args.point, &args.solver)?;
    if args.frozen {
        hover::freeze(&mut chosen)?;
    }
    let vehicle = inputs::vehicle(&chosen.plan, &args.point.what)?;
    if !args.wrench_map.is_empty() {
        return wrench_map::run(args, &chosen, vehicle);
    }
    let inputs = if args.inputs.is_empty() {
        inputs::usual(&chosen.plan, &chosen.values)?
    } else {
        inputs::named(&chosen.plan, &args.inputs).map_err(|error| refused("--inputs", error))?
    };
    if let Some(warning) = inputs::held_constant(&chosen.plan) {
        console::warn(warning);
    }
    let export = args.export.as_deref().map(|path| hover::check_output(path, &chosen.plan)).transpose()?;
    if args.format != OutputFormat::Table && args.damping && args.hover {
        let failure = Failure::usage("--damping and --hover are two tables, but csv and json contain one");
        return Err(failure.help("run the command once with --damping and once with --hover"));
    }
    let vehicle_run = VehicleRun { vehicle, solver: chosen.plan.solver(), interrupted: &never };
    let targets = targets(&args.trim, &vehicle.mass_properties(&chosen.values))?;
    let mut page = String::new();
    let at_point = |inputs: &[Input]| vehicle_run.effectiveness(&chosen.values, inputs, None);
    let here = if args.inputs.is_empty() {
        Some(at_point(&inputs)?.without_idle(&vehicle_run, &chosen.values))
    } else {
        None
    };
    let inputs = here.as_ref().map_or(inputs, |here| here.inputs.clone());
    let found = if targets.is_empty() {
        here.map_or_else(|| at_point(&inputs), Ok)?
    } else {
        let found = trim::to_targets(&vehicle_run, &chosen.values, &inputs, &targets)?;
        let _ = writeln!(page, "trimmed in {}\n", text::count(found.steps as u64, "step"));
        found.at
    };
    let values = found.applied(&chosen.values);
    if let Some(seconds) = args.fly {
        return fly::run(args, seconds, &vehicle_run, &values, &found.inputs);
    }
    let damping = if args.damping { Some(damping(&vehicle_run, &values, &found.row.state)?) } else { None };
    let model = if args.hover || export.is_some() {
        Some(LinearModel::at(&vehicle_run, &values, &found, false, chosen.title())?)
    } else {
        None
    };
    if let Some((model, (path, format))) = model.as_ref().zip(export) {
        hover::export(model, path, format, args.overwrite.force)?;
    }
    for warning in model.iter().flat_map(LinearModel::warnings) {
        console::warn(&warning);
    }
    let model = model.filter(|_| args.hover);
    let (names, rows) = match (&damping, &model) {
        (Some(damping), _) => hover::damping_cells(damping),
        (None, Some(model)) => hover::mode_cells(model),
        (None, None) => {
            let names = ["input", "unit", "value"].into_iter().chain(COMPONENTS).map(str::to_owned);
            (names.collect(), cells(&found))
        }
    };
    print::table(args.format, &names, &rows, || {
        let mut page = format!("{}\n\n{page}{}", title(&chosen, vehicle), table(&found));
        if let Some(damping) = &damping {
            page.push_str(&hover::damping_table(damping));
        }
        if let Some(model) = &model {
            page.push_str(&hover::mode_table(model));
        }
        page
    })?;
    Ok(Exit::Done)
}

/// Returns the components of force and torque that `--trim` names, with their target values.
fn targets(given: &[(String, String)], body: &MassProperties) -> Result<Vec<Target>, Failure> {
    let mut targets: Vec<Target> = Vec::new();
    for (name, value) in given {
        if name == HOVER {
            for target in hover::targets(body)? {
                if targets.iter().any(|other| other.component == target.component) {
                    let name = COMPONENTS[target.component];
                    return Err(Failure::usage(format!("--trim: `{name}` and `{HOVER}` cannot be combined")));
                }
                targets.push(target);
            }
            continue;
        }
        let is_named = |component: &str| {
            component == name || component.rsplit_once('_').is_some_and(|(short, _)| short == name)
        };
        let Some(component) = COMPONENTS.iter().position(|component| is_named(component)) else {
            let failure = Failure::usage(format!("--trim: there is no component `{name}`"));
            return Err(failure.nearest(name, COMPONENTS, "components are force_forward to torque_yaw"));
        };
        let number = value.trim().parse().ok().filter(|number: &f64| number.is_finite());
        let Some(value) = number else {
            let unit = if component < 3 { "mN" } else { "uN*m" };
            let failure = Failure::usage(format!("--trim {name}={value}: `{value}` is not a number"));
            return Err(failure.help(format!("write a number in {unit}, without a unit")));
        };
        if targets.iter().any(|target| target.component == component) {
            return Err(point::twice("--trim", name));
        }
        targets.push(Target { component, value });
    }
    Ok(targets)
}

/// Returns as text the mean force and torque, the control matrix, and the combinations of inputs with the
/// largest effects.
fn table(found: &Effectiveness) -> String {
    let mut here = Table::with_headings(&["mean", "unit", HEADINGS[0], HEADINGS[1], HEADINGS[2]]);
    let row = |name: &str, unit: &str, numbers: &[f64]| {
        let numbers = numbers.iter().map(|number| six_digits(tidy(*number)));
        [name.to_owned(), unit.to_owned()].into_iter().chain(numbers).collect::<Vec<_>>()
    };
    here.row(row("force", "mN", &found.wrench[..3]));
    let mut torque = Table::with_headings(&["mean", "unit", HEADINGS[3], HEADINGS[4], HEADINGS[5]]);
    torque.row(row("torque", "uN*m", &found.wrench[3..]));

    let headings = ["input", "value", "unit"].into_iter().chain(HEADINGS).chain(["makes"]);
    let mut matrix = Table::with_headings(&headings.collect::<Vec<_>>());
    for (j, input) in found.inputs.iter().enumerate() {
        let column: Vec<f64> = found.matrix.column(j).iter().copied().collect();
        let mut cells = vec![input.name.clone(), six_digits(found.values[j]), input.unit.to_owned()];
        cells.extend(column.iter().map(|slope| six_digits(tidy(*slope))));
        cells.push(main_effects(&column));
        matrix.row(cells);
    }
    let found_combinations = found.combinations();
    let largest = found_combinations.first().map_or(0.0, |strongest| strongest.size);
    let mut combinations = Table::with_headings(&["size", "inputs", "force and torque"]);
    for combination in found_combinations.iter().filter(|combination| combination.size > NO_EFFECT * largest)
    {
        let inputs = largest_components(&combination.inputs, |i| found.inputs[i].name.clone());
        combinations.row([
            six_digits(combination.size),
            inputs,
            largest_components(&combination.components, |i| HEADINGS[i].to_owned()),
        ]);
    }
    let width = console::width();
    format!(
        "{}\n{}\nChange of force (mN) and torque (uN*m) per unit of each input:\n\n{}\n\
         Combinations of inputs with the largest effects (each combination has unit length; 1 µN·m counts as 1 mN):\n\n{}",
        here.text_within(width),
        torque.text_within(width),
        matrix.text_within(width),
        combinations.text_within(width)
    )
}

/// Returns the names of the force component and the torque component that an input changes most. Components
/// with small changes are left out.
fn main_effects(column: &[f64]) -> String {
    let largest = |from: usize| {
        let of = (from..from + 3).max_by(|&one, &other| column[one].abs().total_cmp(&column[other].abs()))?;
        let size = column.iter().fold(0.0, |one: f64, other| one.max(other.abs()));
        (column[of].abs() > SMALL * size && size > 0.0).then_some((column[of].abs(), HEADINGS[of]))
    };
    let mut made: Vec<(f64, &str)> = [largest(0), largest(3)].into_iter().flatten().collect();
    made.sort_by(|(one, _), (other, _)| other.total_cmp(one));
    made.iter().map(|(_, name)| *name).collect::<Vec<_>>().join(", ")
}

/// Returns the largest entries of a vector as text, each entry with its name.
fn largest_components(shares: &[f64], name: impl Fn(usize) -> String) -> String {
    let mut places: Vec<usize> = (0..shares.len()).filter(|&i| shares[i].abs() >= SMALL).collect();
    places.sort_by(|&one, &other| shares[other].abs().total_cmp(&shares[one].abs()));
    places.iter().map(|&i| format!("{:+.2} {}", shares[i], name(i))).collect::<Vec<_>>().join(" ")
}

/// Returns the mean force and torque and the control matrix for csv and json, with all digits.
fn cells(found: &Effectiveness) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    let head = ["mean".to_owned(), String::new(), String::new()];
    rows.push(head.into_iter().chain(found.wrench.map(text::float)).collect());
    for (j, input) in found.inputs.iter().enumerate() {
        let head = [input.name.clone(), input.unit.to_owned(), text::float(found.values[j])];
        rows.push(
            head.into_iter().chain(found.matrix.column(j).iter().map(|slope| text::float(*slope))).collect(),
        );
    }
    rows
}

impl From<ControlError> for Failure {
    fn from(error: ControlError) -> Failure {
        let help = match &error {
            ControlError::Unfinished(error) => return error.clone().into(),
            ControlError::NotPeriodic { .. } => {
                "choose another point with --point, or other values with --set: `flap run` shows the row"
            }
            ControlError::Unset { .. } => "for example with --set, or leave the input out",
            ControlError::NoHarmonics(_) => "use --set drive_shape=harmonics, or leave the input out",
            ControlError::NoSize(_) => "set it with --set, or remove it from --inputs",
            ControlError::NoSlope { reason: NoSlope::Edge, .. } => {
                "the input is at an end of its range: set another value with --set, or remove it from --inputs"
            }
            ControlError::NoSlope { .. } => {
                "the manual explains this reason in Reference, Grid files: choose another point, or remove the input from --inputs"
            }
            ControlError::FewInputs { .. } => "give more --inputs or fewer --trim",
            ControlError::NotReached(_) => {
                "choose other --inputs, or targets closer to the point's force and torque; a smaller --rtol reduces the errors of the \
                 point's force and torque"
            }
        };
        Failure::usage(error.to_string()).help(help)
    }
}
