//! What do a scheme's rules say of one step: on the regular lattice, and at the extraordinary point?
//!
//! Names mean what schemes/vocabulary.toml says. Regular rules must make the quartic box spline on triangles, bicubic
//! splines on quads, biquadratic ones on dual quads: so only the rule at the centre tells one scheme from another.

use crate::formula::{Count, Reader};
use crate::polynomial::{C, Poly, Z};
use crate::{Refusal, beyond};
use dashu_ratio::RBig;
use std::cell::Cell;
use std::collections::BTreeMap;
use toml::{Table, Value};

/// A point of sector 0, unfolded: (0, 0) is the centre, on dual quads the first point beside the central face.
pub(crate) type Index = (i32, i32);

/// What the extraordinary point is: a vertex of triangles, a vertex of quads, a face of quads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lattice {
    Triangles,
    Quads,
    Dual,
}
use Lattice::{Dual, Quads, Triangles};

/// A scheme of single-pass rules in the interior that are regular away from the centre.
pub(crate) struct Scheme {
    pub(crate) lattice: Lattice,
    rules: Table,
    lets: Table,
}

impl Lattice {
    /// The spline's row of a new point: weights by new index less twice the old one, by averaging over directions.
    pub(crate) fn row(self, (a, b): Index) -> Vec<(Index, Poly)> {
        let (directions, times, start): (&[Index], _, _) = match self {
            Triangles => (&[(1, 0), (0, 1), (-1, 1)], 2, (0, -2)),
            Quads => (&[(1, 0), (0, 1)], 4, (-2, -2)),
            Dual => (&[(1, 0), (0, 1)], 3, (-1, -1)),
        };
        let mut mask = BTreeMap::from([(start, RBig::from(4) / RBig::from(1 << (times * directions.len())))]);
        for (x, y) in directions.repeat(times) {
            for ((a, b), weight) in mask.clone() {
                *mask.entry((a + x, b + y)).or_insert(RBig::ZERO) += weight;
            }
        }
        let near = mask.into_iter().filter(|((x, y), _)| (a - x) % 2 == 0 && (b - y) % 2 == 0);
        near.map(|((x, y), own)| (((a - x) / 2, (b - y) / 2), Poly::number(own))).collect()
    }
}

impl Scheme {
    pub(crate) fn new(mut rules: Table) -> Result<Scheme, Refusal> {
        let lets = rules.remove("let").and_then(|own| own.try_into().ok()).unwrap_or_default();
        let word = |key: &str| rules.get(key).and_then(Value::as_str).unwrap_or_default();
        let (lattice, kinds): (_, &[&str]) = match (word("mesh"), word("split")) {
            ("triangles", "1-to-4") => (Triangles, &["vertex", "edge"]),
            ("quads" | "polygons", "1-to-n") => (Quads, &["vertex", "edge", "face"]),
            ("quads" | "polygons", "dual") => (Dual, &["corner"]),
            _ => return beyond("its mesh and split"),
        };
        if let Some(key) = rules.keys().find(|key| ![&["mesh", "split"], kinds].concat().contains(&key.as_str())) {
            return beyond(format!("the key `{key}` of the scheme"));
        }
        let scheme = Scheme { lattice, rules, lets };
        if scheme.is_regular() == Some(true) {
            Ok(scheme)
        } else {
            beyond("its words, or its rules where all is regular")
        }
    }

    /// The weights of a rule that has no other names than these; 0 where a name is missing.
    fn rule<const N: usize>(&self, kind: &str, names: [&str; N], count: Option<Count>) -> Option<[Poly; N]> {
        let known = |own: &&Table| own.keys().all(|key| names.contains(&key.as_str()));
        let rule = self.rules.get(kind)?.as_table().filter(known)?;
        let weight = |name| {
            rule.get(name).map_or(Some(Poly::default()), |own| Reader(&self.lets, count, Cell::new(400)).read(own))
        };
        names.map(weight).into_iter().collect::<Option<Vec<Poly>>>()?.try_into().ok()
    }

    /// Whether the weights are the spline's where all is regular.
    fn is_regular(&self) -> Option<bool> {
        let n = if self.lattice == Triangles { 6 } else { 4 };
        let (count, part) = (Count { n, tail: false }, |above: i64, below: i64| RBig::from(above) / RBig::from(below));
        let row = |k: i64| Some(self.centre(k, count)?.into_iter().map(|(_, own)| own).collect::<Vec<_>>());
        let (own, numbers): (Vec<Poly>, &[(i64, i64)]) = match self.lattice {
            Triangles => {
                let edge = self.rule("edge", ["ends", "opposite"], None)?;
                ([&edge, &row(0)?[..]].concat(), &[(3, 8), (1, 8), (5, 8), (3, 8)])
            }
            Quads => {
                let [ends, faces] = self.rule("edge", ["ends", "new faces"], None)?;
                let corners = self.rule("face", ["corners"], Some(count))?;
                // each of the two faces has both ends
                let edge = [&ends + &faces.scaled(part(1, 2)), faces.scaled(part(1, 4))];
                ([&corners[..], &edge, &row(0)?].concat(), &[(1, 4), (3, 8), (1, 16), (9, 16), (3, 8), (1, 16)])
            }
            // even weights are known by these sums
            Dual => {
                let sums = [(0, 1), (1, 0), (2, -1)].map(|(k, c)| Some(row(k)?[0].with(C, &Poly::number(c))));
                (sums.into_iter().collect::<Option<_>>()?, &[(1, 1), (1, 2), (1, 4)])
            }
        };
        let cosine = Poly::number(if n == 6 { part(1, 2) } else { RBig::ZERO });
        let wanted = numbers.iter().map(|(above, below)| Some(part(*above, *below)));
        Some(own.iter().map(|own| own.with(C, &cosine).as_number()).eq(wanted))
    }

    /// The row of (0, 0) in c_k, weights of all sectors at points of sector 0: of a centre at frequency 0 only.
    pub(crate) fn centre(&self, k: i64, count: Count) -> Option<Vec<(Index, Poly)>> {
        let (n, part) = (count.value(), |below: i64| RBig::ONE / RBig::from(below));
        let row = match self.lattice {
            Triangles => {
                let [centre, ring] = self.rule("vertex", ["centre", "ring"], Some(count))?;
                vec![((0, 0), centre), ((1, 0), &ring * &n)]
            }
            // a new point of a face has weights 1/4, two of them in the ring
            Quads => {
                let [centre, ring, faces] = self.rule("vertex", ["centre", "ring", "new faces"], Some(count))?;
                let quarter = &faces.scaled(part(4)) * &n;
                vec![((0, 0), &centre + &quarter), ((1, 0), &(&ring * &n) + &quarter.scaled(2)), ((1, 1), quarter)]
            }
            // a cosine of the place is that of frequency 1, and what is told of two neighbours is twice a cosine
            Dual => {
                let [own, near, all] = self.rule("corner", ["itself", "ring[-1,1]", "ring"], Some(count))?;
                let cosine = if k == 0 { Poly::number(1) } else { Poly::power_of(C, 1) };
                let sum = match (k, &all.by_power(Z)[..]) {
                    (0, [all] | [all, _]) => all * &n,
                    (1, [_, all]) => &all.scaled(part(2)) * &n,
                    (_, all) => Some(Poly::default()).filter(|_| all.len() < 3)?,
                };
                let told = [&own, &near, &all].iter().any(|own| own.has(C));
                vec![((0, 0), Some(&(&own + &(&near * &cosine.scaled(2))) + &sum).filter(|_| !told)?)]
            }
        };
        Some(row).filter(|row| row.iter().all(|(_, own)| !own.has(Z)))
    }
}
