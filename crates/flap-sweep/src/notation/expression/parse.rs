//! Parses expressions. The parser converts the text into tokens, and the tokens into operations in postfix
//! order, with Pratt's method for the precedence of operators.

use std::ops::Range;

use super::error::{ExpressionError, Mistake};
use super::evaluate::{self, Function, Operation, Operator, precedence};
use super::scope::{Kind, Meaning, Scope};
use crate::notation::{nearest, text, units};

/// Largest allowed depth of nested parentheses, functions and operators. Deeper nesting is a mistake or an
/// attack, and could overflow the stack of the program.
const MOST_NESTED: usize = 100;

/// Parts of a parsed expression: its type, its operations, and the byte ranges of its comparisons of two
/// numbers.
type Parsed = (Kind, Vec<Operation>, Vec<Range<usize>>);

/// Checks `text`. See [`super::Expression::parse`].
pub(super) fn parse(text: &str, scope: &dyn Scope) -> Result<Parsed, Vec<ExpressionError>> {
    if text.trim().is_empty() {
        return Err(vec![ExpressionError::new(0..text.len(), "the expression is empty")]);
    }
    let mut parser = Parser {
        tokens: Tokens::new(text, scope.has_units()),
        next: (Token::End, 0..0),
        consumed: Vec::new(),
        scope,
        operations: Vec::new(),
        comparisons: Vec::new(),
        errors: Vec::new(),
        unit_errors: Vec::new(),
        nested: 0,
    };
    let whole = parser.expression();
    let mut errors = parser.errors;
    errors.append(&mut parser.unit_errors);
    match whole {
        Ok(operand) if errors.is_empty() => {
            Ok((operand.kind.unwrap_or(Kind::Number), parser.operations, parser.comparisons))
        }
        Ok(_) => Err(errors),
        Err(error) => {
            errors.push(error);
            Err(errors)
        }
    }
}

/// An operand of an operator.
struct Operand {
    /// Type of the operand; `None` if the operand contains a mistake, so that the mistake is not reported
    /// twice.
    kind: Option<Kind>,
    span: Range<usize>,
}

struct Parser<'a> {
    tokens: Tokens<'a>,
    next: (Token<'a>, Range<usize>),
    /// All tokens that the parser has consumed.
    consumed: Vec<Token<'a>>,
    scope: &'a dyn Scope,
    operations: Vec<Operation>,
    comparisons: Vec<Range<usize>>,
    /// Mistakes after which the parser can still check the rest of the text.
    errors: Vec<ExpressionError>,
    /// Mistakes in numbers with units, which the parser reports after the mistakes in names.
    unit_errors: Vec<ExpressionError>,
    nested: usize,
}

impl<'a> Parser<'a> {
    fn expression(&mut self) -> Result<Operand, ExpressionError> {
        self.advance()?;
        let operand = self.operand(precedence::ANY)?;
        match self.next.0 {
            Token::End => Ok(operand),
            _ => Err(self.no_operator()),
        }
    }

    /// Consumes the next token.
    fn advance(&mut self) -> Result<(Token<'a>, Range<usize>), ExpressionError> {
        let next = self.tokens.next()?;
        let token = std::mem::replace(&mut self.next, next);
        self.consumed.push(token.0);
        Ok(token)
    }

    fn is_next(&self, sign: &str) -> bool {
        matches!(self.next.0, Token::Sign(next) if next == sign)
    }

    /// Consumes the next token, which must be the operator or parenthesis `sign`.
    fn take(&mut self, sign: &str, expected: &'static str) -> Result<Range<usize>, ExpressionError> {
        if self.is_next(sign) {
            return self.advance().map(|(_, span)| span);
        }
        match self.next.0 {
            Token::Number(_) | Token::Quantity(_) | Token::Name(_) | Token::Text(_) => {
                Err(self.no_operator())
            }
            Token::Sign(_) | Token::End => Err(self.expected(expected)),
        }
    }

    /// Returns an error whose position is the next token.
    fn error(&self, message: impl Into<String>) -> ExpressionError {
        ExpressionError::new(self.next.1.clone(), message)
    }

    fn expected(&self, what: &str) -> ExpressionError {
        self.error(format!("expected {what}"))
    }

    fn no_operator(&self) -> ExpressionError {
        let help = "values are in SI units and written without them; products need a `*`";
        self.expected("an operator").helps(help).of(Mistake::NoOperator)
    }

    /// Records a mistake, and returns an operand without a type, so that no further mistake is reported for
    /// the operand.
    fn record(&mut self, error: ExpressionError, span: Range<usize>) -> Operand {
        self.errors.push(error);
        Operand { kind: None, span }
    }

    /// Records a mistake if `operand` does not have the type `wanted`.
    fn check_kind(&mut self, wanted: Kind, operand: &Operand) {
        if operand.kind.is_some_and(|kind| kind != wanted) {
            self.errors.push(ExpressionError::mismatch(operand.span.clone(), wanted));
        }
    }

    /// Parses an operand and the operators after it. Parsing stops before an operator whose precedence is
    /// below `least`.
    fn operand(&mut self, least: u8) -> Result<Operand, ExpressionError> {
        self.nested += 1;
        if self.nested > MOST_NESTED {
            return Err(self.error("the expression is nested too deeply"));
        }
        let mut left = self.prefix()?;
        let mut is_comparison = false;
        while let Some(operator) = infix(&self.next.0)
            && operator.binds >= least
        {
            let binds = operator.binds;
            if binds == precedence::COMPARISON && is_comparison {
                let error = self.error("comparisons cannot be chained");
                return Err(error.helps("join two comparisons: 1 < x and x < 2"));
            }
            is_comparison = binds == precedence::COMPARISON;
            self.advance()?;
            // Equal operators associate to the left, except powers.
            let right = self.operand(if binds == precedence::POWER { binds } else { binds + 1 })?;
            left = self.combine(operator, &left, &right);
        }
        self.nested -= 1;
        Ok(left)
    }

    /// Adds the operation of a binary operator, and returns the operand that represents the result of the
    /// operation.
    fn combine(&mut self, operator: &'static Operator, left: &Operand, right: &Operand) -> Operand {
        self.check_kind(operator.takes, left);
        self.check_kind(operator.takes, right);
        self.operations.push(Operation::Binary(operator));
        let span = left.span.start..right.span.end;
        if (operator.takes, operator.gives) == (Kind::Number, Kind::Condition) {
            self.comparisons.push(span.clone());
        }
        Operand { kind: Some(operator.gives), span }
    }

    /// Parses a number, a name or parentheses, optionally after a unary operator.
    fn prefix(&mut self) -> Result<Operand, ExpressionError> {
        let (token, span) = self.next.clone();
        match token {
            Token::Number(number) => {
                self.advance()?;
                self.operations.push(Operation::Push(number));
                Ok(Operand { kind: Some(Kind::Number), span })
            }
            Token::Quantity(quantity) => {
                self.advance()?;
                Ok(self.quantity(quantity, span))
            }
            Token::Name("not") => self.unary(Some(|a| 1.0 - a), precedence::NOT, Kind::Condition),
            Token::Sign("-") => self.unary(Some(|a: f64| -a), precedence::SIGN, Kind::Number),
            Token::Sign("+") => self.unary(None, precedence::SIGN, Kind::Number),
            Token::Sign("(") => {
                self.advance()?;
                let inner = self.operand(precedence::ANY)?;
                let end = self.take(")", "`)`")?.end;
                Ok(Operand { kind: inner.kind, span: span.start..end })
            }
            Token::Name(name) if name != "and" && name != "or" => {
                self.advance()?;
                if self.is_next("(") { self.call(name, span) } else { self.named(name, span) }
            }
            _ => Err(self.expected("a number, a name or `(`")),
        }
    }

    /// Converts a number with a unit, such as `95 Hz`, into an operand. In `drive_frequency > 95 Hz`, the
    /// number is converted to the unit of `drive_frequency`.
    fn quantity(&mut self, quantity: &str, span: Range<usize>) -> Operand {
        let unit = self.compared().and_then(|name| Some((name, self.scope.unit(name)?)));
        let converted = if let Some((name, unit)) = unit {
            units::parse_in(quantity, &unit).map_err(|error| ExpressionError {
                help: error.help(),
                ..ExpressionError::new(span.clone(), error.message(name))
            })
        } else {
            let message = format!("`{quantity}` is not compared with a column");
            let help = "a number with a unit stands beside a column: drive_frequency > 95 Hz";
            Err(ExpressionError::new(span.clone(), message).helps(help))
        };
        let kind = converted.as_ref().ok().map(|_| Kind::Number);
        match converted {
            Ok(number) => self.operations.push(Operation::Push(number)),
            Err(error) => self.unit_errors.push(error),
        }
        Operand { kind, span }
    }

    /// Returns the name with which the last consumed number is compared, such as `x` in `x > 95 Hz` or
    /// `95 Hz < x`.
    fn compared(&self) -> Option<&'a str> {
        let is_comparison =
            |token: &Token<'_>| infix(token).is_some_and(|operator| operator.binds == precedence::COMPARISON);
        let before = self.consumed.iter().rev().skip(1);
        let mut before = before.skip_while(|token| matches!(token, Token::Sign("+" | "-")));
        let name = if before.next().is_some_and(is_comparison) {
            before.next().copied()
        } else if is_comparison(&self.next.0) {
            self.tokens.clone().next().ok().map(|(token, _)| token)
        } else {
            None
        };
        match name {
            Some(Token::Name(name)) => Some(name),
            _ => None,
        }
    }

    /// Parses a unary operator and its operand.
    fn unary(
        &mut self,
        function: Option<fn(f64) -> f64>,
        binds: u8,
        kind: Kind,
    ) -> Result<Operand, ExpressionError> {
        let (_, sign) = self.advance()?;
        let operand = self.operand(binds)?;
        self.check_kind(kind, &operand);
        self.operations.extend(function.map(Operation::Apply));
        Ok(Operand { kind: Some(kind), span: sign.start..operand.span.end })
    }

    /// Returns the operand that the name `name` represents.
    fn named(&mut self, name: &str, span: Range<usize>) -> Result<Operand, ExpressionError> {
        let constant = || (name == evaluate::PI.0).then_some(Meaning::Constant(evaluate::PI.1));
        let (kind, operation) = match self.scope.meaning(name).or_else(constant) {
            Some(Meaning::Number(place)) => (Kind::Number, Operation::Read(place)),
            Some(Meaning::Condition(place)) => (Kind::Condition, Operation::Read(place)),
            Some(Meaning::Constant(value)) => (Kind::Number, Operation::Push(value)),
            Some(Meaning::OfChoice(place, numbers)) => (Kind::Number, Operation::ReadOf(place, numbers)),
            Some(Meaning::Choice(place, options)) => return self.choice(name, span, place, options),
            Some(Meaning::Unset(follows, designs)) => {
                return Ok(self.record(unset(name, follows, &designs, &span), span));
            }
            None => return Ok(self.record(self.unknown(name, &span), span)),
        };
        self.operations.push(operation);
        Ok(Operand { kind: Some(kind), span })
    }

    fn unknown(&self, name: &str, span: &Range<usize>) -> ExpressionError {
        if evaluate::find(name).is_some() {
            let error = ExpressionError::new(span.clone(), format!("`{name}` is a function"));
            return error.helps(format!("write {name}(…)"));
        }
        let mut known = self.scope.names();
        known.push(evaluate::PI.0.to_owned());
        let help = nearest(name, known.iter().map(String::as_str)).map(did_you_mean);
        let mistake = Mistake::UnknownName(name.to_owned());
        ExpressionError { span: span.clone(), mistake, message: format!("unknown name `{name}`"), help }
    }

    /// Parses the comparison of a choice with one of its options. An expression can use a choice only in a
    /// comparison with one of its options.
    fn choice(
        &mut self,
        name: &str,
        span: Range<usize>,
        place: usize,
        options: &[&str],
    ) -> Result<Operand, ExpressionError> {
        let comparison = infix(&self.next.0).filter(|operator| ["==", "!="].contains(&operator.sign));
        let Some(comparison) = comparison else {
            let first = options.first().copied().unwrap_or_default();
            let message = format!("`{name}` is a choice between options, not a number");
            let help = format!("compare it with an option: {name} == '{first}'");
            return Ok(self.record(ExpressionError::new(span.clone(), message).helps(help), span));
        };
        self.advance()?;
        let (token, text_span) = self.advance()?;
        let Token::Text(text) = token else {
            let error = ExpressionError::new(text_span, "expected the name of an option in quotes");
            return Err(error.of(Mistake::NotInQuotes));
        };
        let span = span.start..text_span.end;
        let Some(index) = options.iter().position(|option| *option == text) else {
            let error = ExpressionError::new(text_span, format!("`{name}` has no option `{text}`"));
            return Ok(self.record(error.helps(nearest_or_all(text, options, "options")), span));
        };
        self.operations.push(Operation::Read(place));
        self.operations.push(Operation::Push(index as f64));
        self.operations.push(Operation::Binary(comparison));
        Ok(Operand { kind: Some(Kind::Condition), span })
    }

    /// Parses the arguments of the function `name`, which stand in parentheses.
    fn call(&mut self, name: &str, span: Range<usize>) -> Result<Operand, ExpressionError> {
        let Some(function) = evaluate::find(name) else {
            let help = if name == "log" {
                "write ln for the natural logarithm, or log10".to_owned()
            } else {
                nearest_or_all(name, &evaluate::names().collect::<Vec<_>>(), "functions")
            };
            return Err(ExpressionError::new(span, format!("there is no function `{name}`")).helps(help));
        };
        self.advance()?;
        let mut count = 0;
        while !self.is_next(")") {
            if count > 0 {
                self.take(",", "`,` or `)`")?;
            }
            let argument = self.operand(precedence::ANY)?;
            self.check_kind(Kind::Number, &argument);
            count += 1;
            // Applied pairwise, as the arguments are read.
            if let (Function::Many(function), 2..) = (function, count) {
                self.operations.push(Operation::Apply2(function));
            }
        }
        let span = span.start..self.take(")", "`)`")?.end;
        let takes = match function {
            Function::One(one) => {
                self.operations.push(Operation::Apply(one));
                (count != 1).then_some("one argument")
            }
            Function::Two(two) => {
                self.operations.push(Operation::Apply2(two));
                (count != 2).then_some("two arguments")
            }
            Function::Many(_) => (count < 2).then_some("two arguments or more"),
        };
        if let Some(takes) = takes {
            self.errors.push(ExpressionError::new(span.clone(), format!("`{name}` takes {takes}")));
        }
        Ok(Operand { kind: Some(Kind::Number), span })
    }
}

fn did_you_mean(name: &str) -> String {
    format!("did you mean `{name}`?")
}

/// Returns advice for a message about the unknown name `name`. The advice is the most similar known name, or
/// a list of all known names if no name is similar.
fn nearest_or_all(name: &str, known: &[&str], what: &str) -> String {
    let all = || format!("{what}: {}", known.join(", "));
    nearest(name, known.iter().copied()).map_or_else(all, did_you_mean)
}

/// Returns the error for the parameter `name`, whose value is not set. `follows` describes the parameters
/// from which the model computes the value. `designs` lists the designs in which the value is not set, and is
/// empty if no design sets the value.
fn unset(name: &str, follows: &str, designs: &str, span: &Range<usize>) -> ExpressionError {
    let why = text::no_default(follows).unwrap_or_else(|| format!("it follows other parameters ({follows})"));
    let help = if name.contains('.') {
        format!("{why}, so that there is no number to use")
    } else {
        format!("{why}: set `{name}` under [params] to use it here")
    };
    let designs = if designs.is_empty() { String::new() } else { format!(" for {designs}") };
    ExpressionError::new(span.clone(), format!("`{name}` is not set{designs}")).helps(help)
}

/// Returns the binary operator of `token`.
fn infix(token: &Token<'_>) -> Option<&'static Operator> {
    match *token {
        Token::Name(sign) | Token::Sign(sign) => evaluate::operator(sign),
        _ => None,
    }
}

/// A token.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'t> {
    Number(f64),
    /// A number with a unit.
    Quantity(&'t str),
    /// A name, which may contain dots, as in `preset.wing_area`. The words `and`, `or` and `not` are also
    /// tokens of the variant `Name`.
    Name(&'t str),
    /// A text that is written in quotes. The token contains the text without the quotes.
    Text(&'t str),
    /// An operator, a parenthesis or a comma.
    Sign(&'static str),
    End,
}

/// Signs. In the list, `<=` must come before `<`, because the parser uses the first sign that matches.
const SIGNS: [&str; 14] = ["<=", ">=", "==", "!=", "<", ">", "+", "-", "*", "/", "^", "(", ")", ","];

/// Operators that are words.
pub(super) const WORDS: [&str; 3] = ["and", "or", "not"];

/// Operators of programming languages that are not allowed in expressions, each with the operator to use
/// instead.
const FOREIGN: [(&str, &str); 6] =
    [("**", "^ for powers"), ("&&", "and"), ("||", "or"), ("<>", "!="), ("=", "== to compare"), ("!", "not")];

/// Iterator over the tokens of a text.
#[derive(Clone)]
pub(super) struct Tokens<'t> {
    text: &'t str,
    at: usize,
    /// True if numbers may have units.
    has_units: bool,
}

impl<'t> Tokens<'t> {
    pub(super) fn new(text: &'t str, has_units: bool) -> Tokens<'t> {
        Tokens { text, at: 0, has_units }
    }

    /// Returns the next token with its byte range. After the last token, always returns [`Token::End`].
    pub(super) fn next(&mut self) -> Result<(Token<'t>, Range<usize>), ExpressionError> {
        self.at = self.text.len() - self.text[self.at..].trim_start().len();
        let rest = &self.text[self.at..];
        let Some(first) = rest.chars().next() else {
            return Ok((Token::End, self.at..self.at));
        };
        let found = match first {
            '0'..='9' | '.' => number(rest, self.has_units),
            'a'..='z' | 'A'..='Z' | '_' => Ok(name(rest)),
            '\'' | '"' => quoted(rest, first),
            _ => sign(rest, first),
        };
        // The position of a mistake is shifted from the rest of the text to the whole text.
        let shifted = |error: ExpressionError| {
            let span = self.at + error.span.start..self.at + error.span.end;
            ExpressionError { span, ..error }
        };
        let (token, length) = found.map_err(shifted)?;
        let span = self.at..self.at + length;
        self.at = span.end;
        Ok((token, span))
    }
}

/// A token with its length in bytes, or a mistake. The position of the mistake is counted from the first byte
/// of the token.
type Found<'t> = Result<(Token<'t>, usize), ExpressionError>;

fn is_name(character: char) -> bool {
    character.is_ascii_alphanumeric() || character == '_'
}

fn number(rest: &str, has_units: bool) -> Found<'_> {
    let (_, end) = units::decimal(rest);
    let unit = rest[end..].trim_start();
    let length = if has_units && rest[..end].parse::<f64>().is_ok() { unit_length(unit) } else { 0 };
    if length > 0 {
        let length = rest.len() - unit.len() + length;
        return Ok((Token::Quantity(&rest[..length]), length));
    }
    // Characters that continue a number are a mistake: `2x`, `1.2.3`, `1_000`.
    let run = end + rest[end..].find(|c: char| !is_name(c) && c != '.').unwrap_or(rest.len() - end);
    match rest[..end].parse::<f64>() {
        Ok(value) if run == end && value.is_finite() => Ok((Token::Number(value), end)),
        Ok(_) if run == end => {
            Err(ExpressionError::new(0..end, "the number is too large (largest about 1.8e308)"))
        }
        _ => Err(ExpressionError::new(0..run, format!("`{}` is not a number", &rest[..run]))
            .helps("numbers look like 12, 0.5 or 1.5e-6; products need a `*`")
            .of(Mistake::NoOperator)),
    }
}

/// Returns the length in bytes of the unit at the beginning of `text`, or 0 if `text` does not begin with a
/// unit.
fn unit_length(text: &str) -> usize {
    let word = text.find(|letter| !is_name(letter)).unwrap_or(text.len());
    let is_unit = text.starts_with(|letter: char| letter.is_alphabetic() || "°%".contains(letter));
    if !is_unit || WORDS.contains(&&text[..word]) {
        return 0;
    }
    let is_part = |letter: char| letter.is_alphanumeric() || "*/^·°%-".contains(letter);
    text.find(|letter| !is_part(letter)).unwrap_or(text.len())
}

fn name(rest: &str) -> (Token<'_>, usize) {
    let length = rest.find(|c: char| !is_name(c) && c != '.').unwrap_or(rest.len());
    (Token::Name(&rest[..length]), length)
}

fn quoted(rest: &str, quote: char) -> Found<'_> {
    match rest[1..].find(quote) {
        Some(length) => Ok((Token::Text(&rest[1..=length]), length + 2)),
        None => Err(ExpressionError::new(0..rest.len(), "a closing quote is missing")),
    }
}

fn sign(rest: &str, first: char) -> Found<'_> {
    let known = SIGNS.iter().find(|sign| rest.starts_with(**sign));
    let foreign = FOREIGN.iter().find(|(foreign, _)| rest.starts_with(foreign));
    // `**` begins with `*`, and `!=` with `!`.
    let foreign = foreign.filter(|(foreign, _)| known.is_none_or(|known| foreign.len() > known.len()));
    match (known, foreign) {
        (_, Some((foreign, right))) => {
            let error = ExpressionError::new(0..foreign.len(), format!("`{foreign}` is not an operator"));
            Err(error.helps(format!("write {right}")))
        }
        (Some(known), None) => Ok((Token::Sign(known), known.len())),
        (None, None) => {
            let message = format!("`{}` is not allowed in an expression", first.escape_debug());
            Err(ExpressionError::new(0..first.len_utf8(), message))
        }
    }
}
