use proptest::prelude::*;

use super::*;

/// Names for the expressions of the tests. `T`, `preset.kappa`, `x` and `y` are numbers, `ok` is a condition,
/// `arms` is a choice, and `width` has no value.
struct Names;

const OPTIONS: &[&str] = &["printed", "axis"];

impl Scope for Names {
    fn meaning(&self, name: &str) -> Option<Meaning<'_>> {
        Some(match name {
            "T" => Meaning::Number(0),
            "x" => Meaning::Number(1),
            "y" => Meaning::Number(2),
            "arms" => Meaning::Choice(3, OPTIONS),
            "ok" => Meaning::Condition(4),
            "preset.kappa" => Meaning::Constant(1.52e-6),
            "width" => Meaning::Unset("half of the length", String::new()),
            _ => return None,
        })
    }

    fn names(&self) -> Vec<String> {
        ["T", "x", "y", "arms", "ok", "preset.kappa", "width"].map(str::to_owned).to_vec()
    }
}

const VALUES: [f64; 5] = [2000.0, 3.0, f64::NAN, 1.0, 1.0];

fn value(text: &str) -> f64 {
    let expression = Expression::parse(text, &Names).unwrap_or_else(|errors| panic!("{text}: {errors:?}"));
    expression.value(&VALUES)
}

/// The first cases are expressions that some expression libraries compute wrongly, such as `-2^2`.
#[test]
fn numbers() {
    let scaled = 1.52e-6 * libm::pow(2000.0 / 3333.0, -1.47);
    let cases = [
        ("1.52e-6*(T/3333)^(-1.47)", scaled),
        ("preset.kappa * (T / 3333) ^ -1.47", scaled),
        ("2^3^2", 512.0),
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("1/2", 0.5),
        ("2^-1", 0.5),
        ("2^-1^2", 0.5),
        ("2^-2*3", 0.75),
        ("-x^2*2", -18.0),
        ("1 - 2 - 3", -4.0),
        ("12/2/3", 2.0),
        ("12 / 2 * 3", 18.0),
        ("1 + 2 * 3", 7.0),
        ("(1 + 2) * 3", 9.0),
        ("--x", 3.0),
        ("+x - -x", 6.0),
        (".5 + 5. + 1E2 + 1e+2 + 1e-1", 205.6),
        ("x", 3.0),
        ("\tx\n", 3.0),
        ("min(3, 1, 2) + max(3, 1, 2)", 4.0),
        ("sqrt(16) + cbrt(8) + abs(-1)", 7.0),
        ("exp(0) + ln(exp(2)) + log10(1000) + log2(8)", 9.0),
        ("sin(pi/2) + cos(0) + tan(0) + asin(0) + acos(1) + atan(0)", 2.0),
        ("atan2(0, -1)", std::f64::consts::PI),
        ("hypot(3, 4) + sinh(0) + cosh(0) + tanh(0)", 6.0),
        ("floor(1.5) + ceil(1.5) + round(1.5) + sign(-3) + sign(0)", 4.0),
    ];
    for (text, expected) in cases {
        assert_eq!(value(text).to_bits(), expected.to_bits(), "{text} is {}", value(text));
        assert_eq!(Expression::parse(text, &Names).map(|e| e.kind()), Ok(Kind::Number), "{text}");
    }
}

#[test]
fn conditions() {
    let cases = [
        ("x < 3", false),
        ("x <= 3", true),
        ("x > 3", false),
        ("x >= 3", true),
        ("x == 3", true),
        ("x != 3", false),
        ("1 + 1 == 4 / 2", true),
        ("1 < x and x < 5", true),
        ("x < 1 or x > 2 and x > 5", false),
        ("(x < 1 or x > 2) and x < 5", true),
        ("not x < 1", true),
        ("not x > 1 or x > 1", true),
        ("not not ok", true),
        ("ok and arms == 'axis'", true),
        ("arms != \"axis\"", false),
        ("arms=='printed'", false),
        // An unknown side matters only if the other side does not decide.
        ("x < 5 or y > 1", true),
        ("y > 1 and x > 5", false),
    ];
    for (text, expected) in cases {
        assert_eq!(value(text), f64::from(u8::from(expected)), "{text}");
        assert_eq!(Expression::parse(text, &Names).map(|e| e.kind()), Ok(Kind::Condition), "{text}");
    }
}

#[test]
fn what_is_unknown_stays_unknown() {
    let cases = [
        "y",
        "y^0",
        "min(y, 1)",
        "max(1, y)",
        "y == y",
        "y != y",
        "not y > 1",
        "y > 1 and ok",
        "y > 1 or x > 5",
        "sqrt(-1)",
        "0/0",
        "sign(y)",
    ];
    for text in cases {
        assert!(value(text).is_nan(), "{text} is {}", value(text));
    }
}

#[test]
fn reads_are_the_places_of_the_names() {
    let expression = Expression::parse("x + T * x + preset.kappa", &Names).expect("an expression");
    assert_eq!(expression.reads().collect::<Vec<_>>(), [1, 0, 1]);
}

/// Message if an operator is missing before a token.
const OPERATOR: &str =
    "expected an operator; values are in SI units and written without them; products need a `*`";

/// Each case contains an expression with mistakes. For each mistake, the case contains the wrong part of the
/// expression and the complete message.
#[test]
fn mistakes_say_what_and_where() {
    let cases: [(&str, &[(&str, &str)]); 35] = [
        ("", &[("", "the expression is empty")]),
        ("  ", &[("  ", "the expression is empty")]),
        ("2 + S", &[("S", "unknown name `S`")]),
        (
            "preset.kapa * z",
            &[
                ("preset.kapa", "unknown name `preset.kapa`; did you mean `preset.kappa`?"),
                ("z", "unknown name `z`"),
            ],
        ),
        ("2x", &[("2x", "`2x` is not a number; numbers look like 12, 0.5 or 1.5e-6; products need a `*`")]),
        (
            "1.2.3",
            &[("1.2.3", "`1.2.3` is not a number; numbers look like 12, 0.5 or 1.5e-6; products need a `*`")],
        ),
        ("1e", &[("1e", "`1e` is not a number; numbers look like 12, 0.5 or 1.5e-6; products need a `*`")]),
        (".", &[(".", "`.` is not a number; numbers look like 12, 0.5 or 1.5e-6; products need a `*`")]),
        ("1e999", &[("1e999", "the number is too large (largest about 1.8e308)")]),
        ("60 Hz", &[("Hz", OPERATOR)]),
        ("(60 Hz)", &[("Hz", OPERATOR)]),
        ("x +", &[("", "expected a number, a name or `(`")]),
        ("* x", &[("*", "expected a number, a name or `(`")]),
        ("(x", &[("", "expected `)`")]),
        ("x)", &[(")", OPERATOR)]),
        ("sin x", &[("sin", "`sin` is a function; write sin(…)"), ("x", OPERATOR)]),
        ("sine(x)", &[("sine", "there is no function `sine`; did you mean `sin`?")]),
        ("log(x)", &[("log", "there is no function `log`; write ln for the natural logarithm, or log10")]),
        ("sin()", &[("sin()", "`sin` takes one argument")]),
        ("1 + atan2(x)", &[("atan2(x)", "`atan2` takes two arguments")]),
        ("min(x)", &[("min(x)", "`min` takes two arguments or more")]),
        ("sin(x, T)", &[("sin(x, T)", "`sin` takes one argument")]),
        ("max(1, ", &[("", "expected a number, a name or `(`")]),
        ("x ** 2", &[("**", "`**` is not an operator; write ^ for powers")]),
        ("x = 2", &[("=", "`=` is not an operator; write == to compare")]),
        ("ok && ok", &[("&&", "`&&` is not an operator; write and")]),
        ("!ok", &[("!", "`!` is not an operator; write not")]),
        ("x · 2", &[("·", "`·` is not allowed in an expression")]),
        ("1 < x < 5", &[("<", "comparisons cannot be chained; join two comparisons: 1 < x and x < 2")]),
        ("1 + (x < 2)", &[("(x < 2)", "this is a condition, not a number")]),
        (
            "x and ok",
            &[("x", "this is a number, not a condition; conditions compare numbers with < <= > >= == or !=")],
        ),
        (
            "arms + 1",
            &[(
                "arms",
                "`arms` is a choice between options, not a number; compare it with an option: arms == 'printed'",
            )],
        ),
        ("arms == 'axes'", &[("'axes'", "`arms` has no option `axes`; did you mean `axis`?")]),
        ("arms == axis", &[("axis", "expected the name of an option in quotes")]),
        (
            "width / 2",
            &[(
                "width",
                "`width` is not set; it follows other parameters (half of the length): set `width` under [params] to use it here",
            )],
        ),
    ];
    for (text, expected) in cases {
        let errors = Expression::parse(text, &Names).expect_err(text);
        let found: Vec<(&str, String)> =
            errors.iter().map(|error| (&text[error.span.clone()], error.to_string())).collect();
        let expected: Vec<(&str, String)> =
            expected.iter().map(|(part, message)| (*part, (*message).to_owned())).collect();
        assert_eq!(found, expected, "{text}");
    }
}

#[test]
fn comparisons_have_their_places_in_the_text() {
    let text = "(x + 1) < 3 and (T<4 and 2 < y ) and x > -1";
    let comparisons =
        Expression::parse(text, &Names).expect("an expression").comparisons().expect("comparisons");
    let parts: Vec<&str> = comparisons.iter().map(|(span, _)| &text[span.clone()]).collect();
    assert_eq!(parts, ["(x + 1) < 3", "T<4", "2 < y", "x > -1"]);
    assert!(Expression::parse("x < 1 or y < 2", &Names).expect("an expression").comparisons().is_none());
}

/// Names of columns with units, for use in expressions: a frequency, a stiffness and a pure number.
struct Columns;

impl Scope for Columns {
    fn meaning(&self, name: &str) -> Option<Meaning<'_>> {
        let place = ["drive_frequency", "hinge_stiffness", "x2"].iter().position(|known| *known == name);
        if name == "arms" { Some(Meaning::Choice(3, &["95 Hz"])) } else { place.map(Meaning::Number) }
    }

    fn names(&self) -> Vec<String> {
        ["drive_frequency", "hinge_stiffness", "x2", "arms"].map(str::to_owned).to_vec()
    }

    fn has_units(&self) -> bool {
        true
    }

    fn unit(&self, name: &str) -> Option<String> {
        let units = [("drive_frequency", "Hz"), ("hinge_stiffness", "N*m/rad"), ("x2", ""), ("arms", "")];
        units.iter().find(|(known, _)| *known == name).map(|(_, unit)| (*unit).to_owned())
    }
}

#[test]
fn numbers_with_units_are_in_the_units_of_their_columns() {
    for (text, wanted) in [
        ("drive_frequency > 95 Hz", "drive_frequency > 95.0"),
        ("drive_frequency>0.1kHz", "drive_frequency>100.0"),
        ("95 Hz <= drive_frequency and x2 < 3", "95.0 <= drive_frequency and x2 < 3"),
        ("hinge_stiffness > 90 uN*m/rad or (x2 > 1)", "hinge_stiffness > 9e-5 or (x2 > 1)"),
        ("drive_frequency > -5 Hz", "drive_frequency > -5.0"),
        ("-5 Hz < drive_frequency", "-5.0 < drive_frequency"),
        ("drive_frequency > 5 Hz + 1", "drive_frequency > 5.0 + 1"),
        ("2 * drive_frequency > 1 kHz", "2 * drive_frequency > 1000"),
        ("x2<0.08 %", "x2<0.0008"),
        ("x2 > 5% and x2 < 10 %", "x2 > 0.05 and x2 < 0.1"),
        ("x2 > 1e3 and not x2 == 7", "x2 > 1e3 and not x2 == 7"),
        ("arms == '95 Hz'", "arms == '95 Hz'"),
    ] {
        let operations =
            |text: &str| format!("{:?}", Expression::parse(text, &Columns).expect(text).operations);
        assert_eq!(operations(text), operations(wanted), "{text}");
    }
}

#[test]
fn numbers_with_units_that_fit_no_column_are_refused() {
    let cases: [(&str, &[(&str, &str)]); 8] = [
        ("drive_frequency > 95 V", &[("95 V", "`V` is a voltage, but drive_frequency is in Hz")]),
        ("drive_frequency > 95 Hx", &[("95 Hx", "unknown unit `Hx`")]),
        (
            "95 Hz < drive_freqency",
            &[("drive_freqency", "unknown name `drive_freqency`"), ("95 Hz", "`95 Hz` is not compared")],
        ),
        ("(95 Hz) < drive_frequency", &[("95 Hz", "`95 Hz` is not compared with a column")]),
        ("95 Hz + 1 < drive_frequency", &[("95 Hz", "`95 Hz` is not compared with a column")]),
        ("95 Hz < abs(x2)", &[("95 Hz", "`95 Hz` is not compared with a column")]),
        ("95 Hz and x2 > 1", &[("95 Hz", "`95 Hz` is not compared with a column")]),
        ("x2 > 2 3 Hz", &[("3 Hz", "expected an operator")]),
    ];
    for (text, expected) in cases {
        let errors = Expression::parse(text, &Columns).expect_err(text);
        assert_eq!(errors.len(), expected.len(), "{text}: {errors:?}");
        for (error, (part, message)) in errors.iter().zip(expected) {
            assert_eq!(&text[error.span.clone()], *part, "{text}");
            assert!(error.message.contains(message), "{text}: {}", error.message);
        }
    }
}

#[test]
fn hostile_nesting_is_refused() {
    for piece in ["(", "-", "not ", "sin(", "2^", "min(1,"] {
        let errors = Expression::parse(&piece.repeat(1_000_000), &Names).expect_err(piece);
        assert_eq!(errors[0].message, "the expression is nested too deeply", "{piece}");
    }
    // A long expression is not a deep one.
    assert_eq!(value(&format!("{}1", "1+".repeat(100_000))), 100_001.0);
}

proptest! {
    /// Parsing of random text never panics, and the positions of mistakes are always within the text.
    #[test]
    fn any_text_is_handled(words in prop::collection::vec(0..27_usize, 0..12), other in "\\PC{0,16}") {
        const WORDS: [&str; 27] = [
            "x", "T", "arms", "ok", "width", "preset.kappa", "1", "2.5e-3", "'axis'", "(", ")", "+", "-", "*", "/", "^",
            "<", "==", "and", "or", "not", "min(", ",", "µ", "drive_frequency", "Hz", "%",
        ];
        let words: Vec<&str> = words.into_iter().map(|word| WORDS[word]).collect();
        let scopes: [&dyn Scope; 2] = [&Names, &Columns];
        let texts = [words.join(" "), words.concat(), other];
        for (text, scope) in texts.iter().flat_map(|text| scopes.map(|scope| (text, scope))) {
            match Expression::parse(text, scope) {
                Ok(expression) => {
                    let value = expression.value(&VALUES);
                    let logical = value.is_nan() || value == 0.0 || value == 1.0;
                    prop_assert!(expression.kind() == Kind::Number || logical, "{} is {}", text, value);
                }
                Err(errors) => {
                    prop_assert!(!errors.is_empty());
                    for error in errors {
                        prop_assert!(text.get(error.span.clone()).is_some(), "{} {:?}", text, error);
                    }
                }
            }
        }
    }

    /// For random numbers, the value of an expression equals the value that Rust computes.
    #[test]
    fn arithmetic_is_that_of_rust(a in -1e3..1e3_f64, b in -1e3..1e3_f64, c in 0.1..3.0_f64) {
        prop_assert_eq!(value(&format!("{a} + {b} * {c}")), a + b * c);
        prop_assert_eq!(value(&format!("{a} - {b} / {c}")), a - b / c);
        prop_assert_eq!(value(&format!("({a} - {b}) / {c}")), (a - b) / c);
        prop_assert_eq!(value(&format!("{c}^{c}^2")), libm::pow(c, libm::pow(c, 2.0)));
        prop_assert_eq!(value(&format!("{a} < {b} and not {a} == {c}")), f64::from(u8::from(a < b && a != c)));
    }
}
