//! How do the leading eigenvalues change with a parameter?
//!
//! Approximate (`f64`) spectra at equally spaced values of one parameter, valence by valence. Values at which a weight has no
//! value, or a spectrum can't be computed, are left out.

use super::tables::{Cell, Table};
use crate::analysis::spectra::Spectra;
use crate::analysis::spectrum::Spectrum;
use crate::scheme::{Interval, Scheme};
use dashu_ratio::RBig;
use std::fmt::Write;

/// The steps of a sweep, unless others are asked for.
pub const STEPS: usize = 64;

/// The most spectra of one sweep.
pub const MOST_SPECTRA: usize = 20_000;

/// The largest sum of the valences of these spectra: work grows with it.
pub const MOST_SECTORS: usize = 2_000_000;

/// The rows of the table for people, at most, for each valence.
const SHOWN_STEPS: usize = 8;

/// What is to be swept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SweepRequest {
    /// The parameter with its first and last value.
    pub interval: Interval,
    /// The number of steps between them.
    pub steps: usize,
}

impl SweepRequest {
    /// Reads `w=0..1/8` or `w=0..1/8:32`.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &str) -> Result<SweepRequest, String> {
        let (interval, steps) = match text.rsplit_once(':') {
            None => (text, STEPS),
            Some((interval, steps)) => {
                let count = steps.trim().parse().ok().filter(|count| (1..MOST_SPECTRA).contains(count));
                let wrong = || format!("`{}` is not a number of steps from 1 to {}", steps.trim(), MOST_SPECTRA - 1);
                (interval, count.ok_or_else(wrong)?)
            }
        };
        Ok(SweepRequest { interval: Interval::parse(interval)?, steps })
    }
}

/// The leading eigenvalues at one value of the parameter; approximate.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepPoint {
    /// The valence.
    pub n: usize,
    /// The parameter's value.
    pub value: RBig,
    /// The modulus of the largest eigenvalue after 1.
    pub lambda: f64,
    /// Its frequency.
    pub frequency: usize,
    /// The largest modulus after that.
    pub mu: f64,
    /// |mu|/lambda^2, where lambda is real, positive, of frequency 1 and isolated there.
    pub ratio: Option<f64>,
}

/// The leading eigenvalues against a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// What was asked for.
    pub request: SweepRequest,
    /// By valence, then by value.
    pub points: Vec<SweepPoint>,
    /// How many points have no value.
    pub left_out: usize,
}

impl Sweep {
    /// The sweep of a scheme.
    ///
    /// # Errors
    /// When the parameter can't be swept so, or it would take too long.
    pub fn of(scheme: &Scheme, valences: &[usize], request: &SweepRequest) -> Result<Sweep, String> {
        scheme.admits(&request.interval)?;
        let count = request.steps + 1;
        let sectors: usize = valences.iter().sum();
        if count * valences.len() > MOST_SPECTRA || count.saturating_mul(sectors) > MOST_SECTORS {
            return Err(format!(
                "{count} values at {} valences are too many for one sweep: at most {MOST_SPECTRA} spectra, whose valences sum \
                 to at most {MOST_SECTORS}\n  help: ask for fewer steps ({}:16) or fewer valences",
                valences.len(),
                told(&request.interval)
            ));
        }
        let mut points = Vec::new();
        for step in 0..count {
            let value = request.interval.at(step, request.steps);
            let there = scheme.with_value(&request.interval.name, &value.to_string())?;
            let Ok(spectra) = Spectra::new(&there) else { continue };
            let found = valences.iter().filter_map(|n| point(*n, &value, &spectra.at(*n).ok()?));
            points.extend(found);
        }
        let left_out = count * valences.len() - points.len();
        points.sort_by(|a, b| a.n.cmp(&b.n).then(a.value.cmp(&b.value)));
        Ok(Sweep { request: request.clone(), points, left_out })
    }

    /// The valences that have points, in order.
    pub fn valences(&self) -> Vec<usize> {
        let mut valences: Vec<usize> = self.points.iter().map(|point| point.n).collect();
        valences.dedup();
        valences
    }

    /// The points of a valence, in order.
    pub fn of_valence(&self, n: usize) -> impl Iterator<Item = &SweepPoint> {
        self.points.iter().filter(move |point| point.n == n)
    }

    /// What was left out, in words.
    pub fn what_is_left_out(&self) -> String {
        match self.left_out {
            0 => String::new(),
            1 => " One value is left out: a formula has no value there.".to_string(),
            count => format!(" {count} values are left out: a formula has no value there."),
        }
    }
}

/// `w=0..1/8`
fn told(interval: &Interval) -> String {
    format!("{}={}..{}", interval.name, interval.from, interval.to)
}

fn point(n: usize, value: &RBig, spectrum: &Spectrum) -> Option<SweepPoint> {
    let lambda = spectrum.subdominant()?;
    let mu = spectrum.after_subdominant().next()?.modulus();
    let real = lambda.real().filter(|real| *real > 0.0 && lambda.frequency == 1 && lambda.is_isolated());
    let ratio = real.map(|real| mu / (real * real)).filter(|ratio| ratio.is_finite());
    Some(SweepPoint { n, value: value.clone(), lambda: lambda.modulus(), frequency: lambda.frequency, mu, ratio })
}

/// Every point as CSV; an empty ratio where lambda is not real, positive, of frequency 1 and isolated.
pub fn sweep_csv(sweep: &Sweep) -> String {
    let name = &sweep.request.interval.name;
    let mut text = format!("n,{name},{name} exactly,|lambda|,frequency of lambda,|mu|,ratio |mu|/lambda^2\n");
    for p in &sweep.points {
        let ratio = p.ratio.map_or(String::new(), |ratio| ratio.to_string());
        let decimal = p.value.to_f64().value();
        let _ = writeln!(text, "{},{decimal},{},{},{},{},{ratio}", p.n, p.value, p.lambda, p.frequency, p.mu);
    }
    text
}

fn shown(sweep: &Sweep) -> impl Iterator<Item = &SweepPoint> {
    let every = sweep.request.steps.div_ceil(SHOWN_STEPS).max(1);
    let last = sweep.request.steps;
    let steps: Vec<RBig> = (0..=last)
        .filter(|step| step % every == 0 || *step == last)
        .map(|step| sweep.request.interval.at(step, last))
        .collect();
    sweep.points.iter().filter(move |point| steps.contains(&point.value))
}

/// The title of the table.
pub const TITLE: &str = "Sweep of a parameter";

/// The table for people: some of the values.
pub(super) fn table(sweep: &Sweep) -> Table {
    let name = &sweep.request.interval.name;
    let row = |p: &SweepPoint| -> Vec<Cell> {
        let ratio = p.ratio.map_or("-".to_string(), |ratio| format!("{ratio:.6}"));
        let words = [p.n.to_string(), p.value.to_string(), format!("{:.10}", p.lambda), p.frequency.to_string()];
        words.into_iter().chain([format!("{:.10}", p.mu), ratio]).map(Cell::from).collect()
    };
    let note = format!(
        "Approximate (f64): |λ| and |μ|, the largest moduli after 1, and their ratio, against {name} from {} to {}; some of {} \
         values. sweep.csv has all.{}",
        sweep.request.interval.from,
        sweep.request.interval.to,
        sweep.request.steps + 1,
        sweep.what_is_left_out()
    );
    let head = ["n", name, "|λ|", "of frequency", "|μ|", "|μ|/λ²"].map(String::from).to_vec();
    Table { title: TITLE.to_string(), note, head, rows: shown(sweep).map(row).collect() }
}

/// The most rows on a terminal.
const MOST_ROWS: usize = 30;

/// A short table for a terminal.
pub fn terminal(sweep: &Sweep) -> String {
    let name = &sweep.request.interval.name;
    let mut text = format!("\nSweep, approximate (f64):{}\n", sweep.what_is_left_out());
    let _ = writeln!(text, "{:>6} {name:>12} {:>13} {:>4} {:>13} {:>10}", "n", "|lambda|", "k", "|mu|", "|mu|/l^2");
    for p in shown(sweep).take(MOST_ROWS) {
        let ratio = p.ratio.map_or("-".to_string(), |ratio| format!("{ratio:.6}"));
        let value = p.value.to_string();
        let _ =
            writeln!(text, "{:>6} {value:>12} {:>13.10} {:>4} {:>13.10} {ratio:>10}", p.n, p.lambda, p.frequency, p.mu);
    }
    let rest = shown(sweep).count().saturating_sub(MOST_ROWS);
    if rest > 0 {
        let _ = writeln!(text, "{:>6} ({rest} more rows in the files)", "...");
    }
    text
}
