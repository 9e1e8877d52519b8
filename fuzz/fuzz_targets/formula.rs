//! Is every text either refused as a formula or a condition, or evaluated, without a panic, a hang or unbounded memory?
#![no_main]

use eigenring::numbers::{Laurent, Number, Trouble};
use eigenring::scheme::formula::{Condition, Formula, Names};
use libfuzzer_sys::fuzz_target;

/// `n` is 5; every other name is what `other` says.
struct Values<W> {
    other: fn(&str) -> W,
}

impl<W: Number> Names<W> for Values<W> {
    fn value(&self, name: &str) -> Result<W, Trouble> {
        match name {
            "n" => Ok(W::whole(5)),
            "nothing" => Err(Trouble::Domain("no such name")),
            _ => Ok((self.other)(name)),
        }
    }
}

fuzz_target!(|text: &str| {
    let approximate = Values { other: |name| name.len() as f64 / 8.0 };
    let exact = Values { other: Laurent::atom };
    match Formula::parse(text) {
        Err(fault) => assert!(fault.span.is_some_and(|span| text.get(span).is_some())),
        Ok(formula) => {
            if let Ok(value) = formula.evaluate::<f64>(&approximate) {
                assert!(value.is_finite());
            }
            if let Err(failure) = formula.evaluate::<Laurent>(&exact) {
                assert!(text.get(failure.span).is_some());
            }
        }
    }
    match Condition::parse(text) {
        Err(fault) => assert!(fault.span.is_some_and(|span| text.get(span).is_some())),
        Ok(condition) => {
            let _ = condition.holds::<f64>(&approximate);
            let _ = condition.holds::<Laurent>(&exact);
            let _ = condition.settled_from();
        }
    }
});
