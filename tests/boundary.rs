//! Is the analysis at a boundary, crease, corner and dart vertex right: by its equations, by two ways, on a mesh, by known values?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::Analyzer;
use eigenring::analysis::boundary::halves::{Halves, MirrorNode, Parity};
use eigenring::analysis::boundary::masks::{FanMask, TangentMasks};
use eigenring::analysis::boundary::{BoundaryAnalysis, BoundaryAnalyzer, MAX_FACES};
use eigenring::analysis::cores::Cores;
use eigenring::analysis::spectrum::{Eigenvalue, Spectrum};
use eigenring::mesh::{Connectivity, Crease, Fan, FanKind, HalfEdgeMesh, Label, Lattice, Tagged, Tags};
use eigenring::refine::{Obstacle, Refinement, Refiner, Row, cycle_of, lattice_of};
use eigenring::report::boundary as report_of;
use eigenring::report::{self, Study};
use eigenring::scheme::{RuleBook, Scheme, catalogue};
use nalgebra::{DMatrix, DVector};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

const SCHEMES: [&str; 5] = ["loop", "loop-warren", "catmull-clark", "sqrt3", "four-eight"];

/// A scheme with its first boundary file, or with the one named: `loop/hoppe-1994`.
fn open(name: &str) -> (Scheme, RuleBook) {
    let (id, rules) = name.split_once('/').unwrap_or((name, ""));
    let scheme = catalogue::open(id).unwrap().unwrap();
    let rules = if rules.is_empty() { &scheme.boundary[0] } else { rules };
    let book = catalogue::boundary(rules, &scheme.mesh).unwrap().unwrap();
    (scheme, book)
}

/// Every scheme with every boundary file that it names.
fn variants() -> Vec<String> {
    let of = |id: &str| {
        let scheme = catalogue::open(id).unwrap().unwrap();
        scheme.boundary.iter().map(|rules| format!("{id}/{rules}")).collect::<Vec<_>>()
    };
    SCHEMES.into_iter().flat_map(of).collect()
}

fn crease(faces: usize) -> FanKind {
    FanKind::Crease { faces }
}

fn corner(faces: usize) -> FanKind {
    FanKind::Corner { faces }
}

fn dart(faces: usize) -> FanKind {
    FanKind::Dart { faces }
}

/// Kinds of every sort, the regular ones and both parities of the number of faces among them; darts where creases can run inside a mesh.
fn kinds(scheme: &Scheme) -> Vec<FanKind> {
    let creases = [1, 2, 3, 4, 5, 6, 7, 11].map(crease);
    let corners = [1, 2, 3, 4, 5].map(corner);
    let darts = [3, 4, 5, 6, 7, 8].into_iter().filter(|_| cycle_of(scheme).unwrap().keeps_edges()).map(dart);
    creases.into_iter().chain(corners).chain(darts).collect()
}

/// Numbers between -1 and 1, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self, size: usize) -> DVector<f64> {
        DVector::from_fn(size, |_, _| self.next())
    }
}

fn index(analysis: &BoundaryAnalysis, label: Label) -> usize {
    analysis.local.index(label).unwrap()
}

/// A mask as a row vector on all points.
fn spread(analysis: &BoundaryAnalysis, mask: &FanMask) -> DVector<f64> {
    let mut row = DVector::zeros(analysis.local.size());
    mask.iter().for_each(|(label, weight)| row[index(analysis, *label)] = *weight);
    row
}

fn each(mut visit: impl FnMut(&str, &BoundaryAnalysis)) {
    for name in variants() {
        let (scheme, book) = open(&name);
        let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
        for kind in kinds(&scheme) {
            visit(&format!("{name} {kind:?}"), &analyzer.at(kind).unwrap());
        }
    }
}

/// Every point that influences the points of a level on the faces around the centre, by walking the rules alone.
fn traced(refinement: &Refinement<f64>, fan: Fan, levels: u32) -> BTreeSet<Label> {
    let on_faces = |last: i32| {
        let orbits = (1..=last).flat_map(move |i| (0..=last).map(move |j| (i, j)));
        let orbits = orbits.filter(move |(i, j)| fan.lattice().ring(*i, *j) <= last);
        let all = orbits.flat_map(move |(i, j)| (0..=fan.sectors()).map(move |sector| Label { sector, i, j }));
        let there = move |label: &Label| label.sector < fan.sectors() || !fan.kind().is_closed() && label.j == 0;
        all.filter(there).chain([fan.centre()])
    };
    let dilation = refinement.cycle().unwrap().dilation;
    let mut points: BTreeSet<Label> = on_faces(dilation.pow(levels)).collect();
    for _ in 0..levels {
        let rows = points.iter().flat_map(|label| refinement.row(&fan, *label).unwrap());
        points = rows.map(|(old, _)| old).collect();
    }
    points
}

#[test]
fn the_neighbourhood_is_every_point_of_influence() {
    for id in SCHEMES {
        let (scheme, book) = open(id);
        let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
        let refinement = Refinement::new(&scheme, Some(&book));
        let cycle = cycle_of(&scheme).unwrap();
        let levels = if cycle.dilation == 3 { [3, 4] } else { [4, 5] };
        let tried = [crease(1), crease(2), crease(4), corner(1), corner(3), dart(3), dart(5)];
        for kind in tried.into_iter().filter(|kind| cycle.keeps_edges() || !kind.is_closed()) {
            let local = analyzer.local_matrix(kind).unwrap();
            let own: BTreeSet<Label> = local.labels.iter().copied().collect();
            levels.iter().for_each(|levels| assert_eq!(own, traced(&refinement, local.fan, *levels), "{id} {kind:?}"));
        }
        // inside, one more ring than the faces around the centre have; by sqrt(3) and 4-8 one more than that (1 + 6 n, 1 + 12 n points)
        let (per_face, along) = match id {
            "catmull-clark" => (6, 2),
            "sqrt3" => (6, 1),
            "four-eight" => (11, 3),
            _ => (3, 2),
        };
        for k in [1, 2, 3, 9, 64] {
            assert_eq!(analyzer.local_matrix(crease(k)).unwrap().size(), 1 + along + per_face * k, "{id} {k}");
            if cycle.keeps_edges() {
                assert_eq!(analyzer.local_matrix(dart(k.max(3))).unwrap().size(), 1 + per_face * k.max(3));
            }
        }
    }
}

#[test]
fn vectors_satisfy_their_equations() {
    each(|here, analysis| {
        let (dense, spectrum) = (analysis.local.dense(), &analysis.spectrum);
        let mut tested = 0;
        for e in spectrum.eigenvalues.iter().filter(|e| e.is_isolated() && e.real().is_some()) {
            let (right, _) = spectrum.right_vector(&analysis.halves, &analysis.cores, e).unwrap();
            let (left, _) = spectrum.left_vector(&analysis.halves, &analysis.cores, e).unwrap();
            let (right, left) = (DVector::from_vec(right), DVector::from_vec(left));
            assert!((&dense * &right - &right * e.value.re).amax() < 1e-13 * right.amax(), "{here} {e:?}");
            assert!((dense.tr_mul(&left) - &left * e.value.re).amax() < 1e-13 * left.amax(), "{here} {e:?}");
            let sign = if Parity::of_part(e.frequency) == Parity::Even { 1.0 } else { -1.0 };
            for (own, image) in analysis.local.mirror.iter().enumerate() {
                assert!((right[own] - sign * right[*image]).abs() < 1e-13, "{here} {e:?}");
                assert!((left[own] - sign * left[*image]).abs() < 1e-13, "{here} {e:?}");
            }
            tested += 1;
        }
        assert!(tested >= 3, "{here}: {tested}");
        for mask in analysis.limit_mask.iter().chain(analysis.tangent_masks.iter().flat_map(|own| &own.masks)) {
            let row = spread(analysis, mask);
            let image = dense.tr_mul(&row);
            let lambda = image.dot(&row) / row.norm_squared();
            assert!((image - row * lambda).amax() < 1e-12, "{here}");
        }
    });
}

#[test]
fn the_parts_rebuild_the_matrix() {
    each(|here, analysis| {
        let (dense, halves) = (analysis.local.dense(), &analysis.halves);
        let (mut rebuilt, mut trace) = (DMatrix::zeros(dense.nrows(), dense.nrows()), 0.0);
        for to in halves.nodes() {
            for from in halves.nodes() {
                let even = halves.entry(Parity::Even, *to, *from).unwrap();
                let odd = halves.entry(Parity::Odd, *to, *from).unwrap();
                match (from.image(), to.image()) {
                    (None, _) => rebuilt[(to.point(), from.point())] = even,
                    (Some(image), _) => {
                        rebuilt[(to.point(), from.point())] = (even + odd) / 2.0;
                        rebuilt[(to.point(), image)] = (even - odd) / 2.0;
                    }
                }
            }
            trace += match *to {
                MirrorNode::Fixed(_) => halves.entry(Parity::Even, *to, *to).unwrap(),
                MirrorNode::Pair(..) => {
                    halves.entry(Parity::Even, *to, *to).unwrap() + halves.entry(Parity::Odd, *to, *to).unwrap()
                }
            };
        }
        for node in halves.nodes() {
            if let MirrorNode::Pair(point, image) = *node {
                for column in 0..dense.nrows() {
                    rebuilt[(image, column)] = rebuilt[(point, analysis.local.mirror[column])];
                }
            }
        }
        assert!((&rebuilt - &dense).amax() < 1e-15, "{here}");
        assert!((trace - dense.trace()).abs() < 1e-13, "{here}");
    });
}

/// The sums of powers of all eigenvalues are the traces of the matrix's powers.
#[test]
fn eigenvalues_have_the_sums_of_powers_of_the_matrix() {
    each(|here, analysis| {
        let dense = analysis.local.dense();
        assert_eq!(analysis.spectrum.eigenvalues.len(), analysis.local.size(), "{here}");
        let mut power = dense.clone();
        for p in 1..8 {
            let sum: f64 = analysis.spectrum.eigenvalues.iter().map(|e| e.value.powi(p).re).sum();
            assert!((sum - power.trace()).abs() < 1e-10, "{here} {p}");
            power *= &dense;
        }
    });
}

/// The mirror alone gives the spectrum inside, too: there the analysis by frequencies tells the same.
#[test]
fn inside_the_mirror_and_the_rotation_agree() {
    for id in ["loop", "catmull-clark", "modified-butterfly"] {
        let scheme = catalogue::open(id).unwrap().unwrap();
        let analyzer = Analyzer::new(&scheme).unwrap();
        for n in [3, 4, 5, 6, 7, 9] {
            let analysis = analyzer.at(n).unwrap();
            let (local, patch) = (&analysis.local, analysis.local.patch);
            let labels: BTreeMap<Label, usize> = (0..local.size()).map(|row| (local.label(row), row)).collect();
            let mirror: Vec<usize> = labels
                .len()
                .checked_sub(1)
                .map_or(vec![], |last| (0..=last).map(|row| labels[&patch.mirrored(local.label(row))]).collect());
            let halves = Halves::of((0..local.size()).map(|row| local.row(row)).collect(), &mirror);
            let cores = Cores::of(&halves);
            let spectrum = Spectrum::of(&halves, &cores).unwrap();
            let whole: Vec<f64> = analysis
                .spectrum
                .eigenvalues
                .iter()
                .flat_map(|e| vec![e.modulus(); e.multiplicity(n) / e.cluster])
                .collect();
            let own: Vec<f64> = spectrum.eigenvalues.iter().map(Eigenvalue::modulus).collect();
            let sorted = |mut values: Vec<f64>| {
                values.sort_by(f64::total_cmp);
                values
            };
            let (whole, own) = (sorted(whole), sorted(own));
            assert_eq!(whole.len(), own.len(), "{id} {n}");
            // Jordan blocks of the butterfly at n = 6 cost a third of the digits
            let apart = whole.iter().zip(&own).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-4, "{id} {n}: {apart}");
            assert!(n == 6 || apart < 1e-7, "{id} {n}: {apart}");
            let mask = analysis.limit_mask.as_ref().unwrap().weights(local);
            let (left, _) = spectrum.left_vector(&halves, &cores, &spectrum.one().unwrap()).unwrap();
            let sum: f64 = left.iter().sum();
            for (label, weight) in mask {
                assert!((left[labels[&label]] / sum - weight).abs() < 1e-12, "{id} {n}");
            }
        }
    }
}

/// A mesh of polygons around a fan: its vertices are the labels within some rings.
struct Piece {
    mesh: HalfEdgeMesh,
    tags: Tags,
    vertices: BTreeMap<Label, u32>,
}

impl Piece {
    fn of(fan: Fan, rings: i32) -> Piece {
        let ring = |label: Label| fan.lattice().ring(label.i, label.j);
        let (mut faces, mut seen) = (BTreeSet::new(), BTreeSet::from([fan.centre()]));
        let mut new = vec![fan.spoke(0)];
        while let Some(edge) = new.pop() {
            for edge in fan.around_vertex(edge) {
                let (target, twin) = (fan.target(edge), fan.twin(edge));
                if ring(target) <= rings && seen.insert(target) {
                    new.push(twin);
                }
                if fan.has_face(edge) {
                    let corners: Vec<Label> = fan.around_face(edge).into_iter().map(|edge| fan.origin(edge)).collect();
                    let first = (0..corners.len()).min_by_key(|at| corners[*at]).unwrap();
                    let turned: Vec<Label> = corners[first..].iter().chain(&corners[..first]).copied().collect();
                    faces.insert(turned);
                }
            }
        }
        let whole: Vec<&Vec<Label>> = faces.iter().filter(|face| face.iter().all(|c| ring(*c) <= rings)).collect();
        let used: BTreeSet<Label> = whole.iter().flat_map(|face| face.iter().copied()).collect();
        let vertices: BTreeMap<Label, u32> = used.into_iter().zip(0..).collect();
        let lists: Vec<Vec<usize>> =
            whole.iter().map(|face| face.iter().map(|corner| vertices[corner] as usize).collect()).collect();
        let mesh = HalfEdgeMesh::from_faces(vertices.len(), &lists).unwrap();
        let along = |i: i32| vertices[&if i == 0 { fan.centre() } else { Label { sector: 0, i, j: 0 } }];
        let creases: Vec<Crease> = match fan.kind() {
            FanKind::Dart { .. } => {
                (0..rings).map(|i| Crease { ends: [along(i), along(i + 1)], sharpness: f64::INFINITY }).collect()
            }
            _ => vec![],
        };
        let corners = if matches!(fan.kind(), FanKind::Corner { .. }) { vec![along(0)] } else { vec![] };
        let tags = Tags::new(&mesh, &creases, &corners).unwrap();
        Piece { mesh, tags, vertices }
    }

    /// How the points of the refined fan near the centre are made of vertices of the mesh, by refining that: the same walks on both lead to
    /// the same points.
    fn rows(&self, fan: Fan, refiner: &Refiner) -> BTreeMap<Label, Row<u32, f64>> {
        let chain = refiner.chain(&self.mesh, &self.tags, refiner.steps_of_cycle()).unwrap();
        let tagged = Tagged { mesh: &chain.mesh, tags: &chain.tags, beyond: 0.0 };
        let start = chain.mesh.vertex_edges()[self.vertices[&fan.centre()] as usize];
        let sharp = tagged.sharp_spokes(start);
        let first = *sharp.iter().find(|spoke| sharp.len() == 1 || tagged.has_face(**spoke)).unwrap();
        let mut at = BTreeMap::new();
        let mut waiting = vec![(fan.spoke(0), first)];
        while let Some((edge, own)) = waiting.pop() {
            let (label, vertex) = (fan.origin(edge), tagged.origin(own));
            if fan.lattice().ring(label.i, label.j) > 3 {
                continue;
            }
            match at.insert(label, vertex) {
                Some(known) => assert_eq!(known, vertex, "{label:?}"),
                None => {
                    let (around, own) = (fan.around_vertex(edge), tagged.around_vertex(own));
                    assert_eq!(around.len(), own.len(), "{label:?}");
                    waiting.extend(around.iter().zip(&own).map(|(edge, own)| (fan.twin(*edge), tagged.twin(*own))));
                }
            }
        }
        at.into_iter().map(|(label, vertex)| (label, chain.row(vertex).unwrap())).collect()
    }
}

/// One step of refinement of a mesh of polygons with random points: masks see the same before and after, up to their eigenvalue.
#[test]
fn masks_survive_a_step_on_a_mesh() {
    each(|here, analysis| {
        let (scheme, book) = open(here.split(' ').next().unwrap());
        let refiner = Refiner::new(&scheme, Some(&book)).unwrap();
        let piece = Piece::of(analysis.fan, 5);
        let rows = piece.rows(analysis.fan, &refiner);
        let points = Random(7).vector(piece.vertices.len());
        let old = |label: &Label| points[piece.vertices[label] as usize];
        let new =
            |label: &Label| rows[label].iter().map(|(vertex, weight)| weight * points[*vertex as usize]).sum::<f64>();
        let applied = |mask: &FanMask, at: &dyn Fn(&Label) -> f64| mask.iter().map(|(p, w)| w * at(p)).sum::<f64>();
        let limit = analysis.limit_mask.as_ref().unwrap();
        assert!((limit.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-14, "{here}");
        assert!((applied(limit, &old) - applied(limit, &new)).abs() < 1e-13, "{here}");
        if let Ok(TangentMasks { masks, eigenvalues, .. }) = &analysis.tangent_masks {
            for (mask, e) in masks.iter().zip(eigenvalues) {
                assert!((applied(mask, &old) * e.value.re - applied(mask, &new)).abs() < 1e-13, "{here}");
                assert!(mask.iter().map(|(_, weight)| weight).sum::<f64>().abs() < 1e-13, "{here}");
            }
        }
        for (label, row) in analysis.local.labels.iter().zip(&analysis.local.rows) {
            let own: f64 = row.iter().map(|(column, weight)| weight * old(&analysis.local.labels[*column])).sum();
            assert!((own - new(label)).abs() < 1e-14, "{here} {label:?}");
        }
    });
}

/// The limit mask along a crease: of a cubic B-spline at a knot, by Hoppe et al. 1994 another beside irregular faces.
fn crease_mask(here: &str, faces: usize) -> [(f64, &'static str); 2] {
    let special = here.contains("hoppe-1994") && faces != 3;
    if special { [(3.0 / 5.0, "3/5"), (1.0 / 5.0, "1/5")] } else { [(2.0 / 3.0, "2/3"), (1.0 / 6.0, "1/6")] }
}

/// Limit masks along a crease; a corner stays.
#[test]
fn limit_masks_are_the_known_ones() {
    each(|here, analysis| {
        let mut wanted: FanMask = match analysis.fan.kind() {
            FanKind::Crease { faces } => {
                let [(own, _), (other, _)] = crease_mask(here, faces);
                let end = |sector| (Label { sector, i: 1, j: 0 }, other);
                vec![(analysis.fan.centre(), own), end(0), end(faces as u32)]
            }
            FanKind::Corner { .. } => vec![(analysis.fan.centre(), 1.0)],
            FanKind::Dart { .. } => return,
        };
        let mut own = analysis.limit_mask.clone().unwrap();
        own.sort_by_key(|(label, _)| *label);
        wanted.sort_by_key(|(label, _)| *label);
        assert_eq!(own.len(), wanted.len(), "{here}");
        for ((a, own), (b, wanted)) in own.iter().zip(&wanted) {
            assert!(a == b && (own - wanted).abs() < 1e-14, "{here} {a:?}");
        }
    });
}

/// Hoppe et al. 1994 give the tangent across a crease of Loop's scheme for 2, 3 and 4 edges on a side.
#[test]
fn tangents_across_a_crease_are_the_known_ones() {
    let (scheme, book) = open("loop");
    let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
    let known: [&[f64]; 3] = [&[-2.0, 1.0, 1.0], &[-1.0, 0.0, 1.0, 0.0], &[-2.0, -1.0, 2.0, 2.0, -1.0]];
    for (k, wanted) in (1..).zip(known) {
        let analysis = analyzer.at(crease(k)).unwrap();
        let own = spread(&analysis, &analysis.tangent_masks.as_ref().unwrap().masks[1]);
        let scale = wanted.iter().fold(0.0_f64, |top, weight| top.max(weight.abs()));
        for (at, wanted) in wanted.iter().enumerate() {
            let label = Label { sector: at.saturating_sub(1) as u32, i: (at > 0).into(), j: 0 };
            assert!((own[index(&analysis, label)] - wanted / scale).abs() < 1e-14, "{k} {at}");
        }
    }
}

/// Refines the values of a random function of one parity m times; each step the limit is taken off and the rest divided by `lambda`,
/// and what rounding gave to the other parity is dropped.
fn refined(analysis: &BoundaryAnalysis, parity: Parity, lambda: f64, steps: usize) -> (DVector<f64>, DVector<f64>) {
    let dense = analysis.local.dense();
    let limit = spread(analysis, analysis.limit_mask.as_ref().unwrap());
    let any = Random(11).vector(dense.nrows());
    let sign = if parity == Parity::Even { 1.0 } else { -1.0 };
    let of_parity =
        |x: &DVector<f64>| DVector::from_fn(x.len(), |at, _| (x[at] + sign * x[analysis.local.mirror[at]]) / 2.0);
    let start = of_parity(&any);
    let mut x = start.clone();
    for _ in 0..steps {
        x.add_scalar_mut(-limit.dot(&x));
        x = of_parity(&(&dense * x)) / lambda;
    }
    (start, x)
}

/// What is left of a random function deep down is the tangent mask of it times the characteristic map, with the right sign.
#[test]
fn tangents_are_what_deep_refinement_leaves() {
    let mut planes = 0;
    each(|here, analysis| {
        let Ok(tangents) = &analysis.tangent_masks else { return };
        planes += 1;
        for (axis, e) in tangents.eigenvalues.iter().enumerate() {
            let left = spread(analysis, &tangents.masks[axis]);
            let right = DVector::from_iterator(left.len(), tangents.net.iter().map(|point| point[axis]));
            let (steps, exact) = if tangents.jordan[axis] == 1 { (4_000, 1e-9) } else { (20_000, 1e-3) };
            let (start, left_over) = refined(analysis, Parity::of_part(e.frequency), e.value.re, steps);
            let seen = &left_over / left_over.amax() * left.dot(&start).signum();
            let wanted = &right / right.amax();
            assert!((seen - wanted).amax() < exact, "{here} {axis}");
        }
    });
    // cubic: Loop's and Warren's: 6 creases, 3 corners, 6 darts each, and sqrt(3)'s without darts; Catmull and Clark's: 4, 2, 6, and 4-8's without
    // darts. Hoppe et al.: all but the crease of two faces; Biermann et al.: all
    assert_eq!(planes, 2 * (6 + 3 + 6) + (4 + 2 + 6) + (6 + 3) + (4 + 2) + 2 * (7 + 5 + 6) + 3 * (8 + 5 + 6));
}

/// On a fan that lies in a plane, counter-clockwise, with a little noise: the normal is that of the plane.
#[test]
fn first_times_second_is_the_outward_normal() {
    each(|here, analysis| {
        let Ok(tangents) = &analysis.tangent_masks else { return };
        let sectors = f64::from(analysis.fan.sectors());
        let angle = match analysis.fan.kind() {
            FanKind::Crease { faces } => {
                if faces == 1 {
                    2.0
                } else {
                    PI
                }
            }
            FanKind::Corner { faces } => {
                if faces < 3 {
                    1.5
                } else {
                    2.5
                }
            }
            FanKind::Dart { .. } => TAU,
        };
        let spoke = |s: u32| {
            let at = angle * f64::from(s) / sectors;
            [at.cos(), at.sin()]
        };
        let mut random = Random(5);
        let place = |label: &Label| {
            let ([ax, ay], [bx, by]) = (spoke(label.sector), spoke(label.sector + 1));
            let (i, j) = (f64::from(label.i), f64::from(label.j));
            [i * ax + j * bx, i * ay + j * by]
        };
        let points: BTreeMap<Label, [f64; 3]> = analysis
            .local
            .labels
            .iter()
            .map(|label| (*label, [place(label)[0], place(label)[1], 0.05 * random.next()]))
            .collect();
        let tangent = |mask: &FanMask| {
            let axis = |axis: usize| mask.iter().map(|(label, weight)| weight * points[label][axis]).sum::<f64>();
            [axis(0), axis(1), axis(2)]
        };
        let [[ax, ay, az], [bx, by, bz]] = tangents.masks.each_ref().map(tangent);
        let normal = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!(normal[2] > 0.9 * length, "{here} {normal:?}");
        // the first tangent leads towards spoke 0: at a crease less so than away from spoke k
        let last =
            spoke(if analysis.fan.kind().is_closed() { analysis.fan.sectors() / 2 } else { analysis.fan.sectors() });
        let along = [spoke(0)[0] - last[0], spoke(0)[1] - last[1]];
        assert!(ax * along[0] + ay * along[1] > 0.0, "{here}");
    });
}

/// Beside the boundary's 1, 1/2, 1/4 and 1/8 there are the modes sin(pi m i/k), m = 1..k-1, of the spokes between.
#[test]
fn sine_modes_are_in_the_spectrum() {
    let triangles = |c: f64| vec![3.0 / 8.0 + c / 4.0];
    let quads = |c: f64| {
        let root = ((c + 9.0) * (c + 1.0)).sqrt();
        vec![(5.0 + c + root) / 16.0, (5.0 + c - root) / 16.0]
    };
    for (id, values) in [("loop", &triangles as &dyn Fn(f64) -> Vec<f64>), ("catmull-clark", &quads)] {
        let (scheme, book) = open(id);
        let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
        for k in 1..=16 {
            for kind in [crease(k), corner(k)] {
                let spectrum = analyzer.at(kind).unwrap().spectrum;
                let has = |value: f64, parity: Parity| {
                    let near = |e: &&Eigenvalue| (e.value - value).norm() < 1e-7 && e.frequency == parity.part();
                    assert!(spectrum.eigenvalues.iter().any(|e| near(&e)), "{id} {kind:?}: {value} {parity:?}");
                };
                for m in 1..k {
                    let parity = if m % 2 == 1 { Parity::Even } else { Parity::Odd };
                    values((PI * m as f64 / k as f64).cos()).into_iter().for_each(|value| has(value, parity));
                }
                has(1.0, Parity::Even);
                has(0.5, Parity::Odd);
                has(0.125, Parity::Even);
                has(0.125, Parity::Odd);
                has(if matches!(kind, FanKind::Crease { .. }) { 0.25 } else { 0.5 }, Parity::Even);
            }
        }
    }
}

/// Where two modes that vanish along the boundary pass its 1/2, the tangent plane is lost; where the second equals it, a Jordan block
/// keeps the plane.
#[test]
fn many_faces_have_no_tangent_plane() {
    for (id, creases, corners) in [("loop", 6, 3), ("catmull-clark", 4, 2)] {
        let (scheme, book) = open(id);
        let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
        for k in 1..=14 {
            let at_crease = analyzer.at(crease(k)).unwrap().tangent_masks;
            assert_eq!(at_crease.is_ok(), k <= creases, "{id} {k}: {:?}", at_crease.err());
            let at_corner = analyzer.at(corner(k)).unwrap().tangent_masks;
            assert_eq!(at_corner.is_ok(), k <= corners, "{id} {k}: {:?}", at_corner.err());
            for why in [at_crease.err(), at_corner.err()].into_iter().flatten() {
                assert!(why.starts_with("no tangent plane: ") && why.contains("0.5"), "{id} {k}: {why}");
            }
        }
        // more faces than exact numbers are used for
        let why = analyzer.at(crease(30)).unwrap().tangent_masks.unwrap_err();
        assert!(why.contains("vanish along the boundary"), "{why}");
    }
}

/// Exact numbers decide the Jordan blocks.
#[test]
fn jordan_blocks_are_decided_exactly() {
    for (id, kind, value, parity) in [
        ("loop", crease(6), "1/2", Parity::Odd),
        ("loop", corner(3), "1/2", Parity::Even),
        ("catmull-clark", crease(4), "1/2", Parity::Odd),
        ("catmull-clark", crease(1), "1/4", Parity::Even),
        ("catmull-clark", corner(2), "1/2", Parity::Even),
    ] {
        let (scheme, book) = open(id);
        let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
        let local = analyzer.local_matrix(kind).unwrap();
        let exact = analyzer.exact(&local).unwrap();
        let at = |e: &&eigenring::analysis::exact::ExactEigenvalue| {
            e.frequency == parity.part() && e.exact.as_ref().is_some_and(|words| words.text == value)
        };
        let e = exact.eigenvalues.iter().find(at).unwrap();
        let structure = e.structure.unwrap();
        assert_eq!((e.algebraic, structure.geometric, structure.largest), (Some(2), 1, 2), "{id} {kind:?}");
        // the same by ranks of the approximate matrix, whose other eigenvalues are far away
        let lambda = e.re.midpoint_f64();
        let shifted = local.dense() - DMatrix::identity(local.size(), local.size()) * lambda;
        let nullity = |a: &DMatrix<f64>| a.clone().singular_values().iter().filter(|s| **s < 1e-12).count();
        let (once, twice) = (nullity(&shifted), nullity(&(&shifted * &shifted)));
        assert_eq!(twice - once, 1, "{id} {kind:?}: {once} {twice}");
    }
}

/// Exact and approximate analyses of one vertex agree; exact limit masks are rational.
#[test]
fn exact_and_approximate_numbers_agree() {
    each(|here, analysis| {
        let (scheme, book) = open(here.split(' ').next().unwrap());
        let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
        let Ok(exact) = analyzer.exact(&analysis.local) else {
            // fields of many cosines, and large cores
            let large = ["biermann", "sqrt3", "four-eight"].iter().any(|name| here.contains(name));
            assert!(large && analysis.fan.sectors() >= 7, "{here}");
            return;
        };
        let counted: usize = exact.eigenvalues.iter().map(|e| e.algebraic.unwrap()).sum();
        assert_eq!(counted, analysis.local.size(), "{here}");
        for e in &analysis.spectrum.eigenvalues {
            let distance = |own: &eigenring::analysis::exact::ExactEigenvalue| {
                (own.re.midpoint_f64() - e.value.re).abs().max((own.im.midpoint_f64() - e.value.im).abs())
            };
            let own = exact.eigenvalues.iter().filter(|own| own.frequency == e.frequency).map(distance);
            assert!(own.fold(f64::INFINITY, f64::min) < 1e-7, "{here} {e:?}");
        }
        let mask = spread(analysis, analysis.limit_mask.as_ref().unwrap());
        let known = exact.limit_mask.unwrap();
        assert!(
            known
                .iter()
                .all(|(label, weight)| { (weight.value.midpoint_f64() - mask[index(analysis, *label)]).abs() < 1e-14 })
        );
        if let FanKind::Crease { faces } = analysis.fan.kind() {
            let words: BTreeSet<String> = known.iter().map(|(_, w)| w.exact.as_ref().unwrap().text.clone()).collect();
            assert_eq!(words, crease_mask(here, faces).map(|(_, words)| words.to_string()).into(), "{here}");
        }
    });
}

#[test]
fn what_cannot_be_analysed_is_refused_in_words() {
    let (scheme, book) = open("loop");
    let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
    for (kind, words) in [
        (crease(0), "from 1 to 200, not 0"),
        (crease(MAX_FACES + 1), "from 1 to 200, not 201"),
        (corner(usize::MAX), "corner"),
        (dart(2), "from 3 to 200, not 2"),
    ] {
        let Err(Obstacle::Limit(why)) = analyzer.at(kind) else { panic!("{kind:?}") };
        assert!(why.contains(words), "{why}");
    }
    let dual = catalogue::open("doo-sabin").unwrap().unwrap();
    assert!(BoundaryAnalyzer::new(&dual, &book).is_err_and(|why| why.to_string().contains("dual")));
    let butterfly = catalogue::open("modified-butterfly").unwrap().unwrap();
    let reaches = BoundaryAnalyzer::new(&butterfly, &book).err().unwrap();
    assert!(matches!(reaches, Obstacle::Boundary(_)), "{reaches}");
    let lame = "name = \"No corners\"\n[vertex.crease]\ncentre = \"3/4\"\n\"ring[0,k]\" = \"1/8\"\n[edge.crease]\nends = \"1/2\"\n";
    let lame = RuleBook::parse_boundary("lame.toml", lame, "triangles").unwrap();
    let analyzer = BoundaryAnalyzer::new(&scheme, &lame).unwrap();
    assert!(analyzer.at(crease(2)).is_ok());
    assert_eq!(analyzer.at(corner(2)).err(), Some(Obstacle::NoRule("vertex.corner")));
    assert_eq!(lattice_of(&scheme), Lattice::Triangles);
}

/// A rule that prefers one end of the boundary has no even and odd part.
#[test]
fn rules_that_tell_left_from_right_are_refused() {
    let (scheme, _) = open("loop");
    let text = "name = \"Lopsided\"\n[vertex.crease]\ncentre = \"3/4\"\n\"ring[0]\" = \"1/4\"\n[vertex.corner]\ncentre = \"1\"\n[edge.crease]\nends = \"1/2\"\n";
    let book = RuleBook::parse_boundary("lopsided.toml", text, "triangles").unwrap();
    let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
    let why = analyzer.at(crease(3)).err().unwrap().to_string();
    assert!(why.contains("left from right"), "{why}");
}

/// A boundary rule with weights inside, and one that depends on k.
#[test]
fn other_boundary_rules_are_analysed_too() {
    let (scheme, _) = open("loop");
    let text = "name = \"Bulging\"\n[vertex.crease]\ncentre = \"5/8\"\n\"ring[0,k]\" = \"1/8\"\nring = \"1/(8*(k+1))\"\n[vertex.corner]\ncentre = \"1\"\n[edge.crease]\nends = \"1/2\"\n";
    let book = RuleBook::parse_boundary("bulging.toml", text, "triangles").unwrap();
    let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
    for k in [1, 2, 3, 4] {
        let analysis = analyzer.at(crease(k)).unwrap();
        let dense = analysis.local.dense();
        let mask = spread(&analysis, analysis.limit_mask.as_ref().unwrap());
        assert!((dense.tr_mul(&mask) - &mask).amax() < 1e-13 && mask.len() == 3 + 3 * k, "{k}");
        let inside =
            mask.iter().zip(&analysis.local.labels).filter(|(w, l)| **w > 1e-9 && (1..k as u32).contains(&l.sector));
        assert!(inside.count() >= k - 1, "{k}");
    }
}

/// The unit normals of the faces around the centre after some steps, from random points in space.
fn deep_normals(analysis: &BoundaryAnalysis, seed: u64, steps: usize) -> Vec<[f64; 3]> {
    let dense = analysis.local.dense();
    let limit = spread(analysis, analysis.limit_mask.as_ref().unwrap());
    let mut random = Random(seed);
    let mut axes = [0, 1, 2].map(|_| random.vector(dense.nrows()));
    for _ in 0..steps {
        for x in &mut axes {
            x.add_scalar_mut(-limit.dot(x));
            *x = &dense * &*x * 2.0;
        }
    }
    let fan = analysis.fan;
    let seen = |label: Label| {
        let at = |label: Label| axes.each_ref().map(|x| x[index(analysis, label)]);
        let (own, centre) = (at(label), at(fan.centre()));
        [0, 1, 2].map(|axis| own[axis] - centre[axis])
    };
    let normal = |s: u32| {
        let ([ax, ay, az], [bx, by, bz]) = (seen(fan.point(s, 1, 0)), seen(fan.point(s, 0, 1)));
        let normal = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        normal.map(|x| x / length)
    };
    (0..fan.sectors()).map(normal).collect()
}

/// The largest angle between two of them.
fn widest(normals: &[[f64; 3]]) -> f64 {
    let angle = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>().clamp(-1.0, 1.0).acos();
    normals.iter().flat_map(|a| normals.iter().map(move |b| angle(a, b))).fold(0.0, f64::max)
}

/// From random points in space: where there is a tangent plane, the normals of the faces around the vertex converge to that of the
/// masks, like 1/m where a Jordan block is; where there is none, they stay apart.
#[test]
fn normals_of_deep_faces_converge_exactly_where_there_is_a_plane() {
    let (mut slowly, mut apart) = (0, 0);
    each(|here, analysis| {
        // where the leading eigenvalues are far apart, rounding of the larger part soon covers the smaller
        let parted = analysis.tangent_masks.as_ref().map_or_else(
            |_| {
                let moduli: Vec<f64> = analysis.spectrum.after_one().map(Eigenvalue::modulus).take(3).collect();
                moduli[0] / moduli[2]
            },
            |own| {
                let [a, b] = own.eigenvalues.map(|e| e.modulus());
                a.max(b) / a.min(b)
            },
        );
        let steps = ((1e9_f64.ln() / parted.ln().max(1e-9)) as usize).min(400);
        let [early, late] = [steps / 2, steps].map(|steps| deep_normals(analysis, 3, steps));
        let Ok(tangents) = &analysis.tangent_masks else {
            if analysis.tangent_masks.as_ref().is_err_and(|why| why.contains("2 eigenvectors")) {
                // both faces have one normal, whatever the surface has beside it
                assert!(here.contains("hoppe-1994 Crease { faces: 2 }"), "{here}");
                return;
            }
            assert!(widest(&late) > 0.8 * widest(&early) && widest(&late) > 1e-3, "{here}: {}", widest(&late));
            apart += 1;
            return;
        };
        let mut random = Random(3);
        let axes = [0, 1, 2].map(|_| random.vector(analysis.local.size()));
        let [a, b] = tangents.masks.each_ref().map(|mask| {
            let row = spread(analysis, mask);
            axes.each_ref().map(|x| row.dot(x))
        });
        let normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        let wanted = normal.map(|x| x / length);
        let off = |normals: &[[f64; 3]]| normals.iter().map(|own| widest(&[*own, wanted])).fold(0.0, f64::max);
        let (before, after) = (off(&early), off(&late));
        if tangents.jordan.iter().any(|size| *size > 1) && analysis.fan.sectors() > 1 {
            assert!(after < 0.7 * before && after > 0.3 * before, "{here}: {before} {after}");
            slowly += 1;
        } else {
            assert!(after < 0.05 * before || after < 1e-4, "{here}: {before} {after}");
        }
    });
    // Loop, Warren and sqrt(3); Catmull-Clark and 4-8
    assert_eq!((slowly, apart), (3 * 2 + 2 * 2, 3 * 4 + 2 * 7));
}

/// What a report says is what the analysis found, in every form; without being asked for it is not there.
#[test]
fn reports_tell_the_boundary_in_every_form() {
    let (scheme, book) = open("loop");
    let mut study = Study::of(&scheme, &[3], false, &|| ()).unwrap();
    let plain = report::texts(&study.report, &[]).unwrap();
    assert!(plain.iter().all(|(_, text)| !text.contains("At a boundary") && !text.contains("\"boundary\"")));
    assert_eq!(report_of::terminal(&study.report.boundary), "");
    let counted = std::cell::Cell::new(0);
    let found =
        report_of::boundary(&scheme, &report_of::Variant::all_of(&scheme).unwrap()[..1], &[1, 6, 7], 10, &|| {
            counted.set(counted.get() + 1)
        })
        .unwrap();
    let places: Vec<(&str, usize)> = found.iter().map(|own| (own.kind, own.faces)).collect();
    let both = ["crease", "corner"].into_iter().flat_map(|kind| [1, 6, 7].map(|k| (kind, k)));
    assert_eq!(places, both.chain([("dart", 6), ("dart", 7)]).collect::<Vec<_>>());
    assert_eq!(counted.get(), places.len());
    let analyzer = BoundaryAnalyzer::new(&scheme, &book).unwrap();
    for own in &found {
        let kind = match own.kind {
            "crease" => crease(own.faces),
            "corner" => corner(own.faces),
            _ => dart(own.faces),
        };
        let analysis = analyzer.at(kind).unwrap();
        let tangents = analysis.tangent_masks.as_ref();
        assert_eq!(own.tangent_masks.is_some(), tangents.is_ok(), "{kind:?}");
        assert_eq!(own.why_not, tangents.err().into_iter().cloned().collect::<Vec<String>>(), "{kind:?}");
        assert_eq!(own.eigenvalues.iter().map(|e| e.algebraic).sum::<usize>(), own.size);
        for (spelled, mask) in own.tangent_masks.iter().flatten().zip(tangents.iter().flat_map(|own| &own.masks)) {
            let places = spelled.iter().map(|w| (w.sector.unwrap_or(0), w.orbit.unwrap_or([0, 0]), w.weight));
            let wanted = mask.iter().map(|(Label { sector, i, j }, weight)| (*sector, [*i, *j], *weight));
            assert_eq!(places.collect::<Vec<_>>(), wanted.collect::<Vec<_>>(), "{kind:?}");
        }
    }
    let words = report_of::terminal(&found);
    assert_eq!(words.lines().count(), 3 + found.len(), "{words}");
    assert!(words.contains("no: two modes that vanish along the boundary"), "{words}");
    let csv = report_of::boundary_csv(&found);
    assert!(csv.lines().all(|line| line.matches(',').count() == 10), "{csv}");
    let eigenvalues = csv.lines().filter(|line| line.contains(",eigenvalue,")).count();
    assert_eq!(eigenvalues, found.iter().map(|own| own.size).sum::<usize>());
    study.report.add_boundary(found);
    assert!(study.report.sources.iter().any(|source| source.key == "hoppe-1994"));
    let texts = report::texts(&study.report, &[]).unwrap();
    let has = |ending: &str, words: &str| {
        let (_, text) = texts.iter().find(|(name, _)| name.ends_with(ending)).unwrap();
        assert!(text.contains(words), "{ending}: {words}");
    };
    has(".md", "## At a boundary");
    has(".md", "centre 2/3, ring[0] 1/6, ring[6] 1/6");
    has(".md", "0.5000000000 = 1/2 (sine mode 2, 2 times, Jordan block of size 2)");
    has(".tex", "\\subsection*{Masks at a boundary}");
    has(".json", "\"variant\": \"cubic\"");
}
