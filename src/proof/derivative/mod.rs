//! Is the characteristic map regular and injective, whatever its limits are?
//!
//! For any scheme whose regular rules keep affine functions: a cell's data less a polynomial contract faster than cells shrink,
//! so that derivatives of limits over a cell are enclosed by that polynomial's ([`mod@deviation`]); cells are refined
//! until the Jacobian's sign is told ([`sweep`]). At one valence the net is enclosed ([`super::valence`]); for all valences at
//! once on boxes of c ([`super::family`], [`every`]). Zorin 2000 proves the same for butterfly schemes by other estimates.

pub mod cells;
pub mod deviation;
pub mod every;
pub mod regularity;
pub mod sweep;

use super::enclosed_net::EnclosedNet;
use super::family::CosineBox;
use super::outcome::{Outcome, Valences};
use super::signed::Signed;
use super::valence::{Far, net_at};
use crate::analysis::Analyzer;
use crate::analysis::exact::{ExactAnalysis, Value};
use crate::analysis::regular::mask::{Point, Sequence};
use crate::mesh::Lattice;
use crate::numbers::{Field, Free, Interval, Trouble};
use crate::refine::Obstacle;
use crate::scheme::Scheme;
use cells::{Cell, Local, Tiling};
use deviation::{Deviation, What, deviation};
use regularity::{Rows, points};
use std::collections::BTreeMap;
use std::fmt;
use sweep::{Coefficients, Sweep, Swept};

/// How a map was proved regular and injective.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivativeProof {
    /// The valences that it is proved for.
    pub valences: Valences,
    /// Valences looked at apart, and boxes of c that cover all others.
    pub boxes: Vec<CosineBox>,
    /// How many cells were tested.
    pub cells: usize,
    /// How often cells were refined at most.
    pub depth: usize,
    /// The inner radius of the ring that was covered by cells, in edges of the net.
    pub scale: i32,
}

impl fmt::Display for DerivativeProof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let boxes = self.boxes.iter().filter(|own| own.only.is_none()).count();
        let at_once = match boxes {
            0 => String::new(),
            1 => " on one box of cos(2 pi/n)".to_string(),
            _ => format!(" on {boxes} boxes of cos(2 pi/n)"),
        };
        write!(f, "for {} by enclosed derivatives on {} cells{at_once}", self.valences, self.cells)
    }
}

/// Whether the characteristic maps of these valences are regular and injective, for the subdominant eigenvalue that
/// the exact analysis finds at one valence, or that the forms have for all. Nothing is said of the spectrum of all:
/// whether lambda is subdominant at each n is a condition of its own. Refuted means that the map of some valence
/// among them, which is named, is not injective.
pub fn prove(analyzer: &Analyzer, valences: Valences) -> Outcome<DerivativeProof> {
    let attempt = |engine: &Engine| match valences {
        Valences::At(n) => engine.analysed(analyzer, n),
        Valences::From(n) => engine.from(analyzer, n),
    };
    with_engine(analyzer, attempt)
}

/// The same at one valence whose exact analysis is at hand.
pub fn prove_at(analyzer: &Analyzer, n: usize, analysis: &ExactAnalysis) -> Outcome<DerivativeProof> {
    with_engine(analyzer, |engine| engine.at(n, analysis))
}

fn with_engine(
    analyzer: &Analyzer,
    attempt: impl Fn(&Engine) -> Result<Outcome<DerivativeProof>, Obstacle>,
) -> Outcome<DerivativeProof> {
    let found = Engine::of(analyzer).and_then(|engine| match engine {
        Ok(engine) => attempt(&engine),
        Err(why) => Ok(Outcome::stuck(why)),
    });
    found.unwrap_or_else(|obstacle| Outcome::stuck(obstacle.to_string()))
}

/// What all valences of a scheme share.
pub struct Engine {
    scheme: Scheme,
    lattice: Lattice,
    mask: Sequence,
    far: Far,
    local: Local,
    /// For slopes and for values.
    bounds: [Deviation; 2],
}

/// The limits of refinement, and of the number of cells, at one valence.
const AT_ONE: (usize, usize) = (12, 300_000);

const NO_RING: &str = "rules at the extraordinary point reach into the ring";
const NO_NET: &str = "the net doesn't satisfy S f = lambda f";

impl Engine {
    /// The engine for a scheme, whose parameters have their values, or why it is of no use here.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn of(analyzer: &Analyzer) -> Result<Result<Self, String>, Obstacle> {
        let stuck = |why: &str| Ok(Err(why.to_string()));
        let regular = match analyzer.regular() {
            Ok(regular) => regular,
            Err(why) => return stuck(why),
        };
        if regular.smoothness.is(1) != Some(true) {
            return stuck("limits on regular meshes are not known to be C1");
        }
        let (lattice, mask) = (analyzer.lattice(), regular.mask.coefficients.clone());
        let same = |image: fn(Point) -> Point| mask.iter().all(|(at, weight)| mask.get(&image(*at)) == Some(weight));
        if !same(|[x, y]| [y, x]) || lattice == Lattice::Triangles && !same(|[x, y]| [-x, -y]) {
            return stuck("the regular mask changes under half a turn or in the mirror");
        }
        let tiling = Tiling { lattice, dilation: analyzer.dilation() };
        let Some(local) = Local::of(&mask, tiling)? else { return stuck("stencils reach too far") };
        let (slopes, values) = match (deviation(&local, What::Slopes), deviation(&local, What::Values)) {
            (Ok(slopes), Ok(values)) => (slopes, values),
            (Err(why), _) | (_, Err(why)) => return stuck(why),
        };
        let value = |(at, weight): (&Point, &Free)| Some((*at, Value::rational(&weight.as_rational()?)));
        let Some(rows) = mask.iter().map(value).collect() else { return stuck("a weight of the mask is no number") };
        let far = Far { mask: rows, clear: analyzer.clear_of_centre(), dilation: tiling.dilation };
        let scheme = analyzer.scheme().with_values();
        Ok(Ok(Engine { scheme, lattice, mask, far, local, bounds: [slopes, values] }))
    }

    /// The points and rows of cells.
    pub fn local(&self) -> &Local {
        &self.local
    }

    /// The net at one valence for the subdominant eigenvalue of its exact analysis; else why there is none.
    ///
    /// # Errors
    /// As [`net_at`].
    pub fn net(&self, n: usize, analysis: &ExactAnalysis) -> Result<Result<EnclosedNet<'_, Value>, String>, Obstacle> {
        net_at(&self.scheme, self.lattice, n, analysis, Some(&self.far))
    }

    /// The inner radius of the ring at one valence, or of the one that all valences have.
    fn scale(&self, n: Option<usize>) -> Result<Option<i32>, Obstacle> {
        Rows::of(&self.scheme, self.lattice, n).scale(&self.local, &self.mask, self.far.clear)
    }

    /// Tests the cells of the ring with a net, whose values are `split` into coefficients.
    fn swept<F: Signed>(
        &self,
        net: &mut EnclosedNet<F>,
        scale: i32,
        split: impl Fn(&F) -> Vec<Interval>,
        powers: Vec<Interval>,
        limits: (usize, usize),
    ) -> Result<Swept, Obstacle> {
        let cells = self.local.tiling.ring(scale);
        let mut values: BTreeMap<Point, Coefficients> = BTreeMap::new();
        for [i, j] in points(&cells, &self.local) {
            let pair = net.at(i, j)?;
            let along = net.along_axis(&pair)?;
            values.insert([i, j], [split(&pair.0), split(&pair.1), split(&along)]);
        }
        Ok(Sweep::new(&self.local, self.bounds.each_ref(), powers, limits).run(&self.with_values(&cells, &values)?))
    }

    fn proof(&self, valences: Valences, scale: i32) -> DerivativeProof {
        DerivativeProof { valences, boxes: vec![], cells: 0, depth: 0, scale }
    }

    /// The map at one valence.
    ///
    /// # Errors
    /// When a weight has no value, or a limit of size is passed.
    pub fn analysed(&self, analyzer: &Analyzer, n: usize) -> Result<Outcome<DerivativeProof>, Obstacle> {
        match analyzer.at(n)?.exact {
            Ok(analysis) => self.at(n, &analysis),
            Err(why) => Ok(Outcome::stuck(why)),
        }
    }

    /// The map at one valence whose exact analysis is at hand.
    ///
    /// # Errors
    /// As [`Engine::analysed`].
    pub fn at(&self, n: usize, analysis: &ExactAnalysis) -> Result<Outcome<DerivativeProof>, Obstacle> {
        if n < 3 {
            return Ok(Outcome::stuck("the valence is below 3"));
        }
        match self.net(n, analysis)? {
            Ok(mut net) => self.verify(n, &mut net),
            Err(why) => Ok(Outcome::stuck(why)),
        }
    }

    /// The same with a net that is given.
    ///
    /// # Errors
    /// As [`Engine::analysed`].
    pub fn verify(&self, n: usize, net: &mut EnclosedNet<Value>) -> Result<Outcome<DerivativeProof>, Obstacle> {
        let Some(scale) = self.scale(Some(n))? else { return Ok(Outcome::stuck(NO_RING)) };
        let powers = vec![Interval::point(1.0)];
        let swept = self.swept(net, scale, |value| vec![Interval::enclosing(value)], powers, AT_ONE)?;
        if !net.may_satisfy_its_equation()? {
            return Ok(Outcome::stuck(NO_NET));
        }
        Ok(match swept {
            Swept::Positive { cells, depth } => {
                let (c, lambda) = (Interval::enclosing(&net.c), Interval::enclosing(&net.lambda));
                let boxes = vec![CosineBox { only: Some(n), c, lambda }];
                Outcome::Proved(DerivativeProof { cells, depth, boxes, ..self.proof(Valences::At(n), scale) })
            }
            Swept::Fold { cell, depth } => Outcome::Refuted { witness: fold(n, scale, cell, depth) },
            Swept::Open { cell, what, .. } => Outcome::stuck(format!("{what} near {:?} of ring {scale}", cell.origin)),
        })
    }

    fn with_values<'v>(
        &self,
        cells: &[Cell],
        values: &'v BTreeMap<Point, Coefficients>,
    ) -> Result<Vec<(Cell, Vec<&'v Coefficients>)>, Trouble> {
        let missing = Trouble::BeyondThisWorld("a value of the net is missing");
        let of = |cell: &Cell| {
            let own = self.local.points.iter().map(|q| values.get(&cell.point(*q)).ok_or(missing.clone()));
            Ok((*cell, own.collect::<Result<_, Trouble>>()?))
        };
        cells.iter().map(of).collect()
    }
}

fn fold(n: usize, scale: i32, cell: Cell, depth: usize) -> String {
    let [i, j] = cell.origin;
    format!(
        "n = {n}: the Jacobian is negative in the cell at ({i}, {j}) of ring {scale}, seen after {depth} refinements; \
         so the map is not injective"
    )
}
