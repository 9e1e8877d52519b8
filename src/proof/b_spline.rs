//! What are the Bezier points of a uniform B-spline?
//!
//! A piece of degree d over [0, 1] has the controls f(i-d+1, ..., i), i = 0..d, and the Bezier points f(0, ..., 0, 1,
//! ..., 1) of one blossom f (Ramshaw 1989); de Boor's algorithm (1972) leads from the ones to the others, one argument
//! at a time. Its divisors are d, d - 1, ..., 1 on every path, so that d! times the Bezier points are whole
//! combinations of the controls.

/// d! times the Bezier points of a piece, each by its weights of the d + 1 controls.
pub fn bezier_rows(degree: usize) -> Vec<Vec<i64>> {
    (0..=degree).map(|ones| blossom(degree, ones)).collect()
}

/// d! f(0, ..., 0, 1, ..., 1) with so many ones.
fn blossom(degree: usize, ones: usize) -> Vec<i64> {
    let unit = |i: usize| (0..=degree).map(|k| i64::from(k == i)).collect();
    let mut level: Vec<Vec<i64>> = (0..=degree).map(unit).collect();
    for done in 0..degree {
        let u = i64::from(done < ones);
        let next = |(at, pair): (usize, &[Vec<i64>])| -> Vec<i64> {
            // f(..., i - d) and f(..., i - done), what they have in common left out
            let (before, after) = (at as i64 + 1 - u, u + (degree - done - 1 - at) as i64);
            pair[0].iter().zip(&pair[1]).map(|(low, high)| before * low + after * high).collect()
        };
        level = level.windows(2).enumerate().map(next).collect();
    }
    level.concat()
}

/// n choose k.
pub fn choose(n: usize, k: usize) -> i64 {
    (0..k.min(n)).fold(i64::from(k <= n), |product, i| product * (n - i) as i64 / (i + 1) as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Farin 2002: the uniform cubic and quadratic.
    #[test]
    fn published_tables() {
        assert_eq!(bezier_rows(3), [[1, 4, 1, 0], [0, 4, 2, 0], [0, 2, 4, 0], [0, 1, 4, 1]]);
        assert_eq!(bezier_rows(2), [[1, 1, 0], [0, 2, 0], [0, 1, 1]]);
        // values of the uniform B-splines of degree 4 and 5 at knots: Schoenberg 1973
        assert_eq!(bezier_rows(4)[0], [1, 11, 11, 1, 0]);
        assert_eq!(bezier_rows(5)[0], [1, 26, 66, 26, 1, 0]);
    }

    /// The Cox-de Boor recursion for the i-th B-spline with knots 0, 1, ..., in whole numbers: d! 2^d times its value
    /// at x/2.
    fn cox_de_boor(degree: i64, i: i64, x: i64) -> i64 {
        if degree == 0 {
            return i64::from((2 * i..2 * i + 2).contains(&x));
        }
        (x - 2 * i) * cox_de_boor(degree - 1, i, x) + (2 * (i + degree + 1) - x) * cox_de_boor(degree - 1, i + 1, x)
    }

    #[test]
    fn values_are_those_of_cox_and_de_boor() {
        for degree in 1..=9 {
            let rows = bezier_rows(degree);
            for i in 0..=degree {
                // control i has its knots from i - d on; at 1/2 all Bernstein polynomials count by binomials
                let column: Vec<i64> = rows.iter().map(|row| row[i]).collect();
                let middle: i64 = column.iter().enumerate().map(|(k, own)| choose(degree, k) * own).sum();
                let (d, first) = (degree as i64, i as i64 - degree as i64);
                assert_eq!(middle, cox_de_boor(d, first, 1), "{degree} {i}");
                assert_eq!(column[0] << degree, cox_de_boor(d, first, 0));
            }
            let factorial: i64 = (1..=degree as i64).product();
            assert!(rows.iter().all(|row| row.iter().sum::<i64>() == factorial));
        }
    }
}
