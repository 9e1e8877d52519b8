//! Through which parameter are c and the subdominant eigenvalue both rational?
//!
//! Where lambda is rational in c, through c itself, p = c on [-1/2, 1]. Where lambda's polynomial is of degree 1 in c, through lambda: p = lambda
//! and c(p) is read off. Then c has to grow on [low, 1] from at most -1/2 to at least 1: so each c in [-1/2, 1] has just one root there, its largest real one below 1.

use super::net::{Course, Function};
use super::positive::{Interval, is_positive, is_positive_quotient};
use crate::analysis::exact::Value;
use crate::analysis::exact::formulas::AllValences;
use crate::numbers::polynomial::Polynomial;
use crate::numbers::{C, Field, Free, Trouble, Univariate};
use dashu_ratio::RBig;

/// A parametrisation with the parameter's range.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// c and lambda.
    pub course: Course,
    /// Every n >= 3 has its p in here.
    pub interval: Interval,
}

impl Range {
    /// Whether an enclosed number may be the value of lambda at a valence; only lambda's is for sure.
    pub fn may_be_lambda(&self, n: usize, value: &Value) -> bool {
        let turn = Value::pi().times(&Value::rational(&(RBig::from(2) / RBig::from(n))));
        let Ok(cosine) = turn.map(|turn| turn.cos()) else { return true };
        let p = if self.course.c == Function::variable() { &cosine } else { value };
        let meets = |own: &Function, other: &Value| {
            own.evaluate(p, Value::rational).map_or(true, |own: Value| own.overlaps(other))
        };
        let (low, high) = p.lo_hi();
        let inside = low <= self.interval.high && high >= self.interval.low;
        inside && meets(&self.course.c, &cosine) && meets(&self.course.lambda, value)
    }
}

fn part(above: i64, below: u32) -> RBig {
    RBig::from(above) / RBig::from(below)
}

/// The parametrisation of a scheme's subdominant eigenvalue; `None` where there is none of these kinds.
///
/// # Errors
/// When a limit of size is passed.
pub fn range(forms: &AllValences) -> Result<Option<Range>, Trouble> {
    let Some(polynomial) = &forms.subdominant else { return Ok(None) };
    let foreign = |value: &Free| (0..6).any(|index| index != C && value.mentions(index));
    if polynomial.coefficients().iter().any(foreign) {
        return Ok(None);
    }
    match polynomial.coefficients() {
        [constant, _] => by_cosine(&constant.negated()).map(Some),
        coefficients => by_lambda(coefficients),
    }
}

fn by_cosine(lambda: &Free) -> Result<Range, Trouble> {
    let c = Function::variable();
    let lambda = lambda.evaluate(&vec![c.clone(); 6])?;
    Ok(Range { course: Course { c, lambda }, interval: Interval { low: part(-1, 2), high: part(1, 1) } })
}

fn by_lambda(coefficients: &[Free]) -> Result<Option<Range>, Trouble> {
    let (mut rest, mut slope) = (Vec::new(), Vec::new());
    for value in coefficients {
        let Some(parts) = value.as_polynomial().map(|own| own.coefficients_in(C)) else { return Ok(None) };
        if parts.len() > 2 {
            return Ok(None);
        }
        let number = |at: usize| parts.get(at).map_or(Some(RBig::ZERO), Polynomial::as_constant);
        let (Some(own), Some(with_c)) = (number(0), number(1)) else { return Ok(None) };
        rest.push(own);
        slope.push(with_c);
    }
    let constant = |value: Vec<RBig>| -> Result<Function, Trouble> {
        value
            .iter()
            .rev()
            .try_fold(Function::whole(0), |sum, own| sum.times(&Function::variable())?.plus(&Function::rational(own)))
    };
    let slope = constant(slope)?;
    if slope.is_certainly_zero() {
        return Ok(None);
    }
    let c = constant(rest)?.over(&slope)?.negated();
    Ok(growing(&c)?.map(|interval| Range { course: Course { c, lambda: Function::variable() }, interval }))
}

/// Thousandths between which c grows from at most -1/2 to at least 1; it goes on growing up to 1.
fn growing(c: &Function) -> Result<Option<Interval>, Trouble> {
    let at = |p: &RBig| -> Result<RBig, Trouble> { c.numerator().evaluate(p)?.over(&c.denominator().evaluate(p)?) };
    let (mut low, mut high) = (None, None);
    for thousandths in (1..1000).rev() {
        let p = part(thousandths, 1000);
        let Ok(value) = at(&p) else { return Ok(None) };
        if value >= RBig::ONE {
            high = Some(p.clone());
        }
        if value <= part(-1, 2) {
            low = Some(p);
            break;
        }
    }
    let (Some(low), Some(high)) = (low, high) else { return Ok(None) };
    let (above, below) = (c.numerator(), c.denominator());
    let slope: Univariate<RBig> = above.derivative()?.times(below)?.minus(&above.times(&below.derivative()?)?)?;
    let whole = Interval { low: low.clone(), high: RBig::ONE };
    let grows = is_positive(&slope, &whole) && is_positive(&below.times(below)?, &whole);
    let positive = is_positive_quotient(&Function::variable(), &whole)?;
    Ok((grows && positive).then_some(Interval { low, high }))
}
