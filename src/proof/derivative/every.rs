//! Is the map of every valence regular and injective, at once?
//!
//! The net is rational in a parameter p ([`crate::proof::course`]), the range of p is cut into intervals, and on each
//! the net is expanded ([`super::family`]). Intervals on which cells are not decided are halved. Valences that the
//! forms leave out are looked at one by one.

use super::cells::Cell;
use super::family::Range;
use super::regularity::points;
use super::sweep::{Coefficients, Swept};
use super::{DerivativeProof, Engine, NO_NET, NO_RING};
use crate::analysis::Analyzer;
use crate::analysis::exact::Value;
use crate::analysis::regular::mask::Point;
use crate::numbers::{Angle, EnclosedWorld, Field, Interval, Trouble, World};
use crate::proof::course::{self, Range as Parameters};
use crate::proof::jacobian::ControlNet;
use crate::proof::net::{Function, Net, Pair};
use crate::proof::outcome::{Outcome, Valences};
use crate::proof::positive::{Interval as Closed, is_positive_quotient};
use crate::refine::Obstacle;
use dashu_ratio::RBig;
use std::collections::BTreeMap;

/// The limits of refinement, and of the number of cells, on one interval.
const ON_A_BOX: (usize, usize) = (7, 4000);

/// The intervals that one starts from, and the least width that is halved.
const FIRST_BOXES: usize = 8;
const LEAST_BOX: f64 = 1e-3;

/// The largest valence that is looked at by itself where an interval is not decided.
const MOST_LOOKED_AT: f64 = 32.0;

/// The net at the points of the ring's cells.
type Functions = BTreeMap<Point, Pair>;

impl Engine {
    /// The maps of every valence from one on.
    ///
    /// # Errors
    /// When a weight has no value, or a limit of size is passed.
    pub fn from(&self, analyzer: &Analyzer, first: usize) -> Result<Outcome<DerivativeProof>, Obstacle> {
        let first = first.max(3);
        let forms = match analyzer.forms() {
            Ok(forms) => forms,
            Err(why) => return Ok(Outcome::stuck(why)),
        };
        if !forms.parameters.is_empty() {
            return Ok(Outcome::stuck("a parameter is left free"));
        }
        let Some(parameters) = course::range(forms)? else {
            return Ok(Outcome::stuck("c and the subdominant eigenvalue are not rational functions of one parameter"));
        };
        let singles: Vec<usize> = (first..forms.from).chain(forms.except.filter(|n| *n >= first)).collect();
        let whole = whole(&parameters, first.max(forms.from))?;
        let mut net = Net::of(&self.scheme, self.lattice, forms, parameters.course.clone())?;
        let Some(scale) = self.scale(None)? else { return Ok(Outcome::stuck(NO_RING)) };
        let functions = match self.functions(&mut net, whole, scale)? {
            Ok(functions) => functions,
            Err(why) => return Ok(Outcome::stuck(why)),
        };
        let start = DerivativeProof { singles, boxes: 0, ..self.proof(Valences::From(first), scale) };
        match self.on_boxes(whole, &functions, start)? {
            Ok(proof) => self.singly(analyzer, DerivativeProof { range: Some(parameters), ..proof }),
            Err((range, what)) => {
                let at = format!("{what}, for a parameter between {} and {}", range.low, range.high);
                let candidate = if parameters.course.c == Function::variable() { valence_near(range) } else { None };
                let seen = candidate.map(|n| self.analysed(analyzer, n)).transpose()?;
                Ok(seen.filter(|seen| matches!(seen, Outcome::Refuted { .. })).unwrap_or(Outcome::stuck(at)))
            }
        }
    }

    /// The net on the ring, if it is one of the eigenvalue, which is between 0 and 1, on all of the range.
    fn functions(&self, net: &mut Net, whole: Range, scale: i32) -> Result<Result<Functions, &'static str>, Obstacle> {
        let exact =
            |end: f64| RBig::try_from(end).map_err(|_| Trouble::BeyondThisWorld("an end of the range is no number"));
        let on = Closed { low: exact(whole.low)?, high: exact(whole.high)? };
        let lambda = net.course.lambda.clone();
        let below_one = Function::whole(1).minus(&lambda)?;
        if !is_positive_quotient(&lambda, &on)? || !is_positive_quotient(&below_one, &on)? {
            return Ok(Err("the subdominant eigenvalue is not seen to be between 0 and 1"));
        }
        let mut functions = Functions::new();
        for [i, j] in points(&Cell::ring(scale), &self.local) {
            functions.insert([i, j], net.at(i, j)?);
        }
        let holds = net.satisfies_its_equation()? && net.has_no_pole(&on)?;
        Ok(if holds { Ok(functions) } else { Err(NO_NET) })
    }

    /// The intervals, those of large c first; or one that is not decided, and what isn't.
    fn on_boxes(
        &self,
        whole: Range,
        functions: &Functions,
        mut proof: DerivativeProof,
    ) -> Result<Result<DerivativeProof, (Range, &'static str)>, Obstacle> {
        let cells = Cell::ring(proof.scale);
        let mut left = start(whole);
        while let Some(range) = left.pop() {
            let expanded = |(point, (a, b)): (&Point, &Pair)| (*point, [range.coefficients(a), range.coefficients(b)]);
            let values: BTreeMap<Point, Coefficients> = functions.iter().map(expanded).collect();
            match self.sweep(range.powers(), ON_A_BOX).run(&self.with_values(&cells, &values)?) {
                Swept::Positive { cells, depth } => {
                    (proof.boxes, proof.cells) = (proof.boxes + 1, proof.cells + cells);
                    proof.depth = proof.depth.max(depth);
                }
                Swept::Fold { .. } => return Ok(Err((range, "the Jacobian is negative"))),
                Swept::Open { .. } if range.high - range.low > LEAST_BOX => left.extend(range.halves()),
                Swept::Open { what, .. } => return Ok(Err((range, what))),
            }
        }
        Ok(Ok(proof))
    }

    /// What is left once the intervals are: single valences.
    fn singly(&self, analyzer: &Analyzer, mut proof: DerivativeProof) -> Result<Outcome<DerivativeProof>, Obstacle> {
        for n in proof.singles.clone() {
            match self.analysed(analyzer, n)? {
                Outcome::Proved(own) => {
                    (proof.cells, proof.depth) = (proof.cells + own.cells, proof.depth.max(own.depth));
                }
                Outcome::Undecided { at } => return Ok(Outcome::stuck(format!("n = {n}: {at}"))),
                refuted => return Ok(refuted),
            }
        }
        Ok(Outcome::Proved(proof))
    }
}

/// Floating-point ends of a range that holds the parameters of every valence from one on.
fn whole(parameters: &Parameters, from: usize) -> Result<Range, Trouble> {
    let (low, high) =
        (Interval::around(&parameters.interval.low).lo(), Interval::around(&parameters.interval.high).hi());
    let c: Value = EnclosedWorld.cos(&Angle::fixed(RBig::ONE / RBig::from(from)))?;
    let by_cosine = parameters.course.c == Function::variable();
    Ok(Range { low: if by_cosine { Interval::enclosing(&c).lo() } else { low }, high })
}

fn start(whole: Range) -> Vec<Range> {
    let mut boxes = vec![whole];
    while boxes.len() < FIRST_BOXES {
        boxes = boxes.into_iter().flat_map(Range::halves).collect();
    }
    boxes
}

/// A valence whose c is near the low end of a range, or the largest that is looked at: a guess, which is then looked
/// at by itself.
fn valence_near(range: Range) -> Option<usize> {
    let n = std::f64::consts::TAU / libm::acos(range.low);
    (n >= 3.0).then(|| n.min(MOST_LOOKED_AT).ceil() as usize)
}
