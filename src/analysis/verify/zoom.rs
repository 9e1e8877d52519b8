//! How does the surface look nearer and nearer to one vertex?
//!
//! The mesh around a place is refined, and all but a few rings is dropped, again and again. Lengths shrink, and soon rounding would drown them; so
//! after each step the points are brought back to the same size by an affine map, with which refinement commutes:
//!
//! > x = c + L p,   L a 3 x 3 matrix,
//!
//! where p has the centre at the origin and two neighbours a and b in the plane of the first two coordinates, which keep their places
//! there in the long run. The third coordinate of p tends to 0, and the first two columns of L span the tangent plane; they follow
//! the two directions that shrink in different measure, where they do. Coordinates are refined apart from each other,
//! so each keeps its digits however small it becomes.

use super::super::limit::{cross, scaled, unit};
use super::super::places::{LabelledMask, Place, point_at};
use super::Observed;
use crate::mesh::{
    Centre, Connectivity, Crease, Faces, Fan, FanKind, HalfEdgeMesh, Label, Lattice, Patch, Tags, disc, edge_between,
    first_corner,
};
use crate::numbers::RootsOfUnity;
use crate::refine::{Chain, NotRefinable, Obstacle, Refiner, applied as row_applied, lattice_of};
use num_complex::Complex64;
use std::collections::BTreeSet;

/// A neighbourhood that is looked at through a growing glass.
pub(super) struct Zoom<'r, 'a> {
    refiner: &'r Refiner<'a>,
    rings: usize,
    mesh: HalfEdgeMesh,
    tags: Tags,
    /// p.
    points: Vec<[f64; 3]>,
    place: Place,
    /// c.
    centre: [f64; 3],
    /// The columns of L.
    frame: [[f64; 3]; 3],
    /// The number of points that stand for the centre: itself; dual: the corners of the central face.
    middle: usize,
    /// The edge neighbours of the centre, counter-clockwise; dual: the corners of the central face.
    ring: Vec<usize>,
    /// Which of them are a and b.
    pair: [usize; 2],
}

/// What one step did.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shrunk {
    /// The map of a and b: its trace and determinant.
    trace: f64,
    determinant: f64,
    /// The largest third coordinate.
    height: f64,
}

impl<'r, 'a> Zoom<'r, 'a> {
    /// A disc of regular rings around a place, its points at random in a cube of side 2.
    pub(super) fn random(
        refiner: &'r Refiner<'a>,
        reach: usize,
        place: Place,
        seed: u64,
    ) -> Result<Zoom<'r, 'a>, NotRefinable> {
        let lattice = lattice_of(refiner.scheme());
        // the points of a fine ring lie within half as many coarse ones, and are made of those that the stencils reach from there
        let rings = 2 * reach + 3;
        let (labels, faces) = disc_around(lattice, place, rings as i32);
        let mesh = HalfEdgeMesh::new(labels.len(), faces)?;
        let tags = tags_of(&mesh, &labels, place).map_err(NotRefinable::Obstacle)?;
        let at = |label: &Label| labels.iter().position(|own| own == label);
        let neighbour = |sector: u32| Label { sector, i: i32::from(lattice.has_centre()), j: 0 };
        let ring: Vec<usize> = (0..).map_while(|sector| at(&neighbour(sector))).collect();
        let open = matches!(place, Place::Fan(kind) if !kind.is_closed());
        // at a concave corner the edge half-way round may run straight on from the first
        let quarter = match place {
            Place::Fan(FanKind::Corner { .. }) => ring.len() / 3,
            _ if open => ring.len() / 2,
            _ => (ring.len() + 2) / 4,
        };
        let pair = [0, quarter.clamp(1, ring.len().saturating_sub(1).max(1))];
        let mut random = Random(seed);
        let points = (0..mesh.vertices()).map(|_| [random.next(), random.next(), random.next()]).collect();
        let middle = if lattice.has_centre() { 1 } else { ring.len() };
        let frame = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Ok(Zoom { refiner, rings, mesh, tags, points, place, centre: [0.0; 3], frame, middle, ring, pair })
    }

    /// The number of points.
    pub(super) fn points(&self) -> usize {
        self.points.len()
    }

    /// Where the centre is by now.
    pub(super) fn centre(&self) -> [f64; 3] {
        self.centre
    }

    /// A mask applied to the points x of this level, less an origin.
    pub(super) fn apply(&self, mask: &LabelledMask, origin: [f64; 3]) -> [f64; 3] {
        let spokes: Vec<u32> = match self.middle {
            1 => self.ring.iter().filter_map(|at| edge_between(&self.mesh, [0, *at as u32])).collect(),
            // from the corner that is the first of the ring
            _ => {
                let corners: Vec<u32> = self.mesh.faces().range(0).map(|h| h as u32).collect();
                let is_first = |h: &u32| self.mesh.origin(*h) as usize == self.ring[0];
                let first = corners.iter().position(is_first).unwrap_or(0);
                [&corners[first..], &corners[..first]].concat()
            }
        };
        let lattice = lattice_of(self.refiner.scheme());
        let mut sum = [0.0; 3];
        for (label, weight) in mask {
            // a mask that reaches beyond the disc is none
            let Some(at) = point_at(&self.mesh, lattice, self.place, &spokes, *label) else { return [f64::NAN; 3] };
            let x = self.placed(self.points[at as usize]);
            (0..3).for_each(|axis| sum[axis] += weight * (x[axis] - origin[axis]));
        }
        sum
    }

    /// x = c + L p.
    fn placed(&self, p: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.centre[axis] + (0..3).map(|column| self.frame[column][axis] * p[column]).sum::<f64>())
    }

    /// The normal of the plane of the first two coordinates, outward where the ring turns counter-clockwise.
    pub(super) fn normal(&self) -> [f64; 3] {
        let ring: Vec<[f64; 3]> = self.ring.iter().map(|at| self.points[*at]).collect();
        let turn = |a: &[f64; 3], b: &[f64; 3]| a[0] * b[1] - a[1] * b[0];
        let turns: f64 = ring.iter().zip(&ring[1..]).map(|(a, b)| turn(a, b)).sum();
        let normal = cross(scaled(self.frame[0]), scaled(self.frame[1])).map(|x| if turns < 0.0 { -x } else { x });
        unit(normal, 0.0).unwrap_or([f64::NAN; 3])
    }

    /// One step: refine, drop, and bring back to size.
    pub(super) fn step(&mut self) -> Result<Shrunk, NotRefinable> {
        let before = self.pair_points();
        self.refine()?;
        self.recentre();
        Ok(self.resize(before))
    }

    fn refine(&mut self) -> Result<(), NotRefinable> {
        let chain = self.refiner.chain(&self.mesh, &self.tags, self.refiner.steps_of_cycle())?;
        let middle = if self.middle > 1 { Centre::Face(0) } else { Centre::Vertex(0) };
        let centre = chain.becomes(middle).unwrap_or(middle);
        let kept = self.kept(&chain.mesh, centre);
        let point = |vertex: &u32| Ok(row_applied(&chain.row(*vertex)?, &self.points));
        let points = kept.iter().map(point).collect::<Result<Vec<_>, NotRefinable>>()?;
        let ring = match self.next_ring(&chain, &kept) {
            Some(ring) => ring,
            None => self.nearest_ring(&chain, centre, &kept)?,
        };
        (self.mesh, self.tags) = cropped(&chain.mesh, &chain.tags, &kept, self.middle)?;
        self.ring = ring;
        self.points = points;
        Ok(())
    }

    /// The points on the edges from the centre to its neighbours, among those that are kept, where the splits put them there.
    fn next_ring(&self, chain: &Chain, kept: &[u32]) -> Option<Vec<usize>> {
        let on_edge = |neighbour: &usize| {
            let edge = edge_between(&self.mesh, [0, *neighbour as u32])?;
            let point = chain.point_on_edge(first_corner(&self.mesh, edge))?;
            kept.iter().position(|vertex| *vertex == point)
        };
        if self.middle > 1 { None } else { self.ring.iter().map(on_edge).collect() }
    }

    /// The new neighbours of the centre (dual: the corners of its face), among those that are kept, counter-clockwise from the one that lies in
    /// the direction of the old ring's first, by the weights that its row gives to the old ring.
    fn nearest_ring(&self, chain: &Chain, centre: Centre, kept: &[u32]) -> Result<Vec<usize>, NotRefinable> {
        let mesh = &chain.mesh;
        let own: Vec<u32> = match centre {
            Centre::Vertex(vertex) => mesh
                .around_vertex(mesh.vertex_edges()[vertex as usize])
                .iter()
                .map(|spoke| mesh.target(*spoke))
                .collect(),
            Centre::Face(face) => mesh.faces().face(face as usize).to_vec(),
        };
        let roots = RootsOfUnity::new(self.ring.len());
        let mut first = (f64::NEG_INFINITY, 0);
        for (at, vertex) in own.iter().enumerate() {
            let weights = chain.row(*vertex)?;
            let spoke = |point: u32| self.ring.iter().position(|own| *own == point as usize);
            let towards = |(point, weight): &(u32, f64)| Some(roots.get(spoke(*point)? as i64) * *weight);
            let direction: Complex64 = weights.iter().filter_map(towards).sum();
            let cosine = direction.re / direction.norm_sqr().sqrt();
            if cosine > first.0 {
                first = (cosine, at);
            }
        }
        let place = |vertex: &u32| kept.iter().position(|own| own == vertex).unwrap_or(0);
        Ok((0..own.len()).map(|at| place(&own[(first.1 + at) % own.len()])).collect())
    }

    /// The vertices within the rings: the centre first (dual: the corners of the central face), then in order.
    fn kept(&self, fine: &HalfEdgeMesh, centre: Centre) -> Vec<u32> {
        let middle: Vec<u32> = match centre {
            Centre::Face(face) => fine.faces().face(face as usize).to_vec(),
            Centre::Vertex(vertex) => vec![vertex],
        };
        let mut all: BTreeSet<u32> = middle.iter().copied().collect();
        let mut newest = middle.clone();
        for _ in 0..self.rings {
            let starts = newest.iter().map(|vertex| fine.vertex_edges()[*vertex as usize]);
            let faces: BTreeSet<u32> = starts
                .flat_map(|start| fine.around_vertex(start))
                .filter(|spoke| fine.has_face(*spoke))
                .map(|spoke| fine.faces().face_of(spoke))
                .collect();
            let corners = faces.iter().flat_map(|face| fine.faces().face(*face as usize)).copied();
            newest = corners.filter(|vertex| all.insert(*vertex)).collect();
        }
        let rest = all.into_iter().filter(|vertex| !middle.contains(vertex));
        middle.iter().copied().chain(rest).collect()
    }

    /// Brings the centre to the origin.
    fn recentre(&mut self) {
        let count = self.middle as f64;
        let mean = [0, 1, 2].map(|axis| self.points[..self.middle].iter().map(|p| p[axis]).sum::<f64>() / count);
        self.centre = self.placed(mean);
        self.points.iter_mut().for_each(|p| (0..3).for_each(|axis| p[axis] -= mean[axis]));
    }

    /// Takes the map of the last step off the points: what is left of them keeps its shape.
    fn resize(&mut self, before: [[f64; 3]; 2]) -> Shrunk {
        let [a, b] = self.pair_points();
        let map = Plane::of(before).inverse().followed_by(&Plane::of([a, b]));
        let basis = map.eigenvectors().followed_by(&map);
        let back = basis.inverse();
        for p in &mut self.points {
            [p[0], p[1]] = back.at([p[0], p[1]]);
        }
        // the plane through the origin, a and b becomes that of the first two coordinates
        let [a, b] = self.pair_points();
        let slope = Plane::of([a, b]).inverse().row([a[2], b[2]]);
        self.points.iter_mut().for_each(|p| p[2] -= slope[0] * p[0] + slope[1] * p[1]);
        let [u, v, w] = self.frame;
        let column = |[x, y]: [f64; 2], z: f64| [0, 1, 2].map(|axis| u[axis] * x + v[axis] * y + w[axis] * z);
        self.frame = [column(basis.columns[0], slope[0]), column(basis.columns[1], slope[1]), w];
        let height = self.points.iter().map(|p| p[2].abs()).fold(0.0, f64::max);
        Shrunk { trace: map.trace(), determinant: map.determinant(), height }
    }

    /// The neighbours a and b.
    fn pair_points(&self) -> [[f64; 3]; 2] {
        self.pair.map(|spoke| self.points[self.ring[spoke]])
    }
}

/// A linear map of the plane, by its columns.
#[derive(Clone, Copy, Debug)]
struct Plane {
    columns: [[f64; 2]; 2],
}

impl Plane {
    /// The map that takes (1, 0) and (0, 1) to the first coordinates of two points.
    fn of(points: [[f64; 3]; 2]) -> Plane {
        Plane { columns: points.map(|p| [p[0], p[1]]) }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [a, b] = self.columns;
        [a[0] * x + b[0] * y, a[1] * x + b[1] * y]
    }

    /// A row times the map.
    fn row(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        self.columns.map(|column| x * column[0] + y * column[1])
    }

    fn followed_by(&self, next: &Plane) -> Plane {
        Plane { columns: self.columns.map(|column| next.at(column)) }
    }

    fn trace(&self) -> f64 {
        self.columns[0][0] + self.columns[1][1]
    }

    fn determinant(&self) -> f64 {
        let [a, b] = self.columns;
        a[0] * b[1] - a[1] * b[0]
    }

    fn inverse(&self) -> Plane {
        let ([a, b], determinant) = (self.columns, self.determinant());
        Plane { columns: [[b[1] / determinant, -a[1] / determinant], [-b[0] / determinant, a[0] / determinant]] }
    }

    /// Its eigenvalues where they are real, the larger first.
    fn eigenvalues(&self) -> Option<[f64; 2]> {
        let (half, determinant) = (self.trace() / 2.0, self.determinant());
        let root = (half * half - determinant).sqrt();
        (!root.is_nan()).then_some([half + root, half - root])
    }

    /// Its eigenvectors where their eigenvalues part clearly, so that one would outgrow the other in time; else the two axes. The larger entry
    /// of each is 1.
    fn eigenvectors(&self) -> Plane {
        let axes = Plane { columns: [[1.0, 0.0], [0.0, 1.0]] };
        let Some([first, second]) = self.eigenvalues().filter(|[a, b]| *b > 0.0 && a / b > 1.01) else { return axes };
        let [a, b] = self.columns;
        // (M - lambda) v = 0: v is at right angles to the longer row
        let vector = |lambda: f64| {
            let rows = [[a[0] - lambda, b[0]], [a[1], b[1] - lambda]];
            let size = |row: [f64; 2]| row[0].abs().max(row[1].abs());
            let [x, y] = if size(rows[0]) > size(rows[1]) { rows[0] } else { rows[1] };
            let largest = if x.abs() > y.abs() { x } else { -y };
            [-y / largest, x / largest]
        };
        let columns = [vector(first), vector(second)];
        // counter-clockwise, as the axes are
        let turned = Plane { columns };
        if turned.determinant() > 0.0 { turned } else { Plane { columns: [columns[0], columns[1].map(|x| -x)] } }
    }
}

/// The rates of the last steps: the eigenvalues of the map of a and b, and the mean ratio of heights while they can be seen.
pub(super) fn observed(steps: &[Shrunk]) -> Observed {
    let Some(last) = steps.last() else { return Observed { lambda: [f64::NAN; 2], mu: None } };
    let root = (last.trace * last.trace / 4.0 - last.determinant).max(0.0).sqrt();
    let lambda = [last.trace / 2.0 + root, last.trace / 2.0 - root];
    let seen: Vec<f64> = steps.iter().map(|step| step.height).take_while(|height| *height > 1e-200).collect();
    const LAST: usize = 12;
    let mu = (seen.len() > 2 * LAST).then(|| {
        let ratio = seen[seen.len() - 1] / seen[seen.len() - 1 - LAST];
        libm::pow(ratio, 1.0 / LAST as f64)
    });
    Observed { lambda, mu }
}

fn disc_around(lattice: Lattice, place: Place, rings: i32) -> (Vec<Label>, Faces) {
    match place {
        Place::Fan(kind) => {
            let fan = Fan::new(lattice, kind);
            disc(&fan, lattice, fan.spoke(0), rings)
        }
        Place::Inside(_) | Place::Cone => {
            let valence = if let Place::Inside(n) = place { n } else { lattice.regular_valence() };
            let patch = Patch::new(lattice, valence);
            let spoke = match patch.centre() {
                Some(centre) => patch.edge(centre, 0),
                None => patch.edge(Label { sector: 0, i: 0, j: 0 }, 2),
            };
            disc(&patch, lattice, spoke, rings)
        }
    }
}

/// A dart's crease along spoke 0, a corner's centre.
fn tags_of(mesh: &HalfEdgeMesh, labels: &[Label], place: Place) -> Result<Tags, Obstacle> {
    let number = |label: Label| labels.iter().position(|own| *own == label);
    let mut creases = Vec::new();
    if matches!(place, Place::Fan(FanKind::Dart { .. })) {
        let spoke = |i: i32| number(Label { sector: 0, i, j: 0 });
        let ends = (0..).map_while(|i| Some([spoke(i)? as u32, spoke(i + 1)? as u32]));
        creases = ends.map(|ends| Crease { ends, sharpness: f64::INFINITY }).collect();
    }
    let corners: &[u32] = if matches!(place, Place::Cone | Place::Fan(FanKind::Corner { .. })) { &[0] } else { &[] };
    Tags::new(mesh, &creases, corners).map_err(|wrong| Obstacle::Limit(wrong.to_string()))
}

/// The mesh of some vertices and of the faces between them, with its tags.
/// The faces on the vertices that are kept; dual: the central face, on the first `middle` of them, first.
fn cropped(
    fine: &HalfEdgeMesh,
    tags: &Tags,
    kept: &[u32],
    middle: usize,
) -> Result<(HalfEdgeMesh, Tags), NotRefinable> {
    let mut number = vec![u32::MAX; fine.vertices()];
    kept.iter().enumerate().for_each(|(at, vertex)| number[*vertex as usize] = at as u32);
    let is_kept = |face: &&[u32]| face.iter().all(|vertex| number[*vertex as usize] != u32::MAX);
    let mut inside: Vec<&[u32]> = fine.faces().iter().filter(is_kept).collect();
    inside.sort_by_key(|face| **face != kept[..middle]);
    let (mut sizes, mut corners) = (Vec::new(), Vec::new());
    for face in inside {
        sizes.push(face.len() as u32);
        corners.extend(face.iter().map(|vertex| number[*vertex as usize]));
    }
    let mesh = HalfEdgeMesh::new(kept.len(), Faces::mixed(&sizes, corners))?;
    let ends = |edge: u32| [fine.origin(edge), fine.target(edge)].map(|vertex| number[vertex as usize]);
    let creases = tags.creases().iter().map(|(edge, sharpness)| Crease { ends: ends(*edge), sharpness: *sharpness });
    let creases: Vec<Crease> = creases.filter(|crease| !crease.ends.contains(&u32::MAX)).collect();
    let cornered: Vec<u32> =
        tags.corners().iter().map(|vertex| number[*vertex as usize]).filter(|v| *v != u32::MAX).collect();
    let tags = Tags::new(&mesh, &creases, &cornered).map_err(|wrong| Obstacle::Limit(wrong.to_string()))?;
    Ok((mesh, tags))
}

/// Numbers in [-1, 1), always the same for a seed (a linear congruential generator; Knuth's multiplier).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        // the upper bits, mixed once more: neighbouring seeds must not give neighbouring numbers
        let mixed = (self.0 ^ (self.0 >> 31)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (mixed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
