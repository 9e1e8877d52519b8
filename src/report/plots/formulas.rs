//! What is written beside a point of a stencil, and what has to be explained?
//!
//! A weight's own formula where that is short, else a letter. Formulas in `j` get the letter with the index of the point.
//! Notes explain the letters, the cases of other valences, the scheme's own names, and its parameters.

use super::prettify::{lowered, name, pretty};
use crate::refine::Obstacle;
use crate::scheme::formula::Formula;
use crate::scheme::vocabulary::{Move, RuleKind, Walk};
use crate::scheme::{Cases, Entry, Pick, Place, Placed, Rule, RuleBook, Weights};
use std::collections::BTreeMap;

/// What is written beside a point.
pub(super) type Weight = String;

/// The longest formula that is written beside a point, in letters; and beside one of many.
const MAX_LETTERS: [usize; 2] = [10, 7];

/// From how many points on a rule has many.
const MANY: usize = 9;

/// The formulas of a scheme file as its pictures write them.
pub(super) struct Formulas<'a> {
    book: &'a RuleBook,
    /// Formulas in print that have got a letter.
    letters: Vec<(String, char)>,
    notes: Vec<String>,
    /// The longest formula that stands beside a point of the rule at hand.
    longest: usize,
}

impl<'a> Formulas<'a> {
    pub(super) fn new(book: &'a RuleBook) -> Formulas<'a> {
        Formulas { book, letters: Vec::new(), notes: Vec::new(), longest: MAX_LETTERS[0] }
    }

    /// The weights of a rule at a count, by entry and index.
    pub(super) fn weights_of(
        &mut self,
        rule: Option<&Rule>,
        kind: RuleKind,
        count: usize,
        told: &str,
    ) -> Result<BTreeMap<(usize, usize), Weight>, Obstacle> {
        let place = Place::<f64>::at(kind.variable(), count as i64);
        let mut written = BTreeMap::new();
        let entries = rule.map_or(&[][..], |rule| &rule.entries);
        let sizes = entries.iter().map(|entry| crate::scheme::class_size(entry, kind, count as i64));
        // many points, or points straight on along a line, leave little room
        let on = |walk: &Walk| walk.ways.iter().flatten().any(|step| *step == Move::On);
        let long = entries.iter().any(|entry| entry.picks.is_none() && entry.position.walks.iter().any(on));
        self.longest = MAX_LETTERS[usize::from(long || sizes.sum::<usize>() >= MANY)];
        for (at, entry) in entries.iter().enumerate() {
            let size = crate::scheme::class_size(entry, kind, count as i64);
            let indices: Vec<usize> =
                self.book.weights(entry, size, &place)?.into_iter().map(|(index, _)| index).collect();
            let selected = self.book.select(&entry.weights, &place)?;
            let condition = condition_of(&entry.weights, selected);
            for (number, index) in indices.into_iter().enumerate() {
                let weight = match selected {
                    Weights::Each(formula) => self.weight(&formula.formula, index, kind, condition.as_deref()),
                    Weights::List(list, _) => list.get(number).map_or(String::new(), |formula| {
                        self.weight(&formula.formula, index, kind, condition.as_deref())
                    }),
                };
                written.insert((at, index), weight);
            }
            self.note_other_cases(entry, selected, told);
        }
        Ok(written)
    }

    fn weight(&mut self, formula: &Formula, index: usize, kind: RuleKind, condition: Option<&str>) -> Weight {
        let print = pretty(formula.text());
        let indexed = self.uses_index(formula);
        let is_name = self.book.lets.iter().any(|named| named.name == formula.text().trim());
        let short = print.chars().count() <= self.longest;
        match (indexed, short) {
            (false, true) => print,
            (true, true) if is_name => format!("{print}{}", lowered(index)),
            (false, false) => self.letter(print, None, condition).to_string(),
            (true, _) => format!("{}{}", self.letter(print, Some(kind), condition), lowered(index)),
        }
    }

    fn uses_index(&self, formula: &Formula) -> bool {
        let indexed =
            |name: &str| name == "j" || self.book.lets.iter().any(|named| named.name == name && named.uses_index);
        formula.names().any(|(name, _)| indexed(name))
    }

    /// The letter of a formula: a new one with its note, or the one that it has.
    fn letter(&mut self, print: String, indexed: Option<RuleKind>, condition: Option<&str>) -> char {
        if let Some((_, letter)) = self.letters.iter().find(|(known, _)| *known == print) {
            return *letter;
        }
        let taken = |letter: char| {
            let own = letter.to_string();
            let named =
                self.book.lets.iter().any(|l| l.name == own) || self.book.parameters.iter().any(|p| p.name == own);
            named || self.letters.iter().any(|(_, other)| *other == letter)
        };
        let letter = "abcdefghpqrstuvxyz".chars().find(|letter| !taken(*letter)).unwrap_or('?');
        let case = condition.map_or(String::new(), |condition| format!(" if {condition}"));
        self.notes.push(match indexed {
            None => format!("{letter} = {print}{case}"),
            Some(kind) => format!(
                "{letter}₀, {letter}₁, … = {print}{case}; j = 0, 1, … counter-clockwise, 0 {}",
                match kind {
                    RuleKind::EdgeFromIrregularEnd => "at the edge's other end",
                    RuleKind::Corner => "at the new point's corner",
                    _ => "at the right",
                }
            ),
        });
        self.letters.push((print, letter));
        letter
    }

    /// One line for each case that the picture doesn't show.
    fn note_other_cases(&mut self, entry: &Entry, selected: &Weights, rule: &str) {
        let Cases::When(cases) = &entry.weights else { return };
        for (condition, _, weights) in cases.iter().filter(|(_, _, weights)| !std::ptr::eq(weights, selected)) {
            let list = match weights {
                Weights::Each(formula) => pretty(formula.formula.text()),
                Weights::List(list, _) => {
                    let all: Vec<String> = list.iter().map(|formula| pretty(formula.formula.text())).collect();
                    all.join(", ")
                }
            };
            let rule = rule.split(',').next().unwrap_or(rule);
            self.notes.push(format!("{rule}, {}, if {}: {list}", points(entry), pretty(condition.text())));
        }
    }

    /// The notes: letters and cases in order of their appearance, then the scheme's names and parameters.
    pub(super) fn notes(&self) -> Vec<String> {
        let mut notes = self.notes.clone();
        for named in &self.book.lets {
            let about = |value: &Placed, case: String| {
                format!("{} = {}{case}", name(&named.name), pretty(value.formula.text()))
            };
            match &named.value {
                Cases::Always(value) => notes.push(about(value, String::new())),
                Cases::When(cases) => notes.extend(
                    cases.iter().map(|(condition, _, value)| about(value, format!(" if {}", pretty(condition.text())))),
                ),
            }
        }
        for parameter in &self.book.parameters {
            let value = pretty(parameter.value.formula.text());
            let means = if parameter.means.is_empty() { String::new() } else { format!(": {}", parameter.means) };
            notes.push(format!("{} = {value}{means}", name(&parameter.name)));
        }
        notes
    }
}

/// The condition of the selected case, where there are cases.
fn condition_of(weights: &Cases<Weights>, selected: &Weights) -> Option<String> {
    let Cases::When(cases) = weights else { return None };
    let case = cases.iter().find(|(_, _, weights)| std::ptr::eq(weights, selected));
    case.map(|(condition, _, _)| pretty(condition.text()))
}

/// The points of a row, as the scheme file names them.
fn points(entry: &Entry) -> String {
    let pick = |pick: &Pick| if let Pick::Index(index) = pick { index.to_string() } else { "k".to_string() };
    match &entry.picks {
        None => entry.position.name.clone(),
        Some(picks) => format!("{}[{}]", entry.position.name, picks.iter().map(pick).collect::<Vec<_>>().join(", ")),
    }
}
