//! Which claims of the literature hold?

use super::analyze::explain;
use super::open::open;
use super::valences::Valences;
use super::{Failure, print};
use clap::Args;
use eigenring::report::Study;
use eigenring::scheme::catalogue;
use eigenring::verdicts::{ClaimCheck, Outcome};
use indicatif::{ProgressBar, ProgressStyle};
use std::fmt::Write;
use std::time::Duration;

/// Holds every claim of scheme files against the analysis.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  eigenring claims                    the whole catalogue\n  eigenring claims loop --valence 3..50\n  \
                        eigenring claims my-scheme.toml\n\nExit status 1 when a claim fails."
)]
pub(crate) struct Claims {
    /// A scheme of the catalogue or the path of a scheme file; all of the catalogue, if left out
    scheme: Option<String>,
    /// The valences to analyse
    #[arg(long, default_value = "3..12")]
    valence: Valences,
    /// Set a parameter of the scheme, for example w=1/32; may be given several times
    #[arg(long, value_name = "NAME=VALUE", requires = "scheme")]
    set: Vec<String>,
}

impl Claims {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let all: Vec<String> = catalogue::SCHEMES.iter().map(|listed| listed.id.to_string()).collect();
        let names = self.scheme.map_or(all, |name| vec![name]);
        let valences = &self.valence.0;
        let bar = progress(names.len() * valences.len());
        let mut text = String::new();
        let mut counts = [0; 3];
        for name in &names {
            let scheme = open(name, &self.set)?;
            let study = Study::of(&scheme, valences, false, &|| bar.inc(1)).map_err(|wrong| explain(&scheme, wrong))?;
            table(&mut text, &scheme.book.title, &study.report.claims);
            for claim in &study.report.claims {
                counts[claim.outcome as usize] += 1;
            }
        }
        bar.finish_and_clear();
        let [holds, fails, undecided] = counts;
        let _ = writeln!(text, "{holds} hold, {fails} fail, {undecided} undecided, at n = {}.", in_words(valences));
        print(&text)?;
        if fails > 0 { Err(Failure::No) } else { Ok(()) }
    }
}

/// The claims of one scheme.
fn table(text: &mut String, title: &str, claims: &[ClaimCheck]) {
    let _ = writeln!(text, "{title}");
    if claims.is_empty() {
        let _ = writeln!(text, "  claims nothing");
    }
    let said = |claim: &ClaimCheck| {
        let value = claim.equals.as_ref().map_or(String::new(), |value| format!(" = {value}"));
        let place = claim.condition.as_ref().map_or(String::new(), |place| format!(", where {place}"));
        format!("{}{value}{place}", claim.what)
    };
    let width = claims.iter().map(|claim| said(claim).chars().count()).max().unwrap_or(0);
    for claim in claims {
        let outcome = match claim.outcome {
            Outcome::Agrees => "holds",
            Outcome::Disagrees => "FAILS",
            Outcome::Undecided => "undecided",
        };
        let said = said(claim);
        let _ = writeln!(text, "  {said:width$}  {outcome:<9}  {}  [{}]", claim.seen, claim.source.join(", "));
    }
    text.push('\n');
}

/// A run of valences as its ends.
fn in_words(valences: &[usize]) -> String {
    match valences {
        [first, .., last] if last - first + 1 == valences.len() => format!("{first} to {last}"),
        _ => valences.iter().map(usize::to_string).collect::<Vec<_>>().join(", "),
    }
}

fn progress(valences: usize) -> ProgressBar {
    let bar = ProgressBar::new(valences as u64);
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} valences, {elapsed}");
    if let Ok(style) = style {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
