//! Are the exponents those that are published, and do witnesses hold in exact arithmetic?

use super::*;

fn rational(over: i64, value: i64) -> RBig {
    RBig::from(value) / RBig::from(over)
}

fn mask(first: i64, arity: u32, over: i64, weights: &[i64]) -> Mask {
    Mask::new(first, arity, weights.iter().map(|w| rational(over, *w)).collect())
}

/// The four-point scheme at w = number/over (Dyn, Levin and Gregory 1987).
fn four_point(number: i64, over: i64) -> Mask {
    let (w, half) = (number * 2, over);
    mask(-3, 2, 2 * over, &[-w, 0, half + w, 2 * over, half + w, 0, -w])
}

fn check(found: &Smoothness, exponent: f64, tolerance: f64) {
    let upper = found.hoelder.upper.unwrap();
    assert!(found.hoelder.lower <= upper);
    assert!((found.hoelder.lower - exponent).abs() < tolerance, "{:?}", found.hoelder);
    assert!((upper - exponent).abs() < tolerance, "{:?}", found.hoelder);
}

/// Degree d: C^(d-1), exponent d in the Lipschitz sense; generation d, reproduction 1 (Conti and Hormann 2011).
#[test]
fn splines() {
    let mut row = vec![1_i64, 1];
    for d in 1..=6_u32 {
        row = (0..=row.len()).map(|i| row.get(i).unwrap_or(&0) + if i > 0 { row[i - 1] } else { 0 }).collect();
        let found = smoothness(&mask(0, 2, 1 << d, &row)).unwrap();
        assert_eq!((found.continuity, found.no_more), (d - 1, true), "{d}");
        assert_eq!(found.hoelder.exact, Some(d.to_string()));
        assert_eq!(found.hoelder.attained, Some(true));
        assert_eq!((found.generation_degree, found.reproduction_degree), (d as usize, 1));
    }
}

/// Values of the joint spectral radius by an independent computation of polytopes; w = 1/16 by Dyn, Levin and Gregory 1987.
#[test]
fn four_points() {
    let found = smoothness(&four_point(1, 16)).unwrap();
    assert_eq!((found.continuity, found.hoelder.exact.as_deref()), (1, Some("2")));
    assert_eq!(found.hoelder.attained, Some(false));
    assert_eq!((found.generation_degree, found.reproduction_degree), (3, 3));
    for (number, over, exponent) in [(1, 32, 1.228447), (1, 10, 1.583705), (3, 20, 1.222856), (19, 100, 1.012662)] {
        let found = smoothness(&four_point(number, over)).unwrap();
        check(&found, exponent, 2e-6);
        assert_eq!((found.continuity, found.no_more), (1, true));
    }
    // from the root of 32w^3 + 4w - 1 on there is no C1 (Hechler, Moessner and Reif 2009)
    let beyond = smoothness(&four_point(193, 1000)).unwrap();
    assert!(beyond.continuity == 0 && beyond.no_more);
}

/// 6 - 2 log2 3 (Daubechies and Lagarias 1992).
#[test]
fn six_points() {
    let found = smoothness(&mask(-5, 2, 256, &[3, 0, -25, 0, 150, 256, 150, 0, -25, 0, 3])).unwrap();
    check(&found, 2.830075, 1e-6);
    assert_eq!((found.continuity, found.reproduction_degree), (2, 5));
}

/// Hassan, Ivrissimitzis, Dodgson and Sabin 2002, mu = 1/11: C2.
#[test]
fn ternary_four_points() {
    // over 198: -1/18 - mu/6, 13/18 + mu/2, 7/18 - mu/2, -1/18 + mu/6
    let (a, b, c, d) = (-14, 152, 68, -8);
    let found = smoothness(&mask(-5, 3, 198, &[d, a, 0, c, b, 198, b, c, 0, a, d])).unwrap();
    check(&found, 2.182658, 1e-6);
    assert_eq!(found.continuity, 2);
}

#[test]
fn masks_without_a_limit() {
    assert!(matches!(smoothness(&mask(0, 2, 2, &[1, 1])), Err(NoLimit::SumRule(_))));
    assert!(matches!(smoothness(&mask(0, 2, 1, &[2, 2, -1, -1])), Err(NoLimit::Diverges(..))));
    assert!(matches!(smoothness(&mask(0, 2, 2, &vec![1; 100_000])), Err(NoLimit::Limit(_))));
    // the hat function with knots 3 apart: convergent, shifts not stable (symbol zero at a cube root of unity)
    let unstable = smoothness(&mask(0, 2, 2, &[1, 0, 0, 2, 0, 0, 1]));
    assert!(unstable.is_err() || unstable.unwrap().stable != Some(true));
}

/// Symmetric masks of 8 weights with three sum rules: the symbol (1+z)^3 (x + y z + (1/2 - 2x - 2y)/2 ...)/4.
#[test]
fn masks_that_nobody_tuned_for() {
    let mut state = 12345_u64;
    let mut seen = 0;
    for _ in 0..40 {
        let mut draw = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as i64 % 101 - 50
        };
        let (x, y) = (draw(), draw());
        let mut row = vec![x, y, 100 - 2 * x - 2 * y, y, x];
        for _ in 0..3 {
            row = (0..=row.len()).map(|i| row.get(i).unwrap_or(&0) + if i > 0 { row[i - 1] } else { 0 }).collect();
        }
        let Ok(found) = smoothness(&mask(0, 2, 400, &row)) else { continue };
        let Some(upper) = found.hoelder.upper else { continue };
        assert!(upper - found.hoelder.lower < 0.01 && upper >= found.hoelder.lower, "{x} {y} {:?}", found.hoelder);
        seen += 1;
    }
    assert!(seen >= 5, "{seen}");
}

/// A checker of its own: exact rational arithmetic on the witness, nothing else.
fn accepts(matrices: &[Exact], polytope: &Polytope) -> bool {
    let exact = |x: f64| RBig::try_from(x).unwrap();
    let abs = |x: RBig| if x < RBig::ZERO { -x } else { x };
    let (cross, bound) = (exact(polytope.cross), exact(polytope.bound));
    let n = matrices[0].len();
    let due = matrices.len() * polytope.vertices.len();
    let unit = |i: usize| (0..n).all(|k| polytope.vertices[i][k] == if i == k { polytope.cross } else { 0.0 });
    (0..n).all(unit)
        && (0..due).all(|index| {
            let (e, j) = (index / polytope.vertices.len(), index % polytope.vertices.len());
            let Some((_, _, weights)) = polytope.combinations.iter().find(|c| (c.0, c.1) == (e, j)) else {
                return false;
            };
            let mut total = weights.iter().fold(RBig::ZERO, |sum, (_, alpha)| sum + abs(exact(*alpha)));
            for (i, row) in matrices[e].iter().enumerate() {
                let image = (0..n).fold(RBig::ZERO, |s, k| s + &row[k] * exact(polytope.vertices[j][k]));
                let rest =
                    weights.iter().fold(image, |s, (l, alpha)| s - exact(*alpha) * exact(polytope.vertices[*l][i]));
                total += abs(rest) / &cross;
            }
            total <= bound
        })
}

#[test]
fn witnesses_hold_and_tampered_ones_do_not() {
    let scheme = four_point(1, 10);
    let found = smoothness(&scheme).unwrap();
    let Witness::Polytope(polytope) = found.witness else { panic!("no polytope") };
    let matrices = transition_matrices(Symbol::of(&scheme).kernel(), 2);
    assert!(accepts(&matrices, &polytope));
    let mut lower = polytope.clone();
    lower.bound *= 0.999;
    assert!(!accepts(&matrices, &lower));
    let mut moved = polytope.clone();
    moved.combinations[0].2.clear();
    moved.combinations.pop();
    assert!(!accepts(&matrices, &moved));
}
