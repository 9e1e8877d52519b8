//! How is the text of a formula or a condition taken apart?

use super::condition::{Comparison, Relation};
use super::{Formula, MAX_DEPTH, MAX_DIGITS, MAX_LENGTH, Step};
use crate::fault::{Fault, nearest};
use crate::numbers::{Function, Literal};
use dashu_int::UBig;
use dashu_ratio::RBig;
use std::ops::Range;

#[derive(Clone, Debug, PartialEq)]
enum Token<'a> {
    Number(&'a str),
    Word(&'a str),
    Sign(char),
    Relation(Relation),
    End,
}

pub(super) struct Parser<'a> {
    text: &'a str,
    token: Token<'a>,
    span: Range<usize>,
    /// The steps read so far; a comparison takes those of each side as it ends.
    pub(super) steps: Vec<(Step, Range<usize>)>,
}

impl<'a> Parser<'a> {
    pub(super) fn new(text: &'a str) -> Result<Self, Fault> {
        if text.len() > MAX_LENGTH {
            let message = format!("the formula has {} bytes; the limit is {MAX_LENGTH}", text.len());
            return Err(Fault::at(0..text.len(), message, "").hint("name parts of it under [let]"));
        }
        let mut parser = Parser { text, token: Token::End, span: 0..0, steps: Vec::new() };
        parser.advance()?;
        Ok(parser)
    }

    pub(super) fn advance(&mut self) -> Result<(), Fault> {
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

    pub(super) fn word(&self) -> Option<&'a str> {
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

    pub(super) fn expect_end(&self) -> Result<(), Fault> {
        if self.token == Token::End { Ok(()) } else { Err(self.unexpected("an operator such as + - * / ^")) }
    }

    fn expect_sign(&mut self, sign: char) -> Result<(), Fault> {
        if self.token != Token::Sign(sign) {
            return Err(self.unexpected(&format!("`{sign}`")));
        }
        self.advance()
    }

    /// `a < b`, or a chain `a < b <= c`.
    pub(super) fn comparisons(&mut self) -> Result<Vec<Comparison>, Fault> {
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

    pub(super) fn sum(&mut self, depth: usize) -> Result<(), Fault> {
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
