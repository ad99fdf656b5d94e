//! Values that a parameter cannot take.

use super::check;

#[test]
fn unknown_parameters() {
    check(
        r#"
preset = "fly"
[params]
drive_voltage = 1
leg_length = 2
temperature = 3
"#,
        r"
3:1 |drive_voltage| model `flapper` has no parameter `drive_voltage` (unknown parameter)
  help: did you mean `drive_voltage_pp`?
4:1 |leg_length| model `flapper` has no parameter `leg_length` (unknown parameter)
  note: it is a parameter of the model hopper
  help: `flap params` lists the parameters of every model
5:1 |temperature| model `flapper` has no parameter `temperature` (unknown parameter)
  help: `flap params` lists the parameters of every model
",
    );
}

#[test]
fn unknown_units() {
    check(
        r#"
preset = "fly"
[params]
drive_voltage_pp = "200 Volt"
drive_frequency = "60 hz"
wing_area = "54 mm2"
hinge_stiffness = "1.5 uNm/rad"
plate_width = "3 mmm"
"#,
        r"
3:25 |Volt| unknown unit `Volt`
  help: use V, mV, kV
4:23 |hz| unknown unit `hz`
  help: did you mean `Hz`?
5:17 |mm2| unknown unit `mm2`
  help: did you mean `mm^2`?
6:24 |uNm| unknown unit `uNm`
  help: did you mean `uN*m`?
7:18 |mmm| unknown unit `mmm`
  help: did you mean `mm`?
",
    );
}

#[test]
fn units_of_something_else() {
    check(
        r#"
preset = "fly"
[params]
drive_voltage_pp = "2 ms"
drive_frequency = "200 rad/s"
wing_area = "54 mm"
hinge_position = "3 mm"
stroke_offset = "2 s"
"#,
        r"
3:23 |ms| `ms` is a time, but `drive_voltage_pp` is in V
  help: use V, mV, kV
4:24 |rad/s| `rad/s` is an angular rate, but `drive_frequency` is in Hz
  help: use Hz, kHz
5:17 |mm| `mm` is a length, but `wing_area` is in m^2
  help: use m^2, mm^2, um^2
6:21 |mm| `mm` is a length, but `hinge_position` is a pure number
  help: write a bare number, or use %
7:20 |s| `s` is a time, but `stroke_offset` is in rad
  help: use rad, mrad, deg
",
    );
}

#[test]
fn malformed_quantities() {
    check(
        r#"
preset = "fly"
[params]
wing_area = "54"
plate_width = "1e-3e m"
hinge_stiffness = "2 N m"
drive_voltage_pp = "1,5 V"
"#,
        r"
3:14 |54| `wing_area` is written as text but has no unit
  help: add a unit: m^2, mm^2, um^2; or write a bare number in m^2
4:16 |1e-3e| `1e-3e` is not a number
  help: numbers look like 12, 0.5 or 1.5e-6, with a space before the unit
5:24 |m| malformed unit: expected `*` or `/`
  help: units look like V, N*m/rad, mm^2 or kg/(m*s)
6:21 |1,5| `1,5` is not a number
  help: numbers look like 12, 0.5 or 1.5e-6, with a space before the unit
",
    );
}

#[test]
fn text_where_a_number_belongs() {
    check(
        r#"
preset = "fly"
[params]
stroke_offset = "fast"
hinge_position = "half"
drive_frequency = "resonance"
"#,
        r#"
3:18 |fast| `stroke_offset` must start with a number
  help: write a bare number, or a number with its unit such as "200 V"
4:19 |half| `hinge_position` must start with a number
  help: write a bare number, or a number with its unit such as "200 V"
5:19 |"resonance"| the model flapper does not measure a stroke
"#,
    );
}

#[test]
fn other_types() {
    check(
        r#"
preset = "fly"
[params]
drive_voltage_pp = true
drive_frequency = 2020-01-01
wing_area = [1, 2]
plate_width = { from = 1, to = 2, n = 2 }
hinge_position = false
"#,
        r#"
3:20 |true| `drive_voltage_pp` must be a number or text with a unit, not a boolean
  help: write "1 V", or a bare number in V
4:19 |2020-01-01| `drive_frequency` must be a number or text with a unit, not a date or time
  help: write "1 Hz", or a bare number in Hz
5:13 |[1, 2]| `wing_area` must be a number or text with a unit, not a list
  help: only an axis under [axes] or [[zip]] takes more than one value
6:15 |{ from = 1, to = 2, n = 2 }| `plate_width` must be a number or text with a unit, not a table
  help: only an axis under [axes] or [[zip]] takes more than one value
7:18 |false| `hinge_position` must be a number, not a boolean
  help: write a bare number
"#,
    );
}

#[test]
fn numbers_that_are_not_finite() {
    check(
        r#"
preset = "fly"
[params]
drive_voltage_pp = nan
drive_frequency = -inf
wing_area = "nan m^2"
plate_width = 1e999
hinge_stiffness = "1e400 N*m"
stroke_offset = 0xffffffffffffffffffffffffffffffffffffffff
hinge_position = 1e-999
"#,
        r"
3:20 |nan| `drive_voltage_pp` cannot be `nan`: values are finite
4:19 |-inf| `drive_frequency` cannot be `-inf`: values are finite
5:14 |nan| `wing_area` cannot be `nan`: values are finite
6:15 |1e999| `plate_width` is too large for a 64-bit float
7:20 |1e400| `hinge_stiffness` is too large for a 64-bit float
8:17 |0xffffffffffffffffffffffffffffffffffffffff| `stroke_offset` is too large for a 64-bit float
9:18 |1e-999| `hinge_position` is too small for a 64-bit float, but not zero
",
    );
}

#[test]
fn numbers_out_of_range() {
    check(
        r#"
preset = "fly"
[params]
drive_voltage_pp = 0
wing_area = "-5 mm^2"
hinge_stiffness = -1e-6
plate_width = """
-3 mm"""
"#,
        r#"
3:20 |0| `drive_voltage_pp` must be more than zero, not 0 V
4:13 |"-5 mm^2"| `wing_area` must be more than zero, not -5e-6 m^2
5:19 |-1e-6| `hinge_stiffness` must be zero or more, not -1e-6 N*m/rad
6:15 |"""
-3 mm"""| `plate_width` must be more than zero, not -0.003 m
"#,
    );
}

#[test]
fn choices() {
    check(
        r#"
preset = "fly"
[params]
arms = 1
[axes]
stroke_offset = [1]
[[zip]]
hinge_position = [1, 2]
arms = ["prinetd", "x"]
"#,
        r#"
3:8 |1| `arms` is a choice between options, not a number
  note: options: "printed", "axis"
8:1 |arms| `arms` is set under [params] and varied by an axis (the axis would override it)
  line 3 |arms| (set here)
  help: keep one of them
8:9 |"prinetd"| `arms` has no option `prinetd` (unknown option)
  note: options: "printed", "axis"
  help: did you mean `printed`?
8:20 |"x"| `arms` has no option `x` (unknown option)
  note: options: "printed", "axis"
"#,
    );
}

#[test]
fn spans_within_text_with_escapes() {
    check(
        r#"
preset = "fly"
[params]
drive_voltage_pp = "3 \u0056\u0056"
plate_width = 'some \u0056'
"wing_area" = '3 acres'
"#,
        r#"
3:20 |"3 \u0056\u0056"| unknown unit `VV`
  help: did you mean `V`?
4:16 |some \u0056| `plate_width` must start with a number
  help: write a bare number, or a number with its unit such as "200 V"
5:18 |acres| unknown unit `acres`
  help: use m^2, mm^2, um^2
"#,
    );
}
