//! What does a formula such as `(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n` say?
//!
//! A formula is parsed once, into steps for a stack machine, and evaluated over any world of [`Number`]s. There is no
//! tree: evaluation and disposal take no recursion, and the parser's own is bounded by [`MAX_DEPTH`]. The parser is that
//! of Pratt ("Top down operator precedence", 1973): `+ -`, then `* /`, then a sign, then `^` (from the right).

mod condition;
mod parser;

pub use condition::Condition;

use crate::fault::Fault;
use crate::numbers::{Function, Literal, Number, Trouble};
use parser::Parser;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::{Field, Laurent};
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
