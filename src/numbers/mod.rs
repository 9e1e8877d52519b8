//! Which kinds of number can a formula of a scheme file evaluate to?
//!
//! A weight is written once, as a formula, and evaluated in whatever *world* of numbers a stage needs. The trait
//! [`Number`] is that world. Two live here: [`f64`] (approximate: nothing computed in it carries an error bound) and
//! [`Laurent`] (exact: rational combinations of products of indeterminates such as `n` or `cos(2*pi/n)`), which shows
//! identities for every valence at once.

mod approximate;
pub mod closed_form;
mod cosine;
mod enclosed_world;
pub mod enclosure;
mod extension;
pub mod factor;
pub mod free;
mod free_world;
mod gcd;
mod hensel;
pub mod interval;
mod kronecker;
mod laurent;
pub mod linear;
pub mod notation;
pub mod polynomial;
mod quotient;
mod rational;
pub mod real_root;
mod ring;
pub mod roots;
mod roots_of_unity;
mod sum;
mod total;
pub mod univariate;
mod world;

pub use cosine::{AtValence, Cosine, CosineField, MAX_DEGREE, degree};
pub use enclosed_world::EnclosedWorld;
pub use enclosure::Enclosure;
pub use extension::Extension;
pub use free::Free;
pub use free_world::{C, C_K, FIRST_PARAMETER, FreeWorld, MOST_PARAMETERS, N, chebyshev};
pub use interval::Interval;
pub use laurent::{Laurent, RingSize};
pub use quotient::{EnclosedParameter, ParameterWorld, Quotient};
pub use ring::{PerFrequency, RingWorld, Series};
pub use roots_of_unity::RootsOfUnity;
pub use sum::sum;
pub use total::Total;
pub use univariate::Univariate;
pub use world::{Angle, World, square_part};

use dashu_ratio::RBig;
use std::cmp::Ordering;
use std::fmt;

/// A literal of a formula: exact, with the nearest `f64` beside it so that it is converted once.
#[derive(Clone, Debug, PartialEq)]
pub struct Literal {
    /// The number as written; decimals are exact (`0.1` is 1/10).
    pub exact: RBig,
    /// The same number rounded to nearest.
    pub approx: f64,
}

impl Literal {
    /// The literal of a rational number.
    pub fn new(exact: RBig) -> Self {
        let approx = exact.to_f64().value();
        Literal { exact, approx }
    }
}

/// The functions that a formula may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Function {
    /// Cosine of an angle in radians.
    Cos,
    /// Sine of an angle in radians.
    Sin,
    /// Square root of a number that is not negative.
    Sqrt,
    /// Binomial coefficient of two whole numbers.
    Binom,
    /// The smaller of two numbers.
    Min,
    /// The larger of two numbers.
    Max,
}

impl Function {
    /// Every function with its name in a formula and its number of arguments.
    pub const ALL: [(&'static str, Function, usize); 6] = [
        ("cos", Function::Cos, 1),
        ("sin", Function::Sin, 1),
        ("sqrt", Function::Sqrt, 1),
        ("binom", Function::Binom, 2),
        ("min", Function::Min, 2),
        ("max", Function::Max, 2),
    ];

    /// The name that a formula calls it by.
    pub fn name(self) -> &'static str {
        Function::ALL.iter().find(|(_, function, _)| *function == self).map_or("", |(name, _, _)| name)
    }
}

/// Why an operation has no value in its world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// The divisor is zero.
    DivisionByZero,
    /// The square root of a negative number.
    NegativeRoot,
    /// The result is infinite or not a number.
    NotFinite,
    /// The arguments are outside the function's domain, as said.
    Domain(&'static str),
    /// The value exists but this world can't hold it, as said.
    BeyondThisWorld(&'static str),
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Trouble::DivisionByZero => f.write_str("division by zero"),
            Trouble::NegativeRoot => f.write_str("the square root of a negative number"),
            Trouble::NotFinite => f.write_str("the value is not a finite number"),
            Trouble::Domain(what) | Trouble::BeyondThisWorld(what) => f.write_str(what),
        }
    }
}

/// What linear algebra needs of numbers. Any operation may pass a stated limit of size.
pub trait Field: Clone + fmt::Debug + PartialEq {
    /// Whether equality of values is decided here.
    const EXACT: bool = true;
    /// The value of a rational number.
    fn rational(value: &RBig) -> Self;
    /// The value of a whole number.
    fn whole(value: i64) -> Self {
        Self::rational(&RBig::from(value))
    }
    /// `-self`
    fn negated(&self) -> Self;
    /// `self + other`
    ///
    /// # Errors
    /// When the result is beyond this world.
    fn plus(&self, other: &Self) -> Result<Self, Trouble>;
    /// `self - other`
    ///
    /// # Errors
    /// When the result is beyond this world.
    fn minus(&self, other: &Self) -> Result<Self, Trouble> {
        self.plus(&other.negated())
    }
    /// `self * other`
    ///
    /// # Errors
    /// When the result is beyond this world.
    fn times(&self, other: &Self) -> Result<Self, Trouble>;
    /// `self / other`
    ///
    /// # Errors
    /// When `other` is zero (an enclosure: when it holds zero), or the result is beyond this world.
    fn over(&self, other: &Self) -> Result<Self, Trouble>;
    /// Whether this is certainly zero. Exact worlds decide it.
    fn is_certainly_zero(&self) -> bool;
}

/// A world of numbers in which formulas are evaluated.
pub trait Number: Field {
    /// The value of a literal.
    fn literal(literal: &Literal) -> Self {
        Self::rational(&literal.exact)
    }
    /// A name that stands for itself, where this world has such.
    fn indeterminate(_name: &str) -> Option<Self> {
        None
    }
    /// The circle's constant.
    fn pi() -> Self;
    /// `self ^ exponent`
    ///
    /// # Errors
    /// When the power is undefined or beyond this world.
    fn power(&self, exponent: &Self) -> Result<Self, Trouble>;
    /// The value of a function.
    ///
    /// # Errors
    /// When the arguments are outside its domain, or the value is beyond this world.
    fn call(function: Function, arguments: &[Self]) -> Result<Self, Trouble>;
    /// Order, where this world can decide it.
    fn order(&self, other: &Self) -> Option<Ordering>;
}
