//! How was a map proved regular and injective by enclosures, and of which eigenvalue is it?

use crate::analysis::exact::Value;
use crate::proof::family::{CosineBox, may_be_lambda};
use crate::proof::jacobian::Pieces;
use crate::proof::outcome::Valences;
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
        may_be_lambda(&self.boxes, n, value)
    }
}
