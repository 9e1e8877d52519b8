//! What are cos(2 pi m/N) and sin(2 pi m/N)?
//!
//! A table of the N-th roots of unity. Arguments are reduced to the first octant in whole numbers before the one
//! rounding of the angle, so that the axes and the table's symmetries are exact (cos(pi/2) is 0, not 6e-17).

use num_complex::Complex64;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// The N-th roots of unity exp(2 pi i m/N), m = 0..N-1, rounded to `f64`.
#[derive(Clone, Debug)]
pub struct RootsOfUnity {
    table: Vec<Complex64>,
}

impl RootsOfUnity {
    /// The table for N = `order`, which must be at least 1.
    pub fn new(order: usize) -> Self {
        let order = order.max(1);
        RootsOfUnity { table: (0..order).map(|m| root(m, order)).collect() }
    }

    /// exp(2 pi i m/N) for any whole m.
    pub fn get(&self, m: i64) -> Complex64 {
        self.table[m.rem_euclid(self.table.len() as i64) as usize]
    }

    /// N.
    pub fn order(&self) -> usize {
        self.table.len()
    }
}

/// exp(2 pi i m/N) for 0 <= m < N: the angle is 8m/N octants.
fn root(m: usize, order: usize) -> Complex64 {
    let (octant, rest) = (8 * m / order, 8 * m % order);
    let folded = if octant % 2 == 0 { rest } else { order - rest };
    let angle = PI / 4.0 * (folded as f64 / order as f64);
    let (sin, cos) = if folded == order { (FRAC_1_SQRT_2, FRAC_1_SQRT_2) } else { libm::sincos(angle) };
    match octant {
        0 => Complex64::new(cos, sin),
        1 => Complex64::new(sin, cos),
        2 => Complex64::new(-sin, cos),
        3 => Complex64::new(-cos, sin),
        4 => Complex64::new(-cos, -sin),
        5 => Complex64::new(-sin, -cos),
        6 => Complex64::new(sin, -cos),
        _ => Complex64::new(cos, -sin),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_roots_agree_with_cosine_and_sine_and_are_exact_on_the_axes() {
        for order in 1..200_usize {
            let roots = RootsOfUnity::new(order);
            for m in 0..order {
                let angle = 2.0 * PI * m as f64 / order as f64;
                let expected = Complex64::new(angle.cos(), angle.sin());
                assert!((roots.get(m as i64) - expected).norm() < 2e-15, "{m}/{order}");
                assert_eq!(roots.get(-(m as i64)), roots.get(m as i64).conj(), "{m}/{order}");
            }
            if order % 4 == 0 {
                assert_eq!(roots.get(order as i64 / 4), Complex64::new(0.0, 1.0));
            }
        }
    }
}
