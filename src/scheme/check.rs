//! Are the weights of a scheme sound: do they sum to 1, are its cases disjoint and covering, do its formulas have values?
//!
//! That the weights of a rule sum to 1 is shown as an identity in n where the formula allows ([`Laurent`]); else the sum is
//! compared with 1 in `f64`, at the valences asked for.

use super::evaluate::Place;
use super::formula::{Condition, Formula};
use super::vocabulary::RuleKind;
use super::{Entry, MOST_PASSES, Parameter, Pass, Rule, RuleBook, Scheme, Weights};
use crate::fault::{Fault, Faults};
use crate::numbers::{Field, Laurent, RingSize, sum};
use std::collections::BTreeSet;
use std::ops::Range;

/// How far an approximate sum may be from 1, relative to the sum of the weights' moduli.
pub const SUM_TOLERANCE: f64 = 1e-12;

/// The largest sum of the moduli of a rule's weights: beyond it nothing is left of the digits of a sum of 1.
const MAX_MODULI: f64 = 1e6;

/// How the message of a wrong sum ends.
const NOT_ONE: &str = ", not to 1";

/// Beyond this count cases are not followed one by one.
const MOST_CASES: i64 = 1000;

/// The largest count at which cases are tried beyond those asked for, when conditions are not comparisons of n with numbers.
const TRIED_UP_TO: i64 = 64;

/// What is known of the sum of a rule's weights.
#[derive(Clone, Debug, PartialEq)]
pub struct RuleSum {
    /// The rule.
    pub kind: RuleKind,
    /// Whether the sum is shown to be 1 for every valence.
    pub identity: bool,
    /// The largest distance from 1 seen at the valences asked for, approximately.
    pub approx_deviation: f64,
}

impl Scheme {
    /// Checks the scheme at the valences asked for.
    ///
    /// # Errors
    /// Every fault found: sums other than 1, cases that overlap or leave a valence out, parameters out of range, formulas
    /// without a value.
    pub fn check(&self, valences: &[usize]) -> Result<Vec<RuleSum>, Faults> {
        self.book.check(valences, self.regular_valence())
    }
}

impl RuleBook {
    /// Checks the rules at the counts asked for: valences, or numbers of faces at a boundary.
    ///
    /// # Errors
    /// As [`Scheme::check`].
    pub fn check(&self, counts: &[usize], regular: usize) -> Result<Vec<RuleSum>, Faults> {
        let mut faults: Vec<Fault> = self.parameter_faults();
        faults.extend(self.passes.iter().filter_map(|pass| self.check_repeat(pass).err()));
        let mut sums = self.like.as_ref().map_or(Ok(Vec::new()), |like| like.check(counts, regular))?;
        sums.retain(|sum| !self.rules.contains_key(&sum.kind));
        if faults.is_empty() {
            for rule in self.all_rules() {
                let cases = self.check_cases(rule, counts, regular);
                let broken = !cases.is_empty();
                faults.extend(cases);
                if !broken {
                    match self.check_sum(rule, counts, regular) {
                        Ok(sum) => sums.push(sum),
                        Err(fault) => faults.push(fault),
                    }
                    faults.extend(self.check_both_sides(rule, counts).err());
                }
            }
        }
        if faults.is_empty() {
            faults.extend(self.flatness_faults(counts));
            faults.extend(self.check_elsewhere(counts, regular));
        }
        let mut seen = BTreeSet::new();
        faults.retain(|fault| seen.insert((fault.span.clone().map(|s| (s.start, s.end)), fault.message.clone())));
        if faults.is_empty() { Ok(sums) } else { Err(self.faults(faults)) }
    }

    /// The weights sum to 1 at other values of the parameters, too: a scheme file is sound for all of them.
    fn check_elsewhere(&self, counts: &[usize], regular: usize) -> Option<Fault> {
        let mut elsewhere = self.clone();
        let mut moved = Vec::new();
        for parameter in elsewhere.parameters.iter_mut().filter(|parameter| !parameter.integer) {
            let Some(probe) = self.other_value(parameter) else { continue };
            let Ok(formula) = Formula::parse(&format!("{probe}")) else { continue };
            parameter.value.formula = formula;
            moved.push(format!("{} = {probe}", parameter.name));
        }
        if moved.is_empty() {
            return None;
        }
        // a formula may have no value elsewhere; only a wrong sum is a fault
        let wrong = |rule: &Rule| {
            let fault = elsewhere.check_sum(rule, counts, regular).err()?;
            fault.message.ends_with(NOT_ONE).then_some(fault)
        };
        let mut fault = elsewhere.all_rules().find_map(wrong)?;
        fault.message = format!("with {}, {}", moved.join(", "), fault.message);
        Some(fault.hint("the weights must sum to 1 whatever the values of the parameters"))
    }

    /// A value of a parameter other than its own, inside its range.
    fn other_value(&self, parameter: &Parameter) -> Option<f64> {
        let nowhere = Place::<f64>::at(None, 0);
        let value = self.evaluate(&parameter.value, &nowhere).ok()?;
        let Some((low, high)) = &parameter.range else { return Some(value + 0.125) };
        let (low, high) = (self.evaluate(low, &nowhere).ok()?, self.evaluate(high, &nowhere).ok()?);
        let end = if high - value > value - low { high } else { low };
        Some(value + (end - value) * 0.375)
    }

    /// A crease looks the same from both of its sides, and an edge from both of its own: `ring[i]` and `ring[k-i]`, or `ring[-1]` and
    /// `ring[1]`, weigh the same.
    fn check_both_sides(&self, rule: &Rule, counts: &[usize]) -> Result<(), Fault> {
        let from_end = RuleKind::FROM_ENDS.contains(&rule.kind);
        if rule.kind != RuleKind::VertexCrease && !from_end {
            return Ok(());
        }
        for count in counts.iter().map(|count| *count as i64).filter(|count| *count >= least_count(rule.kind)) {
            let place = Place::<f64>::at(rule.kind.variable(), count);
            let names: BTreeSet<&str> = rule.entries.iter().map(|entry| entry.position.name.as_str()).collect();
            for name in names {
                let own = rule.entries.iter().filter(|entry| entry.position.name == name && !entry.position.once);
                let mut weights = vec![0.0; own.clone().map(|e| class_size(e, rule.kind, count)).max().unwrap_or(0)];
                let faces = own.clone().any(|entry| entry.position.births() == Some(RuleKind::Face));
                for entry in own {
                    for (index, weight) in self.weights(entry, weights.len(), &place)? {
                        weights[index] += weight;
                    }
                }
                let size = weights.len();
                // points from one sharp edge to the other; edges around an end; the faces between these
                let image = |at: usize| match () {
                    () if from_end && !faces => (size - at) % size,
                    () => size - 1 - at,
                };
                if (0..size).any(|at| (weights[at] - weights[image(at)]).abs() > SUM_TOLERANCE) {
                    let at = rule.kind.variable().map_or(String::new(), |name| format!("at {name} = {count}"));
                    let fault =
                        Fault::at(rule.span.clone(), format!("[{}] tells left from right", rule.kind.name()), at);
                    let hint = if from_end {
                        "ring[-1] and ring[1] weigh the same, and so do new faces[-1] and [0]"
                    } else {
                        "ring[0] and ring[k] weigh the same"
                    };
                    return Err(fault.hint(hint));
                }
            }
        }
        Ok(())
    }

    /// How often a pass is made; 0 where that is no whole number.
    pub(crate) fn repeats(&self, pass: &Pass) -> usize {
        let value = |placed| self.evaluate(placed, &Place::<f64>::at(None, 0)).unwrap_or(0.0);
        pass.repeat.as_ref().map_or(1, |placed| value(placed) as usize)
    }

    fn check_repeat(&self, pass: &Pass) -> Result<(), Fault> {
        let Some(placed) = &pass.repeat else { return Ok(()) };
        let value = self.evaluate(placed, &Place::<f64>::at(None, 0))?;
        if value.fract() == 0.0 && (0.0..=MOST_PASSES as f64).contains(&value) {
            return Ok(());
        }
        let message = format!("a pass is made a whole number of times, 0 to {MOST_PASSES}, not {value}");
        Err(Fault::at(placed.span.clone(), message, "repeated so often"))
    }

    /// What is wrong with the values of parameters.
    pub(super) fn parameter_faults(&self) -> Vec<Fault> {
        self.parameters.iter().filter_map(|p| self.check_parameter(p).err()).collect()
    }

    fn check_parameter(&self, parameter: &Parameter) -> Result<(), Fault> {
        let nowhere = Place::<f64>::at(None, 0);
        let value = self.evaluate(&parameter.value, &nowhere)?;
        let span = || parameter.value.span.clone();
        if parameter.integer && value.fract() != 0.0 {
            return Err(Fault::at(span(), format!("`{}` must be a whole number, not {value}", parameter.name), ""));
        }
        let Some((low, high)) = &parameter.range else { return Ok(()) };
        let (least, greatest) = (self.evaluate(low, &nowhere)?, self.evaluate(high, &nowhere)?);
        if least > greatest {
            return Err(Fault::at(low.span.clone(), format!("the range {least} to {greatest} runs backwards"), ""));
        }
        if value < least || value > greatest {
            let (low, high) = (low.formula.text().trim(), high.formula.text().trim());
            let message = format!("`{}` = {} is outside its range", parameter.name, parameter.value.formula.text());
            return Err(Fault::at(span(), message, format!("the range is {low} to {high}")));
        }
        Ok(())
    }

    /// The conditions that decide a rule's weights, through names as well, each list with its place.
    fn case_lists<'a>(&'a self, rule: &'a Rule) -> Vec<Vec<(&'a Condition, &'a Range<usize>)>> {
        let mut names: BTreeSet<&str> = BTreeSet::new();
        for entry in &rule.entries {
            names.extend(entry_formulas(entry).flat_map(|placed| placed.formula.names()).map(|(name, _)| name));
        }
        for _ in 0..self.lets.len() {
            for own in self.lets.iter().filter(|own| names.contains(own.name.as_str())).collect::<Vec<_>>() {
                names.extend(own.value.values().iter().flat_map(|placed| placed.formula.names()).map(|(name, _)| name));
            }
        }
        let entries = rule.entries.iter().map(|entry| entry.weights.conditions());
        let lets = self.lets.iter().filter(|own| names.contains(own.name.as_str())).map(|own| own.value.conditions());
        entries.chain(lets).filter(|list| !list.is_empty()).collect()
    }

    /// The count from which on none of the rule's conditions changes, if each compares n with a number.
    fn settled_from(&self, rule: &Rule) -> Option<i64> {
        let lists = self.case_lists(rule);
        lists.iter().flatten().map(|(condition, _)| condition.settled_from()).try_fold(0, |a, b| Some(a.max(b?)))
    }

    /// The names that conditions mention.
    pub fn condition_names(&self) -> BTreeSet<String> {
        let lists = self.all_rules().flat_map(|rule| self.case_lists(rule)).flatten();
        lists.flat_map(|(condition, _)| condition.names()).map(|(name, _)| name.to_string()).collect()
    }

    /// The count from which on no condition of a rule in n changes, if each compares n with a number.
    pub fn settled_from_n(&self) -> Option<i64> {
        let told = self.all_rules().filter(|rule| rule.kind.variable() == Some("n"));
        told.map(|rule| self.settled_from(rule)).try_fold(0, |a, b| Some(a.max(b?)))
    }

    /// Which case holds at a count, for each table of cases of the rules in n.
    ///
    /// # Errors
    /// When a condition has no value.
    pub fn cases_at(&self, count: i64) -> Result<Vec<Option<usize>>, Fault> {
        let told = self.all_rules().filter(|rule| rule.kind.variable() == Some("n"));
        let mut cases = Vec::new();
        for list in told.flat_map(|rule| self.case_lists(rule)) {
            let mut holding = None;
            for (index, (condition, span)) in list.iter().enumerate() {
                if self.holds(condition, span, Some("n"), count)? {
                    holding = Some(index);
                }
            }
            cases.push(holding);
        }
        Ok(cases)
    }

    /// Exactly one case holds at every count that the rule is applied at.
    fn check_cases(&self, rule: &Rule, counts: &[usize], regular: usize) -> Vec<Fault> {
        let lists = self.case_lists(rule);
        if lists.is_empty() {
            return Vec::new();
        }
        let Some(variable) = rule.kind.variable() else {
            let span = lists[0][0].1.clone();
            let message = format!("[{}] is told from no vertex, so it can't have cases in n", rule.kind.name());
            return vec![Fault::at(span, message, "a case")];
        };
        let last = self.settled_from(rule).map_or(TRIED_UP_TO, |settled| settled.min(MOST_CASES));
        let all = (least_count(rule.kind)..=last.max(least_count(rule.kind))).chain(counts.iter().map(|n| *n as i64));
        let tried: BTreeSet<i64> = all.filter(|count| self.is_told_at(rule.kind, *count, regular)).collect();
        lists.iter().flat_map(|list| self.check_case_list(list, variable, &tried)).collect()
    }

    fn check_case_list(
        &self,
        list: &[(&Condition, &Range<usize>)],
        variable: &'static str,
        tried: &BTreeSet<i64>,
    ) -> Option<Fault> {
        for count in tried {
            let mut holding = Vec::new();
            for (condition, span) in list {
                match self.holds(condition, span, Some(variable), *count) {
                    Ok(true) => holding.push((condition, span)),
                    Ok(false) => {}
                    Err(fault) => return Some(fault),
                }
            }
            let at = format!("{variable} = {count}");
            match holding.as_slice() {
                [_] => {}
                [] => {
                    let fault =
                        Fault::at(list[0].1.clone(), format!("no case holds at {at}"), "the first of the cases");
                    return Some(fault.hint(format!("add a case that holds at {at}")));
                }
                [(first, _), (_, span), ..] => {
                    let message = format!("two cases hold at {at}");
                    return Some(Fault::at((**span).clone(), message, format!("so does `{}`", first.text())));
                }
            }
        }
        None
    }

    fn check_sum(&self, rule: &Rule, counts: &[usize], regular: usize) -> Result<RuleSum, Fault> {
        let identity = self.sums_to_one_for_every_n(rule, regular) == Some(true);
        let counts: Vec<i64> = match rule.kind.variable() {
            None => vec![0],
            Some(_) => counts.iter().map(|count| *count as i64).chain([regular as i64]).collect(),
        };
        let mut worst: f64 = 0.0;
        for count in counts.into_iter().filter(|count| self.is_told_at(rule.kind, *count, regular)) {
            let (sum, moduli) = self.approx_sum(rule, count)?;
            if moduli > MAX_MODULI {
                let message =
                    format!("the weights of [{}] are too large: their moduli sum to {moduli:e}", rule.kind.name());
                return Err(Fault::at(rule.span.clone(), message, format!("the limit is {MAX_MODULI:e}")));
            }
            worst = worst.max((sum - 1.0).abs());
            if (sum - 1.0).abs() > SUM_TOLERANCE * moduli.max(1.0) {
                return Err(self.wrong_sum(rule, count, sum));
            }
        }
        Ok(RuleSum { kind: rule.kind, identity, approx_deviation: worst })
    }

    fn wrong_sum(&self, rule: &Rule, count: i64, sum: f64) -> Fault {
        let at = rule.kind.variable().map_or(String::new(), |name| format!(" at {name} = {count}"));
        let shown = format!("{sum:.12}");
        let shown = shown.trim_end_matches('0').trim_end_matches('.');
        let shown = if shown == "1" { format!("{sum}") } else { shown.to_string() };
        let message = format!("the weights of [{}] sum to {shown}{at}{NOT_ONE}", rule.kind.name());
        let terms: Vec<String> = rule.entries.iter().map(|entry| points_in_words(entry, rule.kind)).collect();
        let fault = Fault::at(rule.span.clone(), message, "this rule");
        fault.hint(format!("a weight is that of each point of its name: {}", terms.join(", ")))
    }

    fn approx_sum(&self, rule: &Rule, count: i64) -> Result<(f64, f64), Fault> {
        let place = Place::<f64>::at(rule.kind.variable(), count);
        let mut weights = Vec::new();
        for entry in &rule.entries {
            let own = self.weights(entry, class_size(entry, rule.kind, count), &place)?;
            weights.extend(own.into_iter().map(|(_, weight)| weight));
        }
        Ok((sum(weights.iter().copied()), sum(weights.iter().map(|weight| weight.abs()))))
    }

    /// Whether the sum is 1 for every n from 3 on, as an identity; `None` where that can't be shown this way.
    fn sums_to_one_for_every_n(&self, rule: &Rule, regular: usize) -> Option<bool> {
        let least = least_count(rule.kind);
        if rule.kind.variable().is_none() {
            return Some(self.exact_sum(rule, RingSize::Exactly(0))? == Laurent::whole(1));
        }
        // conditions that compare n with numbers, and only those, are decided exactly
        let settled = self.settled_from(rule).filter(|settled| *settled <= MOST_CASES)?.max(least);
        let one = |n: i64| self.exact_sum(rule, RingSize::Exactly(n)) == Some(Laurent::whole(1));
        if let (RuleKind::Face, Some(corners)) = (rule.kind, self.face_corners) {
            return Some(one(corners));
        }
        let told = |n: &i64| self.is_told_at(rule.kind, *n, regular);
        // waves of frequency p alias at n <= p: try the tail from a little later on, and those n one by one
        let tail =
            (settled..settled + 8).find(|n| self.exact_sum(rule, RingSize::From(*n)) == Some(Laurent::whole(1)))?;
        Some((least..tail).filter(told).all(one))
    }

    /// Whether a rule is ever applied where its count is this.
    fn is_told_at(&self, kind: RuleKind, count: i64, regular: usize) -> bool {
        let regular = regular as i64;
        match kind {
            RuleKind::EdgeFromIrregularEnd => count >= least_count(kind) && count != regular,
            RuleKind::Face if self.face_corners.is_some() => self.face_corners == Some(count),
            _ => count >= least_count(kind),
        }
    }

    fn exact_sum(&self, rule: &Rule, size: RingSize) -> Option<Laurent> {
        let (count, value) = match size {
            RingSize::From(n) => (n, Laurent::atom(rule.kind.variable()?)),
            RingSize::Exactly(n) => (n, Laurent::whole(n)),
        };
        let place = Place { variable: rule.kind.variable(), count, value, index: Laurent::whole(0) };
        let sums = rule.entries.iter().map(|entry| self.exact_entry_sum(entry, rule.kind, &place, size));
        sums.into_iter().try_fold(Laurent::whole(0), |sum, term| sum.plus(&term?).ok())
    }

    fn exact_entry_sum(
        &self,
        entry: &Entry,
        kind: RuleKind,
        place: &Place<Laurent>,
        size: RingSize,
    ) -> Option<Laurent> {
        let weights = self.select(&entry.weights, place).ok()?;
        let counts_nothing = entry.position.once || !kind.grows();
        if counts_nothing || matches!(size, RingSize::Exactly(_)) && entry.picks.is_some() {
            return self.sum_of_points(entry, kind, place);
        }
        // here n (or k) may be free: no weight may see the number of points that happens to be at hand
        match (weights, &entry.picks) {
            (Weights::Each(placed), None) if kind.variable() == Some("n") && entry.position.walks.len() == 1 => {
                let at = Place { index: Laurent::atom("j"), ..place.clone() };
                self.evaluate(placed, &at).ok()?.sum_over_ring(size)
            }
            (Weights::Each(placed), None) if kind.variable() == Some("k") && !self.uses_index(&placed.formula) => {
                let points = place.value.plus(&Laurent::whole(1)).ok()?;
                self.evaluate(placed, place).ok()?.times(&points).ok()
            }
            (Weights::Each(placed), Some(picks)) if !self.uses_index(&placed.formula) => {
                self.evaluate(placed, place).ok()?.times(&Laurent::whole(picks.len() as i64)).ok()
            }
            _ if matches!(size, RingSize::Exactly(_)) => self.sum_of_points(entry, kind, place),
            _ => None,
        }
    }

    /// The sum over the points of a class whose number is known.
    fn sum_of_points(&self, entry: &Entry, kind: RuleKind, place: &Place<Laurent>) -> Option<Laurent> {
        let weights = self.weights(entry, class_size(entry, kind, place.count), place).ok()?;
        weights.iter().try_fold(Laurent::whole(0), |sum, (_, weight)| sum.plus(weight)).ok()
    }
}

/// The least count that a rule is applied at; 0 for rules that count nothing.
fn least_count(kind: RuleKind) -> i64 {
    match (kind, kind.variable()) {
        (_, None) => 0,
        // an edge inside the mesh between two sharp ones
        (RuleKind::EdgeFromCreaseEnd | RuleKind::EdgeFromCornerEnd, _) => 2,
        (_, Some("k")) => 1,
        _ => 3,
    }
}

/// How many points a class has where the rule's count is `count`.
pub(crate) fn class_size(entry: &Entry, kind: RuleKind, count: i64) -> usize {
    let starts = if entry.position.once { 1 } else { kind.starts(count) };
    starts.max(0) as usize * entry.position.walks.len()
}

fn entry_formulas(entry: &Entry) -> impl Iterator<Item = &super::Placed> {
    entry.weights.values().into_iter().flat_map(|weights| match weights {
        Weights::Each(placed) => vec![placed],
        Weights::List(list, _) => list.iter().collect(),
    })
}

fn points_in_words(entry: &Entry, kind: RuleKind) -> String {
    let name = &entry.position.name;
    match (&entry.picks, kind) {
        (Some(picks), _) => format!("{} x {name}", picks.len()),
        _ if entry.position.once => name.clone(),
        _ if !kind.grows() => format!("{} x {name}", class_size(entry, kind, 0)),
        (_, RuleKind::VertexCrease) => format!("(k+1) x {name}"),
        _ => format!("n x {name}"),
    }
}

#[cfg(test)]
mod tests {
    use crate::scheme::catalogue;

    #[test]
    fn sums_of_the_catalogue_are_identities() {
        for listed in catalogue::SCHEMES {
            let scheme = catalogue::open(listed.id).unwrap().unwrap();
            let sums = scheme.check(&[3, 4, 5, 6, 7, 12]).unwrap_or_else(|faults| panic!("{faults}"));
            assert_eq!(sums.len(), scheme.book.all_rules().count());
            for sum in sums {
                assert!(sum.identity, "{}: [{}]", listed.id, sum.kind.name());
                assert!(sum.approx_deviation < 1e-14);
            }
        }
    }
}
