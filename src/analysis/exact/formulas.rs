//! What are eigenvalues and masks for every valence at once?
//!
//! The blocks with n, c = cos(2 pi/n) and c_k = cos(2 pi k/n) left free: for k = 0, for the frequencies +-p that a ring of weights
//! singles out, for k = n/2, and for all others. Their characteristic polynomials, core by core, fall into factors over
//! Q(n, c, c_k); linear and quadratic ones give closed forms. What is equal here is equal for every n that the forms are made
//! for: those from [`AllValences::from`] on, where cases no longer change and frequencies don't fall together.

use super::block::{Block, Wave};
use super::jordan::{Answer, Structure, structure};
use super::masks::{Mask, limit_mask, tangent_mask};
use super::rows::Rows;
use super::words::{Words, form_in_words, free_in_words};
use crate::analysis::neighbourhood::Orbit;
use crate::fault::Fault;
use crate::mesh::{Lattice, Patch};
use crate::numbers::closed_form::ClosedForm;
use crate::numbers::factor::factors;
use crate::numbers::linear::part;
use crate::numbers::real_root::of_squares;
use crate::numbers::roots::roots;
use crate::numbers::{
    C, C_K, Enclosure, Extension, FIRST_PARAMETER, Field, Free, FreeWorld, N, PerFrequency, Trouble, Univariate,
    chebyshev,
};
use crate::refine::{Count, ExactWeights, Obstacle, Refinement};
use crate::scheme::vocabulary::RuleKind;
use crate::scheme::{Parameter, Place, Scheme};
use std::cell::Cell;
use std::rc::Rc;

/// The valence of the patch that stands for all: larger than any reach, and no number of edges or corners elsewhere.
pub const GENERIC: usize = 101;

/// Which frequencies forms are made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Which {
    /// k = 0 (p = 0), or k = +-p.
    Is(usize),
    /// k = n/2, for even n.
    Half,
    /// All others.
    General,
}

/// A factor of a core's characteristic polynomial.
#[derive(Clone, Debug)]
pub struct Form {
    /// Monic, irreducible if of degree up to 3, in lambda.
    pub polynomial: Univariate<Free>,
    /// How often it divides the block's characteristic polynomial.
    pub multiplicity: usize,
    /// Eigenvectors and Jordan blocks for general n.
    pub structure: Option<Structure>,
    /// The cores that have it.
    pub cores: Vec<usize>,
}

/// The forms of some frequencies.
#[derive(Clone, Debug)]
pub struct FrequencyForms {
    /// The frequencies.
    pub which: Which,
    /// The block.
    pub block: Block<Free>,
    /// Its factors, each once.
    pub forms: Vec<Form>,
}

/// What is known for all valences at once.
#[derive(Clone, Debug)]
pub struct AllValences {
    /// The forms hold for every n from this one on, ...
    pub from: usize,
    /// ... except for the regular valence, where irregular ends have a rule of their own.
    pub except: Option<usize>,
    /// The free parameters.
    pub parameters: Vec<String>,
    /// Their values, approximately: what is called the largest form is so there.
    pub approx_values: Vec<f64>,
    /// The rows.
    pub rows: Rows<Free>,
    /// By frequency: 0, those singled out, n/2, all others.
    pub frequencies: Vec<FrequencyForms>,
    /// The limit mask.
    pub limit_mask: Option<Mask<Free>>,
    /// The factor of the subdominant eigenvalue, in the forms of frequency 1, when one alone is among the largest at all samples; seen in floating numbers, and
    /// proved by [`crate::proof::spectrum::tail`] only.
    pub subdominant: Option<Univariate<Free>>,
    /// The tangent masks, in terms of the subdominant eigenvalue.
    pub tangent_mask: Option<Mask<Extension<Free>>>,
    /// The largest root of frequency 0 after 1 on the smallest invariant neighbourhood, and that of frequency 2.
    pub classical: [Option<Univariate<Free>>; 2],
}

/// Valences at which numbers tell which form is the largest.
const SAMPLES: [usize; 12] = [3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 24, 101];

impl AllValences {
    /// The forms of a scheme. `orbits` are those of the full neighbourhood at [`GENERIC`], `smallest` those of the smallest invariant one.
    ///
    /// # Errors
    /// Why there are none: cases or weights without a formula in n, or too large a form.
    pub fn of(
        scheme: &Scheme,
        lattice: Lattice,
        orbits: &[Orbit],
        smallest: &[usize],
    ) -> Result<AllValences, Obstacle> {
        let parameters: Vec<String> =
            scheme.book.parameters.iter().filter(|p| p.free).map(|p| p.name.clone()).collect();
        let value = |p: &Parameter| scheme.book.evaluate(&p.value, &Place::<f64>::at(None, 0));
        let approx_values = scheme.book.parameters.iter().filter(|p| p.free).map(value).collect::<Result<_, _>>()?;
        let world = FreeWorld { parameters: parameters.clone() };
        let aliases = Rc::new(Cell::new(0));
        let count = Count::Free { n: Free::variable(N), like: GENERIC };
        let weights = ExactWeights::new(&world, count, GENERIC, Rc::clone(&aliases));
        let refinement: Refinement<PerFrequency<Free>> = Refinement::weighed(scheme, weights);
        let rows = Rows::of(&refinement, Patch::new(lattice, GENERIC), orbits)?;
        let settled = first_of_the_same_cases(scheme)?;
        let from = settled.max(aliases.get() + 1).max(3);
        let from_end = scheme.book.all_rules().any(|rule| rule.kind == RuleKind::EdgeFromIrregularEnd);
        let except = (from_end && scheme.regular_valence() >= from).then(|| scheme.regular_valence());
        let mut all = AllValences {
            from,
            except,
            parameters,
            approx_values,
            frequencies: frequencies(&rows)?,
            rows,
            limit_mask: None,
            subdominant: None,
            tangent_mask: None,
            classical: [None, None],
        };
        all.limit_mask = all.limit().ok();
        all.subdominant = all.largest(1, None, &[]);
        all.tangent_mask = all.tangents();
        let one = Univariate::new(vec![Free::whole(-1), Free::whole(1)]);
        all.classical = [all.largest(0, Some(smallest), &[one]), all.largest(2, Some(smallest), &[])];
        Ok(all)
    }

    /// Whether the forms are made for this valence.
    pub fn holds_at(&self, n: usize) -> bool {
        n >= self.from && self.except != Some(n)
    }

    /// The forms of a frequency at a valence.
    pub fn forms_of(&self, n: usize, k: usize) -> Option<&FrequencyForms> {
        let find = |which: Which| self.frequencies.iter().find(|own| own.which == which);
        let half = if 2 * k == n { Which::Half } else { Which::General };
        find(Which::Is(k)).or_else(|| find(half))
    }

    /// The forms that a fixed frequency has for every large n: c_k is T_k(c).
    fn of_frequency(&self, k: usize) -> Option<(&FrequencyForms, [Free; 6])> {
        let find = |which: Which| self.frequencies.iter().find(|own| own.which == which);
        let forms = find(Which::Is(k)).or_else(|| find(Which::General))?;
        let mut values: [Free; 6] = std::array::from_fn(Free::variable);
        values[C_K] = chebyshev(k, &Free::variable(C)).ok()?;
        Some((forms, values))
    }

    /// The polynomial whose roots are the largest of a fixed frequency at every sample, among cores within some orbits.
    fn largest(&self, k: usize, within: Option<&[usize]>, without: &[Univariate<Free>]) -> Option<Univariate<Free>> {
        let (forms, values) = self.of_frequency(k)?;
        let inside = |core: &usize| {
            let unknowns = forms.block.cores[*core].iter();
            let mut orbits = unknowns.flat_map(|unknown| forms.block.unknowns[*unknown].orbits());
            within.is_none_or(|within| orbits.all(|t| within.contains(&t)))
        };
        let candidates: Vec<Univariate<Free>> = forms
            .forms
            .iter()
            .filter(|form| form.cores.iter().any(inside) && !without.contains(&form.polynomial))
            .filter_map(|form| at(&form.polynomial, &values).ok())
            .collect();
        // at a single n another form may be as large
        let mut largest: Vec<usize> = (0..candidates.len()).collect();
        for n in SAMPLES.into_iter().filter(|n| self.holds_at(*n) && *n > 2 * k) {
            let moduli: Vec<f64> = candidates.iter().map(|form| self.sample(form, n)).collect::<Option<_>>()?;
            let top = moduli.iter().copied().fold(0.0, f64::max);
            largest.retain(|index| top - moduli[*index] < 1e-9);
        }
        let [only] = largest.as_slice() else { return None };
        candidates.into_iter().nth(*only)
    }

    /// The largest modulus of a form's roots at a valence and the parameters' values.
    fn sample(&self, form: &Univariate<Free>, n: usize) -> Option<f64> {
        let values = self.sample_values(n);
        let enclosed = |value: &Free| Enclosure::<128>::from_f64(value.evaluate(&values).ok()?).ok();
        let coefficients: Option<Vec<Enclosure<128>>> = form.coefficients().iter().map(enclosed).collect();
        let found = roots(&coefficients?).ok()?;
        let modulus = found.iter().filter_map(|root| Some(root.modulus_squared().ok()?.midpoint_f64().sqrt()));
        modulus.max_by(f64::total_cmp)
    }

    /// Whether the root of an irreducible factor is lambda^2, as an identity; `None` where that is not told by factors alone.
    pub fn is_square_of_subdominant(&self, factor: &Univariate<Free>) -> Option<bool> {
        let squares = of_squares(self.subdominant.as_ref()?).ok()?;
        let common = squares.gcd(factor).ok()?;
        match common.degree()? {
            0 => Some(false),
            degree => (Some(degree) == factor.degree()).then_some(true),
        }
    }

    /// An element of the field of lambda, the larger root of its factor, in words.
    pub fn extension_in_words(&self, value: &Extension<Free>, factor: &Univariate<Free>) -> Option<Words> {
        let constant = |value: &Free| Some(free_in_words(value, &self.parameters));
        match (value.value().coefficients(), ClosedForm::of(factor)?.as_slice()) {
            ([], _) => constant(&Free::whole(0)),
            ([own], _) => constant(own),
            ([own, slope], [ClosedForm::Root { mean, scale, radicand, .. }, _]) if self.is_positive(scale) => {
                let mean = slope.times(mean).and_then(|part| part.plus(own)).ok()?;
                let scale = slope.times(scale).ok()?;
                let form = ClosedForm::Root { mean, scale, radicand: radicand.clone(), positive: true };
                Some(form_in_words(&form, &self.parameters))
            }
            _ => None,
        }
    }

    /// The indeterminates at a valence, with the parameters' values; the frequency is 2.
    fn sample_values(&self, n: usize) -> Vec<f64> {
        let turn = std::f64::consts::TAU / n as f64;
        indeterminates(n, libm::cos(turn), libm::cos(2.0 * turn), &self.approx_values)
    }

    /// The subdominant form, where it is one closed form.
    pub fn subdominant_in_words(&self) -> Option<Words> {
        match ClosedForm::of(self.subdominant.as_ref()?)?.as_slice() {
            [form] => Some(form_in_words(form, &self.parameters)),
            [plus @ ClosedForm::Root { scale, .. }, _] if self.is_positive(scale) => {
                Some(form_in_words(plus, &self.parameters))
            }
            _ => None,
        }
    }

    /// Whether a function of n is positive at all samples.
    fn is_positive(&self, value: &Free) -> bool {
        let at = |n: &usize| value.evaluate(&self.sample_values(*n));
        SAMPLES.iter().filter(|n| self.holds_at(**n)).all(|n| at(n).is_ok_and(|value| value > 0.0))
    }

    fn limit(&self) -> Result<Mask<Free>, Trouble> {
        let forms = self.frequencies.iter().find(|own| own.which == Which::Is(0)).ok_or(NO_CORE)?;
        let one = Univariate::new(vec![Free::whole(-1), Free::whole(1)]);
        let form = forms.forms.iter().find(|form| form.polynomial == one && form.multiplicity == 1).ok_or(NO_CORE)?;
        let core = &forms.block.cores[*form.cores.first().ok_or(NO_CORE)?];
        limit_mask(&self.rows, &forms.block, core, &Free::variable(N))
    }

    fn tangents(&self) -> Option<Mask<Extension<Free>>> {
        let subdominant = self.subdominant.as_ref()?;
        let (forms, values) = self.of_frequency(1)?;
        let own = |form: &&Form| at(&form.polynomial, &values).is_ok_and(|polynomial| polynomial == *subdominant);
        let form = forms.forms.iter().find(own).filter(|form| form.multiplicity == 1)?;
        let block = match forms.which {
            Which::Is(1) => forms.block.clone(),
            _ => Block::of(&self.rows, None, Wave::Cosine(Free::variable(C))).ok()?,
        };
        let core = &forms.block.cores[*form.cores.first()?];
        if subdominant.degree() > Some(1) && block.below(core).len() > MOST_UNKNOWNS {
            return None;
        }
        let lambda = Extension::root(subdominant).ok()?;
        tangent_mask(&self.rows, &block, core, &lambda, |value| Extension::constant(value.clone())).ok()
    }
}

/// The most unknowns that a tangent mask for all n is eliminated from where lambda is not rational in n and c: more give forms that nobody
/// reads, after a minute (midpoint schemes of degree 7 and 8).
const MOST_UNKNOWNS: usize = 6;

const NO_CORE: Trouble = Trouble::BeyondThisWorld("the eigenvalue 1 is not simple in frequency 0");

/// A polynomial with other values for the indeterminates.
///
/// # Errors
/// When a denominator vanishes, or a limit of size is passed.
pub fn at<F: Field>(polynomial: &Univariate<Free>, values: &[F]) -> Result<Univariate<F>, Trouble> {
    let coefficients = polynomial.coefficients().iter().map(|value| value.evaluate(values));
    Ok(Univariate::new(coefficients.collect::<Result<_, _>>()?))
}

/// The least valence from which on every case is that of [`GENERIC`].
fn first_of_the_same_cases(scheme: &Scheme) -> Result<usize, Obstacle> {
    let inexact = |message: &str| Obstacle::Inexact(Fault::whole(message));
    let mentions = |name: &str| scheme.book.parameters.iter().any(|p| p.free && p.name == name);
    if scheme.book.condition_names().iter().any(|name| mentions(name)) {
        return Err(inexact("a condition depends on a parameter that is left free"));
    }
    let settled =
        scheme.book.settled_from_n().ok_or_else(|| inexact("the cases are not comparisons of n with numbers"))?;
    if settled > GENERIC as i64 {
        return Err(inexact("the cases change beyond n = 101"));
    }
    let last = scheme.book.cases_at(GENERIC as i64)?;
    let mut from = (settled.max(3)) as usize;
    while from > 3 && scheme.book.cases_at(from as i64 - 1).is_ok_and(|cases| cases == last) {
        from -= 1;
    }
    Ok(from)
}

/// The blocks of every kind of frequency with their forms.
fn frequencies(rows: &Rows<Free>) -> Result<Vec<FrequencyForms>, Obstacle> {
    let mut kinds = vec![(Which::Is(0), Wave::One)];
    for p in rows.frequencies().into_iter().filter(|p| *p > 0) {
        kinds.push((Which::Is(p), Wave::Cosine(chebyshev(p, &Free::variable(C))?)));
    }
    kinds.extend([(Which::Half, Wave::MinusOne), (Which::General, Wave::Cosine(Free::variable(C_K)))]);
    kinds.into_iter().map(|(which, wave)| Ok(frequency(rows, which, wave)?)).collect()
}

fn frequency(rows: &Rows<Free>, which: Which, wave: Wave<Free>) -> Result<FrequencyForms, Trouble> {
    let p = if let Which::Is(p) = which { Some(p) } else { None };
    let block = Block::of(rows, p, wave)?;
    let mut forms: Vec<Form> = Vec::new();
    for (core, unknowns) in block.cores.iter().enumerate() {
        for (polynomial, multiplicity) in factors(&Univariate::characteristic(&part(&block.matrix, unknowns))?)? {
            match forms.iter_mut().find(|form| form.polynomial == polynomial) {
                Some(form) => {
                    form.multiplicity += multiplicity;
                    form.cores.push(core);
                }
                None => forms.push(Form { polynomial, multiplicity, structure: None, cores: vec![core] }),
            }
        }
    }
    for form in &mut forms {
        form.structure = match form.multiplicity {
            1 => Some(Structure { geometric: 1, largest: 1 }),
            multiplicity => match structure(&block, &form.cores, &form.polynomial, multiplicity) {
                Ok(Answer::Structure(found)) => Some(found),
                _ => None,
            },
        };
    }
    Ok(FrequencyForms { which, block, forms })
}

/// The values of the indeterminates at a valence and a frequency.
pub fn indeterminates<F: Field>(n: usize, c: F, c_k: F, parameters: &[F]) -> Vec<F> {
    let mut values = vec![F::whole(0); 6];
    (values[N], values[C], values[C_K]) = (F::whole(n as i64), c, c_k);
    for (index, value) in parameters.iter().enumerate() {
        values[FIRST_PARAMETER + index] = value.clone();
    }
    values
}
