//! Is every file either refused as PLY, or written and read back the same?
#![no_main]

mod same;

use eigenring::mesh::io::Format;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| same::back(Format::Ply, bytes));
