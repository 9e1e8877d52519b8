//! What does the report say of every valence at once?
//!
//! Closed forms of eigenvalues and masks, as text in the scheme language and in LaTeX, where c = cos(2 pi/n) and
//! c_k = cos(2 pi k/n).

use crate::analysis::exact::formulas::{AllValences, Form, FrequencyForms, Which};
use crate::analysis::exact::words::{Words, factor_in_words, free_in_words};
use crate::numbers::{Extension, Field, Free};
use crate::refine::OrbitNames;
use serde::Serialize;

/// What holds for every n.
#[derive(Clone, Debug, Serialize)]
pub struct AllValencesReport {
    /// The forms hold for every n from this one on ...
    pub from: usize,
    /// ... but not for this one.
    pub except: Option<usize>,
    /// The number of points of the full neighbourhood: those that don't depend on n, and those for each of the n sectors.
    pub size: [usize; 2],
    /// Eigenvalues by frequency.
    pub frequencies: Vec<FrequencyReport>,
    /// The subdominant eigenvalue, where one form is the largest of frequency 1 at all valences tried.
    pub subdominant: Option<Formula>,
    /// What is equal for every n.
    pub identities: Vec<Identity>,
    /// The limit mask.
    pub limit_mask: Option<Vec<WeightFormula>>,
    /// The tangent masks: own cos(2 pi s/n) + next cos(2 pi (s+1)/n) in sector s.
    pub tangent_forms: Option<Vec<TangentFormula>>,
}

/// A closed form.
#[derive(Clone, Debug, Serialize)]
pub struct Formula {
    /// In the scheme language; `k` is the frequency.
    pub formula: String,
    /// In LaTeX.
    pub latex: String,
}

impl From<Words> for Formula {
    fn from(words: Words) -> Formula {
        Formula { formula: words.text, latex: words.latex }
    }
}

/// The eigenvalues of some frequencies.
#[derive(Clone, Debug, Serialize)]
pub struct FrequencyReport {
    /// `0`, `1`, `2`, ... (and n-k), `n/2`, or `other`.
    pub k: String,
    /// The eigenvalues, core by core.
    pub eigenvalues: Vec<EigenvalueFormula>,
}

/// An eigenvalue, or the roots of a polynomial without a closed form.
#[derive(Clone, Debug, Serialize)]
pub struct EigenvalueFormula {
    /// Its form.
    #[serde(flatten)]
    pub form: Formula,
    /// Its multiplicity in the block.
    pub algebraic: usize,
    /// The dimension of its eigenspace in the block, for general n.
    pub geometric: Option<usize>,
    /// The size of its largest Jordan block, for general n.
    pub jordan: Option<usize>,
}

/// A condition that is an identity in n.
#[derive(Clone, Debug, Serialize)]
pub struct Identity {
    /// What it is about.
    pub claim: &'static str,
    /// What is equal, or not.
    pub states: String,
    /// Whether it holds for every n, as an identity; false: the two sides are different functions of n.
    pub holds: bool,
}

/// A weight of the limit mask.
#[derive(Clone, Debug, Serialize)]
pub struct WeightFormula {
    /// The position.
    pub at: String,
    /// The weight of each of its points.
    #[serde(flatten)]
    pub form: Formula,
}

/// Weights of the tangent masks.
#[derive(Clone, Debug, Serialize)]
pub struct TangentFormula {
    /// The position.
    pub at: String,
    /// What multiplies cos(2 pi s/n).
    pub own: Formula,
    /// What multiplies cos(2 pi (s+1)/n).
    pub next: Formula,
}

/// The report of the forms of a scheme.
pub(super) fn all_valences(all: &AllValences, names: &OrbitNames) -> AllValencesReport {
    let subdominant = all.subdominant_in_words();
    AllValencesReport {
        from: all.from,
        except: all.except,
        size: [usize::from(all.rows.centre.is_some()), all.rows.orbits.len()],
        frequencies: all.frequencies.iter().map(|own| frequency(own, all)).collect(),
        subdominant: subdominant.map(Formula::from),
        identities: identities(all),
        limit_mask: limit_mask(all, names),
        tangent_forms: tangent_forms(all, names),
    }
}

fn frequency(own: &FrequencyForms, all: &AllValences) -> FrequencyReport {
    let k = match own.which {
        Which::Is(p) => p.to_string(),
        Which::Half => "n/2".to_string(),
        Which::General => "other".to_string(),
    };
    FrequencyReport { k, eigenvalues: own.forms.iter().flat_map(|form| eigenvalues(form, all)).collect() }
}

fn eigenvalues(form: &Form, all: &AllValences) -> Vec<EigenvalueFormula> {
    let report = |words: Words| EigenvalueFormula {
        form: words.into(),
        algebraic: form.multiplicity,
        geometric: form.structure.map(|structure| structure.geometric),
        jordan: form.structure.map(|structure| structure.largest),
    };
    factor_in_words(&form.polynomial, &all.parameters).into_iter().map(report).collect()
}

fn identities(all: &AllValences) -> Vec<Identity> {
    let state = |(claim, of, k, least): (&'static str, usize, usize, usize)| {
        let holds = all.is_square_of_subdominant(all.classical[of].as_ref()?)?;
        let value = factor_in_words(all.classical[of].as_ref()?, &all.parameters).into_iter().next()?;
        let equal = if holds { "is lambda^2" } else { "is not lambda^2, as a function of n," };
        let states =
            format!("{}, the largest of frequency {k}, {equal} for every n >= {}", value.text, all.from.max(least));
        let states = if holds { format!("{states}: the ratio is exactly 1") } else { states };
        Some(Identity { claim, states, holds })
    };
    [("cup ratio", 0, 0, 3), ("saddle ratio", 1, 2, 5)].into_iter().filter_map(state).collect()
}

fn limit_mask(all: &AllValences, names: &OrbitNames) -> Option<Vec<WeightFormula>> {
    let mask = all.limit_mask.as_ref()?;
    let weight = |at: String, value: &Free| WeightFormula { at, form: free_in_words(value, &all.parameters).into() };
    let centre = mask.centre.iter().map(|value| weight("centre".to_string(), value));
    let orbits = all.rows.orbits.iter().zip(&mask.orbits);
    let others = orbits
        .filter(|(_, (own, _))| !own.is_certainly_zero())
        .map(|(orbit, (own, _))| weight(names.name(*orbit), own));
    Some(centre.chain(others).collect())
}

fn tangent_forms(all: &AllValences, names: &OrbitNames) -> Option<Vec<TangentFormula>> {
    let (mask, factor) = (all.tangent_mask.as_ref()?, all.subdominant.as_ref()?);
    let form = |value: &Extension<Free>| all.extension_in_words(value, factor).map(Formula::from);
    let mut forms = Vec::new();
    for (orbit, (own, next)) in all.rows.orbits.iter().zip(&mask.orbits) {
        let zero = |value: &Extension<Free>| value.value().is_zero();
        if !(zero(own) && zero(next)) {
            forms.push(TangentFormula { at: names.name(*orbit), own: form(own)?, next: form(next)? });
        }
    }
    Some(forms)
}
