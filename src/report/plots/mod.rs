//! Which pictures belong to a report?
use crate::analysis::{Analysis, Analyzer};
use crate::refine::Obstacle;
/// A picture of a report.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The stem of its file.
    pub name: &'static str,
    /// What is seen.
    pub caption: String,
    /// The picture.
    pub svg: String,
}
/// pictures
pub fn pictures(_: &Analyzer, _: &[Analysis]) -> Result<Vec<Picture>, Obstacle> {
    Ok(vec![])
}
/// png
pub fn png(_: &str) -> Result<Vec<u8>, String> {
    Ok(vec![])
}
