//! What does a condition such as `n == 3` or `4 <= n <= 6 or n >= 9` say?

use super::parser::Parser;
use super::{Failure, Formula, Names};
use crate::fault::Fault;
use crate::numbers::{Number, Trouble};
use std::cmp::Ordering;
use std::ops::Range;

/// A comparison of two formulas.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Comparison {
    pub(super) left: Formula,
    pub(super) relation: Relation,
    pub(super) right: Formula,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Relation {
    Equal,
    Unequal,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

impl Relation {
    pub(super) const ALL: [(&'static str, Relation); 6] = [
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

    /// Whether the condition holds. What stands after a comparison that fails, up to the next `or`, is not looked at.
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
                holds = comparison.relation.holds(order);
                if !holds {
                    break;
                }
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
