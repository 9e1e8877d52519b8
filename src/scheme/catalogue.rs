//! Which schemes come with Eigenring?
//!
//! Files under `schemes/`, in the format that users write, embedded into the program and read through the same door.

use super::curve::CurveScheme;
use super::grid::GridScheme;
use super::{AnyScheme, RuleBook, Scheme};
use crate::fault::Faults;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// A scheme file of the catalogue.
#[derive(Clone, Copy, Debug)]
pub struct Listed {
    /// Its name on the command line.
    pub id: &'static str,
    /// Its text.
    pub text: &'static str,
}

macro_rules! listed {
    ($($id:literal => $path:literal),* $(,)?) => {
        [$(Listed { id: $id, text: include_str!(concat!("../../schemes/", $path)) }),*]
    };
}

/// Every scheme of the catalogue.
pub const SCHEMES: [Listed; 13] = listed! {
    "loop" => "triangle/loop.toml",
    "loop-warren" => "triangle/loop-warren.toml",
    "butterfly" => "triangle/butterfly.toml",
    "modified-butterfly" => "triangle/modified-butterfly.toml",
    "loop-averaging" => "triangle/loop-averaging.toml",
    "sqrt3" => "triangle/sqrt3.toml",
    "catmull-clark" => "quad/catmull-clark.toml",
    "doo-sabin" => "quad/doo-sabin.toml",
    "catmull-clark-biquadratic" => "quad/catmull-clark-biquadratic.toml",
    "kobbelt" => "quad/kobbelt.toml",
    "four-eight" => "quad/four-eight.toml",
    "mid-edge" => "quad/mid-edge.toml",
    "midpoint" => "quad/midpoint.toml",
};

/// Every scheme for curves of the catalogue.
pub const CURVES: [Listed; 13] = listed! {
    "bezier" => "curve/bezier.toml",
    "chaikin" => "curve/chaikin.toml",
    "b-spline" => "curve/b-spline.toml",
    "lane-riesenfeld" => "curve/lane-riesenfeld.toml",
    "cubic-b-spline-natural" => "curve/cubic-b-spline-natural.toml",
    "cubic-b-spline-clamped" => "curve/cubic-b-spline-clamped.toml",
    "corner-cutting" => "curve/corner-cutting.toml",
    "four-point" => "curve/four-point.toml",
    "six-point" => "curve/six-point.toml",
    "deslauriers-dubuc" => "curve/deslauriers-dubuc.toml",
    "ternary-b-spline" => "curve/ternary-b-spline.toml",
    "ternary-four-point" => "curve/ternary-four-point.toml",
    "quaternary-b-spline" => "curve/quaternary-b-spline.toml",


};

/// Every tensor product of the catalogue.
pub const GRIDS: [Listed; 2] = listed! {
    "biquadratic" => "grid/biquadratic.toml",
    "bicubic" => "grid/bicubic.toml",
};

/// Every boundary file of the catalogue.
pub const BOUNDARIES: [Listed; 5] = listed! {
    "cubic" => "boundary/cubic.toml",
    "thirds" => "boundary/thirds.toml",
    "hoppe-1994" => "boundary/hoppe-1994.toml",
    "biermann-levin-zorin-2000" => "boundary/biermann-levin-zorin-2000.toml",
    "biermann-levin-zorin-2000-flat" => "boundary/biermann-levin-zorin-2000-flat.toml",
};

/// The file of a scheme of the catalogue.
pub fn scheme(id: &str) -> Option<Listed> {
    SCHEMES.into_iter().find(|listed| listed.id == id)
}

/// Every scheme of the catalogue, of whatever kind.
pub fn all() -> impl Iterator<Item = Listed> {
    SCHEMES.into_iter().chain(CURVES).chain(GRIDS)
}

/// The scheme of a catalogue file, of whatever kind.
///
/// # Errors
/// The file's faults; `None` when the catalogue has no such name.
pub fn any(id: &str) -> Option<Result<AnyScheme, Faults>> {
    all().find(|listed| listed.id == id).map(|listed| AnyScheme::parse(id, &format!("{id}.toml"), listed.text))
}

/// The scheme for curves of a catalogue file.
///
/// # Errors
/// The file's faults; `None` when the catalogue has no such name.
pub fn curve(id: &str) -> Option<Result<CurveScheme, Faults>> {
    let listed = CURVES.into_iter().find(|listed| listed.id == id)?;
    Some(CurveScheme::parse(id, &format!("{id}.toml"), listed.text))
}

/// The tensor product of a catalogue file.
///
/// # Errors
/// The file's faults; `None` when the catalogue has no such name.
pub fn grid(id: &str) -> Option<Result<GridScheme, Faults>> {
    let listed = GRIDS.into_iter().find(|listed| listed.id == id)?;
    Some(GridScheme::parse(id, &format!("{id}.toml"), listed.text))
}

/// The scheme of a catalogue file.
///
/// # Errors
/// The file's faults; `None` when the catalogue has no such name.
pub fn open(id: &str) -> Option<Result<Scheme, Faults>> {
    scheme(id).map(|listed| Scheme::parse(listed.id, &format!("{id}.toml"), listed.text))
}

/// The rules of a boundary file of the catalogue.
///
/// # Errors
/// The file's faults; `None` when the catalogue has no such name.
pub fn boundary(id: &str, mesh: &str) -> Option<Result<RuleBook, Faults>> {
    let listed = BOUNDARIES.into_iter().find(|listed| listed.id == id)?;
    Some(RuleBook::parse_boundary(&format!("{id}.toml"), listed.text, mesh))
}

/// A work that scheme files and verdicts refer to.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Its authors.
    pub author: String,
    /// Its title.
    pub title: String,
    /// Journal and volume, proceedings or publisher.
    #[serde(rename = "where")]
    pub place: String,
    /// Its year.
    pub year: u16,
}

impl Source {
    /// Authors, title, place and year in one line.
    pub fn citation(&self) -> String {
        format!("{}. {}. {}, {}.", self.author, self.title, self.place, self.year)
    }
}

/// The bibliography, by key.
pub fn sources() -> &'static BTreeMap<String, Source> {
    static SOURCES: OnceLock<BTreeMap<String, Source>> = OnceLock::new();
    SOURCES.get_or_init(|| toml::from_str(include_str!("../../schemes/sources.toml")).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_the_catalogue_is_read_and_cites_known_sources() {
        assert!(sources().len() >= 10);
        for listed in SCHEMES {
            let scheme = open(listed.id).unwrap().unwrap_or_else(|faults| panic!("{faults}"));
            let claimed = scheme.claims.iter().flat_map(|claim| &claim.sources);
            for source in scheme.book.sources.iter().chain(claimed) {
                assert!(sources().contains_key(source), "{}: {source}", listed.id);
            }
            assert!(!scheme.claims.is_empty(), "{} claims nothing", listed.id);
        }
        for listed in BOUNDARIES {
            for mesh in ["triangles", "quads", "polygons"] {
                let book = boundary(listed.id, mesh).unwrap().unwrap_or_else(|faults| panic!("{faults}"));
                let claimed = book.claims.iter().flat_map(|claim| &claim.sources).cloned();
                assert!(book.all_sources().into_iter().chain(claimed).all(|key| sources().contains_key(&key)));
            }
        }
    }
}
