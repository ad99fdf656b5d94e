//! Pictures of the effects of parameters on a measure. The effects from derivatives and the effects from the
//! designs of a sample are drawn as pairs of bars.

use flap_core::num::Backend;
use flap_core::parameter::Parameter;
use flap_core::simulate::{PointRun, Status};
use flap_sweep::derivative::{Per, column_name};
use flap_sweep::picture::colours::{DARK, SERIES};
use flap_sweep::plan::Plan;
use flap_sweep::study::strongest;
use flap_sweep::table::labels;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Scene, TextAnchor};

use super::canvas::{Size, TEXT};
use super::ink;
use super::panel::{Axis, LETTER, Panel};
use super::scale;
use super::selection::Selection;
use crate::console;
use crate::data::columns::{Cells, Table};
use crate::failure::Failure;
use crate::table::{self, four_digits};

/// Largest number of parameters that a picture shows.
const MOST: usize = 20;

/// The height of a pair of bars, relative to the distance between two pairs.
const THICK: f64 = 0.7;

/// Height of the legend, in drawing units.
const LEGEND: f64 = 22.0;

/// The names and the colours of the two methods that compute effects.
const METHODS: [(&str, &str); 2] = [("derivatives", SERIES[0]), ("sample", SERIES[1])];

/// A parameter and its effects on a measure. An effect is the change of the measure per standard deviation of
/// the parameter.
struct Effect {
    column: usize,
    /// Standard deviation of the parameter.
    deviation: f64,
    /// The effect that is computed from the derivative. NaN if the derivative is missing.
    derivative: f64,
    /// The effect that is computed from the least-squares line through the designs.
    sample: f64,
}

/// The effects of all varied parameters. The parameter with the largest effect is first.
struct Effects {
    parameters: Vec<Effect>,
    designs: usize,
    /// Standard deviation of the measure, computed twice: from the derivatives with a linear model, and from
    /// the designs.
    deviations: [f64; 2],
}

/// Prints and draws the effects of the parameters on the measure in column `x`.
///
/// # Errors
/// `Usage` if the file contains no derivatives of the measure and flap cannot compute derivatives from
/// `plan`.
pub(super) fn draw(
    table: &Table,
    selection: &Selection,
    plan: Option<&Plan>,
    size: Size,
) -> Result<Scene, Failure> {
    let found = effects(table, selection, plan)?;
    console::results(&printed(table, selection, &found))?;
    let shown = &found.parameters[..found.parameters.len().min(MOST)];
    if shown.len() < found.parameters.len() {
        console::say(&format!("the {} largest of {} effects are drawn", shown.len(), found.parameters.len()));
    }
    let label = table.label(selection.columns.x);
    let mut notes = selection.notes.clone();
    notes.push(format!("{} designs", found.designs));
    let names = shown.iter().map(|effect| table.label(effect.column).words);
    let bars = shown.iter().map(|effect| [effect.derivative, effect.sample]);
    // The first parameter is on top; all parameters together are at the bottom.
    let mut lines: Vec<(String, [f64; 2])> = names.zip(bars).collect();
    lines.push(("All together".to_owned(), found.deviations));
    lines.reverse();
    let ends = lines.iter().flat_map(|(_, bars)| bars.iter().copied().chain([0.0]));
    let range = scale::range(ends.map(|end| end * label.factor)).unwrap_or((-1.0, 1.0));
    let names = lines.iter().map(|(name, _)| name.clone()).collect();
    let mut parameters = Axis::of_categories(String::new(), names, 0.6);
    // Space for the legend.
    let height = (size.height - 130.0).max(2.0 * LEGEND);
    parameters.range.1 += LEGEND * (lines.len() as f64 + 0.2) / (height - LEGEND);
    let measured = labels::titled(&label.words, &label.unit);
    let panel = Panel {
        title: selection.title.clone(),
        notes,
        ..Panel::new(
            Axis::linear(
                format!("Change for one standard deviation: {measured}"),
                scale::padded(range, 0.06),
            ),
            parameters,
            Vec::new(),
        )
    };
    let frame = ComputedLayout::from_layout(&panel.layout(size));
    let mut scene = panel.scene(size);
    let zero = frame.map_x(0.0);
    for (line, (_, bars)) in lines.iter().enumerate() {
        let middle = frame.map_y(line as f64 + 1.0);
        let half = (frame.map_y(line as f64 + 1.0 - THICK / 2.0) - middle).min(18.0);
        for (method, value) in bars.iter().enumerate().filter(|(_, value)| value.is_finite()) {
            let end = frame.map_x(value * label.factor);
            let corner = (zero.min(end), middle - half + method as f64 * half);
            ink::rectangle(&mut scene, corner, ((end - zero).abs(), half - 0.5), METHODS[method].1);
        }
    }
    let (top, bottom) = (frame.map_y(lines.len() as f64 + 0.5), frame.margin_top + frame.plot_height());
    ink::rectangle(&mut scene, (zero - 0.5, top), (1.0, bottom - top), DARK);
    legend(&mut scene, &frame);
    Ok(scene)
}

/// Draws the legend at the top of the plot: the names and colours of the two methods.
fn legend(scene: &mut Scene, frame: &ComputedLayout) {
    /// Length of the sides of a coloured square in the legend.
    const SIDE: f64 = 10.0;
    let mut left = frame.margin_left + 6.0;
    let top = frame.margin_top + 5.0;
    for (name, colour) in METHODS {
        ink::rectangle(scene, (left, top), (SIDE, SIDE), colour);
        ink::text(scene, (left + SIDE + 4.0, top + SIDE - 0.5), name, TEXT, TextAnchor::Start);
        left += SIDE + 16.0 + name.chars().count() as f64 * f64::from(TEXT) * LETTER;
    }
}

/// Returns the effects as a table for a terminal. The last line is the effect of all parameters together.
fn printed(table: &Table, selection: &Selection, found: &Effects) -> String {
    let measure = &table.columns[selection.columns.x];
    let unit = if measure.unit.is_empty() { String::new() } else { format!(" ({})", measure.unit) };
    let mut page = format!(
        "change of {}{unit} for one standard deviation of each parameter, from {} designs:\n\n",
        measure.name, found.designs
    );
    let number = |value: f64| if value.is_nan() { "none".to_owned() } else { four_digits(value) };
    let rows = found.parameters.iter().map(|effect| {
        let column = &table.columns[effect.column];
        let deviation = four_digits(effect.deviation);
        vec![
            column.name.clone(),
            deviation,
            column.unit.clone(),
            number(effect.derivative),
            number(effect.sample),
        ]
    });
    let [linear, sample] = found.deviations.map(number);
    let all = vec!["all together".to_owned(), String::new(), String::new(), linear, sample];
    let headings = ["parameter", "standard deviation", "unit", "derivatives", "sample"];
    page += &table::Table::of(&headings, rows.chain([all])).text_within(console::width());
    page
}

/// Computes the effects of the parameters that have several values in the selected rows.
fn effects(table: &Table, selection: &Selection, plan: Option<&Plan>) -> Result<Effects, Failure> {
    let measure = selection.columns.x;
    let values = table.numbers(measure)?;
    let rows: Vec<usize> = selection.rows.iter().copied().filter(|&row| values[row].is_finite()).collect();
    if rows.is_empty() {
        return Err(selection.no_numbers(table, measure));
    }
    let of_rows = |values: &[f64]| rows.iter().map(|&row| values[row]).collect::<Vec<f64>>();
    let values = of_rows(values);
    let varied: Vec<(usize, Vec<f64>)> = (selection.parameters.iter())
        .filter_map(|&column| match &table.columns[column].cells {
            Cells::Numbers(numbers) => Some((column, of_rows(numbers))),
            _ => None,
        })
        .filter(|(_, numbers)| is_varied(numbers))
        .collect();
    if varied.is_empty() {
        let message = "no parameter has several values in the selected rows: there is nothing to compare";
        return Err(Failure::usage(message).help("draw a sample, or select other rows with --where"));
    }
    let slopes = slopes(table, measure, &rows, &varied, plan)?;
    let mut predicted = vec![0.0; rows.len()];
    let effects = varied.iter().zip(slopes).map(|((column, numbers), slope)| {
        let deviation = covariance(numbers, numbers).sqrt();
        if slope.is_finite() {
            predicted.iter_mut().zip(numbers).for_each(|(sum, number)| *sum += slope * number);
        }
        let sample = covariance(numbers, &values) / deviation;
        Effect { column: *column, deviation, derivative: slope * deviation, sample }
    });
    let mut effects: Vec<Effect> = effects.collect();
    let size = |effect: &Effect| effect.sample.abs().max(effect.derivative.abs());
    effects.sort_by(|one, other| size(other).total_cmp(&size(one)));
    let deviations = [covariance(&predicted, &predicted).sqrt(), covariance(&values, &values).sqrt()];
    Ok(Effects { parameters: effects, designs: rows.len(), deviations })
}

/// Returns the derivatives of the measure with respect to the varied parameters.
///
/// The derivatives are the means of the columns of `[gradient]`. Without such columns, the function computes
/// the derivatives at the means of the parameters. A missing derivative is NaN.
fn slopes(
    table: &Table,
    measure: usize,
    rows: &[usize],
    varied: &[(usize, Vec<f64>)],
    plan: Option<&Plan>,
) -> Result<Vec<f64>, Failure> {
    let name = |column: usize| table.columns[column].name.as_str();
    let in_file = varied.iter().map(|(column, numbers)| {
        [Per::Cent, Per::Unit].into_iter().find_map(|per| {
            let wanted = column_name(name(measure), name(*column), per);
            let place = table.columns.iter().position(|other| other.name == wanted)?;
            let slopes = table.numbers(place).ok()?;
            let slopes = rows.iter().zip(numbers).map(|(&row, value)| match per {
                Per::Cent => 100.0 * slopes[row] / value,
                Per::Unit => slopes[row],
            });
            let known: Vec<f64> = slopes.filter(|slope| slope.is_finite()).collect();
            (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
        })
    });
    let in_file: Vec<Option<f64>> = in_file.collect();
    if in_file.iter().any(Option::is_some) {
        return Ok(in_file.into_iter().map(|slope| slope.unwrap_or(f64::NAN)).collect());
    }
    let plan = plan.ok_or_else(|| {
        let message =
            format!("--derivatives requires derivatives of {}, or the sidecar of the results", name(measure));
        Failure::usage(message)
            .help("add [gradient] to the grid file, or put FILE.meta.toml beside the results")
    })?;
    console::say("derivatives are computed at the means of the parameters");
    let point = table.numbers(0)?[rows[0]];
    at_means(table, name(measure), varied, plan, point)
}

/// Computes the derivatives of a measure at the means of the varied parameters. Parameters that do not vary
/// have the values of the point with the index `point`.
fn at_means(
    table: &Table,
    measure: &str,
    varied: &[(usize, Vec<f64>)],
    plan: &Plan,
    point: f64,
) -> Result<Vec<f64>, Failure> {
    if plan.resonance().is_some() {
        let message = "flap cannot compute derivatives of designs at resonance";
        return Err(Failure::usage(message).help("draw the tornado without --derivatives"));
    }
    let place = plan.rows().columns().iter().position(|column| column.name == measure);
    let place = place.ok_or_else(|| {
        let message = format!("flap cannot compute derivatives of {measure} from the sidecar");
        Failure::usage(message).help("add [gradient] to the grid file, and sweep it again")
    })?;
    let parameter = |column: usize| Parameter::index(plan.parameters(), &table.columns[column].name);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number from 0")]
    let index = Some(point as u64).filter(|&index| index < plan.len()).ok_or_else(|| {
        let message = format!("the grid file in the sidecar has no point {point}");
        Failure::usage(message).help("add [gradient] to the grid file, and sweep it again")
    })?;
    let mut values = plan.point(index).values;
    for (column, numbers) in varied {
        if let Some(index) = parameter(*column) {
            values[index] = numbers.iter().sum::<f64>() / numbers.len() as f64;
        }
    }
    plan.derived().fill(&mut values, &[]);
    let run = PointRun::new(Backend::best(), plan.solver(), &values);
    let row = plan.rows().run_point(&run, None);
    if row.status != Status::Periodic {
        let message = format!(
            "the motion at the means of the parameters is {}, and has no derivatives",
            row.status.name()
        );
        return Err(Failure::usage(message).help("select other rows with --where"));
    }
    let slopes = strongest::slopes(plan, plan.simulator(), &run, &row, place, &[])?;
    let slope = |column: usize| {
        let index = parameter(column)?;
        let (_, slope) = slopes.known.iter().find(|(known, _)| *known == index)?;
        Some(slope / values[index])
    };
    Ok(varied.iter().map(|(column, _)| slope(*column).unwrap_or(f64::NAN)).collect())
}

/// Returns true if all cells of a column contain numbers, and two of the numbers differ. The function
/// compares the values, because the computed covariance of equal values may differ from zero by rounding
/// errors.
fn is_varied(numbers: &[f64]) -> bool {
    numbers.iter().all(|number| number.is_finite())
        && scale::range(numbers.iter().copied()).is_some_and(|(low, high)| low < high)
}

/// Returns the covariance of two columns, or 0 if the columns have fewer than two rows.
fn covariance(x: &[f64], y: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (middle_x, middle_y) = (mean(x), mean(y));
    let sum: f64 = x.iter().zip(y).map(|(x, y)| (x - middle_x) * (y - middle_y)).sum();
    sum / (x.len().max(2) - 1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn covariances_are_unbiased() {
        assert_eq!(covariance(&[1.0, 2.0, 3.0], &[2.0, 4.0, 6.0]), 2.0);
        assert_eq!(covariance(&[1.0, 2.0, 3.0], &[1.0, 1.0, 1.0]), 0.0);
        assert_eq!(covariance(&[5.0], &[5.0]), 0.0);
    }

    #[test]
    fn equal_values_are_not_varied() {
        let same = [0.1; 6];
        assert!(!is_varied(&same) && !is_varied(&[1.0, f64::NAN]) && is_varied(&[1.0, 1.0, 1.5]));
    }
}
