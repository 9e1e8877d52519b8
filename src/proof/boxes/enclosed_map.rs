//! How was a map proved regular and injective by enclosures, and of which eigenvalue is it?

use crate::analysis::exact::{BITS, Value};
use crate::numbers::{Angle, EnclosedWorld, Interval, World};
use crate::proof::jacobian::Pieces;
use crate::proof::outcome::Valences;
use dashu_ratio::RBig;
use std::fmt;

/// A proof.
#[derive(Clone, Debug, PartialEq)]
pub struct EnclosedMap {
    /// The valences that it is proved for.
    pub valences: Valences,
    /// What the map is made of on the ring.
    pub pieces: Pieces,
    /// The ring's inner radius; the largest one, where valences differ.
    pub radius: i32,
    /// How many patches were looked at, those of quartered ones among them.
    pub patches: usize,
    /// What the proof is made of: valences looked at apart, then boxes of c that cover all others.
    pub boxes: Vec<CosineBox>,
}

/// A box of c = cos(2 pi/n), with where lambda lies on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CosineBox {
    /// The one valence that it is about; `None` for all that have no box of their own.
    pub only: Option<usize>,
    /// c.
    pub c: Interval,
    /// lambda.
    pub lambda: Interval,
}

impl fmt::Display for EnclosedMap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let boxes = self.boxes.iter().filter(|own| own.only.is_none()).count();
        let at_once = if boxes == 0 { String::new() } else { format!(" on {boxes} boxes of cos(2 pi/n)") };
        write!(f, "for {} by enclosed Bezier points of {} patches{at_once}", self.valences, self.patches)
    }
}

impl EnclosedMap {
    /// Whether a real number may be the lambda of this proof at a valence; false is certain.
    pub fn may_be_lambda(&self, n: usize, value: &Value) -> bool {
        let cosine = EnclosedWorld::<BITS>.cos(&Angle::fixed(RBig::ONE / RBig::from(n.max(1))));
        let c = cosine.map_or(Interval::REALS, |c| Interval::enclosing(&c));
        let own = self.boxes.iter().any(|part| part.only == Some(n)).then_some(n);
        let near = self.boxes.iter().filter(|part| part.only == own && meet(part.c, c));
        near.into_iter().any(|part| meet(part.lambda, Interval::enclosing(value)))
    }
}

fn meet(a: Interval, b: Interval) -> bool {
    a.lo() <= b.hi() && b.lo() <= a.hi()
}
