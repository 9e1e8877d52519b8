//! Of which polynomials are the eigenvalues roots, whatever the valence?
//!
//! With t = 1/n and c = cos(2 pi/n) they are roots of fixed polynomials ([`AllValences`]): those of general frequencies
//! with c_k as well. The one that lambda is a root of is told apart.

use super::branch::{Branch, approx_largest};
use super::disc::Number;
use crate::analysis::exact::formulas::{AllValences, FrequencyForms, GENERIC, Which};
use crate::numbers::{C, C_K, Field, Free, N, Trouble, Univariate};
use dashu_ratio::RBig;

/// An answer, or what is missing.
pub type Found<T> = Result<Result<T, String>, Trouble>;

/// The factors of the characteristic polynomials, by what they depend on.
pub struct Parts {
    /// That of lambda.
    pub branch: Branch,
    /// Whether the general frequencies have it, too.
    pub is_general: bool,
    /// The others of general frequencies, in c_k.
    pub general: Vec<Univariate<Free>>,
    /// The others of frequencies 0, those that are singled out, and n/2: in t, at the place of n, and c.
    pub single: Vec<(Which, Univariate<Free>)>,
}

impl Parts {
    /// The factors, where that of lambda is seen and depends on its cosine alone.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn of(forms: &AllValences) -> Found<Parts> {
        let (first, general) = match frequencies(forms) {
            Ok((_, first, general)) => (first, general),
            Err(why) => return Ok(Err(why)),
        };
        let is_general = first.which == Which::General;
        let variable = if is_general { C_K } else { C };
        let Some(leading) = leading(first)? else {
            return Ok(Err("frequency 1 has no largest eigenvalue that is real and simple".to_string()));
        };
        if depends_on_others(&leading, variable)
            || general.forms.iter().any(|form| depends_on_others(&form.polynomial, C_K))
        {
            return Ok(Err("eigenvalues of general frequencies depend on more than their cosine".to_string()));
        }
        let mut single = Vec::new();
        for own in forms.frequencies.iter().filter(|own| own.which != Which::General) {
            let others = own.forms.iter().map(|form| &form.polynomial);
            let is_known = |polynomial: &&Univariate<Free>| match own.which {
                Which::Is(0) => **polynomial == one(),
                which => which == first.which && **polynomial == leading,
            };
            for polynomial in others.filter(|polynomial| !is_known(polynomial)) {
                single.push((own.which, polynomial.mapped(in_t)?));
            }
        }
        let others = general.forms.iter().map(|form| form.polynomial.clone());
        let general = others.filter(|own| !is_general || *own != leading).collect();
        Ok(Ok(Parts { branch: Branch::of(&leading, variable)?, is_general, general, single }))
    }
}

/// The forms of the frequencies 0, 1 and all general ones, if 1 is simple in frequency 0 and no parameter is free.
///
/// # Errors
/// What is missing, in words.
pub fn frequencies(forms: &AllValences) -> Result<(&FrequencyForms, &FrequencyForms, &FrequencyForms), String> {
    if !forms.parameters.is_empty() {
        return Err("a parameter is left free".to_string());
    }
    let find = |which: Which| forms.frequencies.iter().find(|own| own.which == which);
    let (Some(zero), Some(general)) = (find(Which::Is(0)), find(Which::General)) else {
        return Err("a frequency has no forms".to_string());
    };
    if !zero.forms.iter().any(|form| form.polynomial == one() && form.multiplicity == 1) {
        return Err("1 is not seen to be simple in frequency 0".to_string());
    }
    Ok((zero, find(Which::Is(1)).unwrap_or(general), general))
}

/// x - 1.
pub fn one() -> Univariate<Free> {
    Univariate::new(vec![Free::whole(-1), Free::whole(1)])
}

/// Whether a polynomial's coefficients depend on more than one indeterminate.
pub fn depends_on_others(polynomial: &Univariate<Free>, variable: usize) -> bool {
    let other = |value: &Free| (0..6).any(|index| index != variable && value.mentions(index));
    polynomial.coefficients().iter().any(other)
}

/// The factor with the largest real root at a large valence, if it is a simple one.
fn leading(first: &FrequencyForms) -> Result<Option<Univariate<Free>>, Trouble> {
    let cosine = Number::from_f64(libm::cos(std::f64::consts::TAU / GENERIC as f64))?;
    let mut values = vec![cosine; 6];
    values[N] = Number::whole(GENERIC as i64);
    let mut best: Option<(f64, usize)> = None;
    for (index, form) in first.forms.iter().enumerate() {
        let own = approx_largest(&form.polynomial.mapped(|value| value.evaluate(&values))?);
        if own.is_some_and(|own| best.is_none_or(|(most, _)| own > most)) {
            best = own.map(|own| (own, index));
        }
    }
    let form = best.and_then(|(_, index)| first.forms.get(index)).filter(|form| form.multiplicity == 1);
    Ok(form.map(|form| form.polynomial.clone()))
}

/// A rational function of n with 1/t for n, t standing at the place of n.
///
/// # Errors
/// When a limit of size is passed.
pub fn in_t(value: &Free) -> Result<Free, Trouble> {
    let mut values: Vec<Free> = (0..6).map(Free::variable).collect();
    values[N] = Free::whole(1).over(&Free::variable(N))?;
    value.evaluate(&values)
}

/// cos(2 pi t).
///
/// # Errors
/// When a limit of size is passed.
pub fn cosine(t: &RBig) -> Result<Number, Trouble> {
    Ok(Number::rational(t).times(&Number::pi())?.times(&Number::whole(2))?.cos())
}

/// Values for the indeterminates: t at the place of n, c.
pub fn in_order(t: Number, c: Number) -> Vec<Number> {
    let mut values = vec![Number::whole(0); 6];
    (values[N], values[C]) = (t, c);
    values
}

/// A frequency in words.
pub fn named(which: Which) -> String {
    match which {
        Which::Is(k) => format!("frequency {k}"),
        Which::Half => "frequency n/2".to_string(),
        Which::General => "a general frequency".to_string(),
    }
}
