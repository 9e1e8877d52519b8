//! How are exact values written?
//!
//! In the language of scheme files, so that they can be read again, and in LaTeX. A number of the field Q(2 cos(2 pi/N)) is a sum
//! of cosines; a root of a quadratic polynomial is written with its square root; a root of any other is named by its
//! polynomial and its number, largest modulus first.

use super::split::Hint;
use super::{BITS, Value};
use crate::numbers::closed_form::ClosedForm;
use crate::numbers::roots::Root;
use crate::numbers::{Cosine, Field, Free, Univariate, square_part};
use dashu_base::Gcd;
use dashu_int::UBig;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// A value, written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Words {
    /// In the language of scheme files.
    pub text: String,
    /// In LaTeX.
    pub latex: String,
}

/// The names of n, cos(2 pi/n) and cos(2 pi k/n) in formulas.
const TEXT_NAMES: [&str; 3] = ["n", "cos(2*pi/n)", "cos(2*pi*k/n)"];
const LATEX_NAMES: [&str; 3] = ["n", "c", "c_k"];

/// A field whose numbers can be written; enclosures can't.
pub trait Described: Field {
    /// The number.
    fn in_words(&self) -> Option<Words> {
        None
    }

    /// A root of a monic polynomial.
    fn root_in_words(_polynomial: &Univariate<Self>, _roots: &[Root<BITS>], _index: usize) -> Option<Words> {
        None
    }

    /// The form for all n of a root of a factor.
    fn form_in_words(_hints: &[Hint], _factor: &Univariate<Self>, _root: &Root<BITS>, _k: usize) -> Option<Words> {
        None
    }

    /// A polynomial in a root.
    fn extension_in_words(
        _value: &Univariate<Self>,
        _polynomial: &Univariate<Self>,
        _roots: &[Root<BITS>],
        _index: usize,
    ) -> Option<Words> {
        None
    }
}

impl Described for Value {}

impl Described for Cosine {
    fn in_words(&self) -> Option<Words> {
        Some(sum_of_cosines(self, &UBig::ONE))
    }

    fn root_in_words(polynomial: &Univariate<Self>, roots: &[Root<BITS>], index: usize) -> Option<Words> {
        match polynomial.coefficients() {
            [constant, _] => constant.negated().in_words(),
            [_, _, _] => Surd::of(polynomial, roots, index)?.in_words(),
            _ => numbered(polynomial, index),
        }
    }

    fn form_in_words(hints: &[Hint], factor: &Univariate<Self>, root: &Root<BITS>, k: usize) -> Option<Words> {
        let has = |hint: &&Hint| {
            hint.polynomial == *factor
                || hint.polynomial.degree() >= factor.degree()
                    && hint.polynomial.divided(factor).is_ok_and(|(_, rest)| rest.degree().is_none())
        };
        let hint = hints.iter().find(has)?;
        if !root.is_real() {
            return None;
        }
        let forms = ClosedForm::of(&hint.form)?;
        let distance = |form: &ClosedForm| Some((approx_value(form, &hint.approx)? - root.re.midpoint_f64()).abs());
        let mut nearest: Vec<(f64, &ClosedForm)> =
            forms.iter().filter_map(|form| Some((distance(form)?, form))).collect();
        nearest.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        // two roots that floating numbers hardly part are not named
        let told = nearest.get(1).is_none_or(|(other, _)| nearest[0].0 < 1e-9 && *other > 1e-6);
        let (_, form) = nearest.first().filter(|_| told)?;
        Some(form_at_frequency(form, k, &hint.parameters))
    }

    fn extension_in_words(
        value: &Univariate<Self>,
        polynomial: &Univariate<Self>,
        roots: &[Root<BITS>],
        index: usize,
    ) -> Option<Words> {
        let surd = Surd::of(polynomial, roots, index)?;
        match value.coefficients() {
            [] => Cosine::whole(0).in_words(),
            [constant] => constant.in_words(),
            [constant, slope] => surd.scaled(slope)?.moved(constant)?.in_words(),
            _ => None,
        }
    }
}

/// The value of a closed form, approximately: it tells two roots apart.
fn approx_value(form: &ClosedForm, values: &[f64]) -> Option<f64> {
    match form {
        ClosedForm::Rational(value) => value.evaluate(values).ok(),
        ClosedForm::Root { mean, scale, radicand, positive } => {
            let root = radicand.evaluate(values).ok()?.max(0.0).sqrt() * scale.evaluate(values).ok()?;
            Some(mean.evaluate(values).ok()? + if *positive { root } else { -root })
        }
    }
}

/// A closed form for all n at a frequency that is a number.
fn form_at_frequency(form: &ClosedForm, k: usize, parameters: &[String]) -> Words {
    let angle = if k == 1 { "2*pi/n".to_string() } else { format!("{}*pi/n", 2 * k) };
    let (text, latex) = (format!("cos({angle})"), if k == 1 { "c".to_string() } else { format!("c_{{{k}}}") });
    let texts = names(&["n", "cos(2*pi/n)", &text], parameters);
    let latexes = names(&["n", "c", &latex], parameters);
    Words { text: form.text(&texts), latex: form.latex(&latexes) }
}

/// A closed form for all n, with the names of free parameters.
pub fn form_in_words(form: &ClosedForm, parameters: &[String]) -> Words {
    let (text, latex) = (names(&TEXT_NAMES, parameters), names(&LATEX_NAMES, parameters));
    Words { text: form.text(&text), latex: form.latex(&latex) }
}

/// The roots of a factor over the free world; those of a factor without closed forms are named together.
pub fn factor_in_words(factor: &Univariate<Free>, parameters: &[String]) -> Vec<Words> {
    if let Some(forms) = ClosedForm::of(factor) {
        return forms.iter().map(|form| form_in_words(form, parameters)).collect();
    }
    let written =
        |value: &Free| (free_in_words(value, parameters), *value == Free::whole(1), value.is_certainly_zero());
    let terms: Vec<(Words, bool, bool)> = factor.coefficients().iter().map(written).collect();
    let polynomial = polynomial_in_words(&terms);
    vec![Words {
        text: format!("roots of {}", polynomial.text),
        latex: format!("\\text{{roots of }}{}", polynomial.latex),
    }]
}

/// A rational function, with the names of free parameters.
pub fn free_in_words(value: &Free, parameters: &[String]) -> Words {
    form_in_words(&ClosedForm::Rational(value.clone()), parameters)
}

fn names<'a>(own: &[&'a str], parameters: &'a [String]) -> Vec<&'a str> {
    let mut names: Vec<&str> = own.iter().copied().chain(parameters.iter().map(String::as_str)).collect();
    names.resize(6, "?");
    names
}

/// mean + factor * sqrt(radicand), the radicand positive; with an imaginary unit where `imaginary`.
struct Surd {
    mean: Cosine,
    factor: Cosine,
    radicand: Cosine,
    imaginary: bool,
}

impl Surd {
    /// A root of x^2 + b x + c.
    fn of(polynomial: &Univariate<Cosine>, roots: &[Root<BITS>], index: usize) -> Option<Surd> {
        let [c, b, _] = polynomial.coefficients() else { return None };
        let mean = b.over(&Cosine::whole(-2)).ok()?;
        let radicand = mean.times(&mean).and_then(|square| square.minus(c)).ok()?;
        let ([first, second], own) = (roots, roots.get(index)?) else { return None };
        let other = if index == 0 { second } else { first };
        let positive = if own.is_real() {
            own.re.compare(&other.re)? == Ordering::Greater
        } else {
            own.im.sign()? == Ordering::Greater
        };
        let radicand = if own.is_real() { radicand } else { radicand.negated() };
        let factor = Cosine::whole(if positive { 1 } else { -1 });
        Some(Surd { mean, factor, radicand, imaginary: !own.is_real() })
    }

    fn scaled(self, slope: &Cosine) -> Option<Surd> {
        Some(Surd { mean: self.mean.times(slope).ok()?, factor: self.factor.times(slope).ok()?, ..self })
    }

    fn moved(self, constant: &Cosine) -> Option<Surd> {
        Some(Surd { mean: self.mean.plus(constant).ok()?, ..self })
    }

    fn in_words(self) -> Option<Words> {
        let unit = if self.imaginary { Words { text: "i*".into(), latex: "i".into() } } else { Words::empty() };
        let (factor, under) = self.simplified();
        if under == Cosine::whole(1) && !self.imaginary {
            return self.mean.plus(&factor).ok()?.in_words();
        }
        let inner = sum_of_cosines(&under, &UBig::ONE);
        let root = Words {
            text: format!("{}sqrt({})", unit.text, inner.text),
            latex: format!("{}\\sqrt{{{}}}", unit.latex, inner.latex),
        };
        match (self.mean.as_rational(), factor.as_rational()) {
            (_, Some(factor)) => Some(over_one_denominator(&self.mean, &factor, &root)),
            _ => {
                let (mean, factor) = (self.mean.in_words()?, factor.in_words()?);
                Some(Words {
                    text: format!("{} + ({})*{}", mean.text, factor.text, root.text),
                    latex: format!("{} + \\left({}\\right){}", mean.latex, factor.latex, root.latex),
                })
            }
        }
    }

    /// Squares taken out of the root: those of rational numbers.
    fn simplified(&self) -> (Cosine, Cosine) {
        if let Some(Ok((square, free))) = self.radicand.as_rational().map(|radicand| square_part(&radicand)) {
            let factor = self.factor.times(&Cosine::rational(&square)).unwrap_or_else(|_| self.factor.clone());
            return (factor, Cosine::whole(free as i64));
        }
        // denominators leave the root
        let (_, parts) = self.radicand.as_cosines();
        let common = parts.iter().fold(UBig::ONE, |lcm, (_, part)| common_multiple(lcm, part.denominator()));
        let scale = least_root(&common);
        let square = RBig::from(&scale * &scale);
        match (self.radicand.times(&Cosine::rational(&square)), self.factor.over(&Cosine::rational(&RBig::from(scale))))
        {
            (Ok(radicand), Ok(factor)) => (factor, radicand),
            _ => (self.factor.clone(), self.radicand.clone()),
        }
    }
}

impl Words {
    fn empty() -> Words {
        Words { text: String::new(), latex: String::new() }
    }
}

fn common_multiple(a: UBig, b: &UBig) -> UBig {
    let gcd = (&a).gcd(b);
    a / gcd * b
}

/// The least s found such that s^2 is a multiple of this number.
fn least_root(number: &UBig) -> UBig {
    let whole = RBig::from(number.clone());
    square_part(&whole)
        .map_or(number.clone(), |(square, free)| square.numerator().clone().try_into().unwrap_or(UBig::ONE) * free)
}

/// (mean + factor root)/denominator, with whole numbers where that can be.
fn over_one_denominator(mean: &Cosine, factor: &RBig, root: &Words) -> Words {
    let (_, parts) = mean.as_cosines();
    let denominator =
        parts.iter().fold(factor.denominator().clone(), |lcm, (_, part)| common_multiple(lcm, part.denominator()));
    let scaled = |value: &RBig| value * RBig::from(denominator.clone());
    let factor = scaled(factor);
    let negative = factor < RBig::ZERO;
    let size = if negative { -factor } else { factor };
    let times = Words {
        text: if size == RBig::ONE { root.text.clone() } else { format!("{size}*{}", root.text) },
        latex: if size == RBig::ONE { root.latex.clone() } else { format!("{size}{}", root.latex) },
    };
    let joined = if parts.is_empty() {
        let sign = if negative { "-" } else { "" };
        Words { text: format!("{sign}{}", times.text), latex: format!("{sign}{}", times.latex) }
    } else {
        let mean = sum_of_cosines(mean, &denominator);
        let sign = if negative { "-" } else { "+" };
        Words {
            text: format!("{} {sign} {}", mean.text, times.text),
            latex: format!("{} {sign} {}", mean.latex, times.latex),
        }
    };
    if denominator.is_one() {
        return joined;
    }
    let text = if parts.is_empty() { joined.text } else { format!("({})", joined.text) };
    Words { text: format!("{text}/{denominator}"), latex: format!("\\frac{{{}}}{{{denominator}}}", joined.latex) }
}

/// `scale` times a number, as a sum of cosines.
fn sum_of_cosines(value: &Cosine, scale: &UBig) -> Words {
    let (order, parts) = value.as_cosines();
    let mut sum = Words::empty();
    for (p, part) in &parts {
        let part = part * RBig::from(scale.clone());
        let term = term(*p as u64, order, &part);
        let negative = part < RBig::ZERO;
        let join = match (sum.text.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        sum = Words {
            text: format!("{}{join}{}", sum.text, term.text),
            latex: format!("{}{join}{}", sum.latex, term.latex),
        };
    }
    if sum.text.is_empty() { Words { text: "0".into(), latex: "0".into() } } else { sum }
}

/// |part| cos(2 pi p/order)
fn term(p: u64, order: u64, part: &RBig) -> Words {
    let (top, bottom) = (part.numerator().to_string().replace('-', ""), part.denominator().to_string());
    if p == 0 {
        let latex = if bottom == "1" { top.clone() } else { format!("\\frac{{{top}}}{{{bottom}}}") };
        let text = if bottom == "1" { top } else { format!("{top}/{bottom}") };
        return Words { text, latex };
    }
    let gcd = (2 * p).gcd(order);
    let (turns, order) = (2 * p / gcd, order / gcd);
    let times = if turns == 1 { String::new() } else { turns.to_string() };
    let angle = if turns == 1 { "pi".to_string() } else { format!("{turns}*pi") };
    let (front, front_latex) = match (top.as_str(), bottom.as_str()) {
        ("1", "1") => (String::new(), String::new()),
        ("1", _) => (String::new(), format!("\\frac{{1}}{{{bottom}}}")),
        (_, "1") => (format!("{top}*"), top.clone()),
        _ => (format!("{top}*"), format!("\\frac{{{top}}}{{{bottom}}}")),
    };
    let back = if bottom == "1" { String::new() } else { format!("/{bottom}") };
    Words {
        text: format!("{front}cos({angle}/{order}){back}"),
        latex: format!("{front_latex}\\cos\\frac{{{times}\\pi}}{{{order}}}"),
    }
}

/// A root by its polynomial and its number.
fn numbered(polynomial: &Univariate<Cosine>, index: usize) -> Option<Words> {
    let written = |value: &Cosine| Some((value.in_words()?, *value == Cosine::whole(1), value.is_certainly_zero()));
    let terms: Option<Vec<(Words, bool, bool)>> = polynomial.coefficients().iter().map(written).collect();
    let polynomial = polynomial_in_words(&terms?);
    Some(Words {
        text: format!("root {} of {}", index + 1, polynomial.text),
        latex: format!("\\text{{root {} of }}{}", index + 1, polynomial.latex),
    })
}

/// A polynomial in x from its coefficients, low to high: each written, whether it is 1, and whether it is 0.
fn polynomial_in_words(coefficients: &[(Words, bool, bool)]) -> Words {
    let (mut text, mut latex) = (Vec::new(), Vec::new());
    for (power, (words, is_one, _)) in coefficients.iter().enumerate().filter(|(_, (_, _, zero))| !zero).rev() {
        let (x, x_latex) = match power {
            0 => (String::new(), String::new()),
            1 => ("x".to_string(), "x".to_string()),
            _ => (format!("x^{power}"), format!("x^{{{power}}}")),
        };
        if *is_one && power > 0 {
            text.push(x);
            latex.push(x_latex);
        } else {
            text.push(if power == 0 { format!("({})", words.text) } else { format!("({})*{x}", words.text) });
            latex.push(format!("\\left({}\\right){x_latex}", words.latex));
        }
    }
    Words { text: text.join(" + "), latex: latex.join(" + ") }
}
