#!/usr/bin/env python3
"""Checks Eigenring's meshes against an independent implementation of the schemes, straight from the literature.

Nothing here is shared with the program: files are read and written by this script, meshes are lists of corners, and each step is told
in the words of the papers. Random meshes are refined by both, and compared: the order of the points, their positions, the faces in
order, creases and corners. Limit points and normals are compared with published masks, and with this script's own refinement, tens of levels
deep around each vertex. See README.md beside this file.

    pip install numpy
    python3 tests/oracle/meshes.py [path/to/eigenring]
    python3 tests/oracle/meshes.py --self-test [path/to/eigenring]

Options: --seed N (another choice of meshes), --rounds N (how many of them; 3). Exit status: 0 all agree, 1 something doesn't, 2 the check could
not be made. It is run by hand.

C. Loop, Smooth subdivision surfaces based on triangles, 1987. J. Warren, Subdivision methods for geometric design, 1995. E. Catmull
and J. Clark, Recursively generated B-spline surfaces on arbitrary topological meshes, 1978. D. Doo and M. Sabin, Behaviour of recursive division
surfaces near extraordinary points, 1978. N. Dyn, J. Gregory and D. Levin, A butterfly subdivision scheme for surface interpolation with tension
control, 1990. D. Zorin, P. Schroeder and W. Sweldens, Interpolating subdivision for meshes with arbitrary topology, 1996. H. Hoppe et al.,
Piecewise smooth surface reconstruction, 1994. T. DeRose, M. Kass and T. Truong, Subdivision surfaces in character animation, 1998.
M. Halstead, M. Kass and T. DeRose, Efficient, fair interpolation using Catmull-Clark surfaces, 1993.
"""

import argparse
import json
import math
import random
import struct
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

try:
    import numpy as np
except ImportError as error:
    print(f"{error}: pip install numpy", file=sys.stderr)
    sys.exit(2)

INF = math.inf
TIGHT = 1e-12                              # positions and limit points of 64 bits, on meshes of size 1 or so
NORMAL = 1e-9                              # normals


class Mismatch(Exception):
    """What the program says is not what was found here."""


class Unable(Exception):
    """The check itself could not be made."""


def require(holds, message):
    if not holds:
        raise Mismatch(message)


# ------------------------------------------------------------------------------------------------ weights
#
# Every weight of the literature that a self-test can spoil, by its name.

W = {
    "loop edge ends": 3 / 8, "loop edge opposite": 1 / 8,
    "loop beta: 5/8": 5 / 8, "loop beta: 3/8": 3 / 8, "loop beta: 1/4": 1 / 4,
    "warren n = 3": 3 / 16, "warren n > 3": 3 / 8,
    "catmull-clark face": 1, "catmull-clark edge": 1 / 4, "catmull-clark Q": 1, "catmull-clark R": 2, "catmull-clark S": 3,
    "doo-sabin own": 5, "doo-sabin 3": 3, "doo-sabin cos": 2,
    "biquadratic vertex": 1 / 4, "biquadratic edge": 1 / 4, "biquadratic face": 1 / 4,
    "butterfly ends": 1 / 2, "butterfly opposite": 1 / 8, "butterfly wings": -1 / 16, "butterfly tips": 1,
    "butterfly centre": 3 / 4, "butterfly n = 3, 0": 5 / 12, "butterfly n = 3, 1": -1 / 12, "butterfly n = 4, 0": 3 / 8,
    "butterfly n = 4, 2": -1 / 8, "butterfly 1/4": 1 / 4, "butterfly cos": 1, "butterfly cos 2": 1 / 2,
    "crease vertex": 3 / 4, "crease neighbour": 1 / 8, "crease edge": 1 / 2, "corner": 1, "sharpness of a child": 1,
    "blend of an edge": 1, "blend of a vertex": 1,
    "hoppe special": 3 / 8, "hoppe other": 5 / 8, "blz loop": 1 / 2, "blz catmull-clark": 3 / 8, "blz cos": 1 / 4,
    "blz ends": 3 / 4, "blz loop others": 1 / 8, "blz catmull-clark others": 1 / 4,
}

# Boundary rules other than cubic B-splines: told after a plus sign, loop+hoppe-1994.
HOPPE, BLZ = "hoppe-1994", "biermann-levin-zorin-2000"
VARIANTS = (f"loop+{HOPPE}", f"loop+{BLZ}", f"loop-warren+{BLZ}", f"catmull-clark+{BLZ}")


def base(scheme):
    return scheme.split("+")[0]


def rules_of(scheme):
    return scheme.split("+")[1] if "+" in scheme else None

TRIANGLES = ("loop", "loop-warren", "modified-butterfly")
PRIMAL = ("loop", "loop-warren", "catmull-clark", "modified-butterfly")
WITH_CREASES = ("loop", "loop-warren", "catmull-clark")
DUAL = ("doo-sabin", "catmull-clark-biquadratic")
SCHEMES = PRIMAL + DUAL


# ------------------------------------------------------------------------------------------------ meshes


class Mesh:
    """Faces as lists of vertices, and for each corner the number of the edge to the next; edges are numbered as they first appear.

    Edges have keys of their own (here: their ends), since in a refined mesh two edges may well have the same ends.
    """

    def __init__(self, faces, points, keys=None, sharp=None, corners=()):
        self.faces = [list(face) for face in faces]
        self.points = np.asarray(points, dtype=float)
        if keys is None:
            keys = [[frozenset((a, b)) for a, b in zip(face, face[1:] + face[:1])] for face in self.faces]
        self.number, self.ends, self.sides, self.edges = {}, [], [], []
        for f, (face, own) in enumerate(zip(self.faces, keys)):
            ids = []
            for i, key in enumerate(own):
                e = self.number.setdefault(key, len(self.ends))
                if e == len(self.ends):
                    self.ends.append((face[i], face[(i + 1) % len(face)]))
                    self.sides.append([])
                self.sides[e].append((f, i))
                ids.append(e)
            self.edges.append(ids)
        self.keys = list(self.number)
        given = sharp or {}
        self.tagged = {self.number[key]: s for key, s in given.items() if s > 0 and len(self.sides[self.number[key]]) == 2}
        self.sharpness = [INF if len(side) == 1 else self.tagged.get(e, 0.0) for e, side in enumerate(self.sides)]
        self.corners = set(corners)
        self.at = [[] for _ in range(len(self.points))]                 # the edges of each vertex, in no order
        for e, (a, b) in enumerate(self.ends):
            self.at[a].append(e)
            self.at[b].append(e)

    def other(self, e, v):
        a, b = self.ends[e]
        return b if a == v else a

    def is_boundary(self, v):
        return any(len(self.sides[e]) == 1 for e in self.at[v])

    def fans(self):
        """For each vertex its edges counter-clockwise, the clockwise-most first on the boundary; and the corners between them."""
        after, leaving = [{} for _ in self.points], [{} for _ in self.points]
        for f, face in enumerate(self.faces):
            for i, v in enumerate(face):
                after[v][self.edges[f][i]] = (self.edges[f][i - 1], (f, i))
                leaving[v][self.edges[f][i - 1]] = self.edges[f][i]
        fans = []
        for v in range(len(self.points)):
            if not after[v]:
                fans.append(([], []))
                continue
            starts = [e for e in after[v] if e not in leaving[v]]
            e = first = starts[0] if starts else next(iter(after[v]))
            spokes, between = [first], []
            while e in after[v]:
                e, corner = after[v][e]
                between.append(corner)
                if e == first:
                    break
                spokes.append(e)
            fans.append((spokes, between))
        return fans

    def across(self, f, e):
        """The third corner of the triangle beyond edge e of face f; None beyond the boundary."""
        for g, i in self.sides[e]:
            if g != f:
                return self.faces[g][(i + 2) % 3], g, i
        return None


class Rows:
    """Rows of weights, to be applied all at once."""

    def __init__(self):
        self.rows, self.columns, self.weights, self.count = [], [], [], 0

    def add(self, row):
        for column, weight in row:
            self.rows.append(self.count)
            self.columns.append(column)
            self.weights.append(weight)
        self.count += 1

    def apply(self, points):
        new = np.zeros((self.count, points.shape[1]))
        np.add.at(new, self.rows, np.array(self.weights)[:, None] * points[self.columns])
        return new


def mixed(share, one, other):
    return [(p, share * w) for p, w in one] + [(p, (1 - share) * w) for p, w in other]


# ------------------------------------------------------------------------------------------------ one step of each scheme


def edge_with_creases(mesh, e, smooth):
    """Sharpness 1 or more: the midpoint. Less: so much of it (DeRose, Kass and Truong)."""
    a, b = mesh.ends[e]
    s = mesh.sharpness[e]
    if s <= 0:
        return smooth()
    sharp = [(a, W["crease edge"]), (b, W["crease edge"])]
    return sharp if s >= 1 else mixed(s * W["blend of an edge"], sharp, smooth())


class Ends:
    """What is special at the ends of edges, where edges beyond a sharpness are creases."""

    def __init__(self, mesh, beyond, regular):
        self.mesh, self.beyond, self.regular, self.fans = mesh, beyond, regular, mesh.fans()

    def sharp(self, e):
        return self.mesh.sharpness[e] > self.beyond

    def sides(self, v):
        """Lists of edges from one crease to the next, both included, with nothing where the boundary is open."""
        spokes, _ = self.fans[v]
        cuts = [i for i, e in enumerate(spokes) if self.sharp(e)]
        runs = zip(cuts, cuts[1:]) if self.mesh.is_boundary(v) else zip(cuts, cuts[1:] + [cuts[0] + len(spokes)] if cuts else [])
        return [[spokes[i % len(spokes)] for i in range(i, j + 1)] for i, j in runs]

    def kind(self, v):
        count = sum(self.sharp(e) for e in self.mesh.at[v])
        if count > 2 or count == 2 and v in self.mesh.corners:
            return "corner"
        if v in self.mesh.corners:
            return "cone"
        return ("smooth", "dart", "crease")[count]

    def is_special(self, v):
        return self.kind(v) in ("corner", "cone") or any(len(side) - 1 != self.regular // 2 for side in self.sides(v))

    def theta(self, v, e):
        kind = self.kind(v)
        if kind == "dart":
            return 2 * math.pi / len(self.mesh.at[v])
        if kind not in ("crease", "corner"):
            return None
        side = next(side for side in self.sides(v) if e in side[1:-1])
        return (math.pi if kind == "crease" else math.pi / 2) / (len(side) - 1)


def edge_by_hoppe(ends, e, smooth):
    a, b = ends.mesh.ends[e]
    if not ends.sharp(e) or "dart" in (ends.kind(a), ends.kind(b)):
        return smooth()
    if ends.is_special(a) == ends.is_special(b):
        return [(a, W["crease edge"]), (b, W["crease edge"])]
    special, other = (a, b) if ends.is_special(a) else (b, a)
    return [(special, W["hoppe special"]), (other, W["hoppe other"])]


def edge_by_blz(ends, e, smooth, scheme, others):
    """3/4 - gamma and gamma at the ends, from each tagged end; `others` is the part that is not at the ends."""
    if ends.sharp(e):
        return [(p, W["crease edge"]) for p in ends.mesh.ends[e]]
    found = []
    for v in ends.mesh.ends[e]:
        theta = ends.theta(v, e)
        if theta is not None:
            gamma = W[f"blz {'catmull-clark' if scheme == 'catmull-clark' else 'loop'}"] - W["blz cos"] * math.cos(theta)
            found.append([(v, W["blz ends"] - gamma), (ends.mesh.other(e, v), gamma)] + others(e))
    return [(p, w / len(found)) for row in found for p, w in row] if found else smooth()


def edges_with_rules(mesh, scheme, smooth, others):
    """The rows of all edges, by the rules that the scheme's name tells."""
    rules = rules_of(scheme)
    if rules is None:
        return [edge_with_creases(mesh, e, lambda: smooth(e)) for e in range(len(mesh.ends))]
    views = [Ends(mesh, beyond, 4 if base(scheme) == "catmull-clark" else 6) for beyond in (0, 1)]

    def row(e, ends):
        if rules == HOPPE:
            return edge_by_hoppe(ends, e, lambda: smooth(e))
        return edge_by_blz(ends, e, lambda: smooth(e), base(scheme), others)

    rows = []
    for e in range(len(mesh.ends)):
        s = mesh.sharpness[e]
        if s == 0:
            # of the creases at its ends those that end within this step, on average
            near = [mesh.sharpness[x] for v in mesh.ends[e] for x in mesh.at[v]]
            ending = [x for x in near if 0 < x <= 1]
            s = sum(ending) / len(ending) if ending else 1
        rows.append(row(e, views[0]) if s >= 1 else mixed(s, row(e, views[0]), row(e, views[1])))
    return rows


def vertex_with_creases(mesh, v, smooth):
    """All creases, as far as those that end within this step last, on average; and those that go on alone, for the rest."""
    creases = [(e, mesh.sharpness[e]) for e in mesh.at[v] if mesh.sharpness[e] > 0]

    def rule(edges):
        if v in mesh.corners or len(edges) > 2:
            return [(v, W["corner"])]
        if len(edges) == 2:
            return [(v, W["crease vertex"])] + [(mesh.other(e, v), W["crease neighbour"]) for e in edges]
        return smooth()

    every = rule([e for e, _ in creases])
    ending = [s for _, s in creases if s <= 1]
    if not ending:
        return every
    return mixed(sum(ending) / len(ending) * W["blend of a vertex"], every, rule([e for e, s in creases if s > 1]))


def loop_beta(scheme, n):
    if base(scheme) == "loop-warren":
        return W["warren n = 3"] if n == 3 else W["warren n > 3"] / n
    return (W["loop beta: 5/8"] - (W["loop beta: 3/8"] + W["loop beta: 1/4"] * math.cos(2 * math.pi / n)) ** 2) / n


def loop_points(mesh, scheme):
    rows = Rows()
    for v in range(len(mesh.points)):
        def smooth():
            n = len(mesh.at[v])
            beta = loop_beta(scheme, n)
            return [(v, 1 - n * beta)] + [(mesh.other(e, v), beta) for e in mesh.at[v]]
        rows.add(vertex_with_creases(mesh, v, smooth))

    def across(e, weight):
        return [(mesh.faces[f][(i + 2) % 3], W[weight]) for f, i in mesh.sides[e]]

    def smooth(e):
        return [(p, W["loop edge ends"]) for p in mesh.ends[e]] + across(e, "loop edge opposite")
    for row in edges_with_rules(mesh, scheme, smooth, lambda e: across(e, "blz loop others")):
        rows.add(row)
    return rows.apply(mesh.points)


def butterfly_points(mesh, w):
    """Closed meshes; near the rim of a piece that was cut out points may be missing, and what is made there is not used."""
    rows = Rows()
    fans = mesh.fans()
    for v in range(len(mesh.points)):
        rows.add([(v, 1.0)])
    for e, (a, b) in enumerate(mesh.ends):
        stencils = [ring_of_end(mesh, fans, e, v) for v in (a, b) if len(mesh.at[v]) != 6]
        if not stencils:
            stencils = [ten_points(mesh, fans, e, w)]
        rows.add([(p, weight / len(stencils)) for stencil in stencils for p, weight in stencil])
    return rows.apply(mesh.points)


def ring_of_end(mesh, fans, e, v):
    spokes = fans[v][0]
    if e not in spokes:                                                  # at the rim of a piece, where fans only touch
        return [(v, 1.0)]
    n, start = len(spokes), spokes.index(e)
    if n == 3:
        weights = [W["butterfly n = 3, 0"], W["butterfly n = 3, 1"], W["butterfly n = 3, 1"]]
    elif n == 4:
        weights = [W["butterfly n = 4, 0"], 0, W["butterfly n = 4, 2"], 0]
    else:
        turn = [2 * math.pi * j / n for j in range(n)]
        weights = [(W["butterfly 1/4"] + W["butterfly cos"] * math.cos(t) + W["butterfly cos 2"] * math.cos(2 * t)) / n
                   for t in turn]
    return [(v, W["butterfly centre"])] + [(mesh.other(spokes[(start + j) % n], v), weights[j]) for j in range(n)]


def ten_points(mesh, fans, e, w):
    row = [(v, W["butterfly ends"] - w) for v in mesh.ends[e]]
    for f, i in mesh.sides[e]:
        row.append((mesh.faces[f][(i + 2) % 3], W["butterfly opposite"] + 2 * w))
        for j in (1, 2):
            beyond = mesh.across(f, mesh.edges[f][(i + j) % 3])
            if beyond:
                row.append((beyond[0], W["butterfly wings"] - w))
    for v in mesh.ends[e] if w else ():
        spokes = fans[v][0]
        straight = spokes[(spokes.index(e) + 3) % len(spokes)]
        row.append((mesh.other(straight, v), w * W["butterfly tips"]))
    return row


def catmull_clark_points(mesh, scheme):
    vertices, edges = len(mesh.points), len(mesh.ends)
    faces = Rows()
    for face in mesh.faces:
        faces.add([(v, W["catmull-clark face"] / len(face)) for v in face])
    pool = np.vstack([mesh.points, faces.apply(mesh.points)])
    at = [set() for _ in range(vertices)]
    for f, face in enumerate(mesh.faces):
        for i, v in enumerate(face):
            at[v].add((f, i))
    rows = Rows()
    for v in range(vertices):
        def smooth():
            # Q/n + 2 R/n + S (n - 3)/n: Q the mean of the face points, R that of the edges' midpoints, S the old vertex
            n = len(mesh.at[v])
            row = [(v, (n - W["catmull-clark S"]) / n)]
            row += [(vertices + f, W["catmull-clark Q"] / n / n) for f, _ in at[v]]
            for e in mesh.at[v]:
                row += [(p, W["catmull-clark R"] / n / n / 2) for p in mesh.ends[e]]
            return row
        rows.add(vertex_with_creases(mesh, v, smooth))

    def smooth(e):
        return [(p, W["catmull-clark edge"]) for p in [*mesh.ends[e]] + [vertices + f for f, _ in mesh.sides[e]]]

    def others(e):
        # 1/16 for each of four other vertices of quads: a quarter of the face points, less what these have of the ends
        faces = [(vertices + f, W["blz catmull-clark others"]) for f, _ in mesh.sides[e]]
        return faces + [(p, -W["blz catmull-clark others"] / 2) for p in mesh.ends[e]]
    for row in edges_with_rules(mesh, scheme, smooth, others):
        rows.add(row)
    made = rows.apply(pool)
    return np.vstack([made[:vertices + edges], pool[vertices:]])


def dual_points(mesh, scheme):
    rows = Rows()
    for face in mesh.faces:
        n = len(face)
        for i in range(n):
            if scheme == "doo-sabin":
                weights = [(W["doo-sabin 3"] + W["doo-sabin cos"] * math.cos(2 * math.pi * j / n)) / (4 * n) for j in range(n)]
                weights[0] = (n + W["doo-sabin own"]) / (4 * n)
            else:
                # the mean of the vertex, the midpoints of its two edges, and the centroid
                weights = [W["biquadratic face"] / n] * n
                weights[0] += W["biquadratic vertex"]
                for j in (0, 1, 0, n - 1):
                    weights[j] += W["biquadratic edge"] / 2
            rows.add([(face[(i + j) % n], weights[j]) for j in range(n)])
    return rows.apply(mesh.points)


def children(mesh):
    """The keys of the halves of an edge, and their sharpness."""
    sharp = {}
    for e, s in mesh.tagged.items():
        for v in mesh.ends[e]:
            sharp[("half", e, v)] = s - W["sharpness of a child"]
    return sharp


def step(mesh, scheme, w=0.0):
    if scheme in DUAL:
        return dual_step(mesh, scheme)
    vertices, edges = len(mesh.points), len(mesh.ends)
    faces, keys = [], []
    if base(scheme) in TRIANGLES:
        require(all(len(face) == 3 for face in mesh.faces), "not triangles")
        points = butterfly_points(mesh, w) if scheme == "modified-butterfly" else loop_points(mesh, scheme)
        for f, (face, own) in enumerate(zip(mesh.faces, mesh.edges)):
            on = [vertices + e for e in own]
            for i in range(3):
                faces.append([face[i], on[i], on[i - 1]])
                keys.append([("half", own[i], face[i]), ("inside", f, i), ("half", own[i - 1], face[i])])
            faces.append(on)
            keys.append([("inside", f, 1), ("inside", f, 2), ("inside", f, 0)])
    else:
        points = catmull_clark_points(mesh, scheme)
        for f, (face, own) in enumerate(zip(mesh.faces, mesh.edges)):
            for i in range(len(face)):
                faces.append([face[i], vertices + own[i], vertices + edges + f, vertices + own[i - 1]])
                keys.append([("half", own[i], face[i]), ("inside", f, own[i]), ("inside", f, own[i - 1]),
                             ("half", own[i - 1], face[i])])
    return Mesh(faces, points, keys, children(mesh), mesh.corners)


def dual_step(mesh, scheme):
    start, total = [], 0
    for face in mesh.faces:
        start.append(total)
        total += len(face)

    def point(corner):
        return start[corner[0]] + corner[1]

    faces = [[start[f] + i for i in range(len(face))] for f, face in enumerate(mesh.faces)]
    keys = [[("face", f, i) for i in range(len(face))] for f, face in enumerate(mesh.faces)]
    for side in mesh.sides:
        if len(side) < 2:
            continue
        (f, i), (g, j) = side
        after_f, after_g = (f, (i + 1) % len(mesh.faces[f])), (g, (j + 1) % len(mesh.faces[g]))
        # around the edge: the two points of one face, then those of the other; between the faces, edges shared with vertices' faces
        faces.append([point(after_f), point((f, i)), point(after_g), point((g, j))])
        keys.append([("face", f, i), ("turn", f, i), ("face", g, j), ("turn", g, j)])
    for v, (spokes, between) in enumerate(mesh.fans()):
        if not spokes or mesh.is_boundary(v):
            continue
        faces.append([point(corner) for corner in between])
        # from one corner to the next counter-clockwise over the edge before the first: its half-edge on the other side leaves v
        own = []
        for f, i in between:
            e = mesh.edges[f][i - 1]
            beyond = [side for side in mesh.sides[e] if side != (f, (i - 1) % len(mesh.faces[f]))]
            own.append(("turn", *beyond[0]))
        keys.append(own)
    return Mesh(faces, dual_points(mesh, scheme), keys)


# ------------------------------------------------------------------------------------------------ limits


def cut_out(mesh, v, rings):
    """The faces within some rings around a vertex, which becomes number 0, with the keys of their edges.

    The rim of the piece is no boundary of the mesh: what goes wrong there is cut off after the next step.
    """
    inside, chosen = {v}, []
    for _ in range(rings):
        chosen = [f for f, face in enumerate(mesh.faces) if inside.intersection(face)]
        inside = set().union(*(mesh.faces[f] for f in chosen))
    order = {old: new for new, old in enumerate([v] + sorted(inside - {v}))}
    keys = [[mesh.keys[e] for e in mesh.edges[f]] for f in chosen]
    sharp = {mesh.keys[e]: mesh.sharpness[e] for f in chosen for e in mesh.edges[f]}
    piece = Mesh([[order[p] for p in mesh.faces[f]] for f in chosen], mesh.points[list(order)], keys, sharp,
                 {order[c] for c in mesh.corners if c in order})
    return piece


class Deep:
    """A vertex of a mesh, refined again and again: its limit, and the normals of its sides."""

    LEVELS = 64

    def __init__(self, mesh, v, scheme, w=0.0, levels=LEVELS):
        self.scheme, self.w, self.levels = scheme, w, levels
        self.rings = 3 if scheme == "modified-butterfly" else 2
        ending = max([s for s in mesh.tagged.values() if s < INF], default=0)
        piece = cut_out(mesh, v, self.rings + 1)
        for _ in range(2 + math.ceil(ending)):
            piece = cut_out(step(piece, scheme, w), 0, self.rings + 1)
        self.piece = piece
        spokes, _ = piece.fans()[0]
        boundary = piece.is_boundary(0)
        cuts = [i for i, e in enumerate(spokes) if piece.sharpness[e] > 0]
        self.is_corner = 0 in piece.corners or len(cuts) > 2
        self.creases = len(cuts)
        if len(cuts) < 2:
            first = cuts[0] if cuts else 0
            sides = [[spokes[(first + i) % len(spokes)] for i in range(len(spokes) + 1)]]
        else:
            sides = []
            for i, j in zip(cuts, cuts[1:] + cuts[:1]):
                if boundary and j <= i:
                    continue
                length = (j - i) % len(spokes)
                sides.append([spokes[(i + k) % len(spokes)] for k in range(length + 1)])
        results = [self.side([piece.other(e, 0) for e in side]) for side in sides]
        self.limit = results[0][0]
        self.sides = [(normal, regular, moved) for _, normal, regular, moved in results]

    def side(self, ring):
        """One side: the points of its ring are told by their numbers, which stay as they are cut out."""
        mesh = self.piece
        first = mesh.points
        origin, back, there = np.zeros(3), np.eye(3), np.eye(3)
        closed = ring[0] == ring[-1]
        normal, moved, regular, normals = None, INF, False, []
        size = max(1e-300, np.abs(first).max())
        for level in range(self.levels):
            origin = origin + back @ mesh.points[0]
            points = mesh.points - mesh.points[0]
            around = points[ring[:-1] if closed else ring]
            _, s, axes = np.linalg.svd(around, full_matrices=True)
            s = list(s) + [0.0] * (3 - len(s))
            if s[1] <= 1e-14 * s[0] or s[0] == 0:
                return origin, None, False, 0.0
            scale = np.diag([1 / s[0], 1 / s[1], 1 / s[1]]) @ axes
            points = points @ scale.T
            there, back = scale @ there, back @ np.linalg.inv(scale)
            there = there / np.abs(there).max()
            # normals are covectors
            turns = [np.cross(points[a], points[b]) for a, b in zip(ring, ring[1:])]
            total = sum(turns)
            own = np.linalg.det(there) * there.T @ total
            length = np.linalg.norm(own)
            own = own / length if length > 0 else None
            moved = INF if normal is None or own is None else np.abs(own - normal).max()
            normal = own
            normals.append(own)
            regular = all(turn @ total > 0 for turn in turns)
            mesh = Mesh(mesh.faces, points, [[mesh.keys[e] for e in own] for own in mesh.edges],
                        {mesh.keys[e]: s for e, s in mesh.tagged.items()}, mesh.corners)
            if level > 20 and moved < 1e-14 and np.abs(back).max() < 1e-16 * size:
                break
            finer = step(mesh, self.scheme, self.w)
            vertices, numbers = len(mesh.points), []
            for p in ring:
                e = next(e for e in mesh.at[0] if mesh.other(e, 0) == p)
                numbers.append(vertices + e)
            mesh, ring = renumbered(finer, numbers, self.rings + 1)
        if moved > 1e-12 and len(normals) == self.levels and all(n is not None for n in normals):
            # a Jordan block: towards the limit like 1/m, which the levels m, m/2 and m/4 take out
            m = self.levels - 1
            last, half, quarter = normals[m], normals[m // 2], normals[m // 4]
            once = 2 * last - half
            twice = (8 * last - 6 * half + quarter) / 3
            normal, moved = unit(twice), max(moved, np.abs(twice - once).max())
        return origin, normal, regular, moved


def renumbered(mesh, ring, rings):
    inside, chosen = {0}, []
    for _ in range(rings):
        chosen = [f for f, face in enumerate(mesh.faces) if inside.intersection(face)]
        inside = set().union(*(mesh.faces[f] for f in chosen))
    order = {old: new for new, old in enumerate([0] + sorted(inside - {0}))}
    return cut_out(mesh, 0, rings), [order[p] for p in ring]


def deep_of_face(mesh, f, scheme):
    """Dual: the middle of a face, which is made of its own corners alone."""
    points = mesh.points[mesh.faces[f]]
    origin, size = np.zeros(3), 1.0
    normal = None
    piece = Mesh([list(range(len(points)))], points)
    for _ in range(4 * Deep.LEVELS):
        middle = piece.points[0]
        origin = origin + size * middle
        own = piece.points - middle
        scale = np.abs(own).max()
        if scale == 0:
            return origin, None
        size *= scale
        piece = Mesh(piece.faces, own / scale)
        piece = dual_step(piece, scheme)
        p = piece.points
        normal = sum(np.cross(p[i] - p[0], p[(i + 1) % len(p)] - p[0]) for i in range(len(p)))
    length = np.linalg.norm(normal)
    return origin, normal / length if length > 1e-12 else None


def published_limit(mesh, v, scheme, fans):
    """The limit of a vertex, and its normal where tangent masks are published; None for what isn't."""
    if mesh.tagged and any(s < INF for s in mesh.tagged.values()):
        return None, None
    P = mesh.points
    creases = [e for e in mesh.at[v] if mesh.sharpness[e] > 0]
    if scheme == "modified-butterfly":
        return P[v], None
    if v in mesh.corners or len(creases) > 2:
        return P[v], None
    if len(creases) == 2:
        a, b = (P[mesh.other(e, v)] for e in creases)
        return (a + 4 * P[v] + b) / 6, None
    if creases:
        return None, None
    spokes, between = fans[v]
    n = len(spokes)
    ring = [P[mesh.other(e, v)] for e in spokes]
    turn = [2 * math.pi * i / n for i in range(n)]
    if base(scheme) in ("loop", "loop-warren"):
        beta = loop_beta(scheme, n)
        centre = 1 / (1 + 8 * n * beta / 3)
        t1 = sum(math.cos(t) * p for t, p in zip(turn, ring))
        t2 = sum(math.sin(t) * p for t, p in zip(turn, ring))
        return centre * P[v] + (1 - centre) / n * sum(ring), unit(np.cross(t1, t2))
    if any(len(mesh.faces[f]) != 4 for f, _ in between):
        return None, None
    diagonal = [P[mesh.faces[f][(i + 2) % 4]] for f, i in between]
    limit = (n * P[v] + 4 / n * sum(ring) + 1 / n * sum(diagonal)) / (n + 5)
    c = math.cos(2 * math.pi / n)
    a = 1 + c + math.cos(math.pi / n) * math.sqrt(2 * (9 + c))
    nearby = [t + 2 * math.pi / n for t in turn]
    t1 = sum(a * math.cos(t) * r + (math.cos(t) + math.cos(u)) * d for t, u, r, d in zip(turn, nearby, ring, diagonal))
    t2 = sum(a * math.sin(t) * r + (math.sin(t) + math.sin(u)) * d for t, u, r, d in zip(turn, nearby, ring, diagonal))
    return limit, unit(np.cross(t1, t2))


def unit(vector):
    length = np.linalg.norm(vector)
    return vector / length if length > 0 else vector


# ------------------------------------------------------------------------------------------------ files


class Read:
    """What a file says: points, faces, normals, creases by their ends, corners."""

    def __init__(self, points, faces, normals=None, creases=None, corners=()):
        self.points, self.faces = np.array(points, dtype=float).reshape(-1, 3), faces
        self.normals = None if normals is None else np.array(normals, dtype=float).reshape(-1, 3)
        self.creases, self.corners = creases or {}, set(corners)


def read_obj(data):
    points, faces, normals, creases, corners, of_normals = [], [], [], {}, set(), []
    for line in data.decode("ascii").splitlines():
        words = line.split("#")[0].split()
        if not words:
            continue
        if words[0] == "v":
            points.append([float(x) for x in words[1:4]])
        elif words[0] == "vn":
            normals.append([float(x) for x in words[1:4]])
        elif words[0] == "f":
            corner = [word.split("/") for word in words[1:]]
            faces.append([int(c[0]) - 1 for c in corner])
            of_normals += [(int(c[0]), int(c[2])) for c in corner if len(c) == 3]
        elif words[0] == "t":
            integers, floats, strings = (int(x) for x in words[2].split("/"))
            require(strings == 0 and len(words) == 3 + integers + floats or words[2].count("/") < 2, f"tag {line!r}")
            ids = [int(x) for x in words[3:3 + integers]]
            values = [float(x) for x in words[3 + integers:]]
            if words[1] == "crease":
                for k, (a, b) in enumerate(zip(ids[::2], ids[1::2])):
                    s = values[k if len(values) > 1 else 0]
                    creases[frozenset((a, b))] = INF if s >= 10 else s
            elif words[1] == "corner":
                corners.update(ids)
        else:
            raise Mismatch(f"an OBJ line that is not known: {line!r}")
    require(all(a == b for a, b in of_normals), "normals of an OBJ file are not those of their vertices")
    return Read(points, faces, normals or None, creases, corners)


PLY_TYPES = {"char": "b", "int8": "b", "uchar": "B", "uint8": "B", "short": "h", "int16": "h", "ushort": "H", "uint16": "H",
             "int": "i", "int32": "i", "uint": "I", "uint32": "I", "float": "f", "float32": "f", "double": "d", "float64": "d"}


def read_ply(data):
    header, body = data.split(b"end_header\n", 1)
    lines = [line.split() for line in header.decode("ascii").splitlines()]
    require(lines[0] == ["ply"] and lines[1][1:] == ["binary_little_endian", "1.0"], "the head of a PLY file")
    elements = []
    for words in lines[2:]:
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    at, found, types = 0, {}, {}
    for name, count, properties in elements:
        rows = []
        for _ in range(count):
            row = {}
            for p in properties:
                if p[0] == "list":
                    (length,) = struct.unpack_from("<" + PLY_TYPES[p[1]], body, at)
                    at += struct.calcsize(PLY_TYPES[p[1]])
                    kind = "<" + str(length) + PLY_TYPES[p[2]]
                    row[p[3]] = list(struct.unpack_from(kind, body, at))
                    at += struct.calcsize(kind)
                else:
                    (row[p[1]],) = struct.unpack_from("<" + PLY_TYPES[p[0]], body, at)
                    at += struct.calcsize(PLY_TYPES[p[0]])
                    types[p[1]] = p[0]
            rows.append(row)
        found[name] = rows
    require(at == len(body), "a PLY file has bytes beyond its end")
    vertices = found["vertex"]
    normals = [[v["nx"], v["ny"], v["nz"]] for v in vertices] if "nx" in types else None
    read = Read([[v["x"], v["y"], v["z"]] for v in vertices], [f["vertex_indices"] for f in found["face"]], normals)
    read.type = types.get("x")
    return read


def read_off(data):
    words = data.decode("ascii").split()
    require(words[0] in ("OFF", "NOFF"), "the first word of an OFF file")
    vertices, faces = int(words[1]), int(words[2])
    each, at = (6 if words[0] == "NOFF" else 3), 4
    numbers = [[float(x) for x in words[at + each * i:at + each * (i + 1)]] for i in range(vertices)]
    at += each * vertices
    polygons = []
    for _ in range(faces):
        n = int(words[at])
        polygons.append([int(x) for x in words[at + 1:at + 1 + n]])
        at += 1 + n
    require(at == len(words), "an OFF file has words beyond its end")
    return Read([p[:3] for p in numbers], polygons, [p[3:] for p in numbers] if each == 6 else None)


def read_stl(data):
    """Triangles of points of 32 bits, corner by corner; each with its normal."""
    (count,) = struct.unpack_from("<I", data, 80)
    require(len(data) == 84 + 50 * count, "the length of an STL file")
    numbers = np.array([struct.unpack_from("<12f", data, 84 + 50 * i) for i in range(count)], dtype=float).reshape(-1, 4, 3)
    return numbers[:, 1:], numbers[:, 0]


def read_glb(data):
    magic, version, length = struct.unpack_from("<4sII", data, 0)
    require(magic == b"glTF" and version == 2 and length == len(data), "the head of a GLB file")
    size, kind = struct.unpack_from("<I4s", data, 12)
    require(kind == b"JSON" and size % 4 == 0, "the first chunk of a GLB file")
    document = json.loads(data[20:20 + size])
    rest, kind = struct.unpack_from("<I4s", data, 20 + size)
    require(kind == b"BIN\0" and 28 + size + rest == len(data) and rest % 4 == 0, "the second chunk of a GLB file")
    binary = data[28 + size:]
    require(document["asset"]["version"] == "2.0" and document["buffers"][0]["byteLength"] <= rest, "the JSON of a GLB file")

    def accessor(index):
        told = document["accessors"][index]
        view = document["bufferViews"][told["bufferView"]]
        start = view.get("byteOffset", 0) + told.get("byteOffset", 0)
        kinds = {5126: ("<f4", 4), 5125: ("<u4", 4), 5123: ("<u2", 2), 5121: ("u1", 1)}
        dtype, width = kinds[told["componentType"]]
        each = {"SCALAR": 1, "VEC3": 3}[told["type"]]
        require(start % width == 0, "an accessor that is not aligned")
        require(told.get("byteOffset", 0) + each * width * told["count"] <= view["byteLength"], "an accessor beyond its view")
        values = np.frombuffer(binary, dtype, told["count"] * each, start).reshape(-1, each)
        for name, pick in (("min", np.min), ("max", np.max)):
            if name in told:
                require(np.array_equal(np.array(told[name], dtype="f4"), pick(values, axis=0)), f"{name} of an accessor")
        return values, told

    (mesh,) = document["meshes"]
    (part,) = mesh["primitives"]
    require(part.get("mode", 4) == 4, "a GLB file without triangles")
    positions, told = accessor(part["attributes"]["POSITION"])
    require("min" in told and "max" in told, "positions without min and max")
    normals = accessor(part["attributes"]["NORMAL"])[0] if "NORMAL" in part["attributes"] else None
    triangles = accessor(part["indices"])[0].reshape(-1, 3)
    return Read(positions, triangles.tolist(), normals)


def obj_of(mesh):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh.points.tolist()]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in mesh.faces]
    for k, (e, s) in enumerate(mesh.tagged.items()):
        a, b = mesh.ends[e]
        if k % 3 == 0:
            lines.append(f"t crease {a + 1}/{b + 1} {s}")
        elif k % 3 == 1:
            lines.append(f"t crease {b + 1} {a + 1} {s}")
        else:
            lines.append(f"t crease 2/1/0 {a} {b} {10 if s == INF else s}")
    for k, v in enumerate(sorted(mesh.corners)):
        lines.append(f"t corner {v + 1} 10" if k % 2 else f"t corner 1/1/0 {v} 10")
    return ("\n".join(lines) + "\n").encode()


def ply_of(mesh, form):
    big = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}[form]
    head = f"ply\nformat {form} 1.0\ncomment by hand\nelement vertex {len(mesh.points)}\nproperty double x\nproperty uchar red\n" \
           f"property double y\nproperty double z\nelement face {len(mesh.faces)}\nproperty float quality\n" \
           "property list uchar int vertex_index\nend_header\n"
    body = b""
    for x, y, z in mesh.points.tolist():
        body += f"{x!r} 7 {y!r} {z!r}\n".encode() if big is None else struct.pack(big + "dBdd", x, 7, y, z)
    for face in mesh.faces:
        n = len(face)
        body += f"0.5 {n} {' '.join(map(str, face))}\n".encode() if big is None else struct.pack(f"{big}fB{n}i", 0.5, n, *face)
    return head.encode() + body


def off_of(mesh):
    lines = ["OFF", f"{len(mesh.points)} {len(mesh.faces)} 0"]
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in mesh.points.tolist()]
    lines += [f"{len(face)} {' '.join(map(str, face))}" for face in mesh.faces]
    return ("\n".join(lines) + "\n").encode()


def stl_of(mesh, binary):
    if not binary:
        text = "solid by hand\n"
        for face in mesh.faces:
            text += "facet normal 0 0 0\nouter loop\n"
            text += "".join(f"vertex {x!r} {y!r} {z!r}\n" for x, y, z in mesh.points[face].tolist())
            text += "endloop\nendfacet\n"
        return (text + "endsolid by hand\n").encode()
    data = b"\0" * 80 + struct.pack("<I", len(mesh.faces))
    for face in mesh.faces:
        data += struct.pack("<12fH", 0, 0, 0, *mesh.points[face].ravel(), 0)
    return data


# ------------------------------------------------------------------------------------------------ meshes to try


ICOSAHEDRON = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
               (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
TETRAHEDRON = [(0, 1, 3), (1, 0, 2), (2, 3, 1), (3, 2, 0)]
OCTAHEDRON = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1), (5, 2, 1), (5, 3, 2), (5, 4, 3), (5, 1, 4)]
CUBE = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


def directed(faces):
    return {(a, b): f for f, face in enumerate(faces) for a, b in zip(face, face[1:] + face[:1])}


def triangulation(rng, changes):
    """A closed triangulation of the sphere: flips, and vertices put into faces and onto edges."""
    faces = [list(f) for f in rng.choice([ICOSAHEDRON, TETRAHEDRON, OCTAHEDRON])]
    for _ in range(changes):
        along = directed(faces)
        (a, b), f = rng.choice(sorted(along.items()))
        g = along[(b, a)]
        c, d = ((set(faces[f]) - {a, b}).pop(), (set(faces[g]) - {a, b}).pop())
        new = 1 + max(max(face) for face in faces)
        valence = Counter(v for face in faces for v in face)
        action = rng.random()
        if action < 0.7:
            if (c, d) not in along and c != d and valence[a] > 3 and valence[b] > 3:
                faces[f], faces[g] = [a, d, c], [d, b, c]
        elif action < 0.85:
            faces[f] = [a, b, new]
            faces += [[b, c, new], [c, a, new]]
        else:
            faces[f], faces[g] = [a, new, c], [new, b, c]
            faces += [[b, new, d], [new, a, d]]
    return faces


def polygons(rng, changes):
    """A closed mesh of polygons: a triangulation with edges taken out, where faces stay simple and valences 3 or more."""
    faces = triangulation(rng, changes)
    for _ in range(2 * changes):
        along = directed(faces)
        (a, b), f = rng.choice(sorted(along.items()))
        g = along[(b, a)]
        valence = Counter(v for face in faces for v in face)
        if f == g or len(faces) < 5 or valence[a] < 4 or valence[b] < 4 or len(set(faces[f]) & set(faces[g])) != 2:
            continue
        if len(faces[f]) + len(faces[g]) > 10:
            continue
        i, j = faces[f].index(b), faces[g].index(a)
        joined = faces[f][i:] + faces[f][:i] + (faces[g][j:] + faces[g][:j])[1:-1]
        faces = [face for k, face in enumerate(faces) if k not in (f, g)] + [joined]
    return faces


def holes(rng, faces, most):
    """Faces taken out as long as the rest is one fan around each vertex, and in one piece by its edges."""
    for _ in range(most):
        f = rng.randrange(len(faces))
        rest = faces[:f] + faces[f + 1:]
        if len(rest) > 1 and manifold(rest):
            faces = rest
    return faces


def manifold(faces):
    along = directed(faces)
    if len(along) != sum(len(face) for face in faces):
        return False
    at = {}
    for face in faces:
        for i, v in enumerate(face):
            at.setdefault(v, {})[face[(i + 1) % len(face)]] = face[i - 1]
    for after in at.values():
        starts = set(after) - set(after.values())
        if len(starts) > 1:
            return False
        first = p = starts.pop() if starts else next(iter(after))
        count = 0
        while p in after:
            p, count = after[p], count + 1
            if p == first:
                break
        if count != len(after):
            return False
    return True


def grid(columns, rows, wrap_columns, wrap_rows, triangles, rng):
    across, down = columns + (not wrap_columns), rows + (not wrap_rows)

    def at(i, j):
        return (i % across) + across * (j % down)

    faces = []
    for j in range(rows):
        for i in range(columns):
            quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
            if not triangles:
                faces.append(quad)
            elif rng.random() < 0.5:
                faces += [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]
            else:
                faces += [[quad[1], quad[2], quad[3]], [quad[1], quad[3], quad[0]]]
    return faces


def boundary_fan(k, triangles):
    """k faces around one vertex of the boundary."""
    if triangles:
        return [[0, i + 1, i + 2] for i in range(k)]
    return [[0, 2 * i + 1, 2 * i + 2, 2 * i + 3] for i in range(k)]


def prism(n):
    top, bottom = list(range(n)), list(range(n, 2 * n))
    return [top, bottom[::-1]] + [[top[i], bottom[i], bottom[(i + 1) % n], top[(i + 1) % n]] for i in range(n)]


def with_flap_pyramid(n):
    return [[0, i + 1, (i + 1) % n + 1] for i in range(n)] + [list(range(n, 0, -1))]


def bipyramid(n):
    return [[0, i + 2, (i + 1) % n + 2] for i in range(n)] + [[1, (i + 1) % n + 2, i + 2] for i in range(n)]


def shuffled(rng, faces, numpy_rng):
    """New numbers, another order of faces, faces turned; random points."""
    used = sorted({v for face in faces for v in face})
    names = list(range(len(used)))
    rng.shuffle(names)
    name = dict(zip(used, names))
    faces = [[name[v] for v in face] for face in faces]
    rng.shuffle(faces)
    turned = []
    for face in faces:
        k = rng.randrange(len(face))
        turned.append(face[k:] + face[:k])
    return turned, numpy_rng.uniform(-1, 1, (len(used), 3))


SHARP = [0.25, 0.3, 0.75, 1.0, 1.4, 1.75, 2.0, 2.5, 3.2, INF, INF]


def tagged(rng, faces, points, creases, corners):
    mesh = Mesh(faces, points)
    sharp = {}
    if creases:
        # runs of edges rather than single ones, so that all kinds of vertices come up
        for _ in range(creases):
            v = rng.randrange(len(points))
            kind = rng.choice(SHARP)
            for _ in range(rng.randrange(1, 5)):
                e = rng.choice(mesh.at[v])
                if len(mesh.sides[e]) == 2:
                    sharp[mesh.keys[e]] = kind if rng.random() < 0.7 else rng.choice(SHARP)
                v = mesh.other(e, v)
    return Mesh(faces, points, None, sharp, rng.sample(range(len(points)), min(corners, len(points))))


def triangle_meshes(rng, random_points, rounds):
    yield "tetrahedron", TETRAHEDRON
    yield "octahedron", OCTAHEDRON
    yield "bipyramid over 7", bipyramid(7)
    yield "two in one file", [list(f) for f in TETRAHEDRON] + [[v + 4 for v in f] for f in OCTAHEDRON]
    for k in range(1, 8):
        yield f"fan of {k}", boundary_fan(k, True)
    yield "torus", grid(4, 3, True, True, True, rng)
    yield "tube", grid(4, 2, True, False, True, rng)
    yield "sheet", grid(3, 2, False, False, True, rng)
    for i in range(rounds):
        yield f"random {i}", triangulation(rng, 20 + 15 * i)
        yield f"random with holes {i}", holes(rng, triangulation(rng, 20 + 10 * i), 4 + 2 * i)


def polygon_meshes(rng, random_points, rounds):
    yield "cube", CUBE
    yield "tetrahedron", TETRAHEDRON
    for n in (3, 5, 6, 9):
        yield f"prism over {n}", prism(n)
    yield "pyramid over 7", with_flap_pyramid(7)
    yield "one pentagon", [list(range(5))]
    for k in range(1, 8):
        yield f"fan of {k}", boundary_fan(k, False)
    yield "torus", grid(4, 3, True, True, False, rng)
    yield "tube", grid(4, 2, True, False, False, rng)
    yield "sheet", grid(3, 2, False, False, False, rng)
    for i in range(rounds):
        yield f"random {i}", polygons(rng, 20 + 15 * i)
        yield f"random with holes {i}", holes(rng, polygons(rng, 20 + 10 * i), 3 + 2 * i)


def is_closed(faces):
    along = directed([list(face) for face in faces])
    return all((b, a) in along for a, b in along)


# ------------------------------------------------------------------------------------------------ the program


class Program:
    def __init__(self, path, folder):
        self.path, self.folder, self.count = path, folder, 0
        self.runs = Counter()

    def run(self, command, scheme, given, options=(), ending="obj", came="obj"):
        self.count += 1
        self.runs[command] += 1
        source, target = self.folder / f"in.{came}", self.folder / f"out.{ending}"
        source.write_bytes(given)
        target.unlink(missing_ok=True)
        rules = ["--boundary-rules", rules_of(scheme)] if rules_of(scheme) else []
        words = [self.path, command, base(scheme), str(source), "--out", str(target), *rules, *options]
        try:
            done = subprocess.run(words, capture_output=True, text=True, timeout=600, check=False)
        except OSError as error:
            raise Unable(f"{self.path} can't be run: {error}") from error
        require(done.returncode == 0, f"exit status {done.returncode}: {done.stderr.strip()[-400:]}")
        return target.read_bytes()


class Case:
    """A mesh, a scheme and options; the program's answer is kept, so that a self-test can look at it again."""

    def __init__(self, name, mesh, scheme, levels, options=(), w=0.0):
        self.name, self.mesh, self.scheme, self.levels, self.options, self.w = name, mesh, scheme, levels, tuple(options), w
        self.answer = None

    def __str__(self):
        return f"{self.scheme} on '{self.name}', {self.levels} levels {' '.join(self.options)}".rstrip()

    def ask(self, program):
        if self.answer is None:
            self.answer = program.run("refine", self.scheme, file_of(self.mesh), ["--levels", str(self.levels), *self.options])
        return self.answer

    def own(self):
        mesh = self.mesh
        for _ in range(self.levels):
            mesh = step(mesh, self.scheme, self.w)
        return mesh

    def check(self, program):
        return compare(read_obj(self.ask(program)), self.own(), TIGHT)


def turned_alike(one, other):
    if sorted(one) != sorted(other):
        return False
    n = len(one)
    return any(all(one[(i + k) % n] == other[i] for i in range(n)) for k in range(n))


def compare(read, mesh, tolerance, tags=True):
    """Returns the largest difference."""
    require(len(read.points) == len(mesh.points), f"{len(read.points)} points, not {len(mesh.points)}")
    require(len(read.faces) == len(mesh.faces), f"{len(read.faces)} faces, not {len(mesh.faces)}")
    for f, (theirs, ours) in enumerate(zip(read.faces, mesh.faces)):
        require(turned_alike(theirs, ours), f"face {f} is {theirs}, not {ours}")
    apart = np.abs(read.points - mesh.points)
    worst = int(np.argmax(np.max(apart, axis=1)))
    require(apart.max() <= tolerance, f"point {worst} is {read.points[worst]}, not {mesh.points[worst]}: off by {apart.max():.3g}")
    if tags:
        ours = {frozenset(mesh.ends[e]): s for e, s in mesh.tagged.items()}
        require(set(read.creases) == set(ours), f"creases {set(read.creases) ^ set(ours)} in one only")
        for edge, s in ours.items():
            same = read.creases[edge] == s or abs(read.creases[edge] - s) < 1e-9
            require(same, f"the crease {set(edge)} has sharpness {read.creases[edge]}, not {s}")
        require(read.corners == mesh.corners, f"corners {read.corners}, not {mesh.corners}")
    return apart.max()


def refinement_cases(rng, random_points, rounds):
    for kind, meshes, schemes in (("triangles", triangle_meshes, TRIANGLES + ("catmull-clark",) + DUAL + VARIANTS),
                                  ("polygons", polygon_meshes, ("catmull-clark",) + DUAL + VARIANTS[-1:])):
        for name, faces in meshes(rng, random_points, rounds):
            closed = is_closed(faces)
            faces, points = shuffled(rng, [list(face) for face in faces], random_points)
            name = f"{name} ({kind})"
            levels = 3 if len(faces) < 12 else 2 if len(faces) < 60 else 1
            for scheme in schemes:
                if scheme in DUAL and not any(True for _ in directed(faces)):
                    continue
                if scheme == "modified-butterfly" and not closed:
                    continue
                if scheme in DUAL and kind == "triangles" and not closed and levels > 2:
                    continue
                plain = Mesh(faces, points)
                yield Case(name, plain, scheme, levels)
                if scheme == "modified-butterfly":
                    for text, w in (("1/32", 1 / 32), ("-1/10", -0.1)):
                        yield Case(name, plain, scheme, min(levels, 2), ["--set", f"w={text}"], w)
                if base(scheme) not in WITH_CREASES:
                    continue
                for creases, corners in ((1, 0), (3, 1), (len(faces) // 2, 0), (len(faces), 2)):
                    yield Case(name + ", tagged", tagged(rng, faces, points, creases, corners), scheme, levels)
                if not closed:
                    yield Case(name, cornered(tagged(rng, faces, points, 2, 0)), scheme, levels, ["--boundary", "corner"])
                degrees = rng.choice([30, 60, 90, 120])
                yield Case(name, by_angle(plain, degrees), scheme, levels, ["--crease-angle", str(degrees)])


def cornered(mesh):
    """The vertices of one face on the boundary are corners, too."""
    at = Counter(v for face in mesh.faces for v in face)
    corners = {v for v in at if at[v] == 1}
    return Cornered(mesh, corners)


class Cornered(Mesh):
    """A mesh with corners that its file doesn't tell."""

    def __init__(self, mesh, corners):
        super().__init__(mesh.faces, mesh.points, None, {mesh.keys[e]: s for e, s in mesh.tagged.items()}, mesh.corners | corners)
        self.told = mesh


def by_angle(mesh, degrees):
    """The edges whose faces meet at this angle or more: creases that the file doesn't tell."""
    normals = []
    for face in mesh.faces:
        p = mesh.points[face]
        normals.append(unit(sum(np.cross(p[i], p[(i + 1) % len(p)]) for i in range(len(p)))))
    sharp = {}
    for e, side in enumerate(mesh.sides):
        if len(side) == 2:
            a, b = (normals[f] for f, _ in side)
            if math.degrees(math.acos(max(-1.0, min(1.0, float(a @ b))))) >= degrees:
                sharp[mesh.keys[e]] = INF
    own = Mesh(mesh.faces, mesh.points, None, sharp)
    own.told = mesh
    return own


def file_of(mesh):
    return obj_of(getattr(mesh, "told", mesh))


# ------------------------------------------------------------------------------------------------ the checks


class Tally:
    def __init__(self):
        self.done, self.wrong, self.largest = Counter(), [], {}

    def check(self, what, label, run):
        try:
            apart = run()
            if apart is not None:
                self.largest[what] = max(self.largest.get(what, 0.0), apart)
        except Mismatch as wrong:
            self.wrong.append((what, f"{label}: {wrong}"))
            print(f"MISMATCH ({what}) {label}: {wrong}", file=sys.stderr, flush=True)
        self.done[what] += 1


def check_refinement(program, tally, cases):
    for case in cases:
        tally.check("refinement", str(case), lambda: case.check(program))


def check_limits(program, tally, rng, random_points, rounds, notes):
    shapes = [("triangles", item) for item in triangle_meshes(rng, random_points, max(1, rounds - 1))]
    shapes += [("polygons", item) for item in polygon_meshes(rng, random_points, max(1, rounds - 1))]
    for kind, (name, faces) in shapes:
        closed = is_closed(faces)
        faces, points = shuffled(rng, [list(face) for face in faces], random_points)
        schemes = (TRIANGLES if kind == "triangles" else ("catmull-clark",)) + DUAL
        for scheme in schemes:
            if not closed and scheme not in WITH_CREASES:
                continue
            meshes = [("", Mesh(faces, points), ())]
            if scheme in WITH_CREASES:
                meshes.append((", tagged", tagged(rng, faces, points, max(2, len(faces) // 5), 1), ()))
                if not closed:
                    meshes.append((", corners", cornered(Mesh(faces, points)), ("--boundary", "corner")))
            for suffix, mesh, options in meshes:
                label = f"{scheme} on '{name} ({kind}{suffix})'"
                tally.check("limits", label, lambda: check_limit(program, tally, mesh, scheme, options, rng, notes))


def check_limit(program, tally, mesh, scheme, options, rng, notes):
    read = read_obj(program.run("limit", scheme, file_of(mesh), options))
    require(read.faces == mesh.faces, "limit changes faces")
    require(read.normals is not None and len(read.normals) == len(read.points) == len(mesh.points), "limit loses points or normals")
    fans = mesh.fans()
    worst = 0.0
    refined = dual_step(mesh, scheme) if scheme in DUAL else None
    chosen = list(range(len(mesh.points)))
    rng.shuffle(chosen)
    for v in sorted(chosen[:10]):
        point, normal = read.points[v], read.normals[v]
        length = np.linalg.norm(normal)
        require(length == 0 or abs(length - 1) < 1e-9, f"the normal of vertex {v} has length {length}")
        if refined is not None:
            f = len(mesh.faces) + len(mesh.ends) + v
            limit, own = deep_of_face(refined, f, scheme)
            middle = refined.points[refined.faces[f]].mean(axis=0)
            worst = max(worst, near(point, middle, TIGHT, f"published limit of vertex {v}"))
            worst = max(worst, near(point, limit, TIGHT, f"limit of vertex {v}"))
            near(normal, own if own is not None else np.zeros(3), NORMAL, f"normal of vertex {v}")
            notes["normals of dual schemes"] += 1
            continue
        limit, own = published_limit(mesh, v, scheme, fans)
        if limit is not None:
            worst = max(worst, near(point, limit, TIGHT, f"published limit of vertex {v}"))
            notes["published limits"] += 1
        if own is not None:
            near(normal, own, NORMAL, f"published normal of vertex {v}")
            notes["published normals"] += 1
        deep = Deep(mesh, v, scheme)
        worst = max(worst, near(point, deep.limit, TIGHT, f"limit of vertex {v} by refinement"))
        notes["limits by refinement"] += 1
        if deep.is_corner and deep.creases < 2:
            require(length == 0, f"vertex {v} is the tip of a cone and has a normal")
            notes["tips of cones"] += 1
            continue
        sides = deep.sides
        if length == 0:
            bad = any(n is None or not regular or moved > 1e-12 for n, regular, moved in sides)
            require(bad, f"vertex {v} has no normal, but refinement finds {sides}")
            notes["no normals, rightly"] += 1
            continue
        require(all(n is not None for n, _, _ in sides), f"vertex {v} has a normal, refinement finds none")
        slow = max(moved for _, _, moved in sides)
        if slow >= 1e-12:
            # what 1/m leaves is only told apart further down
            sides = Deep(mesh, v, scheme, levels=4 * Deep.LEVELS).sides
            slow = max(moved for _, _, moved in sides)
        total = unit(sum(n for n, _, _ in sides))
        tolerance = NORMAL if slow < 1e-12 else max(1e-6, 4 * slow)
        near(normal, total, tolerance, f"normal of vertex {v} by refinement ({deep.creases} creases)")
        notes["normals by refinement" if slow < 1e-12 else "slow normals, roughly"] += 1
    return worst


def near(theirs, ours, tolerance, what):
    apart = float(np.abs(np.asarray(theirs) - np.asarray(ours)).max())
    require(apart <= tolerance, f"{what}: {theirs}, not {ours}: off by {apart:.3g}")
    return apart


def check_single(program, tally, cases):
    for case in cases:
        def run():
            data = program.run("refine", case.scheme, file_of(case.mesh),
                               ["--levels", str(case.levels), "--precision", "single", *case.options])
            return compare(read_obj(data), case.own(), 2e-6 * 4 ** min(case.levels, 1))
        tally.check("single precision", str(case), run)


def check_outputs(program, tally, cases):
    for case in cases:
        options = ["--levels", str(case.levels), *case.options]
        for single in (False, True):
            extra = options + (["--precision", "single"] if single else [])
            own = case.own()
            tolerance = 1e-5 if single else TIGHT
            for to_limit in (False, True):
                if to_limit and case.scheme in DUAL and not is_closed(own.faces):
                    continue
                more = extra + (["--to-limit"] if to_limit else [])

                def run():
                    return compare_outputs(program, case, own, more, single, to_limit, tolerance)
                tally.check("formats written", f"{case}{', single' if single else ''}{', limit' if to_limit else ''}", run)


def compare_outputs(program, case, own, options, single, to_limit, tolerance):
    given = file_of(case.mesh)
    answers = {ending: program.run("refine", case.scheme, given, options, ending) for ending in ("obj", "ply", "off", "stl", "glb")}
    obj, ply, off = read_obj(answers["obj"]), read_ply(answers["ply"]), read_off(answers["off"])
    require(ply.type == ("float" if single else "double"), f"coordinates of type {ply.type} in PLY")
    glb = read_glb(answers["glb"])
    triangles, normals = read_stl(answers["stl"])
    if not to_limit:
        compare(obj, own, tolerance)
    require(ply.faces == obj.faces and off.faces == obj.faces, "faces differ between formats")
    rounded = obj.points.astype("f4") if single else obj.points
    near(ply.points.astype("f4") if single else ply.points, rounded, 0, "points of PLY and OBJ")
    near(off.points.astype("f4") if single else off.points, rounded, 0, "points of OFF and OBJ")
    near(glb.points, obj.points.astype("f4"), 0, "points of GLB and OBJ")
    if to_limit:
        for name, read in (("PLY", ply), ("OFF", off)):
            if read.normals is not None:
                near(read.normals, obj.normals, 1e-7 if single else 0, f"normals of {name} and OBJ")
        require(ply.normals is not None and glb.normals is not None, "normals are lost in PLY or GLB")
        told = np.linalg.norm(obj.normals, axis=1) > 0
        near(glb.normals[told], obj.normals[told], 1e-6, "normals of GLB and OBJ")
    # the triangles of each polygon have its edges as their sum, in GLB by number, in STL by place
    place = {tuple(p): i for i, p in reversed(list(enumerate(obj.points.astype("f4").astype(float).tolist())))}
    stl = [[place[tuple(p)] for p in triangle] for triangle in triangles.tolist()]
    for name, cut in (("GLB", glb.faces), ("STL", stl)):
        at = 0
        for face in obj.faces:
            parts = cut[at:at + len(face) - 2]
            at += len(parts)
            edges = Counter()
            for triangle in parts:
                for a, b in zip(triangle, triangle[1:] + triangle[:1]):
                    if edges[(b, a)] > 0:
                        edges[(b, a)] -= 1
                    else:
                        edges[(a, b)] += 1
            require(+edges == Counter(zip(face, face[1:] + face[:1])), f"{name}: {parts} are not the face {face}")
        require(at == len(cut), f"{name}: {len(cut)} triangles, not {at}")
    for triangle, normal in zip(triangles, normals):
        near(normal, unit(np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])), 1e-4, "the normal of an STL triangle")
    return 0.0


def check_inputs(program, tally, rng, random_points):
    for name, faces in (("cube", CUBE), ("octahedron", OCTAHEDRON), ("random", triangulation(rng, 30)), ("polygons", polygons(rng, 30))):
        faces, points = shuffled(rng, [list(face) for face in faces], random_points)
        points = points.astype("f4").astype(float)
        mesh = Mesh(faces, points)
        files = {"OBJ": (obj_of(mesh), "obj"), "OFF": (off_of(mesh), "off")}
        for form in ("ascii", "binary_little_endian", "binary_big_endian"):
            files[f"PLY {form}"] = (ply_of(mesh, form), "ply")
        for what, (data, came) in files.items():
            tally.check("formats read", f"{what} of '{name}'", lambda: compare(
                read_obj(program.run("refine", "catmull-clark", data, came=came)), step(mesh, "catmull-clark"), TIGHT))
        if all(len(face) == 3 for face in faces):
            numbers = {}
            for face in faces:
                for v in face:
                    numbers.setdefault(v, len(numbers))
            welded = Mesh([[numbers[v] for v in face] for face in faces], points[list(numbers)])
            for binary in (False, True):
                tally.check("formats read", f"STL of '{name}'", lambda: compare(
                    read_obj(program.run("refine", "loop", stl_of(mesh, binary), came="stl")), step(welded, "loop"), TIGHT))


def check_threads(program, tally, rng, random_points):
    for scheme, triangles in (("loop", True), ("catmull-clark", False), ("doo-sabin", False), ("modified-butterfly", True)):
        faces, points = shuffled(rng, grid(50, 40, True, True, triangles, rng), random_points)
        mesh = Mesh(faces, points)
        if scheme in WITH_CREASES:
            mesh = tagged(rng, faces, points, 40, 5)
        for command, options in (("refine", ["--levels", "3"]), ("refine", ["--levels", "2", "--precision", "single"]),
                                 ("limit", ["--levels", "1"])):
            def run():
                answers = {n: program.run(command, scheme, obj_of(mesh), [*options, "--threads", str(n)], "ply") for n in (1, 2, 3, 7)}
                require(len(set(answers.values())) == 1, "the bytes depend on the number of threads")
            tally.check("threads", f"{command} {scheme} {' '.join(options)}", run)
        tally.check("refinement", f"{scheme} on a large torus", lambda: Case("torus of 2000", mesh, scheme, 1).check(program))


def self_test(program, rng, random_points):
    """Each weight is spoilt a little; the comparison must notice."""
    cases = list(refinement_cases(rng, random_points, 1))
    for case in cases:
        case.check(program)
    unseen = []
    for name in W:
        kept = W[name]
        W[name] = kept + 1e-6
        try:
            def seen(case):
                try:
                    case.check(program)
                    return False
                except Mismatch:
                    return True
            if not any(seen(case) for case in cases):
                unseen.append(name)
        finally:
            W[name] = kept
    # and faces, limits, normals
    spoilt = 0
    mesh = Mesh(*shuffled(rng, triangulation(rng, 20), random_points))
    data = read_obj(program.run("refine", "loop", obj_of(mesh)))
    own = step(mesh, "loop")
    for change in ("turned", "swapped", "points"):
        read = Read(data.points.copy(), [list(face) for face in data.faces])
        if change == "turned":
            read.faces[3].reverse()
        elif change == "swapped":
            read.faces[0], read.faces[1] = read.faces[1], read.faces[0]
        else:
            read.points[[0, 1]] = read.points[[1, 0]]
        try:
            compare(read, own, TIGHT)
            unseen.append(f"faces and points: {change}")
        except Mismatch:
            spoilt += 1
    for name in ("loop edge ends", "loop beta: 5/8", "crease neighbour"):
        kept = W[name]
        W[name] = kept + 1e-6
        try:
            check_limit(program, Tally(), tagged(rng, *shuffled(rng, triangulation(rng, 20), random_points), 6, 0), "loop", (), rng, Counter())
            unseen.append(f"limits: {name}")
        except Mismatch:
            spoilt += 1
        finally:
            W[name] = kept
    print(f"{len(W) + spoilt} changes, {len(unseen)} not noticed{': ' + ', '.join(unseen) if unseen else ''}")
    return 1 if unseen else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    default = Path(__file__).resolve().parents[2] / "target" / "release" / "eigenring"
    parser.add_argument("program", nargs="?", default=str(default), help="the program; target/release/eigenring if left out")
    parser.add_argument("--self-test", action="store_true", help="spoil weights one by one, and expect each to be noticed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rounds", type=int, default=3, help="random meshes of each kind")
    arguments = parser.parse_args()
    rng, random_points = random.Random(arguments.seed), np.random.default_rng(arguments.seed)
    start = time.monotonic()
    try:
        with tempfile.TemporaryDirectory() as folder:
            program = Program(arguments.program, Path(folder))
            if arguments.self_test:
                return self_test(program, rng, random_points)
            return check_all(program, rng, random_points, arguments.rounds, start)
    except (Unable, subprocess.TimeoutExpired) as error:
        print(f"the check could not be made: {error}", file=sys.stderr)
        return 2


def check_all(program, rng, random_points, rounds, start):
    tally, notes = Tally(), Counter()
    cases = list(refinement_cases(rng, random_points, rounds))
    check_refinement(program, tally, cases)
    check_limits(program, tally, rng, random_points, rounds, notes)
    check_single(program, tally, rng.sample(cases, min(40, len(cases))))
    small = [case for case in cases if len(case.mesh.faces) < 30 and not hasattr(case.mesh, "told")]
    check_outputs(program, tally, rng.sample(small, min(12, len(small))))
    check_inputs(program, tally, rng, random_points)
    check_threads(program, tally, rng, random_points)
    for what, count in tally.done.items():
        wrong = sum(1 for kind, _ in tally.wrong if kind == what)
        most = f"; differences up to {tally.largest[what]:.2g}" if tally.largest.get(what) else ""
        print(f"{what}: {count} compared, {wrong} wrong{most}")
    print("of the limits: " + ", ".join(f"{count} {what}" for what, count in sorted(notes.items())))
    print(f"{program.count} runs of the program, {time.monotonic() - start:.0f} s")
    return 1 if tally.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
