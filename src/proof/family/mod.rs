//! What are the nets of all valences from one on, by boxes of c?
//!
//! n enters the net through c = cos(2 pi/n) alone, which lies in [cos(2 pi/n_0), 1]. That range is covered by boxes; on
//! each, everything is a Taylor form in c ([`taylor`]), the subdominant eigenvalue too ([`root`]). A box where a test doesn't tell is halved.

pub mod root;
pub mod taylor;

use crate::analysis::Analyzer;
use crate::analysis::exact::Value;
use crate::analysis::exact::block::{Block, Wave};
use crate::analysis::exact::formulas::{AllValences, GENERIC, at};
use crate::analysis::neighbourhood::Orbit;
use crate::mesh::{Label, Patch};
use crate::numbers::linear::{Matrix, part, shifted};
use crate::numbers::roots::roots;
use crate::numbers::{C, Field, Free, FreeWorld, Interval, N, PerFrequency, Trouble, Univariate};
use crate::proof::enclosed_net::EnclosedNet;
use crate::proof::kernel::null_vector;
use crate::proof::net::placed;
use crate::refine::{Count, ExactWeights, Obstacle, Refinement};
use crate::scheme::Scheme;
use dashu_ratio::RBig;
use root::largest_root;
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;
use taylor::Taylor;

/// What a scheme's nets of all valences have in common.
pub struct Family<'s> {
    forms: &'s AllValences,
    subdominant: &'s Univariate<Free>,
    block: Block<Free>,
    patch: Patch,
    refinement: Refinement<'s, PerFrequency<Free>>,
    rows: RefCell<BTreeMap<Orbit, Rc<Row>>>,
}

/// Old points with their weights at frequency 1.
type Row = Vec<(Label, Free)>;

/// The world of n and c; parameters have their values.
static WORLD: FreeWorld = FreeWorld { parameters: Vec::new() };

/// Boxes are halved so often.
const MOST_HALVINGS: u32 = 14;

/// A box of c = cos(2 pi/n), with where lambda lies on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CosineBox {
    /// The one valence that it is about; `None` for all that have no box of their own.
    pub only: Option<usize>,
    /// c.
    pub c: Interval,
    /// lambda.
    pub lambda: Interval,
}

/// Why a test does not hold on a box.
#[derive(Clone, Debug, PartialEq)]
pub struct Open {
    /// What isn't seen.
    pub why: String,
    /// Whether smaller boxes can't help.
    pub for_good: bool,
}

impl Open {
    /// It may hold on smaller boxes.
    pub fn yet(why: impl Into<String>) -> Open {
        Open { why: why.into(), for_good: false }
    }
}

impl From<Obstacle> for Open {
    fn from(obstacle: Obstacle) -> Open {
        Open::yet(obstacle.to_string())
    }
}

impl<'s> Family<'s> {
    /// The family of a scheme whose parameters have values, or why there is none.
    ///
    /// # Errors
    /// When a limit of size is passed.
    pub fn of(analyzer: &'s Analyzer, scheme: &'s Scheme) -> Result<Result<Family<'s>, String>, Obstacle> {
        let forms = match analyzer.forms() {
            Ok(forms) => forms,
            Err(why) => return Ok(Err(why.to_string())),
        };
        let stuck = |why: &str| Ok(Err(why.to_string()));
        if !forms.parameters.is_empty() {
            return stuck("a parameter is left free");
        }
        let Some(subdominant) = &forms.subdominant else {
            return stuck("the subdominant eigenvalue has no form for all n");
        };
        let block = Block::of(&forms.rows, Some(1), Wave::Cosine(Free::variable(C)))?;
        let mut entries = block.matrix.iter().flatten().chain(subdominant.coefficients());
        if !entries.all(in_cosine_alone) {
            return stuck("a weight of frequency 1 depends on n in other ways than through c");
        }
        let count = Count::Free { n: Free::variable(N), like: GENERIC };
        let weights = ExactWeights::new(&WORLD, count, GENERIC, Rc::new(Cell::new(0)));
        Ok(Ok(Family {
            forms,
            subdominant,
            block,
            patch: Patch::new(analyzer.lattice(), GENERIC),
            refinement: Refinement::weighed(scheme, weights),
            rows: RefCell::default(),
        }))
    }

    /// The least valence that the forms hold at.
    pub fn from(&self) -> usize {
        self.forms.from.max(3)
    }

    /// A valence with rules of its own.
    pub fn except(&self) -> Option<usize> {
        self.forms.except
    }

    fn row(&self, label: Label) -> Result<Rc<Row>, Obstacle> {
        if let (0, Some(known)) = (label.sector, self.rows.borrow().get(&label.orbit())) {
            return Ok(Rc::clone(known));
        }
        let own = self.refinement.row(&self.patch, label)?;
        let row: Row = own.into_iter().map(|(old, weight)| (old, weight.value(Some(1)).clone())).collect();
        if !row.iter().all(|(_, weight)| in_cosine_alone(weight)) {
            return Err(Obstacle::Limit(
                "a weight of frequency 1 depends on n in other ways than through c".to_string(),
            ));
        }
        let row = Rc::new(row);
        if label.sector == 0 {
            self.rows.borrow_mut().insert(label.orbit(), Rc::clone(&row));
        }
        Ok(row)
    }

    /// The net over the box of c from m - r to m + r; `None` where the eigenvalue isn't enclosed.
    ///
    /// # Errors
    /// When Taylor forms are too wide.
    pub fn net(&self, m: f64, r: f64) -> Result<Option<EnclosedNet<'_, Taylor>>, Obstacle> {
        let c = Taylor::variable(m, r);
        let Some(start) = self.largest_root_at(m)? else { return Ok(None) };
        let Some(lambda) = largest_root(&at(self.subdominant, &in_place_of_c(&c))?, start)? else { return Ok(None) };
        if !lambda.range().is_positive() || lambda.range().hi() >= 1.0 {
            return Ok(None);
        }
        let values = in_place_of_c(&c);
        let entry = |value: &Free| value.evaluate(&values);
        let matrix: Matrix<Taylor> = self
            .block
            .matrix
            .iter()
            .map(|row| row.iter().map(entry).collect::<Result<_, _>>())
            .collect::<Result<_, Trouble>>()?;
        let all: Vec<usize> = (0..matrix.len()).collect();
        let vector = null_vector(&shifted(&part(&matrix, &all), &lambda)?)?;
        let values = placed(&self.block.unknowns, &vector, &self.forms.rows, &c)?;
        let row = move |(i, j): Orbit| {
            let here = in_place_of_c(&c);
            let row = self.row(Label { sector: 0, i, j })?;
            row.iter().map(|(old, weight)| Ok((*old, weight.evaluate(&here)?))).collect()
        };
        Ok(Some(EnclosedNet::new(self.patch, c, lambda, values, Box::new(row))?))
    }

    /// A number near the largest real root of the subdominant polynomial at one c.
    fn largest_root_at(&self, c: f64) -> Result<Option<f64>, Trouble> {
        let c = Value::from_f64(c)?;
        let mut values = vec![Value::whole(0); 6];
        values[C] = c;
        let found = roots(at(self.subdominant, &values)?.coefficients())?;
        let real = found.iter().filter(|root| root.is_real()).map(|root| root.re.midpoint_f64());
        Ok(real.max_by(f64::total_cmp))
    }

    /// Covers the c of every n from `first` on by boxes on which a test of the net holds, or tells the one that is left open.
    ///
    /// # Errors
    /// The interval of c, and what isn't seen there.
    pub fn cover(
        &self,
        first: usize,
        mut test: impl FnMut(&mut EnclosedNet<Taylor>) -> Result<(), Open>,
    ) -> Result<Vec<CosineBox>, (Interval, String)> {
        let mut boxes = Vec::new();
        let mut open = vec![(low_end(first), 1.0, 0)];
        while let Some((low, high, halvings)) = open.pop() {
            let (m, c) = (0.5 * (low + high), Interval::point(low).hull(Interval::point(high)));
            match self.on_box(low, high, &mut test) {
                Ok(lambda) => boxes.push(CosineBox { only: None, c, lambda }),
                Err(own) if own.for_good || halvings == MOST_HALVINGS => return Err((c, own.why)),
                // the part of large n first
                Err(_) => open.extend([(low, m, halvings + 1), (m, high, halvings + 1)]),
            }
        }
        Ok(boxes)
    }

    /// Where lambda lies on a box of c, if the test holds there.
    fn on_box(
        &self,
        low: f64,
        high: f64,
        test: &mut impl FnMut(&mut EnclosedNet<Taylor>) -> Result<(), Open>,
    ) -> Result<Interval, Open> {
        let (m, r) = (0.5 * (low + high), 0.5 * (high - low));
        let mut net = self.net(m, r)?.ok_or_else(|| Open::yet("the eigenvalue isn't enclosed"))?;
        test(&mut net)?;
        match net.may_satisfy_its_equation()? {
            true => Ok(net.lambda.range()),
            false => Err(Open::yet("the net doesn't satisfy S f = lambda f")),
        }
    }
}

fn in_cosine_alone(value: &Free) -> bool {
    (0..6).all(|index| index == C || !value.mentions(index))
}

fn in_place_of_c(c: &Taylor) -> Vec<Taylor> {
    let mut values = vec![Taylor::whole(0); 6];
    values[C] = *c;
    values
}

/// A number at most cos(2 pi/n), with so few digits that halving stays exact.
fn low_end(n: usize) -> f64 {
    let turn = Value::rational(&(RBig::from(2) / RBig::from(n)));
    let low = Value::pi().times(&turn).map(|angle| angle.cos().lo_hi().0);
    let parts = low.map_or(-1024, |low| {
        let parts = (low * RBig::from(1024)).floor();
        i32::try_from(parts).unwrap_or(-1024)
    });
    f64::from(parts) / 1024.0
}
