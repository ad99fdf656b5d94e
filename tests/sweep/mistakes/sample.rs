//! Impossible samples.

use super::check;

#[test]
fn keys_of_samples() {
    check(
        "preset = \"fly\"\n[sample]\nn = 5\n",
        r#"
2:2 |sample| the sample has no `method`
  note: methods: "sobol", "latin-hypercube", "random", "file"
  help: start with `method = "sobol"`, `n`, and the parameters under [sample.parameters]
"#,
    );
    check(
        "preset = \"fly\"\n[sample]\nmethod = \"sobel\"\n",
        r#"
3:10 |"sobel"| `method` has no option `sobel` (unknown option)
  note: options: "sobol", "latin-hypercube", "random", "file"
  help: did you mean `sobol`?
"#,
    );
    check(
        "preset = \"fly\"\n[sample]\nmethod = \"sobol\"\nseed = -1\nsize = 3\n",
        r#"
2:2 |sample| the sample has no `n`
  help: `n` is the number of points: write `n = 1000`
2:2 |sample| the sample has no parameters
  help: list them under [sample.parameters]: wing_area = { from = "50 mm^2", to = "60 mm^2" }
4:8 |-1| `seed` must be a whole number from 0 to 2^64 - 1
5:1 |size| unknown key `size` in [sample] (unknown key)
  note: keys in [sample]: method, n, seed, of, parameters
"#,
    );
    check(
        "preset = \"fly\"\n[sample]\nmethod = \"file\"\nn = 5\n",
        r#"
2:2 |sample| the sample has no `path`
  help: name the file of points: write `path = "points.csv"`
4:1 |n| unknown key `n` in a [sample] from a file (unknown key)
  note: keys in a [sample] from a file: method, path
"#,
    );
    check(
        "preset = \"fly\"\n[sample]\nmethod = \"random\"\nn = 4294967297\nparameters.wing_area = [1]",
        r"
4:5 |4294967297| `n` must be at most 4294967296, not 4294967297
",
    );
}

#[test]
fn a_sample_has_parameters() {
    for (method, parameters) in [("sobol", ""), ("latin-hypercube", ""), ("random", "")] {
        check(
            &format!(
                "preset = \"fly\"\n[sample]\nmethod = \"{method}\"\nn = 8\n[sample.parameters]\n{parameters}"
            ),
            r#"
5:9 |parameters| the sample has no parameters (nothing below it)
  help: list them under [sample.parameters]: wing_area = { from = "50 mm^2", to = "60 mm^2" }
"#,
        );
    }
}

#[test]
fn distributions() {
    check(
        r#"
preset = "fly"
[axes]
wing_area = [1]
[sample]
method = "random"
n = 5
[sample.parameters]
wing_area = { from = 2, to = 1 }
drive_voltage_pp = { from = 1 }
drive_frequency = { from = -1, to = "2 V" }
stroke_offset = { relative_sd = "5 %" }
hinge_position = { sd = 1, relative_sd = 0.1 }
plate_width = { relative_sd = "5 %" }
arms = { from = 0, to = 1 }
hinge_stiffness = 5
"#,
        r#"
8:1 |wing_area| `wing_area` is varied by two axes (again here)
  line 3 |wing_area| (first here)
  help: keep one of them
8:13 |{ from = 2, to = 1 }| `from` must be less than `to`
9:20 |{ from = 1 }| the distribution of `drive_voltage_pp` needs `from` and `to`, or `sd`
  note: distributions look like { from = 1, to = 5 }, { from = 1, to = 5, scale = "log" }, { mean = 3, sd = 0.1 }, { relative_sd = "5 %" } or [1, 2, 5]
10:28 |-1| `drive_frequency` must be more than zero, not -1 Hz
10:40 |V| `V` is a voltage, but `drive_frequency` is in Hz
  help: use Hz, kHz
11:33 |"5 %"| `relative_sd` must give a standard deviation of more than zero, not 0
  help: the mean is zero: give `sd` in the unit of the parameter
12:28 |relative_sd| a normal distribution takes `sd` or `relative_sd`, not both
  help: keep one of them
13:15 |{ relative_sd = "5 %" }| `plate_width` is not set, so it has no value for the mean
  help: give the distribution a `mean`
14:8 |{ from = 0, to = 1 }| `arms` is a choice and has no such distribution
  help: list the options to choose from at random, such as ["printed", "axis"]
15:19 |5| `hinge_stiffness` must be a distribution or a list, not a number
  note: distributions look like { from = 1, to = 5 }, { from = 1, to = 5, scale = "log" }, { mean = 3, sd = 0.1 }, { relative_sd = "5 %" } or [1, 2, 5]
  help: to give `hinge_stiffness` a single value, put it under [params]
"#,
    );
    check(
        r#"
preset = "fly"
[sample]
method = "random"
n = 5
[sample.parameters]
wing_area = { mean = 1, sd = 0.1, from = 9 }
stroke_offset = { from = -1, to = 1, scale = "log" }
hinge_position = { mean = 1, scale = "log" }
drive_frequency = { mean = 1, form = 2 }
"#,
        r#"
6:13 |{ mean = 1, sd = 0.1, from = 9 }| the normal distribution has no values between `from` and `to`
7:17 |{ from = -1, to = 1, scale = "log" }| a logarithmic scale needs ends that are not zero and have the same sign
8:30 |scale| a normal distribution has no `scale`
  help: remove it, or give `from` and `to` alone
9:31 |form| unknown key `form` in a distribution (unknown key)
  note: keys in a distribution: from, to, scale, mean, sd, relative_sd
  help: did you mean `from`?
"#,
    );
}

#[test]
fn a_share_is_no_standard_deviation() {
    check(
        "preset = \"fly\"\n[sample]\nmethod = \"random\"\nn = 5\n[sample.parameters]\nhinge_position = { mean = 1, sd = \"5 %\" }\n",
        r#"
6:35 |"5 %"| `sd` is in the unit of the parameter, not a share of its value
  help: write `relative_sd` for a share
"#,
    );
}
