//! Which spectra exclude that limits are C1 at the extraordinary point?
//!
//! Near it generic limits look like their leading eigenfunctions: those of the largest modulus after 1 that have the
//! largest Jordan blocks among these. If there are three or more, secants fill the space and no plane is tangent. If
//! all are of one frequency k other than 0, 1, n-1, the surface passes its tangent plane in another cyclic order than
//! that of its sectors. If there is one of frequency 0 alone, it lies along a half line. Proofs are in
//! docs/theory.md; the first reasons of this kind are in Peters and Reif (1998) and Zorin (2000).

use crate::analysis::Analyzer;
use crate::analysis::exact::{ExactAnalysis, ExactEigenvalue};
use std::cmp::Ordering;

/// Whether no eigenvector of an eigenvalue other than 0 has the limit 0, as far as that is known: control points are
/// limit points, or they are the coefficients of a box spline with linearly independent shifts.
pub fn is_effective(analyzer: &Analyzer) -> bool {
    let spline = analyzer.regular().ok().and_then(|regular| regular.spline.as_ref());
    analyzer.scheme().is_interpolating() || spline.is_some_and(|spline| spline.is_independent())
}

/// What these reasons rest on beside the spectrum: that zeros on a ring are of finitely many parts, as they are for piecewise polynomials, and, for
/// frequency 0, that the function does not vanish along a line into the point without changing its sign.
pub(super) const SUPPOSED: &str = "if zeros of the leading eigenfunction are as docs/theory.md, section 17, supposes";

/// Why limits of generic data are not C1 at the extraordinary point of this valence, if the spectrum tells so. It is
/// told for schemes that are effective, see [`is_effective`]; leading eigenfunctions are supposed to vanish nowhere
/// along a line into the point, or to change their sign, and their zeros on a ring to be of finitely many parts.
pub fn against_c1(exact: &ExactAnalysis, valence: usize, effective: bool) -> Option<String> {
    let leading = leading(exact).filter(|_| effective)?;
    let first = leading.first()?;
    let alone = leading.iter().all(|e| e.frequency == first.frequency);
    let functions: usize = leading.iter().map(|e| functions(e, valence)).sum();
    match first.frequency {
        0 if alone && functions == 1 && has_one_largest_block(first) => Some(format!(
            "frequency 0 leads: after 1 its {} is larger in modulus than {}: limits lie along a half line, {SUPPOSED}",
            in_words(first),
            rest(exact, first)
        )),
        _ if functions > 2 => {
            let names: Vec<String> =
                leading.iter().map(|e| format!("{} of frequency {}", in_words(e), e.frequency)).collect();
            Some(format!("a tie: after 1 lead {} alike: limits have no tangent plane", names.join(" and ")))
        }
        k if alone && k > 1 => Some(format!(
            "frequency {k} leads: after 1 its {} is larger in modulus than {}: limits are not single-sheeted, {SUPPOSED}",
            in_words(first),
            rest(exact, first)
        )),
        _ => None,
    }
}

/// The eigenvalues of the largest modulus after 1 with the largest Jordan blocks; `None` where that is not decided or
/// 1 doesn't lead.
fn leading(exact: &ExactAnalysis) -> Option<Vec<&ExactEigenvalue>> {
    let (one, (first, e)) = (exact.one?, exact.after_one().next()?);
    if exact.compare_moduli(one, first)? != Ordering::Greater || !exact.certain[e.level] {
        return None;
    }
    if e.modulus_squared.sign() != Some(Ordering::Greater) {
        return None;
    }
    let level = exact.after_one().map(|(_, other)| other).filter(|other| other.level == e.level);
    let sizes: Option<Vec<(usize, &ExactEigenvalue)>> = level.map(|own| Some((own.structure?.largest, own))).collect();
    let sizes = sizes?;
    let largest = sizes.iter().map(|(size, _)| *size).max()?;
    Some(sizes.into_iter().filter(|(size, _)| *size == largest).map(|(_, own)| own).collect())
}

/// At least so many real eigenfunctions of the leading kind an eigenvalue has: those of the frequencies k and n-k go
/// together.
fn functions(e: &ExactEigenvalue, valence: usize) -> usize {
    let blocks = e.structure.map_or(1, |structure| if structure.largest == 1 { structure.geometric } else { 1 });
    let real = e.frequency == 0 || 2 * e.frequency == valence;
    blocks * if real { 1 } else { 2 }
}

/// Whether an eigenvalue of frequency 0 or n/2 has no room for a second block as large as its largest.
fn has_one_largest_block(e: &ExactEigenvalue) -> bool {
    let largest = e.structure.map_or(1, |structure| structure.largest);
    e.algebraic.is_some_and(|times| times < 2 * largest)
}

fn in_words(e: &ExactEigenvalue) -> String {
    let size = e.structure.map_or(1, |structure| structure.largest);
    let block = if size > 1 { format!(" with a Jordan block of size {size}") } else { String::new() };
    format!("{}{block}", value(e))
}

fn value(e: &ExactEigenvalue) -> String {
    let short = e.exact.as_ref().map(|words| &words.text).filter(|text| text.len() < 30);
    short.cloned().unwrap_or_else(|| {
        let (re, im) = (e.re.midpoint_f64(), e.im.midpoint_f64());
        if e.is_real() { format!("{re:.7}...") } else { format!("{re:.7}...{im:+.7}... i") }
    })
}

/// The largest that the leading eigenvalue is compared with: of frequency 1.
fn rest(exact: &ExactAnalysis, leading: &ExactEigenvalue) -> String {
    let other = exact.after_one().find(|(_, e)| e.frequency == 1);
    match other {
        Some((_, e)) if e.level == leading.level => format!("{}, whose blocks are smaller", in_words(e)),
        Some((_, e)) => format!("{} of frequency 1 and all others", value(e)),
        None => "all others".to_string(),
    }
}
