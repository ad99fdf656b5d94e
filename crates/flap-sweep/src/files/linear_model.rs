//! Files with a linear hover model for other programs. The formats of the files are JSON, MATLAB, Python and
//! FMU. All numbers are in SI units.

use std::io::{self, Write};
use std::path::Path;

use flap_core::parameter::Parameter;
use flap_core::simulate::Simulator as _;
use nalgebra::DMatrix;

use super::fmu::Fmu;
use super::matlab::{self, Variable};
use crate::notation::text;
use crate::vehicle::control::{Effectiveness, VehicleRun};
use crate::vehicle::hover::{HoverError, HoverModel, STATES, WRENCH_UNITS, component};

/// Input of a linear model, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearInput {
    /// Name.
    pub name: String,
    /// Unit of the input; may be empty.
    pub unit: String,
    /// Value of the input at the operating point.
    pub value: f64,
}

/// A hover model with the operating point at which the model is valid.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearModel {
    /// Model.
    pub hover: HoverModel,
    /// Inputs, in the order of the columns of B.
    pub inputs: Vec<LinearInput>,
    /// Drive frequency (Hz).
    pub frequency: f64,
    /// Largest magnitude of the Floquet multipliers of the wings.
    pub floquet_max: f64,
    /// Position of the centre of mass (m). Torques and velocities refer to the centre of mass.
    pub about: [f64; 3],
    /// Assumption about the wings while the body moves: the wings respond (`passive`), or keep their
    /// motion (`frozen`).
    pub response: String,
    /// Name of the model, and of the preset or device.
    pub design: String,
}

/// Format of a file with a linear model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearFormat {
    /// JSON object.
    Json,
    /// MAT file of version 5.
    Matlab,
    /// Python module.
    Python,
    /// Functional mock-up unit of FMI 3.0, with source code in C.
    Fmu,
}

impl LinearFormat {
    /// Endings of file names, for messages.
    pub const ENDINGS: &str = ".json, .mat, .py or .fmu";

    /// Returns the format that the ending of the file name `path` determines, or `None` if no format has
    /// this ending.
    pub fn of(path: &Path) -> Option<LinearFormat> {
        match path.extension()?.to_str()? {
            "json" => Some(LinearFormat::Json),
            "mat" => Some(LinearFormat::Matlab),
            "py" => Some(LinearFormat::Python),
            "fmu" => Some(LinearFormat::Fmu),
            _ => None,
        }
    }
}

impl LinearModel {
    /// Returns the hover model at an operating point. `values` contains the values of the vehicle's
    /// parameters, and `at` contains the inputs and the effect of each input.
    ///
    /// If `has_position` is true, the states include the position of the body. `design` contains the name
    /// of the model, and the name of the preset or device.
    ///
    /// # Errors
    /// Returns an error if a mass property is missing or impossible, if the body is not at rest, or if a
    /// derivative cannot be computed.
    pub fn at(
        vehicle_run: &VehicleRun<'_>,
        values: &[f64],
        at: &Effectiveness,
        has_position: bool,
        design: String,
    ) -> Result<LinearModel, HoverError> {
        let vehicle = vehicle_run.vehicle;
        let parameters = vehicle.parameters();
        let index = |name: &str| Parameter::index(parameters, name);
        let hover = HoverModel::at(vehicle_run, values, at, has_position)?;
        let response =
            index("body_response").and_then(|index| text::option(&parameters[index], values[index]));
        let inputs = at.inputs.iter().zip(&at.values).map(|(input, value)| LinearInput {
            name: input.name.clone(),
            unit: parameters[input.parameter].unit.to_owned(),
            value: value * input.factor,
        });
        Ok(LinearModel {
            hover,
            inputs: inputs.collect(),
            frequency: index("drive_frequency").map_or(f64::NAN, |index| values[index]),
            floquet_max: at.row.floquet_max,
            about: vehicle.about(values),
            response: response.unwrap_or_default().to_owned(),
            design,
        })
    }

    /// Returns the reasons why the linear model may be inaccurate.
    pub fn warnings(&self) -> Vec<String> {
        self.hover.warnings(self.frequency, self.floquet_max)
    }

    /// Writes the hover model to `target` in the format `format`.
    ///
    /// # Errors
    /// Returns the error of the operating system if the target cannot be written.
    pub fn write(&self, format: LinearFormat, target: &mut dyn Write) -> io::Result<()> {
        let variables = self.variables();
        match format {
            LinearFormat::Json => target.write_all(json(&variables).as_bytes()),
            LinearFormat::Matlab => matlab::write(&variables, target),
            LinearFormat::Python => target.write_all(python(&variables).as_bytes()),
            LinearFormat::Fmu => target.write_all(&self.fmu().archive()?),
        }
    }

    /// Returns the variables that the files of all formats except FMU contain.
    fn variables(&self) -> Vec<(&'static str, Variable)> {
        let texts = |texts: &[&str]| Variable::Texts(texts.iter().map(|text| (*text).to_owned()).collect());
        let (names, units): (Vec<&str>, Vec<&str>) = self.hover.states().iter().copied().unzip();
        let motions: Vec<&str> = STATES[..6].iter().map(|(name, _)| *name).collect();
        let motion_units: Vec<&str> = STATES[..6].iter().map(|(_, unit)| *unit).collect();
        let components: Vec<&str> = (0..6).map(component).collect();
        let size = self.hover.a.nrows();
        let of_inputs = |text: fn(&LinearInput) -> &String| {
            Variable::Texts(self.inputs.iter().map(|input| text(input).clone()).collect())
        };
        let values = self.inputs.iter().map(|input| input.value).collect();
        let damping = DMatrix::from_fn(6, 6, |i, j| self.hover.damping[(i, j)]);
        let mut variables = vec![
            ("A", Variable::Matrix(self.hover.a.clone())),
            ("B", Variable::Matrix(self.hover.b.clone())),
            ("C", Variable::Matrix(DMatrix::identity(size, size))),
            ("D", Variable::Matrix(DMatrix::zeros(size, self.inputs.len()))),
            ("states", texts(&names)),
            ("state_units", texts(&units)),
            ("inputs", of_inputs(|input| &input.name)),
            ("input_units", of_inputs(|input| &input.unit)),
            ("outputs", texts(&names)),
            ("output_units", texts(&units)),
            ("input_values", Variable::Vector(values)),
            ("damping", Variable::Matrix(damping)),
            ("control_matrix", Variable::Matrix(self.hover.control.clone())),
            ("W0", Variable::Vector(self.hover.wrench.to_vec())),
            ("wrench", texts(&components)),
            ("wrench_units", texts(&WRENCH_UNITS)),
            ("motions", texts(&motions)),
            ("motion_units", texts(&motion_units)),
            ("design", Variable::Text(self.design.clone())),
            ("body_response", Variable::Text(self.response.clone())),
            ("about", Variable::Vector(self.about.to_vec())),
        ];
        variables.extend(self.numbers().map(|(name, _, value)| (name, Variable::Number(value))));
        variables
    }

    /// Returns numbers that describe the operating point and the body, each with a name and a unit.
    fn numbers(&self) -> [(&'static str, &'static str, f64); 8] {
        let body = &self.hover.body;
        [
            ("drive_frequency", "Hz", self.frequency),
            ("floquet_max", "", self.floquet_max),
            ("total_mass", "kg", body.mass),
            ("body_inertia_roll", "kg*m^2", body.inertia[0]),
            ("body_inertia_pitch", "kg*m^2", body.inertia[1]),
            ("body_inertia_yaw", "kg*m^2", body.inertia[2]),
            ("body_inertia_product", "kg*m^2", body.product),
            ("gravity", "m/s^2", body.gravity),
        ]
    }

    /// Returns the model as an FMU. The constants of the FMU describe the operating point.
    fn fmu(&self) -> Fmu<'_> {
        let inputs = self.inputs.iter();
        let values =
            inputs.clone().map(|input| (format!("input_values.{}", input.name), &*input.unit, input.value));
        let numbers =
            self.numbers().map(|(name, unit, value)| (format!("operating_point.{name}"), unit, value));
        Fmu {
            description: format!(
                "Linear hover model of {}, whose inputs are changes from input_values. The response of the wings to the \
                 motion of the body is {}.",
                self.design, self.response
            ),
            a: &self.hover.a,
            b: &self.hover.b,
            states: self.hover.states(),
            inputs: inputs.map(|input| (&*input.name, &*input.unit)).collect(),
            constants: values.chain(numbers).filter(|(_, _, value)| value.is_finite()).collect(),
        }
    }
}

/// Returns the variables as a JSON object. A matrix is a list of rows.
fn json(variables: &[(&str, Variable)]) -> String {
    let entries = variables.iter().map(|(name, variable)| {
        let literal = match variable {
            Variable::Matrix(matrix) => format!("[\n    {}\n  ]", rows(matrix, "null").join(",\n    ")),
            Variable::Vector(vector) => list(vector, "null"),
            Variable::Number(value) => number(*value, "null"),
            Variable::Text(text) => quoted(text),
            Variable::Texts(texts) => quoted_list(texts),
        };
        format!("  \"{name}\": {literal}")
    });
    format!("{{\n{}\n}}\n", entries.collect::<Vec<_>>().join(",\n"))
}

/// Returns the text of a Python module with the variables. If python-control is installed, the module also
/// builds a `control.StateSpace`.
fn python(variables: &[(&str, Variable)]) -> String {
    const HEAD: &str = "\
\"\"\"Linear hover model of a flapping-wing vehicle, written by flap. All numbers are in SI units.

x' = A x + B s, where x contains small deviations from hover (`states`) and s the changes of the `inputs` from
`input_values`. The outputs are the states. `damping` and `control_matrix` are the derivatives of mean force and torque
(`wrench`) with respect to `motions` and `inputs`, and `W0` is the mean force and torque at the operating point.

`system` is a `control.StateSpace`, or None if python-control is not installed.
\"\"\"

import numpy as np

";
    const TAIL: &str = "
try:
    import control
except ImportError:
    system = None
else:
    system = control.ss(A, B, C, D, states=states, inputs=inputs, outputs=outputs)
";
    let entries = variables.iter().map(|(name, variable)| {
        let literal = match variable {
            Variable::Matrix(matrix) => {
                format!("np.array([\n    {},\n])", rows(matrix, "np.nan").join(",\n    "))
            }
            Variable::Vector(vector) => format!("np.array({})", list(vector, "np.nan")),
            Variable::Number(value) => number(*value, "np.nan"),
            Variable::Text(text) => quoted(text),
            Variable::Texts(texts) => quoted_list(texts),
        };
        format!("{name} = {literal}\n")
    });
    format!("{HEAD}{}{TAIL}", entries.collect::<String>())
}

/// Returns the shortest decimal text from which exactly the float `value` can be read, or `missing` if
/// `value` is not finite.
fn number(value: f64, missing: &str) -> String {
    if value.is_finite() { text::float(value) } else { missing.to_owned() }
}

fn list(values: &[f64], missing: &str) -> String {
    let values: Vec<String> = values.iter().map(|value| number(*value, missing)).collect();
    format!("[{}]", values.join(", "))
}

/// Returns each row of a matrix as a list.
fn rows(matrix: &DMatrix<f64>, missing: &str) -> Vec<String> {
    let row = |i: usize| matrix.row(i).iter().copied().collect::<Vec<f64>>();
    (0..matrix.nrows()).map(|i| list(&row(i), missing)).collect()
}

/// Returns a text in quotes, so that both JSON and Python can read the text.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn quoted_list(texts: &[String]) -> String {
    let texts: Vec<String> = texts.iter().map(|text| quoted(text)).collect();
    format!("[{}]", texts.join(", "))
}

#[cfg(test)]
mod tests {
    use flap_core::vehicle::MassProperties;
    use nalgebra::Matrix6;

    use super::*;

    #[test]
    fn literals_of_python_and_json() {
        let variables = [
            ("A", Variable::Matrix(DMatrix::from_row_slice(2, 1, &[1e-9, f64::NAN]))),
            ("v", Variable::Vector(vec![1.0])),
            ("n", Variable::Number(f64::INFINITY)),
            ("t", Variable::Texts(vec!["a \"b\"".to_owned(), String::new()])),
        ];
        let json: serde_json::Value = serde_json::from_str(&json(&variables)).unwrap();
        assert_eq!(
            json,
            serde_json::json!({"A": [[1e-9], [null]], "v": [1.0], "n": null, "t": ["a \"b\"", ""]})
        );
        let python = python(&variables);
        let expected = "A = np.array([\n    [1e-9],\n    [np.nan],\n])\nv = np.array([1.0])\nn = np.nan\nt = [\"a \\\"b\\\"\", \"\"]\n";
        assert!(python.contains(expected), "{python}");
    }

    #[test]
    fn files_contain_the_model() {
        let body =
            MassProperties { mass: 69e-6, inertia: [1.5e-9, 1.5e-9, 0.5e-9], product: 1e-10, gravity: 9.8 };
        let damping =
            Matrix6::from_fn(|i, j| if i == j { -1e-7 } else { 1e-9 * (i as f64 - 2.0 * j as f64) });
        let control = DMatrix::from_fn(6, 2, |i, j| 1e-6 / (1.0 + i as f64) - 1e-7 * j as f64);
        let hover = HoverModel::new(body, damping, control, [0.0; 6], true).unwrap();
        let input = |name: &str| LinearInput { name: name.to_owned(), unit: "V".to_owned(), value: 140.0 };
        let model = LinearModel {
            hover,
            inputs: vec![input("amplitude"), input("bias")],
            frequency: 120.0,
            floquet_max: 0.2,
            about: [0.0, 0.0, -3e-3],
            response: "passive".to_owned(),
            design: "bimorph from \"µ\"".to_owned(),
        };
        let file = |format| {
            let mut file = Vec::new();
            model.write(format, &mut file).unwrap();
            file
        };
        let json: serde_json::Value = serde_json::from_slice(&file(LinearFormat::Json)).unwrap();
        assert_eq!(json["A"][0][7], 9.8);
        assert_eq!(json["B"][3][1].as_f64(), Some(model.hover.b[(3, 1)]));
        assert_eq!(json["D"].as_array().map(Vec::len), Some(12));
        assert_eq!((&json["states"][11], &json["motions"][3]), (&"position_up".into(), &"rate_roll".into()));
        assert_eq!(json["design"], "bimorph from \"µ\"");
        let module = String::from_utf8(file(LinearFormat::Python)).unwrap();
        assert!(module.contains("inputs = [\"amplitude\", \"bias\"]\n"), "{module}");
        assert!(file(LinearFormat::Matlab).starts_with(b"MATLAB 5.0 MAT-file"));
        let archive = file(LinearFormat::Fmu);
        assert_eq!(archive, file(LinearFormat::Fmu));
        let archive = String::from_utf8_lossy(&archive);
        let input = r#"<Float64 name="bias" valueReference="14" unit="V" causality="input""#;
        assert!(archive.contains(input) && archive.contains("bimorph from &quot;µ&quot;"), "{archive}");
    }

    #[test]
    fn formats_by_ending() {
        let of = |name: &str| LinearFormat::of(Path::new(name));
        assert_eq!(of("folder.py/model.mat"), Some(LinearFormat::Matlab));
        assert_eq!(
            (of("model.json"), of("model.py"), of("model.fmu")),
            (Some(LinearFormat::Json), Some(LinearFormat::Python), Some(LinearFormat::Fmu))
        );
        assert_eq!((of("model"), of("model.csv")), (None, None));
    }
}
