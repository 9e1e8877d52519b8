//! Is the characteristic map regular and injective where limits are no polynomials?
//!
//! For schemes on triangles whose regular symbol is divisible by (1 + z_1)(1 + z_2)(1 + z_1/z_2): differences along
//! each axis are refined by a scheme of their own, and those of differences along the other directions, too. So the
//! derivatives on a cell are enclosed by the differences that they depend on ([`mod@lebesgue`]), and cells are refined
//! until the Jacobian's sign is told ([`sweep`]). At one valence the net is enclosed ([`super::valence`]); for all valences at
//! once it is rational in a parameter and expanded on small intervals ([`every`], [`family`]). Zorin 2000 proves the
//! same by other estimates.

pub mod cells;
pub mod every;
pub mod family;
pub mod lebesgue;
pub mod norms;
pub mod regularity;
pub mod sweep;

use super::course::Range;
use super::enclosed_net::EnclosedNet;
use super::outcome::{Outcome, Valences};
use super::valence::net_at;
use crate::analysis::Analyzer;
use crate::analysis::exact::{ExactAnalysis, Value};
use crate::analysis::regular::factors::scaled;
use crate::analysis::regular::mask::{Point, Sequence};
use crate::mesh::Lattice;
use crate::numbers::{Field, Interval, Trouble};
use crate::refine::Obstacle;
use crate::scheme::Scheme;
use cells::{AXES, Cell, Local};
use lebesgue::{Lebesgue, differences, lebesgue};
use regularity::{Rows, points};
use std::collections::BTreeMap;
use std::fmt;
use sweep::{Coefficients, Sweep, Swept};

/// How a map was proved regular and injective.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivativeProof {
    /// The valences that it is proved for.
    pub valences: Valences,
    /// For all valences at once: which eigenvalue the map belongs to. At one it is that of the exact analysis.
    pub range: Option<Range>,
    /// The valences that were looked at one by one.
    pub singles: Vec<usize>,
    /// The number of intervals of the parameter, those of the others.
    pub boxes: usize,
    /// How many cells were tested.
    pub cells: usize,
    /// How often cells were refined at most.
    pub depth: usize,
    /// The inner radius of the ring that was covered by cells, in edges of the net.
    pub scale: i32,
    /// L for the derivatives along an axis.
    pub derivatives: Lebesgue,
    /// L_f, for the values.
    pub values: Lebesgue,
}

impl fmt::Display for DerivativeProof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at_once = match self.valences {
            Valences::At(_) => String::new(),
            Valences::From(_) => format!(" on {} intervals of a parameter", self.boxes),
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
    clear: i32,
    mask: Sequence,
    local: Local,
    derivatives: Lebesgue,
    values: Lebesgue,
}

/// The directions of the edges, each told so that it comes after 0.
const EDGES: [Point; 3] = [[1, 0], [0, 1], [1, -1]];

/// The limits of refinement, and of the number of cells, at one valence.
const AT_ONE: (usize, usize) = (9, 60_000);

const NOT_DIVISIBLE: &str = "the regular symbol lacks a factor of one of the three directions";
const NO_RING: &str = "rules at the extraordinary point reach into the ring";
const NO_NET: &str = "the net doesn't satisfy S f = lambda f";

impl Engine {
    /// The engine for a scheme, whose parameters have their values, or why it is of no use here.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn of(analyzer: &Analyzer) -> Result<Result<Self, String>, Obstacle> {
        let stuck = |why: &str| Ok(Err(why.to_string()));
        let lattice = analyzer.lattice();
        if lattice != Lattice::Triangles || analyzer.steps() != 1 || analyzer.dilation() != 2 {
            return stuck("derivatives are enclosed on triangles that each step halves");
        }
        let regular = match analyzer.regular() {
            Ok(regular) => regular,
            Err(why) => return stuck(why),
        };
        if regular.smoothness.is(1) != Some(true) {
            return stuck("limits on regular meshes are not known to be C1");
        }
        let mask = regular.mask.coefficients.clone();
        let same = |image: fn(Point) -> Point| mask.iter().all(|(at, weight)| mask.get(&image(*at)) == Some(weight));
        if !same(|[x, y]| [-x, -y]) || !same(|[x, y]| [y, x]) {
            return stuck("the regular mask changes under half a turn or in the mirror");
        }
        let Some(along) = along_axes(&mask)? else { return stuck(NOT_DIVISIBLE) };
        // in the mirror, which keeps the mask, both axes are the same
        let (derivatives, values) = (lebesgue(&along[0], &[[0, 1], [1, -1]])?, lebesgue(&mask, &EDGES)?);
        let (Some(derivatives), Some(values)) = (derivatives, values) else {
            return stuck("second differences are not seen to contract");
        };
        let Some(local) = Local::of(&mask, &along)? else { return stuck("stencils reach too far") };
        let (scheme, clear) = (analyzer.scheme().with_values(), analyzer.clear_of_centre());
        Ok(Ok(Engine { scheme, lattice, clear, mask, local, derivatives, values }))
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
        net_at(&self.scheme, self.lattice, n, analysis)
    }

    /// The inner radius of the ring at one valence, or of the one that all valences have.
    fn scale(&self, n: Option<usize>) -> Result<Option<i32>, Obstacle> {
        Rows::of(&self.scheme, self.lattice, n).scale(&self.local, &self.mask, self.clear)
    }

    fn sweep(&self, powers: Vec<Interval>, (most_depth, most_cells): (usize, usize)) -> Sweep<'_> {
        let upper = |own: &Lebesgue| Interval::around(&own.bound).hi();
        let (derivatives, values) = (upper(&self.derivatives), upper(&self.values));
        Sweep { local: &self.local, derivatives, values, powers, most_depth, most_cells }
    }

    fn proof(&self, valences: Valences, scale: i32) -> DerivativeProof {
        let (derivatives, values) = (self.derivatives.clone(), self.values.clone());
        DerivativeProof {
            valences,
            range: None,
            singles: vec![],
            boxes: 1,
            cells: 0,
            depth: 0,
            scale,
            derivatives,
            values,
        }
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
        let cells = Cell::ring(scale);
        let mut values: BTreeMap<Point, Coefficients> = BTreeMap::new();
        for [i, j] in points(&cells, &self.local) {
            let (a, b) = net.at(i, j)?;
            values.insert([i, j], [a, b].map(|own| vec![Interval::enclosing(&own)]));
        }
        if !net.may_satisfy_its_equation()? {
            return Ok(Outcome::stuck(NO_NET));
        }
        let swept = self.sweep(vec![Interval::point(1.0)], AT_ONE).run(&self.with_values(&cells, &values)?);
        Ok(match swept {
            Swept::Positive { cells, depth } => {
                Outcome::Proved(DerivativeProof { cells, depth, ..self.proof(Valences::At(n), scale) })
            }
            Swept::Fold { cell, depth } => Outcome::Refuted { witness: fold(n, scale, cell, depth) },
            Swept::Open { cell, what } => Outcome::stuck(format!("{what} near {:?} of ring {scale}", cell.origin)),
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

/// The masks of twice the differences along both axes; `None` where the mask lacks a factor.
fn along_axes(mask: &Sequence) -> Result<Option<[Sequence; 2]>, Trouble> {
    let twice = |own: Sequence| scaled(&own, &Field::whole(2));
    let [Some(first), Some(second)] = [differences(mask, AXES[0])?, differences(mask, AXES[1])?] else {
        return Ok(None);
    };
    Ok(Some([twice(first)?, twice(second)?]))
}

fn fold(n: usize, scale: i32, cell: Cell, depth: usize) -> String {
    let [i, j] = cell.origin;
    format!(
        "n = {n}: the Jacobian is negative in the triangle at ({i}, {j}) of ring {scale}, seen after {depth} refinements; \
         so the map is not injective"
    )
}
