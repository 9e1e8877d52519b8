//! Makes `reports/atlas/` again: the committed reports of the catalogue's schemes, for n = 3..12.
//!
//! `cargo run --release --example atlas`

use eigenring::report::{ATLAS, atlas, write_whole};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reports/atlas");
    for id in ATLAS {
        let own = folder.join(id);
        std::fs::create_dir_all(&own)?;
        for (name, text) in atlas(id)? {
            write_whole(&own.join(name), text.as_bytes())?;
        }
    }
    Ok(())
}
