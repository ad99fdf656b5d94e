//! Functional mock-up units (FMUs, version 3.0 of the standard) of linear models.
//!
//! An FMU contains source code in C. The user, or the program that simulates the FMU, compiles the source
//! code. Source: Modelica Association, Functional Mock-up Interface Specification, version 3.0, sections 2.4
//! (model description) and 2.5 (archive).

use std::collections::BTreeSet;
use std::io::{self, Cursor, Write as _};

use nalgebra::DMatrix;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use crate::notation::{text, units};

/// Code of all models.
const CODE: &str = include_str!("fmu.c");

const BUILD_DESCRIPTION: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiBuildDescription fmiVersion="3.0">
  <BuildConfiguration modelIdentifier="hover">
    <SourceFileSet language="C99">
      <SourceFile name="fmu.c"/>
    </SourceFileSet>
  </BuildConfiguration>
</fmiBuildDescription>
"#;

/// A linear model x' = A x + B s with the states x and the inputs s. The outputs of the model are the
/// states x.
pub(super) struct Fmu<'m> {
    /// Description of the model.
    pub(super) description: String,
    /// State matrix.
    pub(super) a: &'m DMatrix<f64>,
    /// Input matrix.
    pub(super) b: &'m DMatrix<f64>,
    /// Names and units of the states.
    pub(super) states: &'m [(&'m str, &'m str)],
    /// Names and units of the inputs.
    pub(super) inputs: Vec<(&'m str, &'m str)>,
    /// Names, units and values of the constants. The list contains at least one constant.
    pub(super) constants: Vec<(String, &'m str, f64)>,
}

impl Fmu<'_> {
    /// Returns the archive. The archives of equal models have equal bytes.
    ///
    /// # Errors
    /// Returns an error if the archive is larger than the ZIP format allows.
    pub(super) fn archive(&self) -> io::Result<Vec<u8>> {
        let numbers = self.numbers();
        let token = text::hash(&[&self.description(""), &numbers, CODE].concat());
        archive(&[
            ("modelDescription.xml", &self.description(&token)),
            ("sources/buildDescription.xml", BUILD_DESCRIPTION),
            ("sources/fmu.c", CODE),
            ("sources/model.h", &format!("#define TOKEN \"{token}\"\n{numbers}")),
        ])
    }

    /// Returns C code that defines the matrices and the constants of the model.
    fn numbers(&self) -> String {
        let list = |values: &mut dyn Iterator<Item = f64>| {
            format!("{{{}}}", values.map(text::float).collect::<Vec<_>>().join(", "))
        };
        let row = |i: usize| list(&mut self.a.row(i).iter().chain(&self.b.row(i)).copied());
        let rows: Vec<String> = (0..self.states.len()).map(row).collect();
        format!(
            "#define STATES {}\n#define INPUTS {}\n#define NORM {}\n\
             static const double MATRIX[STATES][STATES + INPUTS] = {{\n    {},\n}};\n\
             static const double CONSTANTS[] = {};\n",
            self.states.len(),
            self.inputs.len(),
            text::float(self.a.abs().column_sum().max()),
            rows.join(",\n    "),
            list(&mut self.constants.iter().map(|(_, _, value)| *value)),
        )
    }

    /// Returns the XML text of the file `modelDescription.xml`.
    fn description(&self, token: &str) -> String {
        // Names, units and other attributes in the order of the value references.
        let mut variables = vec![("time".to_owned(), "s".to_owned(), continuous("independent"))];
        let first_state = variables.len();
        variables.extend(self.states.iter().map(|(name, unit)| {
            let start = r#" initial="exact" start="0.0""#;
            ((*name).to_owned(), (*unit).to_owned(), continuous("output") + start)
        }));
        variables.extend(self.inputs.iter().map(|(name, unit)| {
            let change = format!(r#" start="0.0" description="change from input_values.{}""#, escaped(name));
            ((*name).to_owned(), (*unit).to_owned(), continuous("input") + &change)
        }));
        let first_derivative = variables.len();
        variables.extend(self.states.iter().zip(first_state..).map(|((name, unit), state)| {
            let per_second = unit.strip_suffix("/s").map(|unit| format!("{unit}/s^2"));
            let unit = per_second.unwrap_or_else(|| format!("{unit}/s"));
            (format!("der({name})"), unit, format!(r#"{} derivative="{state}""#, continuous("local")))
        }));
        variables.extend(self.constants.iter().map(|(name, unit, value)| {
            let start =
                format!(r#"causality="local" variability="constant" start="{}""#, text::float(*value));
            (name.clone(), (*unit).to_owned(), start)
        }));
        let used_units: BTreeSet<&str> = variables.iter().map(|(_, unit, _)| &**unit).collect();
        let used_units = used_units.into_iter().filter(|unit| !unit.is_empty());
        let elements = variables.iter().enumerate().map(|(reference, (name, unit, attributes))| {
            let name = escaped(name);
            let unit = if unit.is_empty() { String::new() } else { format!(r#" unit="{}""#, escaped(unit)) };
            format!("    <Float64 name=\"{name}\" valueReference=\"{reference}\"{unit} {attributes}/>\n")
        });
        let states = self.states.len();
        // Without dependencies, importers would assume that the outputs depend on the inputs.
        let outputs = (first_state..first_state + states)
            .map(|state| format!("    <Output valueReference=\"{state}\" dependencies=\"{state}\"/>\n"));
        let derivatives = |element: &'static str| {
            (first_derivative..first_derivative + states)
                .map(move |derivative| format!("    <{element} valueReference=\"{derivative}\"/>\n"))
        };
        let structure =
            outputs.chain(derivatives("ContinuousStateDerivative")).chain(derivatives("InitialUnknown"));
        format!(
            r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="hover" instantiationToken="{token}"
  description="{}" generationTool="flap {}" variableNamingConvention="structured">
  <ModelExchange modelIdentifier="hover" providesDirectionalDerivatives="true"/>
  <CoSimulation modelIdentifier="hover" providesDirectionalDerivatives="true" canHandleVariableCommunicationStepSize="true"/>
  <UnitDefinitions>
{}  </UnitDefinitions>
  <LogCategories>
    <Category name="logStatusError"/>
  </LogCategories>
  <ModelVariables>
{}  </ModelVariables>
  <ModelStructure>
{}  </ModelStructure>
</fmiModelDescription>
"#,
            escaped(&self.description),
            env!("CARGO_PKG_VERSION"),
            used_units.map(unit_definition).collect::<String>(),
            elements.collect::<String>(),
            structure.collect::<String>(),
        )
    }
}

/// Returns a ZIP archive of files with the given names and texts. The date of all files is 1980-01-01, so equal files
/// give equal bytes.
fn archive(files: &[(&str, &str)]) -> io::Result<Vec<u8>> {
    let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    let options = stored.last_modified_time(DateTime::default());
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in files {
        archive.start_file(*name, options)?;
        archive.write_all(text.as_bytes())?;
    }
    Ok(archive.finish()?.into_inner())
}

fn continuous(causality: &str) -> String {
    format!(r#"causality="{causality}" variability="continuous""#)
}

/// Returns the XML element that defines a unit by the powers of the SI base units. If flap does not know
/// the unit, the element contains no base units.
fn unit_definition(unit: &str) -> String {
    let base = units::si_powers(unit).map(|powers| {
        let powers = powers.iter().filter(|(_, exponent)| *exponent != 0);
        let powers = powers.map(|(symbol, exponent)| format!(r#" {symbol}="{exponent}""#));
        format!("<BaseUnit{}/>", powers.collect::<Vec<_>>().concat())
    });
    format!("    <Unit name=\"{}\">{}</Unit>\n", escaped(unit), base.unwrap_or_default())
}

/// Returns a copy of `text` that can be the value of an XML attribute: special characters such as `<` are
/// escaped.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_in_base_units() {
        let stiffness = r#"    <Unit name="N*m/rad"><BaseUnit m="2" kg="1" s="-2" rad="-1"/></Unit>"#;
        assert_eq!(unit_definition("N*m/rad"), format!("{stiffness}\n"));
        // A unit with a factor, and a unit of another program.
        for unit in ["mm", "a<b"] {
            assert_eq!(unit_definition(unit), format!("    <Unit name=\"{}\"></Unit>\n", escaped(unit)));
        }
        assert_eq!(escaped("a<\"b\"&c"), "a&lt;&quot;b&quot;&amp;c");
    }
}
