//! What must be written down so that a small program can check a proof again?
//!
//! Numbers that are hard to find: the parametrisation, the net of the characteristic map, and where the parameter of
//! each valence lies. All else follows from the scheme's rules. docs/certificate.md describes the file, and the crate
//! `eigenring-check` checks it.

use super::jacobian::Pieces;
use super::map::MapProof;
use super::net::{Function, Net, content, polynomial_scale};
use crate::analysis::Analyzer;
use crate::analysis::exact::Value;
use crate::numbers::{Field, Trouble};
use crate::refine::Obstacle;
use dashu_int::IBig;
use dashu_ratio::RBig;
use serde::Serialize;

/// A polynomial in p with whole coefficients, from power 0 on.
pub type Whole = Vec<i128>;

/// A point i, j of a sector with i >= j, and its value x + i sin(2 pi/n) y as x, y.
pub type Valued = ((i32, i32), [Whole; 2]);

/// What a certificate says: limit surfaces of a scheme are C1 at the extraordinary point, for generic control points,
/// every valence from one on. Parameters are told in thousandths.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Certificate {
    /// Which version of this format it is.
    pub format: &'static str,
    /// What is claimed.
    pub claim: &'static str,
    /// For every valence from this one on.
    pub from: usize,
    /// The rules of the scheme in the interior.
    pub scheme: toml::Table,
    /// The range of the parameter p.
    pub range: [i32; 2],
    /// cos(2 pi/n), numerator and denominator.
    pub c: [Whole; 2],
    /// The subdominant eigenvalue, over a whole number.
    pub lambda: (Whole, i128),
    /// The points of a sector with their values.
    pub net: Vec<Valued>,
    /// For each valence from the first one on, two parameters between which its own lies.
    pub each: Vec<[i32; 2]>,
    /// A parameter below that of every further valence.
    pub tail: i32,
}

/// What stands in a scheme file beside the rules in the interior.
const BESIDE: [&str; 4] = ["name", "source", "boundary", "claims"];

fn stuck<T>(why: &str) -> Result<T, Obstacle> {
    Err(Obstacle::Limit(why.to_string()))
}

impl Certificate {
    /// The certificate of a map that is proved; `file` is the text of the scheme's file. Of two valences the first is
    /// the claim's; those before the second one are told singly, and from there on all at once. That eigenvalues are
    /// ordered as the claim says is for the checker to see.
    ///
    /// # Errors
    /// When it can't be put into these words, or a limit of size is passed.
    pub fn of(
        analyzer: &Analyzer,
        proof: &MapProof,
        file: &str,
        valences: (usize, usize),
    ) -> Result<Certificate, Obstacle> {
        let (course, interval, (from, next)) = (&proof.range.course, &proof.range.interval, valences);
        let Ok(mut scheme) = file.parse::<toml::Table>() else { return stuck("the scheme's file is not TOML") };
        scheme.retain(|key: &str, _| !BESIDE.contains(&key));
        if course.lambda.denominator().degree() != Some(0) {
            return stuck("the subdominant eigenvalue is not a polynomial in the parameter");
        }
        let divisor = content([&course.lambda])?.1;
        let one = Function::whole(1);
        let scale = polynomial_scale(|| [&course.c, &one].into_iter(), &interval.low)?;
        Ok(Certificate {
            format: "eigenring-certificate/1",
            claim: "C1",
            from,
            scheme,
            range: [thousandths(&interval.low)?, thousandths(&interval.high)?],
            c: [whole(&course.c, &scale)?, whole(&one, &scale)?],
            lambda: (whole(&course.lambda, &Function::rational(&divisor.clone().into()))?, small(&divisor)?),
            net: net(analyzer, proof)?,
            each: (from..next).map(|n| between(proof, n)).collect::<Result<_, _>>()?,
            tail: between(proof, next)?[0],
        })
    }

    /// Its text.
    ///
    /// # Errors
    /// When it can't be written.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string(self)
    }
}

/// A number that certificates can hold.
fn small(own: &IBig) -> Result<i128, Obstacle> {
    own.try_into().or_else(|_| stuck("a number of more than 127 bits"))
}

fn thousandths(own: &RBig) -> Result<i32, Obstacle> {
    let (above, below) = (own * RBig::from(1000)).into_parts();
    match i32::try_from(&above) {
        Ok(own) if below.is_one() => Ok(own),
        _ => stuck("an end of the parameter's range is not in thousandths"),
    }
}

/// The product of a function and a scale that makes it a polynomial with whole coefficients.
fn whole(own: &Function, scale: &Function) -> Result<Whole, Obstacle> {
    own.times(scale)?.numerator().coefficients().iter().map(|own| small(own.numerator())).collect()
}

/// Two neighbouring parameters, or twice the same, with cos(2 pi/n) between their values of c, which grows.
fn between(proof: &MapProof, n: usize) -> Result<[i32; 2], Obstacle> {
    let (interval, c) = (&proof.range.interval, &proof.range.course.c);
    let (low, high) = match [(3, -1), (4, 0), (6, 1)].into_iter().find(|own| own.0 == n) {
        Some((_, twice)) => (RBig::from(twice) / RBig::from(2), RBig::from(twice) / RBig::from(2)),
        None => Value::pi().times(&Value::rational(&(RBig::from(2) / RBig::from(n))))?.cos().lo_hi(),
    };
    let at = |own: i32| -> Result<RBig, Trouble> {
        let p = RBig::from(own) / RBig::from(1000);
        c.numerator().evaluate(&p)?.over(&c.denominator().evaluate(&p)?)
    };
    let (mut first, mut last) = (thousandths(&interval.low)?, thousandths(&interval.high)?);
    if at(first)? > low || at(last)? < high {
        return stuck("c doesn't take the cosine's value on the range");
    }
    while last - first > 1 {
        let middle = first + (last - first) / 2;
        let value = at(middle)?;
        if value <= low {
            first = middle;
        } else if value >= high {
            last = middle;
        } else {
            break;
        }
    }
    Ok(if at(first)? >= high { [first, first] } else { [first, last] })
}

/// All values that the ring and these need, of half a sector: times what makes them polynomials.
fn net(analyzer: &Analyzer, proof: &MapProof) -> Result<Vec<Valued>, Obstacle> {
    let (lattice, course) = (analyzer.lattice(), &proof.range.course);
    let spline = analyzer.regular().ok().and_then(|regular| regular.spline.as_ref());
    let (Some(pieces), Ok(forms)) = (spline.and_then(|own| Pieces::of(own, lattice)), analyzer.forms()) else {
        return stuck("limit functions on regular meshes are not of a kind whose Bezier points are known here");
    };
    let scheme = analyzer.scheme().with_values();
    let mut net = Net::of(&scheme, lattice, forms, course.clone())?;
    for patch in pieces.ring() {
        pieces.bezier(&mut net, patch)?;
    }
    let mut values = Vec::new();
    for (orbit, (a, b)) in net.values().iter().filter(|((i, j), _)| i >= j) {
        values.push((*orbit, [a.plus(&b.times(&course.c)?)?, b.clone()]));
    }
    let scale = polynomial_scale(|| values.iter().flat_map(|(_, own)| own), &proof.range.interval.low)?;
    values.iter().map(|(orbit, [x, y])| Ok((*orbit, [whole(x, &scale)?, whole(y, &scale)?]))).collect()
}
