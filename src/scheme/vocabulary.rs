//! Which words may a scheme file use, and which points do they name?
//!
//! The words are data: `schemes/vocabulary.toml` lists the splits and the positions, each position with the walks that
//! lead to its points. Any other point is named by its address: `"2,0"` is two edges straight on, `"1,1"` one on and one
//! over ([`address`]).

use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// The longest walk that an address may stand for, in edges.
pub const MAX_REACH: u32 = 8;

/// What a rule is told around, and on which kind of place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
pub enum RuleKind {
    /// A vertex inside the mesh.
    #[serde(rename = "vertex")]
    Vertex,
    /// An edge inside the mesh.
    #[serde(rename = "edge")]
    Edge,
    /// An edge inside the mesh, told from an end whose valence is not the regular one.
    #[serde(rename = "edge.from-irregular-end")]
    EdgeFromIrregularEnd,
    /// A face.
    #[serde(rename = "face")]
    Face,
    /// A corner of a face.
    #[serde(rename = "corner")]
    Corner,
    /// A vertex on a smooth boundary or crease.
    #[serde(rename = "vertex.crease")]
    VertexCrease,
    /// A vertex that is a corner of the boundary.
    #[serde(rename = "vertex.corner")]
    VertexCorner,
    /// An edge of the boundary or of a crease.
    #[serde(rename = "edge.crease")]
    EdgeCrease,
    /// A third of an edge of the boundary, told from the end that is nearer.
    #[serde(rename = "edge.crease.third")]
    CreaseThird,
    /// The same where that end is a corner.
    #[serde(rename = "edge.crease.third.from-corner-end")]
    ThirdFromCorner,
    /// An edge of the boundary or of a crease, told from an end that is a corner, or has a side whose number of faces is not the regular one.
    #[serde(rename = "edge.crease.from-irregular-end")]
    CreaseFromIrregularEnd,
    /// Such an edge, told from an end at which the crease ends.
    #[serde(rename = "edge.crease.from-dart-end")]
    CreaseFromDartEnd,
    /// An edge inside the mesh, told from an end that the boundary or a crease passes through.
    #[serde(rename = "edge.from-crease-end")]
    EdgeFromCreaseEnd,
    /// An edge inside the mesh, told from an end that is a corner between two sharp edges.
    #[serde(rename = "edge.from-corner-end")]
    EdgeFromCornerEnd,
    /// An edge inside the mesh, told from an end at which one crease ends.
    #[serde(rename = "edge.from-dart-end")]
    EdgeFromDartEnd,
}

impl RuleKind {
    /// Every kind of rule with its table in a scheme file.
    pub const ALL: [(&'static str, RuleKind); 15] = [
        ("vertex", RuleKind::Vertex),
        ("edge", RuleKind::Edge),
        ("edge.from-irregular-end", RuleKind::EdgeFromIrregularEnd),
        ("face", RuleKind::Face),
        ("corner", RuleKind::Corner),
        ("vertex.crease", RuleKind::VertexCrease),
        ("vertex.corner", RuleKind::VertexCorner),
        ("edge.crease", RuleKind::EdgeCrease),
        ("edge.crease.third", RuleKind::CreaseThird),
        ("edge.crease.third.from-corner-end", RuleKind::ThirdFromCorner),
        ("edge.crease.from-irregular-end", RuleKind::CreaseFromIrregularEnd),
        ("edge.crease.from-dart-end", RuleKind::CreaseFromDartEnd),
        ("edge.from-crease-end", RuleKind::EdgeFromCreaseEnd),
        ("edge.from-corner-end", RuleKind::EdgeFromCornerEnd),
        ("edge.from-dart-end", RuleKind::EdgeFromDartEnd),
    ];

    /// The rules for edges that a boundary file may tell from one of their ends.
    pub const FROM_ENDS: [RuleKind; 5] = [
        RuleKind::CreaseFromIrregularEnd,
        RuleKind::CreaseFromDartEnd,
        RuleKind::EdgeFromCreaseEnd,
        RuleKind::EdgeFromCornerEnd,
        RuleKind::EdgeFromDartEnd,
    ];

    /// The rule's table in a scheme file.
    pub fn name(self) -> &'static str {
        RuleKind::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }

    /// The variable that formulas of this rule may use beside parameters and `[let]` names.
    pub fn variable(self) -> Option<&'static str> {
        match self {
            RuleKind::Edge | RuleKind::EdgeCrease | RuleKind::CreaseThird => None,
            RuleKind::VertexCorner | RuleKind::CreaseFromIrregularEnd | RuleKind::ThirdFromCorner => None,
            RuleKind::VertexCrease | RuleKind::EdgeFromCreaseEnd | RuleKind::EdgeFromCornerEnd => Some("k"),
            _ => Some("n"),
        }
    }

    /// The number of half-edges that a rule is told around, where its count is `count`.
    pub fn starts(self, count: i64) -> i64 {
        match self {
            RuleKind::Edge | RuleKind::EdgeCrease | RuleKind::CreaseThird => 2,
            RuleKind::VertexCorner | RuleKind::CreaseFromIrregularEnd | RuleKind::ThirdFromCorner => 1,
            RuleKind::VertexCrease => count + 1,
            // the edge itself and those beside it
            kind if RuleKind::FROM_ENDS.contains(&kind) => 3,
            _ => count,
        }
    }

    /// Whether the number of half-edges depends on the count.
    pub fn grows(self) -> bool {
        self.starts(3) != self.starts(4)
    }

    /// Whether this rule belongs in a boundary file.
    pub fn is_boundary(self) -> bool {
        let plain = [RuleKind::VertexCrease, RuleKind::VertexCorner, RuleKind::EdgeCrease];
        let thirds = [RuleKind::CreaseThird, RuleKind::ThirdFromCorner];
        plain.contains(&self) || thirds.contains(&self) || RuleKind::FROM_ENDS.contains(&self)
    }
}

/// One move of a walk over half-edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Move {
    /// Along the face to the left.
    Next,
    /// Back along the face to the left.
    Prev,
    /// To the edge's other half.
    Twin,
    /// To the next half-edge that leaves the same vertex, counter-clockwise.
    Turn,
    /// Over the edge and straight on.
    On,
    /// Over the edge and on, one turn to the left of straight on.
    Left,
    /// Over the edge and on, one turn to the right of straight on.
    Right,
}

/// The point that a walk ends at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrival {
    /// The point that the last half-edge leaves.
    Origin,
    /// The point that the last half-edge leads to.
    Target,
    /// The point that this step makes for the face to the left of the last half-edge.
    NewFace,
    /// The point that this step makes for the edge of the last half-edge.
    NewEdge,
}

/// A walk from a half-edge to a point. Where two ways lead to one point of a regular mesh, but may part at irregular
/// vertices, both are taken, each with half of the weight.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Walk {
    /// The ways, one or two, each a list of moves.
    pub ways: Vec<Vec<Move>>,
    /// Where it ends.
    pub arrival: Arrival,
}

impl Walk {
    fn parse(text: &str) -> Option<Walk> {
        let mut words: Vec<&str> = text.split_whitespace().collect();
        let arrival = match words.pop()? {
            "origin" => Arrival::Origin,
            "target" => Arrival::Target,
            "new-face" => Arrival::NewFace,
            "new-edge" => Arrival::NewEdge,
            _ => return None,
        };
        let step = |word: &&str| match *word {
            "next" => Some(Move::Next),
            "prev" => Some(Move::Prev),
            "twin" => Some(Move::Twin),
            "turn" => Some(Move::Turn),
            "on" => Some(Move::On),
            "left" => Some(Move::Left),
            "right" => Some(Move::Right),
            _ => None,
        };
        Some(Walk { ways: vec![words.iter().map(step).collect::<Option<_>>()?], arrival })
    }
}

/// A class of points that a rule may give weights to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Position {
    /// Its name in scheme files: a word of the vocabulary, or an address.
    pub name: String,
    /// The rules that may use it.
    pub around: Vec<RuleKind>,
    /// The kinds of mesh that have it; empty for all.
    pub meshes: Vec<String>,
    /// Whether the walks are made from the first half-edge only.
    pub once: bool,
    /// The walks to its points, made from every half-edge in turn.
    pub walks: Vec<Walk>,
    /// What it is, in words.
    pub means: String,
}

impl Position {
    /// Whether its points lie along one side of a sharp edge, or run from one to another, so that counting does not go round.
    pub fn is_open(&self) -> bool {
        [RuleKind::VertexCrease, RuleKind::CreaseThird].iter().any(|kind| self.around.contains(kind))
    }

    /// Whether its points are made by the same step.
    pub fn births(&self) -> Option<RuleKind> {
        self.walks.iter().find_map(|walk| match walk.arrival {
            Arrival::NewFace => Some(RuleKind::Face),
            Arrival::NewEdge => Some(RuleKind::Edge),
            Arrival::Origin | Arrival::Target => None,
        })
    }
}

/// How a step makes new faces out of old ones.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Split {
    /// The kinds of mesh that it can be applied to.
    pub meshes: Vec<String>,
    /// The rules that it asks for.
    pub births: Vec<RuleKind>,
    /// What it does, in words.
    pub means: String,
}

/// The words of scheme files.
#[derive(Clone, Debug)]
pub struct Vocabulary {
    /// The splits by name.
    pub splits: BTreeMap<String, Split>,
    /// The named positions.
    pub positions: Vec<Position>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PositionRow {
    around: Vec<RuleKind>,
    name: String,
    #[serde(default)]
    meshes: Vec<String>,
    #[serde(default)]
    once: bool,
    walks: Vec<String>,
    means: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    splits: BTreeMap<String, Split>,
    positions: Vec<PositionRow>,
}

/// The vocabulary's text, as data for other readers.
pub const VOCABULARY: &str = include_str!("../../schemes/vocabulary.toml");

impl Vocabulary {
    /// The vocabulary of this build.
    pub fn get() -> &'static Vocabulary {
        static VOCABULARY_ONCE: OnceLock<Vocabulary> = OnceLock::new();
        VOCABULARY_ONCE.get_or_init(|| Vocabulary::parse(VOCABULARY).unwrap_or_else(Vocabulary::empty))
    }

    /// Held to be non-empty by a test: the table is part of the build.
    fn empty() -> Vocabulary {
        Vocabulary { splits: BTreeMap::new(), positions: Vec::new() }
    }

    fn parse(text: &str) -> Option<Vocabulary> {
        let table: Table = toml::from_str(text).ok()?;
        let read = |row: PositionRow| {
            let walks = row.walks.iter().map(|walk| Walk::parse(walk)).collect::<Option<_>>()?;
            let PositionRow { around, name, meshes, once, means, .. } = row;
            Some(Position { name, around, meshes, once, walks, means })
        };
        Some(Vocabulary {
            splits: table.splits,
            positions: table.positions.into_iter().map(read).collect::<Option<_>>()?,
        })
    }

    /// The positions that a rule may name on a kind of mesh (`None`: any).
    pub fn around<'a>(&'a self, kind: RuleKind, mesh: Option<&'a str>) -> impl Iterator<Item = &'a Position> {
        let fits = move |position: &Position| match mesh {
            Some(mesh) => position.meshes.is_empty() || position.meshes.iter().any(|own| own == mesh),
            None => true,
        };
        self.positions.iter().filter(move |position| position.around.contains(&kind) && fits(position))
    }

    /// The position of a name or an address around a rule's place, if there is one.
    pub fn find(&self, kind: RuleKind, mesh: Option<&str>, name: &str) -> Option<Position> {
        self.around(kind, mesh).find(|position| position.name == name).cloned().or_else(|| address(kind, name))
    }
}

/// The class of points at an address `"i,j"`. Around a vertex: from it walk i edges straight along each of its edges in
/// turn, turn counter-clockwise once, walk j edges. Around a corner of a face: i edges in the straight continuation of
/// (next corner -> this corner), then j in that of (previous corner -> this corner); `"0,0"` is the ring itself.
pub fn address(kind: RuleKind, name: &str) -> Option<Position> {
    let (i, j) = name.split_once(',')?;
    let (i, j): (u32, u32) = (i.trim().parse().ok()?, j.trim().parse().ok()?);
    if i.checked_add(j)? > MAX_REACH {
        return None;
    }
    let on = |count: u32| (0..count).map(|_| Move::On);
    let dual = kind == RuleKind::Corner;
    // how the two legs start: along the spoke (or back over the corner's edge), and along the next one
    let (first, second): (&[Move], &[Move]) =
        if dual { (&[Move::Twin, Move::On], &[Move::Prev, Move::On]) } else { (&[], &[Move::Turn]) };
    let straight = |start: &[Move], count: u32| start.iter().copied().chain(on(count - 1)).collect::<Vec<Move>>();
    let bent = |start: &[Move], count: u32, turn: Move, more: u32| {
        straight(start, count).into_iter().chain([turn]).chain(on(more - 1)).collect::<Vec<Move>>()
    };
    let (ways, arrival) = match (kind, i, j) {
        (RuleKind::Corner, 0, 0) => (vec![vec![]], Arrival::Origin),
        (RuleKind::Corner, 0, _) => (vec![straight(second, j)], Arrival::Target),
        (RuleKind::Vertex | RuleKind::EdgeFromIrregularEnd | RuleKind::Corner, 1.., 0) => {
            (vec![straight(first, i)], Arrival::Target)
        }
        (RuleKind::Vertex | RuleKind::EdgeFromIrregularEnd | RuleKind::Corner, 1.., _) => {
            (vec![bent(first, i, Move::Left, j), bent(second, j, Move::Right, i)], Arrival::Target)
        }
        _ => return None,
    };
    let means = format!("the points at address {name}");
    let walks = vec![Walk { ways, arrival }];
    Some(Position { name: name.to_string(), around: vec![kind], meshes: vec![], once: false, walks, means })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_read_whole() {
        let vocabulary = Vocabulary::get();
        assert_eq!(vocabulary.splits.len(), VOCABULARY.matches("[splits.").count());
        assert_eq!(vocabulary.positions.len(), VOCABULARY.matches("[[positions]]").count());
        assert!(vocabulary.splits.len() >= 3);
    }

    #[test]
    fn no_two_positions_of_a_rule_share_a_name() {
        for (_, kind) in RuleKind::ALL {
            for mesh in ["triangles", "quads", "polygons"] {
                let mut names: Vec<_> = Vocabulary::get().around(kind, Some(mesh)).map(|p| &p.name).collect();
                names.sort();
                let all = names.len();
                names.dedup();
                assert_eq!(names.len(), all, "{} on {mesh}", kind.name());
            }
        }
    }

    #[test]
    fn addresses_stop_at_a_stated_reach() {
        assert!(address(RuleKind::Vertex, "2,1").is_some());
        assert!(address(RuleKind::Vertex, "0,1").is_none(), "the canonical address of that point is 1,0");
        assert!(address(RuleKind::Corner, "0,0").is_some());
        assert!(address(RuleKind::Vertex, "9,9").is_none());
        assert!(address(RuleKind::Edge, "1,0").is_none());
    }
}
