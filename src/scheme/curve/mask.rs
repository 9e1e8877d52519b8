//! Which weights make the new points of a curve from the old ones?
//!
//! The mask of a scheme of arity a: p_i' = sum_j a_{i - a j} p_j. Its symbol is a(z) = sum_i a_i z^i, and its submask r the weights
//! with i = r modulo the arity, one for each kind of new point (Dyn and Levin, "Subdivision schemes in geometric modelling", 2002).

use dashu_ratio::RBig;

/// An exact mask: `p^{new}_i = sum_j a_{i - arity*j} p_j`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    /// The index of the first coefficient.
    pub first: i64,
    /// How many new points come for an old one: 2 or more.
    pub arity: u32,
    /// The coefficients from `first` on; neither the first nor the last is zero.
    pub coefficients: Vec<RBig>,
}

impl Mask {
    /// A mask; zeros at both ends are left out.
    pub fn new(first: i64, arity: u32, mut coefficients: Vec<RBig>) -> Mask {
        while coefficients.last().is_some_and(RBig::is_zero) {
            coefficients.pop();
        }
        let zeros = coefficients.iter().take_while(|value| value.is_zero()).count();
        coefficients.drain(..zeros);
        let first = if coefficients.is_empty() { 0 } else { first + zeros as i64 };
        Mask { first, arity, coefficients }
    }

    /// The coefficient `a_i`; zero outside of the support.
    pub fn get(&self, i: i64) -> RBig {
        let inside = usize::try_from(i - self.first).ok().and_then(|index| self.coefficients.get(index));
        inside.cloned().unwrap_or(RBig::ZERO)
    }

    /// The first and the last index with a coefficient; `None` for the mask of zeros.
    pub fn support(&self) -> Option<(i64, i64)> {
        let last = self.first + self.coefficients.len() as i64 - 1;
        (!self.coefficients.is_empty()).then_some((self.first, last))
    }

    /// The coefficients with their indices.
    pub fn terms(&self) -> impl Iterator<Item = (i64, &RBig)> {
        self.coefficients.iter().enumerate().map(|(index, value)| (self.first + index as i64, value))
    }

    /// The weights of the new points i = r modulo the arity, as (j, weight of p_j) for the new point i = r.
    pub fn submask(&self, r: i64) -> Vec<(i64, RBig)> {
        let arity = i64::from(self.arity);
        let own = self.terms().filter(|(i, value)| (i - r).rem_euclid(arity) == 0 && !value.is_zero());
        let mut weights: Vec<(i64, RBig)> = own.map(|(i, value)| ((r - i) / arity, value.clone())).collect();
        weights.reverse();
        weights
    }

    /// The sums of the submasks 0, 1, ..., arity - 1; all are 1 where constants are reproduced.
    pub fn coset_sums(&self) -> Vec<RBig> {
        let mut sums = vec![RBig::ZERO; self.arity as usize];
        for (i, value) in self.terms() {
            sums[i.rem_euclid(i64::from(self.arity)) as usize] += value;
        }
        sums
    }

    /// Whether `a_i` is the same from both ends.
    pub fn is_symmetric(&self) -> bool {
        self.coefficients.iter().eq(self.coefficients.iter().rev())
    }

    /// The mask with its first index elsewhere.
    #[must_use]
    pub fn starting_at(&self, first: i64) -> Mask {
        Mask { first, ..self.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(first: i64, arity: u32, over: i64, weights: &[i64]) -> Mask {
        Mask::new(first, arity, weights.iter().map(|w| RBig::from(*w) / RBig::from(over)).collect())
    }

    #[test]
    fn zeros_at_the_ends_are_left_out() {
        let chaikin = mask(-3, 2, 4, &[0, 1, 3, 3, 1, 0, 0]);
        assert_eq!(chaikin, mask(-2, 2, 4, &[1, 3, 3, 1]));
        assert_eq!(chaikin.support(), Some((-2, 1)));
        assert_eq!(
            (chaikin.get(-3), chaikin.get(0), chaikin.get(2)),
            (RBig::ZERO, mask(0, 2, 4, &[3]).get(0), RBig::ZERO)
        );
        assert_eq!(mask(5, 2, 1, &[0, 0]).support(), None);
    }

    #[test]
    fn submasks_tell_the_old_points_of_a_new_one() {
        let cubic = mask(-2, 2, 8, &[1, 4, 6, 4, 1]);
        let of =
            |r| cubic.submask(r).into_iter().map(|(j, w)| (j, (w * RBig::from(8)).to_string())).collect::<Vec<_>>();
        let row = |weights: &[(i64, &str)]| weights.iter().map(|(j, w)| (*j, (*w).to_string())).collect::<Vec<_>>();
        assert_eq!(of(0), row(&[(-1, "1"), (0, "6"), (1, "1")]));
        assert_eq!(of(1), row(&[(0, "4"), (1, "4")]));
        assert_eq!(of(3), row(&[(1, "4"), (2, "4")]));
        assert_eq!(cubic.coset_sums(), vec![RBig::ONE, RBig::ONE]);
        assert!(cubic.is_symmetric() && !mask(0, 2, 1, &[1, 2]).is_symmetric());
    }

    /// Four weights a set for arity 3, with negative first index.
    #[test]
    fn cosets_are_counted_from_index_zero() {
        let sums = mask(-1, 3, 1, &[1, 2, 3, 4]).coset_sums();
        assert_eq!(sums, [2, 3, 5].map(RBig::from).to_vec());
    }
}
