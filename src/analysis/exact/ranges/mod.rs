//! For which values of a parameter does a spectral condition hold, at one valence?
//!
//! With the parameter left free the eigenvalues are algebraic functions of it. A condition that compares moduli changes only where
//! two of them tie, or a weight has a pole: at finitely many algebraic numbers (`candidates`), the zeros of resultants. Between
//! neighbouring ones every condition is constant and is decided at one rational number; at the candidates themselves it is decided where
//! exact or enclosed numbers tell, and counts as open where they don't. So an interval is never wrong; more candidates than needed do
//! no harm.

mod candidates;
mod decide;

use super::formulas::AllValences;
use super::words::Words;
use super::{BITS, Value};
use crate::analysis::spectra::Spectra;
use crate::numbers::enclosure::rational_decimal;
use crate::numbers::roots::Root;
use crate::numbers::{Cosine, Enclosure, Field, Univariate};
use crate::refine::Obstacle;
use crate::scheme::{Interval, Scheme};
use candidates::Candidate;
use dashu_ratio::RBig;
use decide::{Decided, Decider};

/// The largest valence that is treated.
pub const MOST_VALENCE: usize = 64;
/// The most numbers at which conditions may change.
pub const MOST_CANDIDATES: usize = 300;

/// A spectral condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// 1 is simple and all others are smaller in modulus.
    OneDominates,
    /// The largest eigenvalue after 1 is real, positive, of frequency 1, simple there and larger in modulus than all others.
    Subdominant,
    /// The same, and |mu| <= lambda^2 for all others.
    Bounded,
}

impl Condition {
    /// All of them, in order.
    pub const ALL: [Condition; 3] = [Condition::OneDominates, Condition::Subdominant, Condition::Bounded];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Condition::OneDominates => "1 dominates",
            Condition::Subdominant => "subdominant",
            Condition::Bounded => "|mu| <= lambda^2",
        }
    }
}

/// A value of the parameter.
#[derive(Clone, Debug)]
pub struct End {
    /// The value, enclosed.
    pub value: Value,
    /// In words.
    pub exact: Words,
    /// The value, where it is rational.
    pub rational: Option<RBig>,
}

impl End {
    fn rational(value: &RBig) -> End {
        let text = value.to_string();
        let latex = match text.split_once('/') {
            Some((top, bottom)) => format!("\\frac{{{top}}}{{{bottom}}}"),
            None => text.clone(),
        };
        End { value: Value::rational(value), exact: Words { text, latex }, rational: Some(value.clone()) }
    }

    /// So many decimals, all right.
    pub fn decimal(&self, digits: usize) -> String {
        match &self.rational {
            Some(value) => rational_decimal(value, digits),
            None => self.value.decimal(digits).unwrap_or_else(|| format!("{:.6}", self.value.midpoint_f64())),
        }
    }
}

/// Values of the parameter between two ends.
#[derive(Clone, Debug)]
pub struct Range {
    /// The lower end.
    pub from: End,
    /// The upper end.
    pub to: End,
    /// Whether the condition is decided to hold at the ends.
    pub closed: [bool; 2],
}

/// Where a condition holds.
#[derive(Clone, Debug)]
pub struct Ranges {
    /// The condition.
    pub condition: Condition,
    /// In order; it holds nowhere else, but perhaps at `undecided`.
    pub ranges: Vec<Range>,
    /// Single values at which it is not decided.
    pub undecided: Vec<End>,
}

/// The sub-ranges of an interval in which each condition holds at a valence.
///
/// # Errors
/// Why it is not decided.
pub fn ranges(
    scheme: &Scheme,
    forms: Option<&AllValences>,
    n: usize,
    interval: &Interval,
) -> Result<Vec<Ranges>, String> {
    if n > MOST_VALENCE {
        return Err(format!("ranges are worked out up to n = {MOST_VALENCE}"));
    }
    if scheme.book.conditions_depend_on(&interval.name) {
        return Err(format!("a condition of a case depends on `{}`", interval.name));
    }
    let free = free_in(scheme, &interval.name)?;
    let told = |obstacle: Obstacle| obstacle.to_string();
    let odd = free.with_odd_values();
    let (orbits, _) = Spectra::new(&odd).and_then(|spectra| spectra.neighbourhoods(n)).map_err(told)?;
    let decider = Decider { scheme: &free, orbits: &orbits, forms, name: &interval.name, n };
    let candidates = candidates::of(&decider, interval).map_err(told)?;
    let points = points(interval, &candidates);
    let samples: Vec<RBig> = points.windows(2).map(|pair| between(&pair[0].end, &pair[1].end)).collect();
    let between: Vec<Decided> = samples.iter().map(|value| decider.sample(value)).collect::<Result<_, _>>()?;
    let at: Vec<Decided> = (0..points.len()).map(|index| at_point(&decider, &points, &between, index)).collect();
    Ok(Condition::ALL.iter().map(|condition| merged(*condition, &points, &at, &between)).collect())
}

/// The scheme with this parameter left free and no other.
fn free_in(scheme: &Scheme, name: &str) -> Result<Scheme, String> {
    let mut free = scheme.with_values();
    free.leave_free(name)?;
    Ok(free)
}

/// The forms for all valences of a scheme with one parameter free, which help to split polynomials.
pub fn forms(scheme: &Scheme, name: &str) -> Option<AllValences> {
    let free = free_in(scheme, name).ok()?;
    let odd = free.with_odd_values();
    let spectra = Spectra::new(&odd).ok()?;
    let (orbits, smallest) = spectra.neighbourhoods(super::formulas::GENERIC).ok()?;
    AllValences::of(&free, spectra.lattice(), &orbits, &smallest).ok()
}

/// A point that parts the interval: an end, or a candidate.
struct Point<'a> {
    end: End,
    candidate: Option<&'a Candidate>,
}

fn points<'a>(interval: &Interval, candidates: &'a [Candidate]) -> Vec<Point<'a>> {
    let plain = |value: &RBig| Point { end: End::rational(value), candidate: None };
    let inner = candidates.iter().map(|candidate| Point { end: candidate.end(), candidate: Some(candidate) });
    std::iter::once(plain(&interval.from)).chain(inner).chain([plain(&interval.to)]).collect()
}

/// The simplest rational number between two ends.
fn between(low: &End, high: &End) -> RBig {
    let (low, high) = (low.value.lo_hi().1, high.value.lo_hi().0);
    // away from the ends, so that no enclosure is strained
    let quarter = (&high - &low) / RBig::from(4);
    simplest(&low + &quarter, &high - &quarter)
}

/// The fraction with the smallest denominator from `low` to `high`, by continued fractions.
fn simplest(low: RBig, high: RBig) -> RBig {
    if low < RBig::ZERO && high > RBig::ZERO {
        return RBig::ZERO;
    }
    if high <= RBig::ZERO {
        return -simplest(-high, -low);
    }
    let (mut whole, mut low, mut high) = (Vec::new(), low, high);
    loop {
        let floor = low.floor();
        let part = RBig::from(floor.clone());
        if part == low || RBig::from(high.floor()) > part {
            let last = if part == low { part } else { part + RBig::ONE };
            return whole.into_iter().rev().fold(last, |sum, part: RBig| part + RBig::ONE / sum);
        }
        (low, high) = (RBig::ONE / (&high - &part), RBig::ONE / (&low - &part));
        whole.push(part);
    }
}

/// What holds at a point. Where it is not decided there, a strict condition that fails on a side fails at the point, too: moduli
/// are continuous.
fn at_point(decider: &Decider, points: &[Point], between: &[Decided], index: usize) -> Decided {
    let left = index.checked_sub(1).map(|left| between[left]);
    let sides: Vec<Decided> = left.into_iter().chain(between.get(index).copied()).collect();
    let fails = |which: usize| sides.iter().any(|decided| decided[which] == Some(false));
    let decided = match points[index].candidate {
        None => points[index].end.rational.as_ref().map_or([None; 3], |value| decider.at_rational(value)),
        Some(candidate) if candidate.rational().is_none() && fails(0) && fails(1) => [None; 3],
        Some(candidate) => decider.at_candidate(candidate),
    };
    // where lambda is missing nearby, bounded curvature is, too
    let [one, subdominant, bounded] = decided;
    let side = |which: usize| fails(which).then_some(false);
    let subdominant = subdominant.or(side(1));
    // |mu| <= lambda^2 on a side goes over to the limit, where lambda is there
    let limit = match subdominant {
        Some(true) => sides.iter().any(|decided| decided[2] == Some(true)).then_some(true),
        other => other,
    };
    [one.or(side(0)), subdominant, bounded.or(limit)]
}

/// Neighbours that hold, together.
fn merged(condition: Condition, points: &[Point], at: &[Decided], between: &[Decided]) -> Ranges {
    let which = condition as usize;
    let mut ranges: Vec<Range> = Vec::new();
    let mut undecided = Vec::new();
    for (index, point) in points.iter().enumerate() {
        let (here, right) = (at[index][which], between.get(index).map(|decided| decided[which] == Some(true)));
        let from_left = index.checked_sub(1).is_some_and(|left| between[left][which] == Some(true));
        if here.is_none() {
            undecided.push(point.end.clone());
        }
        let holds = here == Some(true);
        if let Some(range) = ranges.last_mut().filter(|_| from_left) {
            (range.to, range.closed[1]) = (point.end.clone(), holds);
        }
        let joined = from_left && holds;
        if right == Some(true) && !joined {
            ranges.push(Range { from: point.end.clone(), to: point.end.clone(), closed: [holds, false] });
        } else if holds && !from_left && right != Some(true) {
            ranges.push(Range { from: point.end.clone(), to: point.end.clone(), closed: [true, true] });
        }
    }
    Ranges { condition, ranges, undecided }
}

/// The real roots of a polynomial over the field, with the numbers that they have among all roots.
type RealRoots = Vec<(usize, Root<BITS>)>;

/// A root in words: exact, or by polynomial and number.
fn in_words(polynomial: &Univariate<Cosine>, roots: &[Root<BITS>], index: usize) -> Words {
    use super::words::Described;
    Cosine::root_in_words(polynomial, roots, index)
        .unwrap_or_else(|| Words { text: "an algebraic number".into(), latex: "\\text{an algebraic number}".into() })
}

/// A number of the field, enclosed.
type Theta = Enclosure<BITS>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_simplest_fraction_lies_between() {
        let ratio = |a: i64, b: i64| RBig::from(a) / RBig::from(b);
        assert_eq!(simplest(ratio(3, 10), ratio(4, 10)), ratio(1, 3));
        assert_eq!(simplest(ratio(-3, 10), ratio(4, 10)), ratio(0, 1));
        assert_eq!(simplest(ratio(-7, 2), ratio(-10, 3)), ratio(-7, 2));
        assert_eq!(simplest(ratio(301, 1000), ratio(302, 1000)), ratio(16, 53));
        assert_eq!(simplest(ratio(1, 1), ratio(3, 2)), ratio(1, 1));
    }
}
