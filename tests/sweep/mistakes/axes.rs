//! Axes that cannot be, alone or together.

use super::check;

#[test]
fn each_value_of_a_list_has_its_place() {
    check(
        r#"
preset = "fly"
[axes]
drive_voltage_pp = [100, "fast", -1, "2 s", nan]
wing_size = [1]
"#,
        r#"
3:27 |fast| `drive_voltage_pp` must start with a number
  help: write a bare number, or a number with its unit such as "200 V"
3:34 |-1| `drive_voltage_pp` must be more than zero, not -1 V
3:41 |s| `s` is a time, but `drive_voltage_pp` is in V
  help: use V, mV, kV
3:45 |nan| `drive_voltage_pp` cannot be `nan`: values are finite
4:1 |wing_size| model `flapper` has no parameter `wing_size` (unknown parameter)
  help: did you mean `wing_area`?
"#,
    );
}

#[test]
fn axes_without_values() {
    check(
        r#"
preset = "fly"
[axes]
drive_frequency = []
wing_area = 5
hinge_stiffness = "1 uN*m"
[[zip]]
[[zip]]
stroke_offset = []
"#,
        r#"
3:19 |[]| the axis `drive_frequency` has no values (empty list)
  help: list at least one value, or remove the axis
4:13 |5| the axis `wing_area` must be a list or a range, not a number
  note: axes look like [1, 2, 5], { from = 1, to = 5, n = 9 } or { from = 1, to = 5, step = 0.5 }
  help: to give `wing_area` a single value, put it under [params]
5:19 |"1 uN*m"| the axis `hinge_stiffness` must be a list or a range, not text
  note: axes look like [1, 2, 5], { from = 1, to = 5, n = 9 } or { from = 1, to = 5, step = 0.5 }
  help: to give `hinge_stiffness` a single value, put it under [params]
6:1 |[[zip]]| this zip has no parameters
  help: list the parameters that move together below it, or remove it
8:17 |[]| the axis `stroke_offset` has no values (empty list)
  help: list at least one value, or remove the axis
"#,
    );
}

#[test]
fn keys_of_ranges() {
    check(
        r#"
preset = "fly"
[axes]
drive_voltage_pp = { from = 1, n = 2 }
drive_frequency = {}
stroke_offset = { form = 1, to = 2, n = 2, scale = "logarithmic" }
hinge_stiffness = { from = 1, to = 2, n = 2, step = 1 }
hinge_position = { from = 1, to = 2 }
wing_area = { from = 1, to = 2, n = 3, scale = 3 }
arms = { from = 1, to = 2, n = 2 }
"#,
        r#"
3:20 |{ from = 1, n = 2 }| the range of `drive_voltage_pp` has no `to`
  note: ranges look like { from = 1, to = 5, n = 9 } or { from = 1, to = 5, step = 0.5 }
4:19 |{}| the range of `drive_frequency` has no `from`, `to`, `n` (the number of values) or `step`
  note: ranges look like { from = 1, to = 5, n = 9 } or { from = 1, to = 5, step = 0.5 }
5:19 |form| unknown key `form` in a range (unknown key)
  note: keys in a range: from, to, n, step, scale
  help: did you mean `from`?
5:52 |"logarithmic"| `scale` has no option `logarithmic` (unknown option)
  note: options: "linear", "log"
  help: did you mean `log`?
6:46 |step| a range takes `n` or `step`, not both
  line 6 |n| (`n` is here)
  help: remove one of them
7:18 |{ from = 1, to = 2 }| the range of `hinge_position` has no `n` (the number of values) or `step`
  note: ranges look like { from = 1, to = 5, n = 9 } or { from = 1, to = 5, step = 0.5 }
8:48 |3| `scale` is a choice between options, not a number
  note: options: "linear", "log"
9:8 |{ from = 1, to = 2, n = 2 }| `arms` is a choice and has no ranges
  help: list the options to try, such as ["printed", "axis"]
"#,
    );
}

#[test]
fn numbers_of_values() {
    check(
        r#"
preset = "fly"
[axes]
drive_voltage_pp = { from = 1, to = 2, n = 0 }
drive_frequency = { from = 1, to = 2, n = 1 }
wing_area = { from = 1, to = 1, n = 3 }
stroke_offset = { from = 1, to = 2, n = 2.5 }
hinge_stiffness = { from = 1, to = 2, n = "many" }
hinge_position = { from = 1, to = 2, n = -4 }
plate_width = { from = 1, to = 2, n = 99999999999999999999 }
"#,
        r#"
3:44 |0| `n` must be a whole number of 1 or more, not 0
4:43 |1| a single value cannot be at both `from` and `to`
  line 4 |1| (starts here)
  line 4 |2| (ends here)
  help: use `n = 2` or more, or make a list of the one value
5:37 |3| `from` and `to` are equal: all 3 values would be the same
  help: use `n = 1`, or different ends
6:41 |2.5| `n` must be a whole number of 1 or more, not 2.5
7:43 |"many"| `n` must be a whole number of 1 or more, not text
8:42 |-4| `n` must be a whole number of 1 or more, not -4
9:39 |99999999999999999999| `n` must be at most 9223372036854775808, not 99999999999999999999
"#,
    );
}

#[test]
fn steps() {
    check(
        r#"
preset = "fly"
[axes]
drive_voltage_pp = { from = 1, to = 2, step = 0 }
drive_frequency = { from = 1, to = 2, step = "-1 Hz" }
wing_area = { from = 2, to = 1, step = 1 }
stroke_offset = { from = 1, to = 2, step = "1 s" }
plate_width = { from = 1, to = 2, step = 1, scale = "log" }
hinge_position = { from = 1, to = 2, step = 1e-30 }
"#,
        r#"
3:47 |0| `step` is zero
  help: use a step that leads from `from` to `to`
4:46 |"-1 Hz"| `step` leads away from `to`
  line 4 |1| (starts here)
  line 4 |2| (ends here)
  help: the range goes up: make the step positive
5:40 |1| `step` leads away from `to`
  line 5 |2| (starts here)
  line 5 |1| (ends here)
  help: the range goes down: make the step negative
6:47 |s| `s` is a time, but `step` is in rad
  help: use rad, mrad, deg
7:35 |step| a logarithmic range takes `n`, not `step`
  help: its values keep a constant ratio, not a constant step: give their number `n`
8:45 |1e-30| the range has more than 2^63 values
  help: use a larger step
"#,
    );
}

#[test]
fn ends() {
    check(
        r#"
preset = "fly"
[axes]
wing_area = { from = -1, to = 0, n = 2 }
hinge_position = { from = -1, to = 2, n = 3, scale = "log" }
hinge_stiffness = { from = 0, to = 2, n = 2, scale = "log" }
drive_frequency = { from = 1e-200, to = 1e200, n = 3, scale = "log" }
stroke_offset = { from = -1e308, to = 1e308, n = 3 }
"#,
        r#"
3:22 |-1| `wing_area` must be more than zero, not -1 m^2
3:31 |0| `wing_area` must be more than zero, not 0 m^2
4:36 |2| a logarithmic range cannot pass through zero: both ends need the same sign
  line 4 |-1| (of the other sign)
  help: use ends of the same sign, or scale = "linear"
5:28 |0| a logarithmic range cannot include zero, but `from` is zero
  help: use a small number of the right sign, or scale = "linear"
6:41 |1e200| the range is too wide for 64-bit floats
  line 6 |1e-200| (from here)
7:39 |1e308| the range is too wide for 64-bit floats
  line 7 |-1e308| (from here)
"#,
    );
}

#[test]
fn a_parameter_in_two_places() {
    check(
        r#"
preset = "fly"
[params]
wing_area = 1
[axes]
wing_area = [1, 2]
drive_frequency = [1]
[[zip]]
drive_frequency = [1, -2]
[[zip]]
hinge_position = [1]
[[zip]]
hinge_position = [1]
"#,
        r"
5:1 |wing_area| `wing_area` is set under [params] and varied by an axis (the axis would override it)
  line 3 |wing_area| (set here)
  help: keep one of them
8:1 |drive_frequency| `drive_frequency` is varied by two axes (again here)
  line 6 |drive_frequency| (first here)
  help: keep one of them
8:23 |-2| `drive_frequency` must be more than zero, not -2 Hz
12:1 |hinge_position| `hinge_position` is varied by two axes (again here)
  line 10 |hinge_position| (first here)
  help: keep one of them
",
    );
}

#[test]
fn zips_of_unequal_lengths() {
    check(
        r#"
preset = "fly"
[[zip]]
drive_frequency = [1, 2]
arms = ["axis", "axis", "axis"]
stroke_offset = { from = 1, to = 2, n = 2 }
hinge_position = { from = 1, to = 2, n = 4 }
"#,
        r#"
4:8 |["axis", "axis", "axis"]| `arms` has 3 values but `drive_frequency` has 2: parameters that move together need as many each (values: 3)
  line 3 |[1, 2]| (values: 2)
  help: make them equally long, or use [axes] for every combination
6:18 |{ from = 1, to = 2, n = 4 }| `hinge_position` has 4 values but `drive_frequency` has 2: parameters that move together need as many each (values: 4)
  line 3 |[1, 2]| (values: 2)
  help: make them equally long, or use [axes] for every combination
"#,
    );
}

#[test]
fn more_points_than_can_be_counted() {
    check(
        r#"
preset = "fly"
[axes]
drive_voltage_pp = { from = 1, to = 2, n = 0x4000_0000_0000_0000 }
wing_area = [1, 2, 3]
drive_frequency = [100]
"#,
        r"
4:1 |wing_area| the axes have more than 2^63 points between them (too many with this axis)
  note: points: 4611686018427387904 × 3 × 1
  help: use fewer or shorter axes
",
    );
}
