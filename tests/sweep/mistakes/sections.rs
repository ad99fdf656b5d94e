//! Presets, sections and settings.

use super::check;

#[test]
fn an_empty_file() {
    check(
        "",
        r#"
1:1 || the file is empty
  note: presets, with their models: fly (flapper), moth (flapper), flea (hopper)
  help: start the file with a preset, such as: preset = "fly"
"#,
    );
}

#[test]
fn a_missing_preset() {
    check(
        r"
# Everything that does not depend on the model is still checked.
[params]
wing_area = -1
[solver]
rtol = 3
[output]
path = 3
",
        r#"
1:1 || `preset` is missing
  note: presets, with their models: fly (flapper), moth (flapper), flea (hopper)
  help: start the file with a preset, such as: preset = "fly"
5:8 |3| `rtol` must be more than zero and less than 0.1, not 3
7:8 |3| `path` must be text in quotes, not a number
"#,
    );
}

#[test]
fn an_unknown_preset() {
    check(
        r#"
preset = "mothh"
[solver]
rtool = 1
"#,
        r#"
1:10 |"mothh"| there is no preset `mothh` (unknown preset)
  note: presets, with their models: fly (flapper), moth (flapper), flea (hopper)
  help: did you mean `moth`?
3:1 |rtool| unknown key `rtool` in [solver] (unknown key)
  note: keys in [solver]: rtol, atol, settle_tol, max_cycles, max_steps, accuracy, newton
  help: did you mean `rtol`?
"#,
    );
}

#[test]
fn a_preset_that_is_no_name() {
    check(
        r"
preset = 3
",
        r"
1:10 |3| `preset` must be text in quotes, not a number
",
    );
}

#[test]
fn a_preset_without_a_name() {
    check(
        r#"
preset = ""
"#,
        r#"
1:10 |""| `preset` is empty
"#,
    );
}

#[test]
fn unknown_keys() {
    check(
        r#"
preset = "fly"
param = 1
wing_area = 3
shapes = { wing_area = "2" }
"#,
        r"
2:1 |param| unknown key `param` at the top of a grid file (unknown key)
  note: keys at the top of a grid file: preset, params, resonance, axes, zip, sample, derived, where, measure, solver, output
  help: did you mean `params`?
3:1 |wing_area| unknown key `wing_area` at the top of a grid file (unknown key)
  note: keys at the top of a grid file: preset, params, resonance, axes, zip, sample, derived, where, measure, solver, output
  help: parameters go into [params], or into [axes] to vary them
4:1 |shapes| unknown key `shapes` at the top of a grid file (unknown key)
  note: keys at the top of a grid file: preset, params, resonance, axes, zip, sample, derived, where, measure, solver, output
",
    );
}

#[test]
fn sections_that_are_no_tables() {
    check(
        r#"
preset = "fly"
params = 3
axes = [1]
zip = 3
solver = "x"
[[output]]
path = "a"
"#,
        r#"
2:10 |3| `params` must be a table, not a number
  help: write [params] on a line of its own, once
3:8 |[1]| `axes` must be a table, not a list
  help: write [axes] on a line of its own, once
4:7 |3| `zip` must be a table of parameters, not a number
  help: write [[zip]] above the parameters that move together
5:10 |"x"| `solver` must be a table, not text
  help: write [solver] on a line of its own, once
6:1 |[[output]]| `output` must be a table, not a list
  help: write [output] on a line of its own, once
"#,
    );
}

#[test]
fn zip_with_single_brackets() {
    check(
        r#"
preset = "fly"
[zip]
wing_area = [1]
"#,
        r"
2:1 |[zip]| `zip` takes double brackets: there may be several
  help: write [[zip]] above the parameters that move together
",
    );
}

#[test]
fn zip_as_a_list_of_other_things() {
    check(
        r#"
preset = "fly"
zip = [1, {}]
"#,
        r"
2:8 |1| `zip` must be a table of parameters, not a number
  help: write [[zip]] above the parameters that move together
2:11 |{}| this zip has no parameters
  help: list the parameters that move together below it, or remove it
",
    );
}

#[test]
fn solver() {
    check(
        r#"
preset = "fly"
[solver]
rtol = 0.1
atol = 0
settle_tol = nan
max_cycles = 0
max_steps = 5e9
tol = 1
"#,
        r"
3:8 |0.1| `rtol` must be more than zero and less than 0.1, not 0.1
4:8 |0| `atol` must be more than zero, not 0
5:14 |nan| `settle_tol` cannot be `nan`: values are finite
6:14 |0| `max_cycles` must be a whole number of 1 or more, not 0
7:13 |5e9| `max_steps` must be a whole number of 1 or more, not 5e9
8:1 |tol| unknown key `tol` in [solver] (unknown key)
  note: keys in [solver]: rtol, atol, settle_tol, max_cycles, max_steps, accuracy, newton
  help: did you mean `atol`?
",
    );
}

#[test]
fn solver_types() {
    check(
        r#"
preset = "fly"
[solver]
rtol = "1e-6"
atol = -1
settle_tol = [1]
max_cycles = 5000000000
max_step = 5
"#,
        r#"
3:8 |"1e-6"| `rtol` must be a number, not text
  help: write a bare number, such as 1e-6, without quotes
4:8 |-1| `atol` must be more than zero, not -1
5:14 |[1]| `settle_tol` must be a number, not a list
  help: write a bare number, such as 1e-6, without quotes
6:14 |5000000000| `max_cycles` must be at most 4294967295, not 5000000000
7:1 |max_step| unknown key `max_step` in [solver] (unknown key)
  note: keys in [solver]: rtol, atol, settle_tol, max_cycles, max_steps, accuracy, newton
  help: did you mean `max_steps`?
"#,
    );
}

#[test]
fn output() {
    check(
        r#"
preset = "fly"
[output]
path = 3
columns = ["lift_mean", "status", "wing_area", "lift_mean_mn", 3, "lift_mean_mn", "x"]
file = "a"
"#,
        r#"
3:8 |3| `path` must be text in quotes, not a number
4:12 |"lift_mean"| model `flapper` has no column `lift_mean` (unknown column)
  note: columns: lift_mean_mn, power_mean_mw, stroke_pp_deg
  help: did you mean `lift_mean_mn`?
4:25 |"status"| model `flapper` has no column `status` (unknown column)
  note: every row has these columns, and the varied parameters, without asking: point, status, cycles, residual, period, floquet_max, stable, error_estimate, rhs_evals
  help: remove `status`: `columns` selects among the measures
4:35 |"wing_area"| model `flapper` has no column `wing_area` (unknown column)
  note: every row has these columns, and the varied parameters, without asking: point, status, cycles, residual, period, floquet_max, stable, error_estimate, rhs_evals
  help: remove `wing_area`: `columns` selects among the measures
4:64 |3| `columns` must be text in quotes, not a number
4:67 |"lift_mean_mn"| column `lift_mean_mn` is listed twice (again here)
  line 4 |"lift_mean_mn"| (first here)
  help: keep one of them
4:83 |"x"| model `flapper` has no column `x` (unknown column)
  note: columns: lift_mean_mn, power_mean_mw, stroke_pp_deg
5:1 |file| unknown key `file` in [output] (unknown key)
  note: keys in [output]: path, columns
"#,
    );
}

#[test]
fn empty_output() {
    check(
        r#"
preset = "fly"
[output]
path = ""
columns = []
"#,
        r#"
3:8 |""| `path` is empty
4:11 |[]| `columns` must be a list of column names
  help: remove `columns` to write all columns of the model
"#,
    );
}

#[test]
fn columns_that_are_no_list() {
    check(
        r#"
preset = "fly"
[output]
columns = "lift_mean_mn"
"#,
        r#"
3:11 |"lift_mean_mn"| `columns` must be a list of column names
  help: remove `columns` to write all columns of the model
"#,
    );
}
