//! Which signs have the Jacobian and the half-plane form on the ring?
//!
//! The Jacobian is positive on a patch where all of its Bernstein coefficients are. Where they are not, the patch is
//! quartered, which is asking for the same net twice as far out. A coefficient at a corner is the Jacobian's value
//! there, up to a positive factor: so one that is certainly negative is no failure of a bound, but a place where the
//! map turns over.

use crate::proof::enclosed_net::EnclosedNet;
use crate::proof::jacobian::{Grid, PairOf, PatchAt, Pieces};
use crate::proof::ring::quarters;
use crate::proof::signed::Signed;
use crate::refine::Obstacle;
use std::cmp::Ordering;
use std::fmt;

/// A corner of a patch: the patch, how often the lattice was halved for it, and the coefficient's index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    /// The patch.
    pub patch: PatchAt,
    /// How often the ring was quartered.
    pub level: usize,
    /// The index of the coefficient.
    pub index: (usize, usize),
}

/// What is seen on the ring.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Signs {
    /// A corner where the Jacobian is certainly negative, with a number near its value. What comes after it wasn't
    /// looked at.
    pub negative: Option<(Corner, f64)>,
    /// A patch on which the Jacobian isn't seen to be positive.
    pub open: Option<PatchAt>,
    /// A patch that isn't seen to lie in the open half plane.
    pub outside: Option<PatchAt>,
    /// How many patches were looked at.
    pub patches: usize,
}

impl Signs {
    /// Where a sign is not as the theorem asks, in words; `None` where all are.
    pub fn missing(&self) -> Option<String> {
        match self {
            Signs { negative: Some((corner, value)), .. } => {
                Some(format!("the Jacobian is negative at {corner} (near {value:.6})"))
            }
            Signs { open: Some(patch), .. } => {
                Some(format!("the Jacobian is not seen to be positive on the patch at {:?}", patch.0))
            }
            Signs { outside: Some(patch), .. } => {
                Some(format!("the patch at {:?} is not seen to lie in the half plane", patch.0))
            }
            _ => None,
        }
    }
}

/// A reader of signs on the patches of a ring.
pub struct Reader<'n, 'r, F> {
    net: &'n mut EnclosedNet<'r, F>,
    pieces: Pieces,
    depth: usize,
    signs: Signs,
}

impl<'n, 'r, F: Signed> Reader<'n, 'r, F> {
    /// The signs on some patches, each quartered up to `depth` times.
    ///
    /// # Errors
    /// As [`crate::proof::jacobian::ControlNet::at`].
    pub fn read(
        net: &'n mut EnclosedNet<'r, F>,
        pieces: Pieces,
        patches: &[PatchAt],
        depth: usize,
    ) -> Result<Signs, Obstacle> {
        let mut reader = Reader { net, pieces, depth, signs: Signs::default() };
        for patch in patches {
            reader.visit(*patch, 0, [true, true])?;
        }
        Ok(reader.signs)
    }

    /// Looks at a patch for what is wanted of it: a positive Jacobian, the half plane.
    fn visit(&mut self, patch: PatchAt, level: usize, [jacobian, half_plane]: [bool; 2]) -> Result<(), Obstacle> {
        if self.signs.negative.is_some() {
            return Ok(());
        }
        self.signs.patches += 1;
        let points = self.pieces.bezier(self.net, patch)?;
        let outside = half_plane && !self.is_in_half_plane(&points)?;
        let open = jacobian && !self.is_positive(&self.pieces.jacobian(&points)?, patch, level);
        if !open && !outside {
            return Ok(());
        }
        if level < self.depth {
            let mut quarters = quarters(self.pieces, patch).into_iter();
            return quarters.try_for_each(|quarter| self.visit(quarter, level + 1, [open, outside]));
        }
        self.signs.open = self.signs.open.or(open.then_some(patch));
        self.signs.outside = self.signs.outside.or(outside.then_some(patch));
        Ok(())
    }

    fn is_in_half_plane(&mut self, points: &Grid<PairOf<F>>) -> Result<bool, Obstacle> {
        for point in points.values() {
            if self.net.along_axis(point)?.sign() != Some(Ordering::Greater) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether all coefficients are positive; a corner where one is negative is taken down.
    fn is_positive(&mut self, coefficients: &Grid<F>, patch: PatchAt, level: usize) -> bool {
        let negative = |(index, value): &(&(usize, usize), &F)| {
            self.pieces.is_corner(**index) && value.sign() == Some(Ordering::Less)
        };
        if let Some((index, value)) = coefficients.iter().find(negative) {
            self.signs.negative = Some((Corner { patch, level, index: *index }, value.approx()));
        }
        coefficients.values().all(|value| value.sign() == Some(Ordering::Greater))
    }
}

impl fmt::Display for Corner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ((x, y), sign) = self.patch;
        let turned = if sign < 0 { "turned " } else { "" };
        write!(f, "corner {:?} of the {turned}patch at ({x}, {y})", self.index)?;
        match self.level {
            0 => Ok(()),
            level => write!(f, " of level {level}"),
        }
    }
}
