//! At which values of the parameter may two moduli tie?
//!
//! Real roots f(x) = 0, g(y) = 0 tie where x = y or x = -y: at zeros of Res(f(x), g(x)) and Res(f(x), g(-x)). The squared modulus of a
//! root that is not real is a product of two roots of one factor, so that f's *pairs*, the polynomial of the products of two of its roots,
//! tell the rest; |mu| = lambda^2 is compared likewise. Factors that are equal identically never part, and are left out of the resultants.

use super::decide::Decider;
use super::{End, MOST_CANDIDATES, RealRoots, Theta, in_words};
use crate::analysis::exact::block::{Block, Wave};
use crate::analysis::exact::formulas::{self, AllValences, indeterminates};
use crate::analysis::exact::rows::Rows;
use crate::analysis::exact::{BITS, TOO_LARGE_A_FIELD, Value};
use crate::fault::Fault;
use crate::numbers::factor::factors;
use crate::numbers::linear::part;
use crate::numbers::polynomial::Polynomial;
use crate::numbers::real_root::{RealRoot, of_squares, roots_of};
use crate::numbers::roots::Root;
use crate::numbers::{
    AtValence, Cosine, Enclosure, FIRST_PARAMETER, Field, Free, ParameterWorld, Quotient, Trouble, Univariate,
};
use crate::refine::Obstacle;
use crate::scheme::Interval;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// A function of the parameter.
type Function = Quotient<Cosine>;
/// A polynomial in an eigenvalue.
type Poly = Univariate<Function>;

/// The most resultants of one valence.
const MOST_RESULTANTS: usize = 20_000;

/// A value of the parameter at which a condition may change.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    /// Monic, without multiple roots.
    pub(super) polynomial: Univariate<Cosine>,
    /// All of its roots.
    roots: Vec<Root<BITS>>,
    /// The number of this one among them.
    index: usize,
    /// The value, enclosed.
    pub(super) value: Value,
}

impl Candidate {
    /// The value, if it is known to be rational.
    pub(super) fn rational(&self) -> Option<RBig> {
        match self.polynomial.coefficients() {
            [constant, _] => constant.negated().as_rational(),
            _ => None,
        }
    }

    /// As an end of a range.
    pub(super) fn end(&self) -> End {
        match self.rational() {
            Some(value) => End::rational(&value),
            None => {
                let exact = in_words(&self.polynomial, &self.roots, self.index);
                End { value: self.value.clone(), exact, rational: None }
            }
        }
    }

    fn as_root(&self) -> RealRoot<Cosine, BITS> {
        RealRoot { polynomial: Some(self.polynomial.clone()), value: self.value.clone() }
    }
}

/// The candidates inside an interval, in order.
pub(super) fn of(decider: &Decider, interval: &Interval) -> Result<Vec<Candidate>, Obstacle> {
    let mut order = decider.n as u64;
    loop {
        let large = || Obstacle::Inexact(Fault::whole(TOO_LARGE_A_FIELD));
        let base = AtValence::new(order).ok_or_else(large)?;
        match decider.task().rows(&ParameterWorld { base: &base, name: decider.name }) {
            Err(Obstacle::Inexact(_)) if base.needed() > order => order = base.needed(),
            Err(other) => return Err(other),
            Ok(rows) => return with_rows(decider, interval, &base, &rows),
        }
    }
}

fn with_rows(
    decider: &Decider,
    interval: &Interval,
    base: &AtValence,
    rows: &Rows<Function>,
) -> Result<Vec<Candidate>, Obstacle> {
    let n = decider.n;
    let cosine = |k: usize| {
        let turns = RBig::from(k) / RBig::from(n);
        base.field().cosine(&turns).map(Function::constant).ok_or(Trouble::BeyondThisWorld("the field lacks a cosine"))
    };
    let mut all = Factors::default();
    for k in 0..=n / 2 {
        let wave = match k {
            0 => Wave::One,
            k if 2 * k == n => Wave::MinusOne,
            k => Wave::Cosine(cosine(k)?),
        };
        let hints = hints(decider.forms, n, k, &cosine)?;
        let block = Block::of(rows, Some(k), wave)?;
        for core in &block.cores {
            let polynomial = Univariate::characteristic(&part(&block.matrix, core))?;
            for piece in pieces(&polynomial, &hints)? {
                all.insert(&piece, k == 1)?;
            }
        }
    }
    let mut sought = Sought { theta: base.field().theta()?, interval, polynomials: vec![], found: vec![] };
    for entry in rows.rows.iter().chain(&rows.centre).flatten() {
        for weight in std::iter::once(&entry.weight.general).chain(entry.weight.at.values()) {
            // at a pole there is no value; where a weight vanishes the neighbourhood may be smaller
            sought.add(weight.denominator())?;
            sought.add(weight.numerator())?;
        }
    }
    for function in all.ties()? {
        sought.add(function.numerator())?;
        sought.add(function.denominator())?;
    }
    Ok(sought.found)
}

/// Factors that the forms for all valences have here.
fn hints(
    forms: Option<&AllValences>,
    n: usize,
    k: usize,
    cosine: &dyn Fn(usize) -> Result<Function, Trouble>,
) -> Result<Vec<Poly>, Trouble> {
    let mut hints = vec![minus(0), minus(1)];
    let Some(forms) = forms.filter(|forms| forms.holds_at(n)) else { return Ok(hints) };
    let values = indeterminates(n, cosine(1)?, cosine(k)?, &[Function::variable()]);
    let own = forms.forms_of(n, k).map_or(&[][..], |own| &own.forms);
    hints.extend(own.iter().filter_map(|form| formulas::at(&form.polynomial, &values).ok()));
    Ok(hints)
}

/// x - value
fn minus(value: i64) -> Poly {
    Univariate::new(vec![Function::whole(-value), Function::whole(1)])
}

/// Factors of a monic polynomial without multiple roots, each once: by hints, over the rational functions, by squares.
fn pieces(polynomial: &Poly, hints: &[Poly]) -> Result<Vec<Poly>, Trouble> {
    let (mut found, mut rest) = (Vec::new(), polynomial.clone());
    for hint in hints {
        let mut divides = false;
        while rest.degree() >= hint.degree() {
            let (quotient, remainder) = rest.divided(hint)?;
            if !remainder.is_zero() {
                break;
            }
            (rest, divides) = (quotient, true);
        }
        if divides {
            found.extend(refined(hint)?);
        }
    }
    found.extend(refined(&rest)?);
    Ok(found)
}

fn refined(polynomial: &Poly) -> Result<Vec<Poly>, Trouble> {
    match polynomial.degree() {
        None | Some(0) => return Ok(vec![]),
        Some(1) => return Ok(vec![polynomial.monic()?]),
        _ => {}
    }
    let free: Option<Vec<Free>> = polynomial.coefficients().iter().map(as_free).collect();
    if let Some(Ok(split)) = free.map(|free| factors(&Univariate::new(free))) {
        let mut values = vec![Function::whole(0); 6];
        values[FIRST_PARAMETER] = Function::variable();
        return split.iter().map(|(factor, _)| factor.mapped(|value| value.evaluate(&values))).collect();
    }
    Ok(polynomial.squarefree()?.into_iter().map(|(factor, _)| factor).collect())
}

/// A function with rational coefficients.
fn as_free(function: &Function) -> Option<Free> {
    let polynomial = |p: &Univariate<Cosine>| {
        let coefficients: Option<Vec<Polynomial>> =
            p.coefficients().iter().map(|value| value.as_rational().map(Polynomial::constant)).collect();
        Polynomial::from_coefficients_in(FIRST_PARAMETER, &coefficients?).ok()
    };
    Free::new(&polynomial(function.numerator())?, &polynomial(function.denominator())?).ok()
}

/// Factors of which no two share a root identically.
#[derive(Default)]
struct Factors {
    all: Vec<(Poly, bool)>,
}

impl Factors {
    /// Adds a polynomial without multiple roots; `first` tells whether it is of frequency 1.
    fn insert(&mut self, polynomial: &Poly, first: bool) -> Result<(), Trouble> {
        if polynomial.degree().is_none_or(|degree| degree == 0) {
            return Ok(());
        }
        if let Some((_, own)) = self.all.iter_mut().find(|(known, _)| known == polynomial) {
            *own |= first;
            return Ok(());
        }
        for index in 0..self.all.len() {
            let (other, of_other) = &self.all[index];
            if other.degree() == Some(1) && polynomial.degree() == Some(1) {
                continue;
            }
            let common = other.gcd(polynomial)?;
            if common.degree() == Some(0) {
                continue;
            }
            let (rest, own) = (other.divided(&common)?.0.monic()?, polynomial.divided(&common)?.0.monic()?);
            let of_other = *of_other;
            self.all.remove(index);
            self.insert(&common, first || of_other)?;
            self.insert(&rest, of_other)?;
            return self.insert(&own, first);
        }
        self.all.push((polynomial.clone(), first));
        Ok(())
    }

    /// Functions that vanish wherever a condition may change.
    fn ties(&self) -> Result<Vec<Function>, Trouble> {
        let mut ties = Ties { functions: vec![] };
        let (zero, one) = (minus(0), minus(1));
        let pairs: Vec<Option<Poly>> = self.all.iter().map(|(f, _)| pairs(f)).collect::<Result<_, _>>()?;
        for ((g, _), pairs) in self.all.iter().zip(&pairs) {
            ties.real(g, &one)?;
            ties.both(pairs.as_ref(), &one)?;
            // where roots meet, or leave the real line
            ties.real(g, g)?;
        }
        for (f, _) in self.all.iter().filter(|(_, first)| *first) {
            let squares = of_squares(f)?;
            ties.real(f, &zero)?;
            for ((g, _), pairs) in self.all.iter().zip(&pairs) {
                ties.real(f, g)?;
                ties.both(pairs.as_ref(), &squares)?;
                ties.both(Some(&g.composed_with_square()), f)?;
                ties.both(Some(&g.at_negative().composed_with_square()), f)?;
                let fourth = pairs.as_ref().map(|pairs| pairs.composed_with_square().composed_with_square());
                ties.both(fourth.as_ref(), f)?;
            }
        }
        Ok(ties.functions)
    }
}

/// The monic polynomial, without multiple roots, of the products of two different roots; none for degree 1.
fn pairs(f: &Poly) -> Result<Option<Poly>, Trouble> {
    let degree = f.degree().unwrap_or(0);
    if degree < 2 {
        return Ok(None);
    }
    let count = degree * (degree - 1) / 2;
    let sums = power_sums(&f.monic()?, 2 * count)?;
    let half = Function::whole(1).over(&Function::whole(2))?;
    let of_pairs = |k: usize| sums[k].times(&sums[k])?.minus(&sums[2 * k])?.times(&half);
    let of_pairs: Vec<Function> = (1..=count).map(of_pairs).collect::<Result<_, Trouble>>()?;
    let all = from_power_sums(&of_pairs)?;
    let mut product = Univariate::constant(Function::whole(1));
    for (factor, _) in all.squarefree()? {
        product = product.times(&factor)?;
    }
    Ok(Some(product))
}

/// The sums of the k-th powers of a monic polynomial's roots, k = 0..most, by Newton's identities.
fn power_sums(f: &Poly, most: usize) -> Result<Vec<Function>, Trouble> {
    let degree = f.degree().unwrap_or(0);
    // x^d + a_1 x^(d-1) + ... + a_d
    let a = |index: usize| f.coefficients()[degree - index].clone();
    let mut sums = vec![Function::whole(degree as i64)];
    for k in 1..=most {
        let mut sum = Function::whole(0);
        for index in 1..=degree.min(k - 1) {
            sum = sum.minus(&a(index).times(&sums[k - index])?)?;
        }
        if k <= degree {
            sum = sum.minus(&a(k).times(&Function::whole(k as i64))?)?;
        }
        sums.push(sum);
    }
    Ok(sums)
}

/// The monic polynomial whose roots have these power sums, from the first on.
fn from_power_sums(sums: &[Function]) -> Result<Poly, Trouble> {
    let mut high_first = vec![Function::whole(1)];
    for k in 1..=sums.len() {
        let mut sum = Function::whole(0);
        for index in 1..=k {
            sum = sum.plus(&high_first[k - index].times(&sums[index - 1])?)?;
        }
        high_first.push(sum.negated().over(&Function::whole(k as i64))?);
    }
    high_first.reverse();
    Ok(Univariate::new(high_first))
}

/// Whether the parameter stands in a polynomial.
fn varies(f: &Poly) -> bool {
    f.coefficients().iter().any(|value| value.as_constant().is_none())
}

/// Resultants that are functions of the parameter.
struct Ties {
    functions: Vec<Function>,
}

impl Ties {
    /// Where a root of f is one of g, or its negative.
    fn real(&mut self, f: &Poly, g: &Poly) -> Result<(), Trouble> {
        self.both(Some(f), g)?;
        self.both(Some(f), &g.at_negative())
    }

    /// Where a root of f is one of g without being so identically.
    fn both(&mut self, f: Option<&Poly>, g: &Poly) -> Result<(), Trouble> {
        let Some(f) = f.filter(|f| varies(f) || varies(g)) else { return Ok(()) };
        let common = f.gcd(g)?;
        if common.degree() == Some(0) {
            return self.keep(f.resultant(g)?);
        }
        let (own, other) = (f.divided(&common)?.0, g.divided(&common)?.0);
        for (a, b) in [(&own, &other), (&own, &common), (&other, &common)] {
            self.keep_resultant(a, b)?;
        }
        if common.degree() > Some(1) {
            self.keep_resultant(&common, &common.derivative()?)?;
        }
        Ok(())
    }

    fn keep_resultant(&mut self, a: &Poly, b: &Poly) -> Result<(), Trouble> {
        if a.degree() > Some(0) && b.degree() > Some(0) { self.keep(a.resultant(b)?) } else { Ok(()) }
    }

    fn keep(&mut self, function: Function) -> Result<(), Trouble> {
        if function.is_certainly_zero() {
            return Err(Trouble::BeyondThisWorld("eigenvalues are equal identically that were not seen to be"));
        }
        if self.functions.len() >= MOST_RESULTANTS {
            return Err(Trouble::BeyondThisWorld("too many eigenvalues have to be compared"));
        }
        if function.as_constant().is_none() && !self.functions.contains(&function) {
            self.functions.push(function);
        }
        Ok(())
    }
}

/// The candidates found so far.
struct Sought<'a> {
    theta: Theta,
    interval: &'a Interval,
    /// Those whose roots are known.
    polynomials: Vec<Univariate<Cosine>>,
    found: Vec<Candidate>,
}

impl Sought<'_> {
    /// Adds the zeros of a polynomial in the parameter.
    fn add(&mut self, polynomial: &Univariate<Cosine>) -> Result<(), Trouble> {
        for piece in parts(polynomial)? {
            if self.polynomials.contains(&piece) {
                continue;
            }
            self.polynomials.push(piece.clone());
            let theta = self.theta.clone();
            let roots = roots_of(&piece, &|value: &Cosine| value.enclosed(&theta))?;
            if roots.iter().any(|root| root.count > 1) {
                return Err(Trouble::BeyondThisWorld("zeros of a resultant are too near to be told apart"));
            }
            let real: RealRoots = roots
                .iter()
                .enumerate()
                .filter(|(_, root)| root.is_real())
                .map(|(i, root)| (i, root.clone()))
                .collect();
            for (index, root) in real {
                self.insert(Candidate { polynomial: piece.clone(), roots: roots.clone(), index, value: root.re })?;
            }
        }
        Ok(())
    }

    fn compare(&self, a: &RealRoot<Cosine, BITS>, b: &RealRoot<Cosine, BITS>) -> Result<Ordering, Trouble> {
        let order = a.compare(b, &|value: &Cosine| value.enclosed(&self.theta))?;
        order.ok_or(Trouble::BeyondThisWorld("two values of the parameter are too near to be told apart"))
    }

    /// Whether a candidate lies inside the interval, its ends left out.
    fn is_inside(&self, root: &RealRoot<Cosine, BITS>) -> Result<bool, Trouble> {
        let end = |value: &RBig| RealRoot {
            polynomial: Some(Univariate::new(vec![Cosine::rational(&-value), Cosine::whole(1)])),
            value: Enclosure::rational(value),
        };
        let after = self.compare(root, &end(&self.interval.from))? == Ordering::Greater;
        Ok(after && self.compare(root, &end(&self.interval.to))? == Ordering::Less)
    }

    /// Inserts in order; of equal candidates that of the simplest polynomial stays.
    fn insert(&mut self, candidate: Candidate) -> Result<(), Trouble> {
        let root = candidate.as_root();
        if !self.is_inside(&root)? {
            return Ok(());
        }
        let mut place = self.found.len();
        for (index, known) in self.found.iter().enumerate() {
            match self.compare(&root, &known.as_root())? {
                Ordering::Greater => {}
                Ordering::Less => {
                    place = index;
                    break;
                }
                Ordering::Equal => {
                    if candidate.polynomial.degree() < known.polynomial.degree() {
                        self.found[index] = candidate;
                    }
                    return Ok(());
                }
            }
        }
        if self.found.len() >= MOST_CANDIDATES {
            return Err(Trouble::BeyondThisWorld("too many values of the parameter have to be looked at"));
        }
        self.found.insert(place, candidate);
        Ok(())
    }
}

/// The monic parts of a polynomial without multiple roots; over the rational numbers its factors.
fn parts(polynomial: &Univariate<Cosine>) -> Result<Vec<Univariate<Cosine>>, Trouble> {
    if polynomial.degree().is_none_or(|degree| degree == 0) {
        return Ok(vec![]);
    }
    let polynomial = polynomial.monic()?;
    let free: Option<Vec<Free>> =
        polynomial.coefficients().iter().map(|value| Some(Free::rational(&value.as_rational()?))).collect();
    if let Some(Ok(split)) = free.map(|free| factors(&Univariate::new(free))) {
        let back = |value: &Free| Ok(Cosine::rational(&value.as_rational().unwrap_or_default()));
        return split.iter().map(|(factor, _)| factor.mapped(back)).collect();
    }
    Ok(polynomial.squarefree()?.into_iter().map(|(factor, _)| factor).collect())
}
