//! How does a polygon become two, whose union is the next polygon?
//!
//! For Bezier curves by de Casteljau's algorithm: the polygon of n points on one interval gives one for each part of it, and the two
//! share the point between them.

use dashu_ratio::RBig;

/// The two matrices that halve a polygon: rows are new points, columns old ones.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Halves {
    /// The weights of the first half.
    pub first: Vec<Vec<RBig>>,
    /// The weights of the second half.
    pub second: Vec<Vec<RBig>>,
}

impl Halves {
    /// The number of points of each polygon.
    pub fn points(&self) -> usize {
        self.first.len()
    }

    /// What is wrong with them: whether it is the second half, and in words.
    pub(super) fn faults(&self) -> Vec<(bool, String)> {
        let sum = |row: &Vec<RBig>| row.iter().fold(RBig::ZERO, |sum, value| sum + value);
        let mut faults = Vec::new();
        for (second, matrix) in [(false, &self.first), (true, &self.second)] {
            for (i, own) in matrix.iter().map(sum).enumerate().filter(|(_, own)| *own != RBig::ONE) {
                let message = format!(
                    "the weights of the new point i = {i} sum to {}, not to 1, so that constants are not reproduced and the \
                     scheme can't converge",
                    super::forms::shortened(&own)
                );
                faults.push((second, message));
            }
        }
        if faults.is_empty() && self.first.last() != self.second.first() {
            faults.push((true, "the last point of the first half is not the first point of the second".to_string()));
        }
        faults
    }
}
