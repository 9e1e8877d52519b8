//! How many eigenvectors has an eigenvalue, and how large is its largest Jordan block?
//!
//! By exact ranks: the nullities of (B - lambda)^i grow until they reach the algebraic multiplicity; the first is the
//! geometric one, and the power at which they get there is the size of the largest block. Only the part of the block between
//! cores that have the eigenvalue matters: on what is made of none of them, or feeds none, B - lambda is invertible.

use super::block::Block;
use crate::numbers::linear::{Matrix, null_space, part, product, shifted};
use crate::numbers::{Extension, Field, Trouble, Univariate};

/// The structure of one eigenvalue of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Structure {
    /// The dimension of its eigenspace.
    pub geometric: usize,
    /// The size of its largest Jordan block.
    pub largest: usize,
}

/// What came of asking for a structure.
pub enum Answer<F> {
    /// The structure, the same for every root of the polynomial.
    Structure(Structure),
    /// A factor of the polynomial whose roots may have another structure than the rest.
    Splits(Univariate<F>),
}

/// The structure of the roots of a monic polynomial, which `cores` have, `algebraic` being the multiplicity of each.
///
/// # Errors
/// When a limit of size is passed.
pub fn structure<F: Field>(
    block: &Block<F>,
    cores: &[usize],
    polynomial: &Univariate<F>,
    algebraic: usize,
) -> Result<Answer<F>, Trouble> {
    let matrix = part(&block.matrix, &between(block, cores));
    if let [constant, _] = polynomial.coefficients() {
        return Ok(Answer::Structure(by_ranks(&matrix, &constant.negated(), algebraic)?));
    }
    let lambda = Extension::root(polynomial)?;
    let lift = |row: &Vec<F>| row.iter().map(|entry| Extension::constant(entry.clone())).collect();
    let lifted: Matrix<Extension<F>> = matrix.iter().map(lift).collect();
    match (by_ranks(&lifted, &lambda, algebraic), lambda.split()) {
        (Ok(structure), _) => Ok(Answer::Structure(structure)),
        (Err(_), Some(factor)) => Ok(Answer::Splits(factor)),
        (Err(trouble), None) => Err(trouble),
    }
}

/// The unknowns that are made of one of the cores and feed one of them.
fn between<F: Field>(block: &Block<F>, cores: &[usize]) -> Vec<usize> {
    let own: Vec<usize> = cores.iter().flat_map(|core| block.cores[*core].iter().copied()).collect();
    let mut below = block.below(&own);
    below.retain(|unknown| block.below(&[*unknown]).iter().any(|reached| own.contains(reached)));
    below
}

fn by_ranks<F: Field>(matrix: &Matrix<F>, lambda: &F, algebraic: usize) -> Result<Structure, Trouble> {
    let shifted = shifted(matrix, lambda)?;
    let geometric = null_space(&shifted)?.len();
    let (mut nullity, mut power, mut largest) = (geometric, shifted.clone(), 1);
    while nullity < algebraic && largest < algebraic {
        power = product(&power, &shifted)?;
        nullity = null_space(&power)?.len();
        largest += 1;
    }
    if nullity == algebraic { Ok(Structure { geometric, largest }) } else { Err(NO_STRUCTURE) }
}

const NO_STRUCTURE: Trouble = Trouble::BeyondThisWorld("the ranks don't fit the multiplicity");
