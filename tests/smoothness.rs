//! Is a mask as smooth as its papers say, and does every bound have a witness that holds?
#![allow(clippy::unwrap_used)]

use dashu_ratio::RBig;
use eigenring::analysis::smoothness::range::{Finding, Piece, continuity_between};
use eigenring::analysis::smoothness::stability::Stability;
use eigenring::analysis::smoothness::symbol::differences;
use eigenring::analysis::smoothness::transition::transitions;
use eigenring::analysis::smoothness::witness::Witness;
use eigenring::analysis::smoothness::{Smoothness, smoothness};
use eigenring::scheme::catalogue;
use eigenring::scheme::curve::Mask;

fn ratio(a: i64, b: i64) -> RBig {
    RBig::from(a) / RBig::from(b)
}

fn mask(id: &str, settings: &[(&str, &str)]) -> Mask {
    let mut scheme = catalogue::curve(id).unwrap().unwrap_or_else(|faults| panic!("{faults}"));
    settings.iter().for_each(|(name, value)| scheme.book.set(name, value).unwrap());
    scheme.mask().unwrap_or_else(|faults| panic!("{faults}"))
}

fn of(id: &str, settings: &[(&str, &str)]) -> Smoothness {
    smoothness(&mask(id, settings)).unwrap()
}

/// Whether the interval of the exponent holds the value and is not wider than the width.
fn assert_near(found: &Smoothness, value: f64, width: f64) {
    let (lower, upper) = (found.lower.unwrap(), found.upper.unwrap());
    assert!(lower <= value + 1e-6 && value - 1e-6 <= upper, "{value} is not in [{lower}, {upper}]: {:?}", found.why);
    assert!(upper - lower <= width, "[{lower}, {upper}]: {:?}", found.why);
    assert!(found.radius.witness.shows(&found.kernel, &found.radius.upper));
}

/// Splines of degree d are C^(d-1), and their derivative of order d - 1 is Lipschitz continuous.
#[test]
fn splines_have_the_exponent_of_their_degree() {
    for (id, setting) in [("b-spline", "d"), ("ternary-b-spline", "d"), ("quaternary-b-spline", "d")] {
        for d in 1..=5_usize {
            let found = of(id, &[(setting, &d.to_string())]);
            assert_eq!((found.order, found.exact.clone()), (d + 1, Some(d.to_string())), "{id} {d}");
            assert_eq!(
                (found.continuity, found.refuted, found.attained),
                (Some(d - 1), Some(d), Some(true)),
                "{id} {d}"
            );
            assert_near(&found, d as f64, 0.0);
        }
    }
    let chaikin = of("chaikin", &[]);
    assert_eq!((chaikin.exact.as_deref(), chaikin.continuity), (Some("2"), Some(1)));
}

/// Rioul 1992 and Dyn and Levin 2002 for w = 1/16 (no Lipschitz continuous derivative); the other exponents are those of the issue.
#[test]
fn the_four_point_scheme_has_its_exponents() {
    let found = of("four-point", &[("w", "1/16")]);
    assert_eq!((found.exact.as_deref(), found.attained), (Some("2"), Some(false)), "{:?}", found.why);
    assert_eq!((found.order, found.continuity, found.refuted), (4, Some(1), Some(2)));
    for (w, exponent) in [("1/32", 1.228447), ("1/10", 1.583705), ("3/20", 1.222856), ("19/100", 1.012662)] {
        let found = of("four-point", &[("w", w)]);
        assert_near(&found, exponent, 1e-5);
        assert_eq!((found.continuity, found.refuted), (Some(1), Some(2)), "{w}");
    }
}

/// Deslauriers and Dubuc 1989: 6 - 2 log_2 3 = log_2(64/9) for six points.
#[test]
fn six_points_are_twice_differentiable() {
    let found = of("six-point", &[]);
    assert_near(&found, 6.0 - 2.0 * 3.0_f64.log2(), 1e-6);
    assert_eq!((found.exact.as_deref(), found.continuity, found.attained), (Some("log_2(64/9)"), Some(2), Some(true)));
}

/// Hassan, Ivrissimtzis, Dodgson and Sabin 2002: C2 for 1/15 < mu < 1/9, the exponent log_3 11 at 1/11.
#[test]
fn the_ternary_four_point_scheme_is_twice_differentiable() {
    let found = of("ternary-four-point", &[("mu", "1/11")]);
    assert_near(&found, 11.0_f64.ln() / 3.0_f64.ln(), 1e-6);
    assert_eq!((found.exact.as_deref(), found.continuity), (Some("log_3(11)"), Some(2)));
    for (mu, continuity, refuted) in [
        ("67/1000", 2, 3),
        ("1/12", 2, 3),
        ("111/1000", 2, 3),
        ("1/15", 1, 2),
        ("1/9", 1, 2),
        ("66/1000", 1, 2),
        ("112/1000", 1, 2),
    ] {
        let found = of("ternary-four-point", &[("mu", mu)]);
        assert_eq!((found.continuity, found.refuted), (Some(continuity), Some(refuted)), "{mu} {:?}", found.why);
    }
}

/// Symmetric masks (1 + z)^3 (p, q, 1/4 - 2 p - 2 q, q, p) that nobody tuned.
#[test]
fn any_mask_gets_a_narrow_interval() {
    let mut state = 12345_u64;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ratio((state >> 33) as i64 % 2001 - 1000, 4000)
    };
    for _ in 0..12 {
        let (p, q) = (random(), random());
        let middle = ratio(1, 4) - (&p + &q) * RBig::from(2);
        let mut weights = vec![p.clone(), q.clone(), middle, q, p];
        for _ in 0..3 {
            weights.push(RBig::ZERO);
            weights = (0..weights.len())
                .map(|i| &weights[i] + i.checked_sub(1).map_or(&RBig::ZERO, |j| &weights[j]))
                .collect();
        }
        let mask = Mask::new(0, 2, weights);
        assert_eq!(mask.coefficients.len(), 8);
        let found = smoothness(&mask).unwrap();
        let (low, high) = (found.radius.lower.to_f64().value(), found.radius.upper.to_f64().value());
        assert!((high / low).log2() <= 0.01, "{mask:?} [{low}, {high}] {:?}", found.why);
        assert!(found.radius.witness.shows(&found.kernel, &found.radius.upper));
    }
}

/// The spectral radius of a product never exceeds the bound, which its trace bounds from below: |tr P| <= n rho(P).
#[test]
fn products_stay_below_the_bound() {
    let found = of("four-point", &[("w", "1/10")]);
    let matrices = transitions(&found.kernel);
    let n = matrices[0].len();
    for length in 1..=9_u32 {
        for code in 0..2_usize.pow(length) {
            let mut p: Vec<Vec<RBig>> = matrices[code % 2].clone();
            for k in 1..length {
                let t = &matrices[(code >> k) % 2];
                p = (0..n)
                    .map(|i| (0..n).map(|j| (0..n).fold(RBig::ZERO, |sum, l| sum + &t[i][l] * &p[l][j])).collect())
                    .collect();
            }
            let trace = (0..n).fold(RBig::ZERO, |sum, i| sum + &p[i][i]);
            let bound = (0..length).fold(RBig::from(n), |bound, _| bound * &found.radius.upper);
            assert!(trace <= bound && -trace <= bound, "{code} {length}");
        }
    }
}

/// The equations of a witness, written down once more.
fn holds(kernel: &Mask, q: &RBig, witness: &Witness) -> bool {
    let Witness::Polytope(polytope) = witness else { return false };
    let (a, matrices) = (kernel.arity as usize, transitions(kernel));
    (0..polytope.vertices.len()).all(|j| {
        (0..a).all(|e| {
            let terms = &polytope.images[j][e];
            let sum = terms
                .iter()
                .fold(RBig::ZERO, |sum, (_, alpha)| sum + if *alpha < RBig::ZERO { -alpha } else { alpha.clone() });
            let row = |i: usize| {
                let image =
                    (0..matrices[e].len()).fold(RBig::ZERO, |y, l| y + &matrices[e][i][l] * &polytope.vertices[j][l]);
                let combined = terms.iter().fold(RBig::ZERO, |y, (l, alpha)| y + alpha * &polytope.vertices[*l][i]);
                image == combined * q
            };
            sum <= RBig::ONE && (0..matrices[e].len()).all(row)
        })
    })
}

#[test]
fn a_witness_that_was_touched_is_rejected() {
    let found = of("four-point", &[("w", "1/10")]);
    let q = &found.radius.upper;
    let Witness::Polytope(polytope) = found.radius.witness.clone() else { panic!("{:?}", found.why) };
    let rejected = |polytope, q: &RBig| {
        let witness = Witness::Polytope(polytope);
        !holds(&found.kernel, q, &witness) && !witness.shows(&found.kernel, q)
    };
    assert!(holds(&found.kernel, q, &found.radius.witness) && found.radius.witness.shows(&found.kernel, q));
    assert!(rejected(polytope.clone(), &(q * ratio(99, 100))));
    let mut moved = polytope.clone();
    moved.vertices[1][0] += ratio(1, 1_000_000_000);
    assert!(rejected(moved, q));
    let mut larger = polytope.clone();
    larger.images[0][0][0].1 += ratio(1, 1000);
    assert!(rejected(larger, q));
    // vertices that don't span the space say nothing of it
    let mut flat = polytope;
    flat.vertices.truncate(1);
    flat.images.truncate(1);
    assert!(!Witness::Polytope(flat).shows(&found.kernel, q));
    let zero = eigenring::analysis::smoothness::witness::Polytope { vertices: Vec::new(), images: Vec::new() };
    assert!(!Witness::Polytope(zero).shows(&found.kernel, q));
}

/// Without stable shifts there is no upper bound: chi of [0, 3) times the spline of degree 1, symbol (1 + z^3)(1 + z)/2 (1 + z^3 as Jia
/// and Wang 1993).
#[test]
fn no_upper_bound_without_stable_shifts() {
    let mask = Mask::new(0, 2, [1, 1, 0, 1, 1].map(|w| ratio(w, 2)).to_vec());
    let found = smoothness(&mask).unwrap();
    assert!(matches!(found.stability, Stability::Unstable(_)));
    assert_eq!((found.upper, found.refuted), (None, None));
    assert!(found.why.iter().any(|line| line.contains("lower bound of the exponent only")), "{:?}", found.why);
}

#[test]
fn a_mask_without_a_limit_says_why() {
    let none = smoothness(&Mask::new(0, 2, [1, 1, 1].map(|w| ratio(w, 2)).to_vec()));
    assert!(none.unwrap_err().contains("i = 1 modulo 2 sum to 1/2"));
    // each point twice: the limit of a polygon is no continuous curve
    let steps = smoothness(&Mask::new(0, 2, vec![RBig::ONE, RBig::ONE])).unwrap();
    assert_eq!((steps.lower, steps.continuity, steps.refuted), (None, None, Some(0)));
    let wild = of("four-point", &[("w", "2")]);
    assert_eq!((wild.lower, wild.continuity, wild.refuted), (None, None, Some(0)));
}

/// Hechler, Moessner and Reif 2009: C1 exactly for 0 < w < w*, w* the real root of 32 w^3 + 4 w - 1.
#[test]
fn the_four_point_scheme_is_c1_up_to_its_limit() {
    let at = |w: &RBig| mask("four-point", &[("w", &w.to_string())]);
    let (low, high, width) = (ratio(-1, 10), ratio(3, 10), ratio(1, 256));
    let pieces = continuity_between(&at(&low), &at(&high), 1, &width).unwrap();
    let w = |t: &RBig| &low + (&high - &low) * t;
    let beyond = |w: &RBig| RBig::from(32) * w * w * w + RBig::from(4) * w >= RBig::ONE;
    let (mut proved, mut reached) = (RBig::ZERO, RBig::ZERO);
    for piece in &pieces {
        let (from, to) = (w(&piece.from), w(&piece.to));
        assert_eq!(piece.from, reached);
        reached = piece.to.clone();
        match &piece.finding {
            Finding::Proved { bound, ends } => {
                assert!(*bound < ratio(1, 2));
                assert!(from > RBig::ZERO && !beyond(&to), "{from} {to}");
                proved += &to - &from;
                for (polytope, w) in ends.iter().zip([&from, &to]) {
                    let kernel = differences(&at(w), 2).unwrap();
                    assert!(Witness::Polytope(polytope.clone()).shows(&kernel, bound), "{w}");
                }
            }
            Finding::Refuted(_) => assert!(to <= RBig::ZERO || beyond(&from), "{from} {to}"),
            Finding::Undecided => assert!(&piece.to - &piece.from <= width),
        }
    }
    assert_eq!(reached, RBig::ONE);
    let found = |refuted: bool, w0: &RBig| {
        let holds = |finding: &Finding| {
            matches!((finding, refuted), (Finding::Refuted(_), true) | (Finding::Proved { .. }, false))
        };
        pieces.iter().any(|piece| holds(&piece.finding) && w(&piece.from) <= *w0 && *w0 <= w(&piece.to))
    };
    // one stretch without a gap, at 1/16 neither, where the mask has two factors more
    let is_proved = |piece: &&Piece| matches!(piece.finding, Finding::Proved { .. });
    let stretch: Vec<&Piece> = pieces.iter().skip_while(|piece| !is_proved(piece)).collect();
    let stretch: Vec<&Piece> = stretch.into_iter().take_while(is_proved).collect();
    assert_eq!(stretch.len(), pieces.iter().filter(is_proved).count());
    // up to four widths from either end of the range
    let near = ratio(4, 256) * (&high - &low);
    assert!(w(&stretch[0].from) < near && beyond(&(w(&stretch[stretch.len() - 1].to) + &near)));
    assert!(proved > ratio(18, 100), "{proved}");
    assert!(found(true, &ratio(-1, 100)) && found(true, &ratio(1, 5)) && found(false, &ratio(1, 16)));
}

/// Twelve and sixteen points: exponents of many sum rules need a good simplex method.
#[test]
fn masks_of_many_points_get_a_narrow_interval() {
    for (n, order, continuity) in [("6", 12, 4), ("8", 16, 5)] {
        let found = of("deslauriers-dubuc", &[("N", n)]);
        let (lower, upper) = (found.lower.unwrap(), found.upper.unwrap());
        assert!(upper - lower <= 0.01, "[{lower}, {upper}] {:?}", found.why);
        assert_eq!((found.order, found.continuity, found.refuted), (order, Some(continuity), Some(continuity + 1)));
        assert!(found.radius.witness.shows(&found.kernel, &found.radius.upper));
    }
}

/// The four-point scheme is C1 exactly on (0, w*), 32 w*^3 + 4 w* = 1 (Hechler, Moessner and Reif 2009): proved inside, refuted outside, and
/// what is left open is narrow. What is no polynomial of degree 1 in its parameter is refused.
#[test]
fn ranges_of_the_four_point_scheme_close_in_on_its_ends() {
    use eigenring::report::curve::range::range;
    use eigenring::scheme::{Interval, catalogue};
    let scheme = catalogue::curve("four-point").unwrap().unwrap();
    let found = range(&scheme, &Interval::parse("w=-1/8..1/4").unwrap(), 1).unwrap();
    let critical = 0.192_729_25;
    let value = |text: &str| text.parse::<RBig>().unwrap().to_f64().value();
    let (mut proved, mut refuted) = (0.0, 0.0);
    for piece in &found.pieces {
        let (from, to) = (value(&piece.from), value(&piece.to));
        match piece.verdict {
            "proved" => {
                assert!(from > 0.0 && to < critical, "{piece:?}");
                proved += to - from;
            }
            "refuted" => {
                assert!(to <= 0.0 || from >= critical, "{piece:?}");
                refuted += to - from;
            }
            _ => assert!(to - from < 0.003, "{piece:?}"),
        }
    }
    assert!(proved > 0.185 && refuted > 0.18, "{found:?}");
    let verdicts: Vec<&str> = found.pieces.iter().map(|piece| piece.verdict).collect();
    assert_eq!(verdicts, ["refuted", "undecided", "proved", "undecided", "refuted"]);
    let splines = catalogue::curve("bezier").unwrap().unwrap();
    assert!(range(&splines, &Interval::parse("t=1/4..1/2").unwrap(), 1).is_err());
}
