//! Are the committed reports those that this program writes?
#![allow(clippy::unwrap_used)]

use eigenring::report::{ATLAS, atlas};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

const STALE: &str = "make the atlas again: cargo run --release --example atlas";

#[test]
fn the_atlas_is_fresh() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reports/atlas");
    for id in ATLAS {
        let files = atlas(id).unwrap();
        assert!(files.len() >= 3);
        for (name, text) in &files {
            let committed = fs::read_to_string(folder.join(id).join(name)).unwrap_or_default();
            assert!(committed == *text, "reports/atlas/{id}/{name} is stale; {STALE}");
        }
        let there: BTreeSet<String> = fs::read_dir(folder.join(id))
            .unwrap()
            .map(|file| file.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        let made: BTreeSet<String> = files.into_iter().map(|(name, _)| name).collect();
        assert_eq!(there, made, "reports/atlas/{id}; {STALE}");
    }
}

#[test]
fn reports_are_the_same_every_time() {
    assert_eq!(atlas("doo-sabin").unwrap(), atlas("doo-sabin").unwrap());
}
