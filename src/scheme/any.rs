//! Which kind of scheme does a file tell: one for surfaces, for curves, or a tensor product?
//!
//! The key `mesh` says it.

use super::curve::CurveScheme;
use super::grid::GridScheme;
use super::{RuleBook, Scheme};
use crate::fault::Faults;
use toml::de::{DeTable, DeValue};

/// A scheme of any kind.
#[derive(Clone, Debug)]
pub enum AnyScheme {
    /// For surfaces.
    Surface(Box<Scheme>),
    /// For curves.
    Curve(Box<CurveScheme>),
    /// For grids.
    Grid(Box<GridScheme>),
}

impl AnyScheme {
    /// Reads a scheme file: `id` is its short name, `origin` its name in messages.
    ///
    /// # Errors
    /// All faults that reading finds.
    pub fn parse(id: &str, origin: &str, text: &str) -> Result<AnyScheme, Faults> {
        let table = DeTable::parse_recoverable(text).0;
        let mesh = table.get_ref().get("mesh").map(|value| value.get_ref());
        Ok(match mesh {
            Some(DeValue::String(word)) if word == "curve" => {
                AnyScheme::Curve(Box::new(CurveScheme::parse(id, origin, text)?))
            }
            Some(DeValue::String(word)) if word == "grid" => {
                AnyScheme::Grid(Box::new(GridScheme::parse(id, origin, text)?))
            }
            _ => AnyScheme::Surface(Box::new(Scheme::parse(id, origin, text)?)),
        })
    }

    /// Its title, parameters and names.
    pub fn book(&self) -> &RuleBook {
        match self {
            AnyScheme::Surface(scheme) => &scheme.book,
            AnyScheme::Curve(scheme) => &scheme.book,
            AnyScheme::Grid(scheme) => &scheme.book,
        }
    }

    /// Sets a parameter, as `--set name=value` does.
    ///
    /// # Errors
    /// Why it can't be set, in words.
    pub fn set(&mut self, name: &str, given: &str) -> Result<(), String> {
        match self {
            AnyScheme::Surface(scheme) => scheme.book.set(name, given),
            AnyScheme::Curve(scheme) => scheme.book.set(name, given),
            AnyScheme::Grid(scheme) => scheme.book.set(name, given),
        }
    }
}
