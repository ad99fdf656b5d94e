//! Reads the section `[sample]`: points that are spread over the design space, or listed in a file. The
//! points of a sample form one axis.

pub(super) mod distribution;
mod file;

use std::sync::Arc;

use flap_core::parameter::Parameter;
use toml::de::DeInteger;

use super::axes::{self, Placed};
use super::device::Base;
use super::diagnostic::Problems;
use super::lookup::Lookup;
use super::table::{self, Entry};
use super::value;
use crate::plan::axes::{Axis, Values};
use crate::plan::sample::{Method, SamplePoints};
use crate::plan::{PointsFile, Value};

pub(super) const KEYS: [&str; 5] = ["method", "n", "seed", "of", "parameters"];
pub(super) const FILE_KEYS: [&str; 2] = ["method", "path"];
pub(super) const METHODS: [&str; 4] = ["sobol", "latin-hypercube", "random", "file"];
/// Allowed values of the key `of`, which replaces the list of the sampled parameters.
pub(super) const OF: [&str; 1] = ["device"];

/// Returns the sample that the section `[sample]` describes, and the file of its points if the section names
/// a file.
///
/// `base` contains the standard errors of parameters, and `means` contains the values that the parameters
/// have without the sample. If the distribution of a parameter is wrong, the sample contains this parameter
/// without values, so that later checks can use the parameter.
pub(super) fn read(
    entry: Option<&Entry<'_>>,
    base: &Base,
    means: &[Value],
    lookup: &mut Lookup<'_>,
) -> Option<(Placed, Option<PointsFile>)> {
    let section = entry?;
    let entries = table::section(section, lookup.problems);
    let Some(method) = table::find(&entries, "method") else {
        let methods = METHODS.map(|method| format!("\"{method}\"")).join(", ");
        lookup
            .report(section.key_span.clone(), "the sample has no `method`")
            .note(format!("methods: {methods}"))
            .help("start with `method = \"sobol\"`, `n`, and the parameters under [sample.parameters]");
        return None;
    };
    let method = match value::option("method", &METHODS, method.value, lookup.problems)? {
        0 => Method::Sobol,
        1 => Method::LatinHypercube,
        2 => Method::Random,
        _ => {
            table::check_keys(&entries, &FILE_KEYS, "in a [sample] from a file", lookup.problems);
            return file::read(section, &entries, lookup).map(|(placed, file)| (placed, Some(file)));
        }
    };
    table::check_keys(&entries, &KEYS, "in [sample]", lookup.problems);
    let count = count(section, &entries, lookup.problems);
    let seed = seed(&entries, lookup.problems);
    let below = table::find(&entries, "parameters");
    if let Some(of) = table::find(&entries, "of") {
        let sample = (method, seed.unwrap_or(0), count.unwrap_or(1));
        return of_device(section, of, below, sample, base, lookup).map(|placed| (placed, None));
    }
    let parameters = below.map(|entry| table::section(entry, lookup.problems)).unwrap_or_default();
    if parameters.is_empty() {
        let place = below.unwrap_or(section).key_span.clone();
        let diagnostic = lookup.report(place, "the sample has no parameters").help(
            "list them under [sample.parameters]: wing_area = { from = \"50 mm^2\", to = \"60 mm^2\" }",
        );
        if below.is_some() {
            diagnostic.label("nothing below it");
        }
        return None;
    }
    let found: Vec<_> = parameters
        .iter()
        .filter_map(|entry| lookup.parameter(entry).map(|(index, parameter)| (index, parameter, entry)))
        .collect();
    if let Some((.., entry)) = found.get(SamplePoints::MAX_DIMENSIONS) {
        let most = SamplePoints::MAX_DIMENSIONS;
        lookup.report(entry.key_span.clone(), format!("a sample has at most {most} parameters"));
        return None;
    }
    let sample = Arc::new(SamplePoints::new(method, seed.unwrap_or(0), count.unwrap_or(1), found.len()));
    let mut axis = Vec::new();
    let mut keys = Vec::new();
    let mut with_units = Vec::new();
    for (dimension, (index, parameter, entry)) in found.into_iter().enumerate() {
        let distribution = distribution::read(parameter, means[index], entry, lookup.problems);
        let values = distribution.map_or_else(axes::none, |distribution| Values::Sampled {
            sample: Arc::clone(&sample),
            dimension,
            distribution,
        });
        axis.push((index, values));
        keys.push(entry.key_span.clone());
        with_units.push(value::has_units(entry.value));
    }
    Some((Placed { axis: Axis::new(axis), span: section.key_span.clone(), keys, with_units }, None))
}

/// Returns the indices of the parameters in `[sample.parameters]`. Unknown names are left out without a
/// report.
pub(super) fn sampled(section: Option<&Entry<'_>>, parameters: &[Parameter<'_>]) -> Vec<usize> {
    let sample = section.and_then(|section| section.value.get_ref().as_table());
    let sampled = sample.and_then(|sample| sample.get("parameters")?.get_ref().as_table());
    let names = sampled.into_iter().flat_map(|sampled| sampled.keys());
    names.filter_map(|name| Parameter::index(parameters, name.get_ref())).collect()
}

/// Returns a sample of builds of the device. In this sample, all parameters with standard errors vary, with
/// the correlations that the device states.
fn of_device(
    section: &Entry<'_>,
    of: &Entry<'_>,
    below: Option<&Entry<'_>>,
    (method, seed, count): (Method, u64, u64),
    base: &Base,
    lookup: &mut Lookup<'_>,
) -> Option<Placed> {
    value::option("of", &OF, of.value, lookup.problems)?;
    if let Some(below) = below {
        lookup
            .report(below.key_span.clone(), "a sample is of the device or of parameters, not of both")
            .related(of.key_span.clone(), "of the device")
            .help("keep one of them");
        return None;
    }
    if base.robot.has_designs() {
        lookup
            .report(of.value.span(), "a sample draws builds of one device, but the grid has several designs")
            .help("write a grid file for each device");
        return None;
    }
    let errors = base.uncertainty.errors();
    if errors.is_empty() || errors.len() > SamplePoints::MAX_DIMENSIONS {
        let most = SamplePoints::MAX_DIMENSIONS;
        let (message, help) = if errors.is_empty() {
            let help = "write `hinge_stiffness = { value = \"2.1 uN*m/rad\", sd = \"0.1 uN*m/rad\" }` under [params] of the device";
            ("no parameter of the device has a standard error".to_owned(), help)
        } else {
            (
                format!("a sample has at most {most} parameters"),
                "leave out standard errors with little effect",
            )
        };
        lookup.report(of.value.span(), message).help(help);
        return None;
    }
    // Contradicting correlations are reported at their positions.
    let factor = base.uncertainty.factor()?;
    let sample = Arc::new(SamplePoints::new(method, seed, count, errors.len()));
    let axis = errors.iter().zip(factor).filter_map(|(&(index, sd), weights)| {
        let mean = base.values[index].given()?;
        Some((index, Values::Correlated { sample: Arc::clone(&sample), mean, sd, weights }))
    });
    let axis: Vec<_> = axis.collect();
    let (keys, with_units) = (vec![of.key_span.clone(); axis.len()], vec![None; axis.len()]);
    Some(Placed { axis: Axis::new(axis), span: section.key_span.clone(), keys, with_units })
}

/// Returns the number of points of a sample. If the number is missing or wrong, reports a mistake and returns
/// `None`.
fn count(section: &Entry<'_>, entries: &[Entry<'_>], problems: &mut Problems) -> Option<u64> {
    let Some(entry) = table::find(entries, "n") else {
        problems
            .report(section.key_span.clone(), "the sample has no `n`")
            .help("`n` is the number of points: write `n = 1000`");
        return None;
    };
    value::count("n", SamplePoints::MAX_POINTS, entry.value, problems)
}

/// Returns the seed of the random points, if the section has a seed.
fn seed(entries: &[Entry<'_>], problems: &mut Problems) -> Option<u64> {
    let value = table::find(entries, "seed")?.value;
    let integer = value.get_ref().as_integer();
    let seed = integer
        .and_then(|integer: &DeInteger<'_>| u64::from_str_radix(integer.as_str(), integer.radix()).ok());
    if seed.is_none() {
        problems.report(value.span(), "`seed` must be a whole number from 0 to 2^64 - 1");
    }
    seed
}
