//! What does a formula such as `(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n` say?
//!
//! A formula is parsed once, into steps for a stack machine, and evaluated over any world of [`Number`]s. There is no
//! tree: evaluation and disposal take no recursion, and the parser's own is bounded by [`MAX_DEPTH`]. The parser is that
//! of Pratt ("Top down operator precedence", 1973): `+ -`, then `* /`, then a sign, then `^` (from the right).

use crate::fault::{Fault, nearest};
use crate::numbers::{Function, Literal, Number, Trouble};
use dashu_int::UBig;
use dashu_ratio::RBig;
use std::cmp::Ordering;
use std::ops::Range;

/// The longest formula, in bytes.
pub const MAX_LENGTH: usize = 10_000;
/// The deepest nesting of parentheses, signs and powers.
pub const MAX_DEPTH: usize = 100;
/// The longest numeral, in digits.
pub const MAX_DIGITS: usize = 100;

/// One step of the stack machine.
#[derive(Clone, Debug, PartialEq)]
enum Step {
    Literal(Literal),
    Pi,
    Name(String),
    Negate,
    Plus,
    Minus,
    Times,
    Over,
    Power,
    Call(Function, usize),
}

/// A formula, ready to be evaluated.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    text: String,
    /// Steps in order of evaluation, each with the bytes of `text` that it stands for.
    steps: Vec<(Step, Range<usize>)>,
}

/// Where a formula takes the values of its names from.
pub trait Names<W> {
    /// The value of a name.
    ///
    /// # Errors
    /// When the name has no value here.
    fn value(&self, name: &str) -> Result<W, Trouble>;
}

/// An operation of a formula that has no value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Why.
    pub trouble: Trouble,
    /// The bytes of the formula's text whose value is missing.
    pub span: Range<usize>,
}

impl Formula {
    /// Parses a formula.
    ///
    /// # Errors
    /// The first fault, with bytes of `text` as its place.
    pub fn parse(text: &str) -> Result<Formula, Fault> {
        let mut parser = Parser::new(text)?;
        parser.sum(0)?;
        parser.expect_end()?;
        Ok(Formula { text: text.to_string(), steps: parser.steps })
    }

    /// The formula as written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The names that the formula mentions, each with its place.
    pub fn names(&self) -> impl Iterator<Item = (&str, Range<usize>)> {
        self.steps.iter().filter_map(|(step, span)| match step {
            Step::Name(name) => Some((name.as_str(), span.clone())),
            _ => None,
        })
    }

    /// The value of the formula.
    ///
    /// # Errors
    /// The first operation that has no value in this world, with its place in the formula.
    pub fn evaluate<W: Number>(&self, names: &dyn Names<W>) -> Result<W, Failure> {
        let mut stack: Vec<W> = Vec::with_capacity(8);
        for (step, span) in &self.steps {
            let value = apply(step, &mut stack, names);
            stack.push(value.map_err(|trouble| Failure { trouble, span: span.clone() })?);
        }
        let nothing = Failure { trouble: Trouble::Domain("the formula is empty"), span: 0..self.text.len() };
        stack.pop().ok_or(nothing)
    }

    /// The name, if the formula is nothing but one.
    fn as_name(&self) -> Option<&str> {
        match self.steps.as_slice() {
            [(Step::Name(name), _)] => Some(name),
            _ => None,
        }
    }

    /// The whole number, if the formula is nothing but one.
    fn as_whole(&self) -> Option<i64> {
        match self.steps.as_slice() {
            [(Step::Literal(literal), _)] if literal.exact.is_int() => literal.exact.numerator().try_into().ok(),
            _ => None,
        }
    }
}

fn apply<W: Number>(step: &Step, stack: &mut Vec<W>, names: &dyn Names<W>) -> Result<W, Trouble> {
    let missing = || Trouble::Domain("an operand is missing");
    let arity = match step {
        Step::Literal(literal) => return Ok(W::literal(literal)),
        Step::Pi => return Ok(W::pi()),
        Step::Name(name) => return names.value(name),
        Step::Negate => 1,
        Step::Call(_, arity) => *arity,
        _ => 2,
    };
    let operands = stack.split_off(stack.len().checked_sub(arity).ok_or_else(missing)?);
    match (step, operands.as_slice()) {
        (Step::Negate, [a]) => Ok(a.negated()),
        (Step::Plus, [a, b]) => a.plus(b),
        (Step::Minus, [a, b]) => a.plus(&b.negated()),
        (Step::Times, [a, b]) => a.times(b),
        (Step::Over, [a, b]) => a.over(b),
        (Step::Power, [a, b]) => a.power(b),
        (Step::Call(function, _), arguments) => W::call(*function, arguments),
        _ => Err(missing()),
    }
}

/// A comparison of two formulas.
#[derive(Clone, Debug, PartialEq)]
struct Comparison {
    left: Formula,
    relation: Relation,
    right: Formula,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Relation {
    Equal,
    Unequal,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

impl Relation {
    const ALL: [(&'static str, Relation); 6] = [
        ("==", Relation::Equal),
        ("!=", Relation::Unequal),
        ("<=", Relation::LessOrEqual),
        (">=", Relation::GreaterOrEqual),
        ("<", Relation::Less),
        (">", Relation::Greater),
    ];

    fn holds(self, order: Ordering) -> bool {
        match self {
            Relation::Equal => order == Ordering::Equal,
            Relation::Unequal => order != Ordering::Equal,
            Relation::Less => order == Ordering::Less,
            Relation::LessOrEqual => order != Ordering::Greater,
            Relation::Greater => order == Ordering::Greater,
            Relation::GreaterOrEqual => order != Ordering::Less,
        }
    }
}

/// A condition on the valence, such as `n == 3` or `4 <= n <= 6 or n >= 9`.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    text: String,
    /// One of these lists must hold throughout.
    any_of: Vec<Vec<Comparison>>,
}

impl Condition {
    /// Parses a condition: comparisons joined by `and` and `or` (`and` binds tighter); `a <= n <= b` is short for two.
    ///
    /// # Errors
    /// The first fault, with bytes of `text` as its place.
    pub fn parse(text: &str) -> Result<Condition, Fault> {
        let mut parser = Parser::new(text)?;
        let mut any_of = vec![Vec::new()];
        loop {
            let comparisons = parser.comparisons()?;
            if let Some(list) = any_of.last_mut() {
                list.extend(comparisons);
            }
            match parser.word() {
                Some("and") => {}
                Some("or") => any_of.push(Vec::new()),
                _ => break,
            }
            parser.advance()?;
        }
        parser.expect_end()?;
        Ok(Condition { text: text.to_string(), any_of })
    }

    /// The condition as written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The names that the condition mentions, each with its place.
    pub fn names(&self) -> impl Iterator<Item = (&str, Range<usize>)> {
        self.any_of.iter().flatten().flat_map(|c| c.left.names().chain(c.right.names()))
    }

    /// Whether the condition holds.
    ///
    /// # Errors
    /// When a side has no value, or this world can't compare the two.
    pub fn holds<W: Number>(&self, names: &dyn Names<W>) -> Result<bool, Failure> {
        for all_of in &self.any_of {
            let mut holds = true;
            for comparison in all_of {
                let (left, right) = (comparison.left.evaluate(names)?, comparison.right.evaluate(names)?);
                let unknown = Trouble::BeyondThisWorld("the two sides can't be compared");
                let order = left.order(&right).ok_or(Failure { trouble: unknown, span: 0..self.text.len() })?;
                holds &= comparison.relation.holds(order);
            }
            if holds {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The whole number from which on the condition no longer changes with n, when each comparison sets `n` beside a whole
    /// number.
    pub fn settled_from(&self) -> Option<i64> {
        let settled = |comparison: &Comparison| match (comparison.left.as_name(), comparison.right.as_name()) {
            (Some("n"), _) => comparison.right.as_whole().map(|bound| bound.saturating_add(1)),
            (_, Some("n")) => comparison.left.as_whole().map(|bound| bound.saturating_add(1)),
            _ => None,
        };
        self.any_of.iter().flatten().map(settled).try_fold(0, |from, next| Some(from.max(next?)))
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Token<'a> {
    Number(&'a str),
    Word(&'a str),
    Sign(char),
    Relation(Relation),
    End,
}

struct Parser<'a> {
    text: &'a str,
    token: Token<'a>,
    span: Range<usize>,
    /// How many steps stood before each comparison's current side.
    steps: Vec<(Step, Range<usize>)>,
}

impl<'a> Parser<'a> {
    fn new(text: &'a str) -> Result<Self, Fault> {
        if text.len() > MAX_LENGTH {
            let message = format!("the formula has {} bytes; the limit is {MAX_LENGTH}", text.len());
            return Err(Fault::at(0..text.len(), message, "").hint("name parts of it under [let]"));
        }
        let mut parser = Parser { text, token: Token::End, span: 0..0, steps: Vec::new() };
        parser.advance()?;
        Ok(parser)
    }

    fn advance(&mut self) -> Result<(), Fault> {
        let rest = &self.text[self.span.end..];
        let start = self.span.end + (rest.len() - rest.trim_start().len());
        let rest = &self.text[start..];
        let (token, length) = next_token(rest).map_err(|(message, length)| {
            let shown = &rest[..length];
            Fault::at(start..start + length, message, format!("`{shown}` stands here")).hint(GRAMMAR)
        })?;
        self.token = token;
        self.span = start..start + length;
        Ok(())
    }

    fn word(&self) -> Option<&'a str> {
        if let Token::Word(word) = self.token { Some(word) } else { None }
    }

    fn unexpected(&self, wanted: &str) -> Fault {
        let (found, span) = match &self.token {
            Token::End => ("the formula ends here".to_string(), self.end_span()),
            _ => (format!("found `{}`", &self.text[self.span.clone()]), self.span.clone()),
        };
        let hint = match &self.token {
            Token::Word(_) => "a product needs its `*`: 2*pi*j, not 2 pi j",
            Token::Sign('*') => "a power is written with `^`",
            _ => GRAMMAR,
        };
        Fault::at(span, format!("the formula needs {wanted}"), found).hint(hint)
    }

    /// The last character, for a caret at the end.
    fn end_span(&self) -> Range<usize> {
        let last = self.text.trim_end().char_indices().next_back().map_or(0, |(index, _)| index);
        last..self.text.trim_end().len().max(last)
    }

    fn expect_end(&self) -> Result<(), Fault> {
        if self.token == Token::End { Ok(()) } else { Err(self.unexpected("an operator such as + - * / ^")) }
    }

    fn expect_sign(&mut self, sign: char) -> Result<(), Fault> {
        if self.token != Token::Sign(sign) {
            return Err(self.unexpected(&format!("`{sign}`")));
        }
        self.advance()
    }

    /// `a < b`, or a chain `a < b <= c`.
    fn comparisons(&mut self) -> Result<Vec<Comparison>, Fault> {
        let mut left = self.side()?;
        let mut comparisons = Vec::new();
        while let Token::Relation(relation) = self.token {
            self.advance()?;
            let right = self.side()?;
            comparisons.push(Comparison { left: left.clone(), relation, right: right.clone() });
            left = right;
        }
        if comparisons.is_empty() { Err(self.unexpected("a comparison such as `n == 3`")) } else { Ok(comparisons) }
    }

    /// One side of a comparison, with places in the whole condition.
    fn side(&mut self) -> Result<Formula, Fault> {
        self.sum(0)?;
        Ok(Formula { text: self.text.to_string(), steps: std::mem::take(&mut self.steps) })
    }

    fn sum(&mut self, depth: usize) -> Result<(), Fault> {
        let start = self.span.start;
        self.product(depth)?;
        while let Token::Sign(sign @ ('+' | '-')) = self.token {
            self.advance()?;
            self.product(depth)?;
            self.push(if sign == '+' { Step::Plus } else { Step::Minus }, start);
        }
        Ok(())
    }

    fn product(&mut self, depth: usize) -> Result<(), Fault> {
        let start = self.span.start;
        self.signed(depth)?;
        while let Token::Sign(sign @ ('*' | '/')) = self.token {
            self.advance()?;
            self.signed(depth)?;
            self.push(if sign == '*' { Step::Times } else { Step::Over }, start);
        }
        Ok(())
    }

    fn signed(&mut self, depth: usize) -> Result<(), Fault> {
        let start = self.span.start;
        match self.token {
            Token::Sign('-') => {
                self.advance()?;
                self.deeper(depth, Self::signed)?;
                self.push(Step::Negate, start);
                Ok(())
            }
            Token::Sign('+') => {
                self.advance()?;
                self.deeper(depth, Self::signed)
            }
            _ => self.powered(depth),
        }
    }

    fn powered(&mut self, depth: usize) -> Result<(), Fault> {
        let start = self.span.start;
        self.operand(depth)?;
        if self.token == Token::Sign('^') {
            self.advance()?;
            self.deeper(depth, Self::signed)?;
            self.push(Step::Power, start);
        }
        Ok(())
    }

    fn operand(&mut self, depth: usize) -> Result<(), Fault> {
        let start = self.span.start;
        match self.token {
            Token::Number(digits) => {
                let literal = literal(digits).map_err(|message| {
                    Fault::at(self.span.clone(), message, "").hint("write it as a quotient or a power")
                })?;
                self.advance()?;
                self.steps.push((Step::Literal(literal), start..start + digits.len()));
                Ok(())
            }
            Token::Word(word) => {
                self.advance()?;
                if self.token == Token::Sign('(') {
                    return self.call(word, start, depth);
                }
                let step = if word == "pi" { Step::Pi } else { Step::Name(word.to_string()) };
                self.steps.push((step, start..start + word.len()));
                Ok(())
            }
            Token::Sign('(') => {
                self.advance()?;
                self.deeper(depth, Self::sum)?;
                self.expect_sign(')')
            }
            _ => Err(self.unexpected("a number, a name or `(`")),
        }
    }

    fn call(&mut self, word: &str, start: usize, depth: usize) -> Result<(), Fault> {
        let span = start..start + word.len();
        let Some((_, function, arity)) = Function::ALL.iter().find(|(name, ..)| *name == word) else {
            let names: Vec<&str> = Function::ALL.iter().map(|(name, ..)| *name).collect();
            let hint = match nearest(word, names.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the functions are {}; a product needs its `*`", names.join(", ")),
            };
            return Err(Fault::at(span, format!("there is no function `{word}`"), "unknown").hint(hint));
        };
        self.expect_sign('(')?;
        self.deeper(depth, Self::sum)?;
        for _ in 1..*arity {
            self.expect_sign(',')?;
            self.deeper(depth, Self::sum)?;
        }
        self.expect_sign(')')?;
        self.push(Step::Call(*function, *arity), start);
        Ok(())
    }

    fn deeper(&mut self, depth: usize, parse: fn(&mut Self, usize) -> Result<(), Fault>) -> Result<(), Fault> {
        if depth >= MAX_DEPTH {
            let message = format!("the formula is nested more than {MAX_DEPTH} deep");
            return Err(Fault::at(self.span.clone(), message, "here").hint("name parts of it under [let]"));
        }
        parse(self, depth + 1)
    }

    /// Adds a step for everything from `start` up to the current token.
    fn push(&mut self, step: Step, start: usize) {
        let end = self.text[..self.span.start].trim_end().len();
        self.steps.push((step, start..end.max(start)));
    }
}

const GRAMMAR: &str = "a formula is made of numbers, names, + - * / ^, parentheses and cos, sin, sqrt, binom, min, max";

fn next_token(rest: &str) -> Result<(Token<'_>, usize), (String, usize)> {
    let Some(first) = rest.chars().next() else { return Ok((Token::End, 0)) };
    if first.is_ascii_digit() || first == '.' {
        let length = number_length(rest);
        return Ok((Token::Number(&rest[..length]), length));
    }
    if first.is_ascii_alphabetic() || first == '_' {
        let length = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
        return Ok((Token::Word(&rest[..length]), length));
    }
    if let Some((sign, relation)) = Relation::ALL.iter().find(|(sign, _)| rest.starts_with(sign)) {
        return Ok((Token::Relation(*relation), sign.len()));
    }
    match first {
        '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' => Ok((Token::Sign(first), 1)),
        _ => Err((format!("`{first}` has no meaning in a formula"), first.len_utf8())),
    }
}

/// How many bytes a numeral has, its exponent included.
fn number_length(rest: &str) -> usize {
    let span =
        |text: &str, signs: &str| text.find(|c: char| !c.is_ascii_digit() && !signs.contains(c)).unwrap_or(text.len());
    let mantissa = span(rest, ".");
    let exponent = rest[mantissa..].strip_prefix(['e', 'E']).unwrap_or("");
    let digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    match span(digits, "") {
        0 => mantissa,
        length => mantissa + 1 + (exponent.len() - digits.len()) + length,
    }
}

/// The exact value of a decimal numeral, with or without an exponent.
fn literal(numeral: &str) -> Result<Literal, String> {
    let (digits, exponent) = numeral.split_once(['e', 'E']).unwrap_or((numeral, "0"));
    let exponent: i32 = exponent
        .parse()
        .ok()
        .filter(|e: &i32| e.unsigned_abs() as usize <= MAX_DIGITS)
        .ok_or_else(|| format!("the exponent of `{numeral}` is outside -{MAX_DIGITS}..{MAX_DIGITS}"))?;
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    if fraction.contains('.') || (whole.is_empty() && fraction.is_empty()) {
        return Err(format!("`{digits}` is not a number"));
    }
    if digits.len() > MAX_DIGITS {
        return Err(format!("a number of {} digits; the limit is {MAX_DIGITS}", digits.len()));
    }
    let numerator: UBig = format!("0{whole}{fraction}").parse().map_err(|_| format!("`{digits}` is not a number"))?;
    let denominator = UBig::from(10_u8).pow(fraction.len());
    let shift = RBig::from(UBig::from(10_u8).pow(exponent.unsigned_abs() as usize));
    let mantissa = RBig::from_parts(numerator.into(), denominator);
    Ok(Literal::new(if exponent < 0 { mantissa / shift } else { mantissa * shift }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Laurent;
    use proptest::prelude::*;

    struct NoNames;
    impl<W: Number> Names<W> for NoNames {
        fn value(&self, name: &str) -> Result<W, Trouble> {
            if name == "n" { Ok(W::whole(5)) } else { Err(Trouble::Domain("no such name")) }
        }
    }

    fn approx(text: &str) -> f64 {
        Formula::parse(text).unwrap().evaluate(&NoNames).unwrap()
    }

    #[test]
    fn precedence_is_that_of_mathematics() {
        assert_eq!(approx("1 + 2*3^2 - 4/2/2"), 18.0);
        assert_eq!(approx("-2^2"), -4.0);
        assert_eq!(approx("2^-1"), 0.5);
        assert_eq!(approx("2^3^2"), 512.0);
        assert_eq!(approx("(1 - 2) - 3 - (4 - 5)"), -3.0);
        assert_eq!(approx("--n + max(1, min(2, 3)) + binom(5, 2)"), 17.0);
        assert_eq!(approx("sqrt(2)^2"), 2.000_000_000_000_000_4);
    }

    #[test]
    fn decimals_are_exact() {
        let sum: Laurent = Formula::parse("0.1 + .2 - 30e-2 + 1.5E1 - 15").unwrap().evaluate(&NoNames).unwrap();
        assert!(sum.is_certainly_zero());
    }

    #[test]
    fn faults_point_at_their_place() {
        for (text, place, word) in [
            ("1 + ", 2..3, "needs a number"),
            ("2 * (3 + 4", 9..10, "`)`"),
            ("2 $ 3", 2..3, "no meaning"),
            ("1 + coz(2)", 4..7, "no function `coz`"),
            ("3 n", 2..3, "operator"),
            ("3e", 1..2, "operator"),
            ("1e999", 0..5, "exponent"),
            ("1.2.3", 0..5, "not a number"),
            ("", 0..0, "needs a number"),
            ("cos(1, 2)", 5..6, "`)`"),
        ] {
            let fault = Formula::parse(text).unwrap_err();
            assert_eq!(fault.span, Some(place), "{text}: {}", fault.message);
            assert!(fault.message.contains(word), "{text}: {}", fault.message);
        }
        let failure = Formula::parse("1 + 3/(n - 5)").unwrap().evaluate::<f64>(&NoNames).unwrap_err();
        assert_eq!((failure.trouble, failure.span), (Trouble::DivisionByZero, 4..13));
    }

    #[test]
    fn hostile_formulas_meet_a_limit_and_not_the_stack() {
        for text in ["(".repeat(9_999), "-".repeat(9_999), "2^".repeat(4_000) + "2", "cos(".repeat(2_000)] {
            assert!(Formula::parse(&text).unwrap_err().message.contains("nested"), "{}", &text[..9]);
        }
        assert!(Formula::parse(&"1+".repeat(6_000)).unwrap_err().message.contains("limit"));
        assert!(Formula::parse(&"9".repeat(5_000)).unwrap_err().message.contains("digits"));
        let long = vec!["1"; 4_900].join("+");
        assert_eq!(approx(&long), 4900.0);
    }

    #[test]
    fn conditions_hold_where_they_say() {
        let holds = |text: &str| Condition::parse(text).unwrap().holds::<f64>(&NoNames).unwrap();
        assert!(holds("n == 5") && holds("3 <= n <= 5") && holds("n < 3 or n > 4") && holds("n != 4 and n >= 5"));
        assert!(!holds("n != 5") && !holds("5 < n < 9"));
        assert_eq!(Condition::parse("n == 3 or 7 < n").unwrap().settled_from(), Some(8));
        assert_eq!(Condition::parse("n^2 > 10").unwrap().settled_from(), None);
        assert!(Condition::parse("n").is_err() && Condition::parse("n == 3 and").is_err());
    }

    proptest! {
        #[test]
        fn any_text_is_read_or_refused_without_a_panic(text in "[-+*/^(),.0-9a-z =<>!]{0,40}|\\PC{0,20}") {
            if let Ok(formula) = Formula::parse(&text) {
                let _ = formula.evaluate::<f64>(&NoNames);
                let _ = formula.evaluate::<Laurent>(&NoNames);
            }
            let _ = Condition::parse(&text);
        }

        /// The two worlds agree wherever both have a value.
        #[test]
        fn exact_and_approximate_values_agree(a in -50i64..50, b in 1i64..50, c in -9i64..9, e in 0u32..4) {
            let text = format!("({a}/{b} - {c}.5)^{e} + {a}*{c}/({b} + 1)");
            let exact: Laurent = Formula::parse(&text).unwrap().evaluate(&NoNames).unwrap();
            let exact = exact.as_constant().unwrap().to_f64().value();
            prop_assert!((approx(&text) - exact).abs() <= 1e-12 * exact.abs().max(1.0));
        }
    }
}
