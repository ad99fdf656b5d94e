//! Expressions that mean nothing, or too much.

use super::check;

#[test]
fn mistakes_are_shown_inside_the_expression() {
    check(
        r#"
preset = "fly"
[derived]
wing_area = "2 * preset.wing_are + stroke_offst"
hinge_stiffness = "hinge_position > 1"
hinge_position = 5
drive_voltage_pp = 'max(1)'
drive_frequency = "plate_width"
wing_size = "1"
arms = "1"
[where]
small = "2 * wing_area"
axial = "arms > 0"
[measure]
good = "lift_mean_mn > 1 mN"
"#,
        r#"
3:18 |preset.wing_are| unknown name `preset.wing_are`
  help: did you mean `preset.wing_area`?
3:36 |stroke_offst| unknown name `stroke_offst`
  help: did you mean `stroke_offset`?
4:20 |hinge_position > 1| this is a condition, not a number
5:18 |5| `hinge_position` must be an expression in quotes, not a number
  help: expressions look like "2 * preset.drive_frequency"
6:21 |max(1)| `max` takes two arguments or more
7:20 |plate_width| `plate_width` has no value of its own
  help: it follows others (half of the length): set `plate_width` under [params] to use it here
8:1 |wing_size| model `flapper` has no parameter `wing_size` (unknown parameter)
  help: did you mean `wing_area`?
9:1 |arms| `arms` is a choice and cannot be derived
  help: expressions are numbers: set it under [params], or vary it under [axes]
11:10 |2 * wing_area| this is a number, not a condition
  help: conditions compare numbers with < <= > >= == or !=
12:10 |arms| `arms` is a choice between options, not a number
  help: compare it with an option: arms == 'printed'
14:26 |mN| expected an operator
  help: values are in SI units and written without them; products need a `*`
"#,
    );
}

#[test]
fn a_parameter_has_one_source() {
    check(
        r#"
preset = "fly"
[params]
wing_area = 1
[axes]
stroke_offset = [1]
[derived]
wing_area = "1"
stroke_offset = "2"
"#,
        r"
7:1 |wing_area| `wing_area` is derived and set under [params] (derived here)
  line 3 |wing_area| (set under [params] here)
  help: keep one of them
8:1 |stroke_offset| `stroke_offset` is derived and varied (derived here)
  line 5 |stroke_offset| (varied here)
  help: keep one of them
",
    );
}

#[test]
fn cycles() {
    check(
        r#"
preset = "fly"
[derived]
hinge_position = "2 * wing_area"
wing_area = "stroke_offset"
stroke_offset = "drive_voltage_pp + wing_area"
drive_voltage_pp = "3"
plate_width = "sqrt(plate_width)"
"#,
        r"
4:1 |wing_area| `wing_area` is derived from itself: wing_area from stroke_offset from wing_area
  line 5 |stroke_offset| (by way of this)
  help: use `preset.` for the value in the preset, or set one of them under [params]
7:1 |plate_width| `plate_width` is derived from itself: plate_width from plate_width
  help: use `preset.` for the value in the preset, or set one of them under [params]
",
    );
}

#[test]
fn names_of_measures() {
    check(
        r#"
preset = "fly"
[measure]
early = "late"
late = "2 * boom"
lift_mean_mn = "1"
wing_area = "1"
status = "1"
min = "1"
"a b" = "1"
after = "late + 1"
[output]
columns = ["late", "later"]
[where]
w = "lift_mean_mn > 1"
"#,
        r#"
3:10 |late| unknown name `late`
  help: a measure may use those above it
4:13 |boom| unknown name `boom`
5:1 |lift_mean_mn| a measure cannot be called `lift_mean_mn`
  note: names are of letters, digits and _, and not those of parameters, columns or functions
  help: give it another name
6:1 |wing_area| a measure cannot be called `wing_area`
  note: names are of letters, digits and _, and not those of parameters, columns or functions
  help: give it another name
7:1 |status| a measure cannot be called `status`
  note: names are of letters, digits and _, and not those of parameters, columns or functions
  help: give it another name
8:1 |min| a measure cannot be called `min`
  note: names are of letters, digits and _, and not those of parameters, columns or functions
  help: give it another name
9:1 |"a b"| a measure cannot be called `a b`
  note: names are of letters, digits and _, and not those of parameters, columns or functions
  help: give it another name
12:20 |"later"| model `flapper` has no column `later` (unknown column)
  note: columns: lift_mean_mn, power_mean_mw, stroke_pp_deg, early, late, after
  help: did you mean `late`?
14:6 |lift_mean_mn| unknown name `lift_mean_mn`
  help: rows measure it when points have run: only [measure] can use it
"#,
    );
}
