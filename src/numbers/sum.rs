//! What is the sum of many numbers, without losing their last digits?
//!
//! Compensated summation (Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen", 1974): the
//! error does not grow with the number of terms, so that the weights of a ring of 100,000 points still sum to 1.

/// The sum of the terms, to about the rounding of one addition of the sum of their moduli.
pub fn sum(terms: impl IntoIterator<Item = f64>) -> f64 {
    let (mut total, mut lost) = (0.0_f64, 0.0_f64);
    for term in terms {
        let next = total + term;
        lost += if total.abs() >= term.abs() { (total - next) + term } else { (term - next) + total };
        total = next;
    }
    total + lost
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_sums_keep_their_last_digits() {
        for n in [10_u32, 1_000, 100_000] {
            let ring = || (0..n).map(move |_| 1.0 / f64::from(n));
            assert!((sum(ring()) - 1.0).abs() <= f64::EPSILON);
            assert!(sum(ring().chain([1e6, -1e6])) - 1.0 < 1e-9);
        }
        assert_eq!(sum([1.0, 1e100, 1.0, -1e100]), 2.0);
    }
}
