#!/usr/bin/env python3
"""Schemes of several passes and of turning splits, computed apart from Eigenring: their matrices, spectra, masks, meshes and limits.

Butterfly, Kobbelt's quad scheme, sqrt(3), mid-edge, midpoint (repeated averaging), 4-8 by quads, and Loop by averaging are written
here once more from their papers, on polygon meshes of its own, and compared with what the program says. See README.md beside this file.

    python3 tests/oracle/zoo.py [path/to/eigenring]
    python3 tests/oracle/zoo.py --only butterfly,sqrt3 [path/to/eigenring]

Exit status: 0 all agree, 1 something doesn't, 2 the check could not be made.
"""

import argparse
import cmath
import json
import math
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from functools import lru_cache
from pathlib import Path

try:
    import flint
    import numpy as np
    from flint import acb, acb_mat, arb, fmpq
except ImportError as error:
    sys.exit(f"{error}: pip install numpy python-flint")

flint.ctx.prec = 600                      # bits: a Jordan block of size m leaves 180/m decimals to its eigenvalues
SAME = 1e-12                              # eigenvalues closer than this are one
POSITION = 1e-13                          # refined points, the coordinates being at most 1
LIMIT = 1e-12                             # limit points by refinement of many steps
NORMAL = 1e-9                             # unit normals
VALENCES = range(3, 10)


class Mismatch(Exception):
    """What the program says is not what was found here."""


class Unable(Exception):
    """The check itself could not be made."""


def require(holds, message):
    if not holds:
        raise Mismatch(message)


# ------------------------------------------------------------------------------------------------ two arithmetics


class Exact:
    """Rational weights exactly, cosines in enclosures of 600 bits."""

    @staticmethod
    def ratio(a, b=1):
        return fmpq(a, b)

    @staticmethod
    def cos(n):
        return (2 * arb.pi() / n).cos()


class Float:
    """64 bits."""

    @staticmethod
    def ratio(a, b=1):
        return float(a) / float(b) if not isinstance(a, fmpq) else int(a.p) / int(a.q) / b

    @staticmethod
    def cos(n):
        return math.cos(2 * math.pi / n)


def add(row, point, weight):
    row[point] = row[point] + weight if point in row else weight


# ------------------------------------------------------------------------------------------------ meshes


class Mesh:
    """Polygons, counter-clockwise, each a tuple of vertex numbers; no two edges join the same two vertices."""

    def __init__(self, faces):
        self.faces = faces
        self.at = {}                      # the face to the left of an edge that is told by its ends, and where it begins there
        for f, face in enumerate(faces):
            for i, v in enumerate(face):
                edge = (v, face[(i + 1) % len(face)])
                if edge in self.at:
                    raise Unable(f"the edge {edge} belongs to two faces in the same direction")
                self.at[edge] = (f, i)
        self.leaving = {}
        for a, b in self.at:
            self.leaving.setdefault(a, b)
        self.fans = {}

    def left(self, a, b):
        return self.at[a, b][0] if (a, b) in self.at else None

    def after(self, a, b):
        """The corner that comes after the edge from a to b, in the face to its left."""
        f, i = self.at[a, b]
        return self.faces[f][(i + 2) % len(self.faces[f])]

    def before(self, a, b):
        f, i = self.at[a, b]
        return self.faces[f][i - 1]

    def fan(self, v):
        """The neighbours of v, counter-clockwise; None at a boundary."""
        if v not in self.fans:
            first = self.leaving[v]
            ring = [first]
            while ring is not None:
                if (v, ring[-1]) not in self.at:
                    ring = None
                    break
                turned = self.before(v, ring[-1])
                if turned == first:
                    break
                ring.append(turned)
            self.fans[v] = ring
        return self.fans[v]

    def fan_from(self, v, first):
        ring = self.fan(v)
        if ring is None:
            return None
        i = ring.index(first)
        return ring[i:] + ring[:i]

    def edges(self):
        """Each inner edge once, by its ends."""
        return [(a, b) for a, b in self.at if a < b and (b, a) in self.at]

    def faces_around(self, v):
        ring = self.fan(v)
        return None if ring is None else [self.left(v, a) for a in ring]


class Pass:
    """The points and faces that one pass makes, each told by the place it comes from: ("v", v), ("e", a, b), ("f", f)."""

    def __init__(self):
        self.rows, self.number, self.polygons = [], {}, []
        self.vertex_heir, self.face_heir = {}, {}

    def point(self, place, row):
        if row is not None:
            self.number[place] = len(self.rows)
            self.rows.append(row)

    def polygon(self, places):
        """A face, if all its points are there (a patch's rim is lost); its number."""
        if places is None or any(place not in self.number for place in places):
            return None
        self.polygons.append(tuple(self.number[place] for place in places))
        return len(self.polygons) - 1

    def done(self):
        return Mesh(self.polygons)

    def old_vertices_stay(self, mesh):
        for v in mesh.leaving:
            if ("v", v) in self.number:
                self.vertex_heir[v] = ("v", self.number["v", v])

    def faces_become_points(self, mesh):
        for f in range(len(mesh.faces)):
            if ("f", f) in self.number:
                self.face_heir[f] = ("v", self.number["f", f])


def edge(a, b):
    return ("e", min(a, b), max(a, b))


def mean(points, arithmetic):
    row = {}
    for p in points:
        add(row, p, arithmetic.ratio(1, len(points)))
    return row


def apply(rows, points):
    """New points from old ones: an array of coordinates, or sparse combinations of unit vectors."""
    if isinstance(points, np.ndarray):
        new = np.zeros((len(rows), points.shape[1]))
        for i, row in enumerate(rows):
            new[i] = sum(w * points[p] for p, w in row.items())
        return new
    new = []
    for row in rows:
        total = {}
        for p, w in row.items():
            for unit, value in points[p].items():
                add(total, unit, w * value)
        new.append({unit: value for unit, value in total.items() if isinstance(value, arb) or value != 0})
    return new


# ------------------------------------------------------------------------------------------------ splits


def one_to_four(mesh, edge_rule, vertex_rule):
    made = Pass()
    for v in mesh.leaving:
        made.point(("v", v), vertex_rule(v))
    for a, b in mesh.edges():
        made.point(edge(a, b), edge_rule(a, b))
    for f, (a, b, c) in enumerate(mesh.faces):
        middle = made.polygon([edge(a, b), edge(b, c), edge(c, a)])
        if middle is not None:
            made.face_heir[f] = ("f", middle)
        for p, q, r in ((a, b, c), (b, c, a), (c, a, b)):
            made.polygon([("v", p), edge(p, q), edge(r, p)])
    made.old_vertices_stay(mesh)
    return made


def one_to_n(mesh, edge_rule, face_rule):
    """Each polygon into quads; old points stay where they are. The rule of faces may look at the rows of edges."""
    made = Pass()
    rows = {}
    for a, b in mesh.edges():
        row = edge_rule(a, b)
        if row is not None:
            rows[edge(a, b)] = row
    for v in mesh.leaving:
        made.point(("v", v), {v: 1})
    for place, row in rows.items():
        made.point(place, row)
    for f in range(len(mesh.faces)):
        made.point(("f", f), face_rule(f, rows))
    for f, face in enumerate(mesh.faces):
        for i, v in enumerate(face):
            made.polygon([("f", f), edge(face[i - 1], v), ("v", v), edge(v, face[(i + 1) % len(face)])])
    made.old_vertices_stay(mesh)
    made.faces_become_points(mesh)
    return made


def averaging(mesh, arithmetic):
    """Points in the middle of faces, faces from vertices."""
    made = Pass()
    for f, face in enumerate(mesh.faces):
        made.point(("f", f), mean(face, arithmetic))
    for v in mesh.leaving:
        around = mesh.faces_around(v)
        own = made.polygon(None if around is None else [("f", f) for f in around])
        if own is not None:
            made.vertex_heir[v] = ("f", own)
    made.faces_become_points(mesh)
    return made


def flipped(mesh, vertex_rule, arithmetic, quads):
    """A point in each face; for each old edge one quad, or two triangles that meet in the flipped edge."""
    made = Pass()
    for v in mesh.leaving:
        made.point(("v", v), vertex_rule(v))
    for f, face in enumerate(mesh.faces):
        made.point(("f", f), mean(face, arithmetic))
    for a, b in mesh.edges():
        left, right = ("f", mesh.left(a, b)), ("f", mesh.left(b, a))
        if quads:
            made.polygon([("v", a), right, ("v", b), left])
        else:
            made.polygon([("v", a), right, left])
            made.polygon([("v", b), left, right])
    made.old_vertices_stay(mesh)
    made.faces_become_points(mesh)
    return made


def mid_edge_pass(mesh, arithmetic):
    made = Pass()
    for a, b in mesh.edges():
        made.point(edge(a, b), mean((a, b), arithmetic))
    for f, face in enumerate(mesh.faces):
        own = made.polygon([edge(v, face[(i + 1) % len(face)]) for i, v in enumerate(face)])
        if own is not None:
            made.face_heir[f] = ("f", own)
    for v in mesh.leaving:
        ring = mesh.fan(v)
        own = made.polygon(None if ring is None else [edge(v, a) for a in ring])
        if own is not None:
            made.vertex_heir[v] = ("f", own)
    return made


# ------------------------------------------------------------------------------------------------ schemes
#
# A scheme's step is a generator of passes: it is sent the mesh that the last pass made.


class Scheme:
    """`half_steps` steps of refinement bring the lattice back, `dilation` times as fine."""

    name, mesh, dual, dilation, half_steps = "", "triangles", False, 2, 1
    levels = 2                            # whole steps down where limit points tell the full neighbourhood
    far = 3                               # whole steps that part irregular vertices of a mesh far enough

    def __init__(self, settings=()):
        self.settings = tuple(settings)
        self.values = dict(settings)

    def __str__(self):
        return " ".join([self.name, *(f"{k}={v}" for k, v in self.settings)])

    @property
    def options(self):
        return [word for k, v in self.settings for word in ("--set", f"{k}={v}")]

    @property
    def regular(self):
        return 6 if self.mesh == "triangles" else 4

    def number(self, name, default):
        return fmpq(*(int(part) for part in str(self.values.get(name, default)).split("/")))

    def passes(self, mesh, arithmetic):
        raise NotImplementedError

    def refine(self, mesh, points, arithmetic, track=()):
        """One step. `track` names vertices and faces; their heirs come back in the same order."""
        for make in self.passes(arithmetic):
            made = make(mesh)
            points = apply(made.rows, points)
            track = [(made.vertex_heir if kind == "v" else made.face_heir)[i] for kind, i in track]
            mesh = made.done()
        return mesh, points, track


class Butterfly(Scheme):
    """Dyn, Levin and Gregory 1990: 1/2 at the ends of an edge, 2w across its triangles, -w at their four other neighbours."""

    name, levels = "butterfly", 3

    def passes(self, arithmetic):
        w = arithmetic.ratio(self.number("w", "1/16"))
        half = arithmetic.ratio(1, 2)

        def make(mesh):
            def rule(a, b):
                row = {}
                for p, q in ((a, b), (b, a)):
                    top = mesh.after(p, q)
                    if (top, q) not in mesh.at or (p, top) not in mesh.at:
                        return None
                    add(row, p, half)
                    add(row, top, 2 * w)
                    add(row, mesh.after(top, q), -w)
                    add(row, mesh.after(p, top), -w)
                return row
            return one_to_four(mesh, rule, lambda v: {v: 1})
        return [make]


class Kobbelt(Scheme):
    """Kobbelt 1996: the four-point rule along the lines of quads, with a virtual point v_m beyond an irregular vertex."""

    name, mesh, levels = "kobbelt", "quads", 3

    def __init__(self, settings=()):
        super().__init__(settings)
        self.directions = []              # what the two directions across each face say; they should say the same

    def passes(self, arithmetic):
        w = arithmetic.ratio(self.number("w", "1"))
        near, wide, t = (8 + w) / 16, -w / 16, w / (8 + w)

        def make(mesh):
            def straight_on(a, b):
                """What lies beyond b on the way from a: at an irregular b the mean of the second on either hand."""
                ring = mesh.fan_from(b, a)
                return None if ring is None else (ring[2], ring[-2])

            def virtual(row, p, l, share):
                ls = mesh.fan_from(p, l)
                n = len(ls)
                ks = [mesh.after(p, a) for a in ls]
                for a in ls:
                    add(row, a, share * 4 / n)
                for i in (-1, 0, 1):
                    add(row, ls[i % n], -share)
                for i in (-2, -1, 0, 1):
                    add(row, ks[i % n], share * t)
                for a in ks:
                    add(row, a, -share * 4 * t / n)

            def along(p, q, irregular):
                """The four-point rule from p to q, where p is taken as irregular or not."""
                row = {p: near, q: near}
                beyond = straight_on(p, q)
                behind = straight_on(q, p)
                if beyond is None or behind is None:
                    return None
                for a in beyond:
                    add(row, a, wide / 2)
                if irregular:
                    virtual(row, p, q, wide)
                else:
                    for a in behind:
                        add(row, a, wide / 2)
                return row

            def rule(a, b):
                rings = mesh.fan(a), mesh.fan(b)
                if None in rings:
                    return None
                odd = [p != 4 for p in map(len, rings)]
                if not all(odd):
                    return along(b, a, True) if odd[1] else along(a, b, odd[0])
                first, second = along(a, b, True), along(b, a, True)
                row = {}
                for one in (first, second):
                    for p, x in one.items():
                        add(row, p, x / 2)
                return row

            def direction(f, rows, i):
                """The four-point rule over the points of edges across face f, from its edge i to the one opposite."""
                face = mesh.faces[f]
                row = {}
                for j in (i, i + 2):
                    a, b = face[j % 4], face[(j + 1) % 4]
                    if (b, a) not in mesh.at:
                        return None
                    other = mesh.after(b, a), mesh.before(b, a)
                    for place, x in ((edge(a, b), near), (edge(*other), wide)):
                        if place not in rows:
                            return None
                        for p, y in rows[place].items():
                            add(row, p, x * y)
                return row

            def middle(f, rows):
                both = direction(f, rows, 0), direction(f, rows, 1)
                if None in both:
                    return None
                row = {}
                for one in both:
                    for p, x in one.items():
                        add(row, p, x / 2)
                self.directions.append((both, mesh.faces[f]))
                return row
            return one_to_n(mesh, rule, middle)
        return [make]

class Sqrt3(Scheme):
    """Kobbelt 2000: the middle of each triangle, edges flipped, old points with alpha_n = (4 - 2 cos(2 pi/n))/9 of their ring."""

    name, dilation, half_steps, far = "sqrt3", 3, 2, 2

    def passes(self, arithmetic):
        def make(mesh):
            def rule(v):
                ring = mesh.fan(v)
                if ring is None:
                    return None
                alpha = (4 - 2 * arithmetic.cos(len(ring))) / 9
                row = {v: 1 - alpha}
                for a in ring:
                    add(row, a, alpha / len(ring))
                return row
            return flipped(mesh, rule, arithmetic, quads=False)
        return [make]


class FourEight(Scheme):
    """Velho and Zorin 2001, by quads: the middle of each face, old points half-way to the mean of their neighbours."""

    name, mesh, half_steps = "four-eight", "polygons", 2

    def passes(self, arithmetic):
        def make(mesh):
            def rule(v):
                ring = mesh.fan(v)
                if ring is None:
                    return None
                row = {v: arithmetic.ratio(1, 2)}
                for a in ring:
                    add(row, a, arithmetic.ratio(1, 2 * len(ring)))
                return row
            return flipped(mesh, rule, arithmetic, quads=True)
        return [make]


class MidEdge(Scheme):
    """Peters and Reif 1997: the middles of edges; faces from faces and from vertices."""

    name, mesh, dual, half_steps = "mid-edge", "polygons", True, 2

    def passes(self, arithmetic):
        return [lambda mesh: mid_edge_pass(mesh, arithmetic)]


class Midpoint(Scheme):
    """Prautzsch 1998, Zorin and Schröder 2001: quads by plain averages, then d - 1 times the middles of faces."""

    name, mesh = "midpoint", "polygons"

    def __init__(self, settings=(("d", "3"),)):
        super().__init__(settings)
        self.degree = int(self.values["d"])
        self.dual = self.degree % 2 == 0
        self.far = 3 if self.degree < 9 else 4

    def passes(self, arithmetic):
        def split(mesh):
            return one_to_n(mesh, lambda a, b: mean((a, b), arithmetic), lambda f, _: mean(mesh.faces[f], arithmetic))
        return [split] + [lambda mesh: averaging(mesh, arithmetic)] * (self.degree - 1)


class LoopAveraging(Scheme):
    """Warren and Weimer 2001: triangles by plain averages, then m times c at a vertex and 1 - c on its ring."""

    name = "loop-averaging"

    def passes(self, arithmetic):
        def split(mesh):
            return one_to_four(mesh, lambda a, b: mean((a, b), arithmetic), lambda v: {v: 1})

        def smooth(mesh):
            made = Pass()
            for v in mesh.leaving:
                ring = mesh.fan(v)
                if ring is None:
                    continue
                c = arithmetic.ratio(-1, 8) if len(ring) == 3 else arithmetic.ratio(1, 4)
                row = {v: c}
                for a in ring:
                    add(row, a, (1 - c) / len(ring))
                made.point(("v", v), row)
            for face in mesh.faces:
                made.polygon([("v", v) for v in face])
            made.old_vertices_stay(mesh)
            return made
        return [split] + [smooth] * int(self.values.get("m", 1))


SCHEMES = [Butterfly(), Butterfly((("w", "1/32"),)), Kobbelt(), Kobbelt((("w", "1/2"),)), Sqrt3(), MidEdge(), FourEight(),
           *(Midpoint((("d", str(d)),)) for d in range(2, 10)), *(LoopAveraging((("m", str(m)),)) for m in (1, 2, 3))]


# ------------------------------------------------------------------------------------------------ patches and their labels
#
# A point is "c", or (s, i, j): i edges along spoke s, then one turn to the left, then j edges. Around a face (dual): from corner s
# i edges away from corner s + 1, then j edges away from corner s - 1.


def patch(scheme, n, rings):
    """A mesh around an extraordinary vertex or face, its labels, and places in the plane that turn with the sectors."""
    if scheme.dual:
        return face_patch(n, rings)
    triangles = scheme.mesh == "triangles"

    def name(s, i, j):
        s %= n
        if i == 0:
            s, i, j = (s + 1) % n, j, 0
        return "c" if i == j == 0 else (s, i, j)
    faces = []
    for s in range(n):
        for i in range(rings):
            for j in range(rings):
                a, b, c, d = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
                if not triangles:
                    faces.append([a, b, c, d])
                else:
                    if i + j + 1 <= rings:
                        faces.append([a, b, d])
                    if i + j + 2 <= rings:
                        faces.append([b, c, d])
    sectors = len(faces) // n
    named = [tuple(name(f // sectors, *corner) for corner in face) for f, face in enumerate(faces)]
    turn = cmath.exp(2j * math.pi / n)
    return numbered(named, lambda p: 0 if p == "c" else turn ** p[0] * (p[1] + p[2] * turn))


def face_patch(n, rings):
    faces = [tuple((s, 0, 0) for s in range(n))]
    for s in range(n):
        for j in range(rings):
            faces.append(((s, 0, j), (s, 0, j + 1), ((s + 1) % n, j + 1, 0), ((s + 1) % n, j, 0)))
            for i in range(rings):
                faces.append(((s, i, j), (s, i + 1, j), (s, i + 1, j + 1), (s, i, j + 1)))
    turn, half = cmath.exp(2j * math.pi / n), cmath.exp(1j * math.pi / n)
    return numbered(faces, lambda p: turn ** p[0] * (1 + p[1] / half + p[2] * half))


def numbered(named, place):
    labels = list(dict.fromkeys(p for face in named for p in face))
    number = {p: i for i, p in enumerate(labels)}
    mesh = Mesh([tuple(number[p] for p in face) for face in named])
    where = np.array([[complex(place(p)).real, complex(place(p)).imag] for p in labels])
    return mesh, labels, where


def heading(mesh, back, v, left, regular):
    ring = mesh.fan_from(v, back)
    if ring is None:
        return None
    if len(ring) != regular:
        raise Unable("an irregular vertex is too near")
    return ring[regular // 2 + (1 if left else 0)]


def walk(mesh, back, v, i, j, regular, turned):
    """i edges straight on from v, which was reached from `back`, a turn to the left, j edges; None where the mesh ends."""
    for step in range(i + j):
        on = heading(mesh, back, v, not turned and step == i, regular)
        if on is None:
            return None
        back, v = v, on
    return v


def vertex_named(mesh, centre, spokes, label, regular):
    if label == "c":
        return centre
    s, i, j = label
    return walk(mesh, centre, spokes[s], i - 1, j, regular, False)


def corner_named(mesh, corners, label, regular):
    s, i, j = label
    n = len(corners)
    if i == 0:
        return walk(mesh, corners[s - 1], corners[s], 0, j, regular, True)
    return walk(mesh, corners[(s + 1) % n], corners[s], i, j, regular, False)


def find(mesh, scheme, centre, first, labels):
    """The vertices of these labels around a vertex or a face, whose spoke (corner) 0 is `first`."""
    kind, number = centre
    if kind == "v":
        spokes = mesh.fan_from(number, first)
        return [vertex_named(mesh, number, spokes, p, scheme.regular) for p in labels]
    corners = mesh.faces[number]
    i = corners.index(first)
    return [corner_named(mesh, corners[i:] + corners[:i], p, scheme.regular) for p in labels]


def first_spoke(mesh, centre, where):
    """The neighbour (or corner) in the direction that spoke 0 had: the places turn with the sectors and are symmetric."""
    around = mesh.fan(centre[1]) if centre[0] == "v" else mesh.faces[centre[1]]
    angles = sorted((abs(math.atan2(where[v][1], where[v][0])), v) for v in around)
    if angles[0][0] > 1e-9:
        raise Unable("no spoke has the direction of spoke 0")
    return angles[0][1]


def start(scheme, n, rings):
    mesh, labels, where = patch(scheme, n, rings)
    if scheme.dual:
        return mesh, labels, where, ("f", 0)
    return mesh, labels, where, ("v", labels.index("c"))


def whole_step(scheme, mesh, points, where, centre, arithmetic):
    both = [{**p} for p in points]
    for _ in range(scheme.half_steps):
        before, tracked = mesh, [centre]
        mesh, both, (centre,) = scheme.refine(before, both, arithmetic, tracked)
        _, where, _ = scheme.refine(before, where, Float, tracked)
    return mesh, both, where, centre


# ------------------------------------------------------------------------------------------------ the full neighbourhood


def rows_around(scheme, n, labels, rings):
    """One whole step around a centre: each of these labels of the fine mesh as a combination of labels of the coarse one."""
    mesh, names, where, centre = start(scheme, n, rings)
    points = [{p: fmpq(1)} for p in names]
    mesh, points, where, centre = whole_step(scheme, mesh, points, where, centre, Exact)
    found = find(mesh, scheme, centre, first_spoke(mesh, centre, where), labels)
    require(None not in found and len(set(found)) == len(labels), "the labels are not there, or not distinct")
    return {p: points[v] for p, v in zip(labels, found)}


@lru_cache(maxsize=None)
def limit_support(scheme):
    """The labels around a regular vertex (or face) that its limit point is made of, where weights are positive: all that
    those of the centre come from, in any number of steps. The butterfly and Kobbelt's scheme interpolate."""
    support = {(s, 0, 0) for s in range(scheme.regular)} if scheme.dual else {"c"}
    while True:
        labels = sorted(support, key=repr)
        rows = rows_around(scheme, scheme.regular, labels, 3 + max((i + j for _, i, j in support - {"c"}), default=0))
        more = support.union(*rows.values())
        if more == support:
            return labels
        support = more


@lru_cache(maxsize=None)
def orbits(scheme, levels=None):
    """The orbits of the points that change some limit point over the faces around a regular centre, among the limit points of
    vertices (faces) some whole steps down. At an irregular centre they are taken to be the same."""
    levels = levels or scheme.levels
    n = scheme.regular
    mesh, labels, where, centre = start(scheme, n, 7 if scheme.mesh != "triangles" else 6)
    points = [{p: fmpq(1)} for p in labels]
    for _ in range(levels):
        mesh, points, where, centre = whole_step(scheme, mesh, points, where, centre, Exact)
    first = first_spoke(mesh, centre, where)
    reach, support, needed = scheme.dilation ** levels, limit_support(scheme), set()
    if scheme.dual:
        inside = [(0, i, j) for i in range(reach - 1) for j in range(reach - 1)]
    else:
        inside = [(0, i, j) for i in range(1, reach + 1) for j in range(reach + 1) if scheme.mesh != "triangles" or i + j <= reach]
    for v in find(mesh, scheme, centre, first, inside):
        places = [("f", f) for f in mesh.faces_around(v)] if scheme.dual else [("v", v)]
        for place in places:
            spoke = mesh.faces[place[1]][0] if scheme.dual else mesh.fan(v)[0]
            for p in find(mesh, scheme, place, spoke, support):
                needed |= set(points[p])
    return sorted({p[1:] for p in needed if p != "c"}, key=lambda o: (sum(o), o))


class Local:
    """The local subdivision matrix at a valence over the full neighbourhood, and what follows from it."""

    def __init__(self, scheme, n):
        self.scheme, self.n, self.orbits = scheme, n, orbits(scheme)
        self.labels = ([] if scheme.dual else ["c"]) + [(s, *o) for s in range(n) for o in self.orbits]
        reach = max(map(sum, self.orbits)) if scheme.mesh == "triangles" else max(map(max, self.orbits))
        self.rows = rows_around(scheme, n, self.labels, reach + 2)
        inside = set(self.labels)
        for p, row in self.rows.items():
            require(set(row) <= inside, f"{scheme}, n = {n}: {p} needs points beyond the full neighbourhood")
            total = sum(row.values(), fmpq(0))
            require(total == 1 if isinstance(total, fmpq) else abs(float(total) - 1) < 1e-15, f"{scheme}, n = {n}: row {p} has the sum {total}")
        self.spectra = [self.spectrum(k) for k in range(n // 2 + 1)]

    @property
    def size(self):
        return len(self.labels)

    def matrix(self):
        place = {p: i for i, p in enumerate(self.labels)}
        whole = np.zeros((self.size, self.size))
        for p, row in self.rows.items():
            for q, w in row.items():
                whole[place[p], place[q]] = float_of(w)
        return whole

    @lru_cache(maxsize=None)
    def block(self, k):
        """The matrix on functions f(s, orbit) = a(orbit) e^(2 pi i k s/n)."""
        names = (["c"] if k == 0 and not self.scheme.dual else []) + list(self.orbits)
        place = {p: i for i, p in enumerate(names)}
        block = [[acb(0)] * len(names) for _ in names]
        for p in names:
            for q, w in self.rows[p if p == "c" else (0, *p)].items():
                if q == "c":
                    if k == 0:
                        block[place[p]][place["c"]] += w
                else:
                    block[place[p]][place[q[1:]]] += turn(k * q[0], self.n) * w
        return names, acb_mat(block)

    def spectrum(self, k):
        """Eigenvalues of frequency k with their multiplicities, largest first; the mean of those that are one."""
        values = sorted(self.block(k)[1].eig(algorithm="approx", maxiter=100000), key=lambda x: -float(abs(x).mid()))
        groups = []
        for x in values:
            near = [g for g in groups if abs(complex(g[0]) - complex(x)) < SAME]
            if near:
                near[0].append(x)
            else:
                groups.append([x])
        return [(sum(g, acb(0)) / len(g), len(g)) for g in groups]

    @property
    @lru_cache(maxsize=None)
    def ranked(self):
        """(modulus, value, frequency, multiplicity within that frequency), largest first, without one 1 of frequency 0."""
        all_values = []
        for k, spectrum in enumerate(self.spectra):
            for value, m in spectrum:
                if k == 0 and abs(complex(value) - 1) < SAME:
                    m -= 1
                if m:
                    all_values.append((abs(complex(value)), value, k, m))
        return sorted(all_values, key=lambda x: -x[0])

    @property
    def lead(self):
        """lambda, if it is a positive number and simple in frequency 1, and no other is larger; else None."""
        largest = [x for x in self.ranked if x[0] > self.ranked[0][0] - SAME]
        first = [(value, m) for _, value, k, m in largest if k == 1]
        if len(first) != 1 or first[0][1] != 1 or abs(complex(first[0][0]).imag) > SAME or complex(first[0][0]).real <= 0:
            return None
        return first[0][0].real

    @property
    def dominant(self):
        """lambda, if all others are smaller."""
        return self.lead if self.ranked[1][0] < self.ranked[0][0] - SAME else None

    @property
    def mu(self):
        """The largest modulus after 1 and a pair of frequency 1."""
        return abs(self.ranked[1][1])

    def jordan(self, k, value, m):
        """The number and the largest size of the Jordan blocks of an eigenvalue, by ranks of powers."""
        _, block = self.block(k)
        size = block.nrows()
        shifted = block - acb_mat(size, size, [value if i == j else 0 for i in range(size) for j in range(size)])
        power, nullities = shifted, []
        while not nullities or nullities[-1] < m:
            nullities.append(size - rank(power))
            require(len(nullities) <= m, "the nullities don't reach the multiplicity")
            power = power * shifted
        return nullities[0], len(nullities)

    def left(self, k, value):
        """The left eigenvector of a simple eigenvalue: by inverse iteration."""
        names, block = self.block(k)
        size = block.nrows()
        nudge = value + acb(arb("1e-60"))
        shifted = (block - acb_mat(size, size, [nudge if i == j else 0 for i in range(size) for j in range(size)])).transpose()
        vector = acb_mat(size, 1, [acb(1) / (3 + i) for i in range(size)])
        for _ in range(3):
            vector = midpoints(shifted.solve(vector))
            vector = midpoints(vector * (1 / max((vector[i, 0] for i in range(size)), key=lambda x: float(abs(x)))))
        return {p: vector[i, 0] for i, p in enumerate(names)}

    def limit_mask(self):
        u = self.left(0, acb(1))
        total = sum(u.values(), acb(0))
        return {p: float((u[p if p == "c" else p[1:]] / total / (1 if p == "c" else self.n)).real) for p in self.labels}

    def tangent_masks(self):
        u = self.left(1, acb(self.lead))
        base = u[(0, 0) if self.scheme.dual else (1, 0)]
        cosine, sine = {}, {}
        for p in self.labels:
            if p != "c":
                w = complex(u[p[1:]] / base * turn(-p[0], self.n))
                cosine[p], sine[p] = w.real, -w.imag
        return cosine, sine


def float_of(x):
    return int(x.p) / int(x.q) if isinstance(x, fmpq) else float(x)


def turn(k, n):
    angle = 2 * arb.pi() * (k % n) / n
    return acb(angle.cos(), angle.sin())


def midpoints(matrix):
    return acb_mat(matrix.nrows(), matrix.ncols(), [acb(x.real.mid(), x.imag.mid()) for x in matrix.entries()])


def rank(matrix):
    """By elimination; what is below 1e-40 is taken for zero."""
    rows = [[matrix[i, j] for j in range(matrix.ncols())] for i in range(matrix.nrows())]
    count = 0
    for j in range(matrix.ncols()):
        best = max(range(count, len(rows)), key=lambda i: float(abs(rows[i][j]).mid()), default=None)
        if best is None or float(abs(rows[best][j]).mid()) < 1e-40:
            continue
        rows[count], rows[best] = rows[best], rows[count]
        pivot = rows[count]
        for row in rows[count + 1:]:
            if float(abs(row[j]).mid()) > 0:
                factor = row[j] / pivot[j]
                for c in range(j, len(row)):
                    row[c] -= factor * pivot[c]
        count += 1
    return count


@lru_cache(maxsize=None)
def local(scheme, n):
    return Local(scheme, n)


# ------------------------------------------------------------------------------------------------ comparing analyses


class Tally:
    """What was compared, how often, and what was wrong."""

    def __init__(self, quiet=False):
        self.done, self.wrong, self.largest, self.quiet = Counter(), [], {}, quiet

    def check(self, what, label, action):
        self.done[what] += 1
        try:
            apart = action()
            if apart is not None:
                self.largest[what] = max(self.largest.get(what, 0.0), apart)
        except Mismatch as error:
            self.wrong.append((what, label))
            if not self.quiet:
                print(f"MISMATCH {what}: {label}: {error}", file=sys.stderr, flush=True)


class Program:
    def __init__(self, path, folder):
        self.path, self.folder, self.count = path, folder, 0

    def run(self, *words):
        self.count += 1
        try:
            done = subprocess.run([self.path, *map(str, words)], capture_output=True, text=True, timeout=600, check=False)
        except OSError as error:
            raise Unable(f"{self.path} can't be run: {error}") from error
        require(done.returncode == 0, f"{' '.join(map(str, words))}: exit status {done.returncode}: {done.stderr.strip()[-400:]}")
        return done.stdout

    def json(self, *words):
        return json.loads(self.run(*words, "--format", "json"))

    def mesh(self, command, scheme, options, points, faces):
        given, taken = self.folder / "in.obj", self.folder / "out.obj"
        lines = [f"v {' '.join(repr(float(x)) for x in p)}" for p in points]
        given.write_text("\n".join(lines + [f"f {' '.join(str(v + 1) for v in face)}" for face in faces]) + "\n", encoding="utf-8")
        taken.unlink(missing_ok=True)
        self.run(command, scheme, given, "-o", taken, *options)
        read = {"v": [], "vn": [], "f": []}
        for line in taken.read_text(encoding="utf-8").splitlines():
            words = line.split()
            if words and words[0] in ("v", "vn"):
                read[words[0]].append([float(x) for x in words[1:]])
            elif words and words[0] == "f":
                read["f"].append(tuple(int(w.split("/")[0]) - 1 for w in words[1:]))
        return np.array(read["v"]), np.array(read["vn"]), read["f"]


def label_of(entry):
    return "c" if "orbit" not in entry else (entry["sector"], *entry["orbit"])


def check_analysis(program, tally, scheme, file, valences=VALENCES, deep=True):
    """All that a report says at each valence; `file` is the scheme's name or the path of its file."""
    span = f"{valences[0]}..{valences[-1]}"
    report = program.json("analyze", file, "--valence", span, "--digits", 30, *scheme.options)
    for told in report["valences"]:
        n = told["n"]
        own = local(scheme, n)
        where = f"{scheme}, n = {n}"
        tally.check("sizes of the neighbourhood", where, lambda: check_size(scheme, own, told))
        tally.check("matrices, entry by entry", where, lambda: check_matrix(program, file, scheme, own))
        tally.check("eigenvalues by frequency", where, lambda: check_eigenvalues(own, told))
        if deep:
            tally.check("Jordan blocks, by ranks", where, lambda: check_jordan(own, told))
        tally.check("lambda, mu and their ratio", where, lambda: check_dominant(own, told))
        tally.check("limit masks", where, lambda: check_limit_mask(own, told))
        tally.check("tangent masks", where, lambda: check_tangent_masks(own, told))


def check_size(scheme, own, told):
    require(told["size"] == own.size, f"size {told['size']}, not {own.size}")
    require(told["steps"] == scheme.half_steps and told["dilation"] == scheme.dilation,
            f"steps {told['steps']} and dilation {told['dilation']}, not {scheme.half_steps} and {scheme.dilation}")


def check_matrix(program, file, scheme, own):
    told = program.json("matrix", file, "--valence", own.n, *scheme.options)
    labels = ["c" if text == "c" else tuple(int(x) for x in text.replace(":", ",").split(",")) for text in told["labels"]]
    require(set(labels) == set(own.labels) and len(labels) == own.size, "the points are others")
    order = [labels.index(p) for p in own.labels]
    apart = np.abs(np.array(told["rows"])[np.ix_(order, order)] - own.matrix()).max()
    require(apart < 1e-15 * 4, f"entries differ by {apart:.3g}")
    return float(apart)


def pairs(k, n):
    """How many frequencies an entry of frequency k counts."""
    return 1 if k == 0 or 2 * k == n else 2


def within(told, tolerance):
    """Where a report is not exact, its floating values are those of a solver."""
    return tolerance if told["arithmetic"] == "exact" else 1e-10


def check_eigenvalues(own, told):
    largest = 0.0
    for k, spectrum in enumerate(own.spectra):
        entries = [e for e in told["eigenvalues"] if e["frequency"] == k]
        total = sum(e["algebraic"] for e in entries)
        mine = sum(m for _, m in spectrum) * pairs(k, own.n)
        require(total == mine, f"frequency {k} has {total} eigenvalues, not {mine}")
        left = [[value, m * pairs(k, own.n)] for value, m in spectrum]
        for e in entries:
            value = complex(*e["value"])
            nearest = min(left, key=lambda x: abs(complex(x[0]) - value))
            apart = abs(complex(nearest[0]) - value)
            require(apart < within(told, 1e-14), f"frequency {k}: {e['decimal']} is no eigenvalue; the nearest is {complex(nearest[0])}")
            largest = max(largest, apart)
            if told["arithmetic"] == "exact" and e["value"][1] == 0:
                require(abs(float(abs(nearest[0].real - arb(e["decimal"])))) < 2e-30,
                        f"frequency {k}: the decimals {e['decimal']} are wrong: {nearest[0].real.str(32, radius=False)}")
            nearest[1] -= e["algebraic"]
        require(all(m == 0 for _, m in left), f"frequency {k}: multiplicities differ by {[(complex(v), m) for v, m in left if m]}")
    require(sum(e["algebraic"] for e in told["eigenvalues"]) == own.size, "the multiplicities don't add up to the size")
    return largest


def check_jordan(own, told):
    for k, spectrum in enumerate(own.spectra):
        for value, m in spectrum:
            entries = [e for e in told["eigenvalues"] if e["frequency"] == k and abs(complex(*e["value"]) - complex(value)) < within(told, SAME)]
            if m == 1 or any(e["jordan"] is None for e in entries):
                continue
            blocks, size = own.jordan(k, value, m)
            require(len(entries) == 1 and entries[0]["geometric"] == blocks * pairs(k, own.n) and entries[0]["jordan"] == size,
                    f"frequency {k}, {complex(value)}: {[(e['geometric'], e['jordan']) for e in entries]}, "
                    f"not {(blocks * pairs(k, own.n), size)}")


def check_dominant(own, told):
    modulus, value, k, m = own.ranked[0]
    lead = told["subdominant"]
    require(abs(complex(*lead["value"]) - complex(value)) < within(told, 1e-14)
            or abs(abs(complex(*lead["value"])) - modulus) < within(told, 1e-14),
            f"lambda is {lead['value']}, not {complex(value)}")
    tied = {(f) for r, _, f, _ in own.ranked if r > modulus - SAME}
    require(lead["frequency"] in tied, f"lambda is of frequency {lead['frequency']}, not {sorted(tied)}")
    rest = told["subsubdominant"]
    verdict = next(v for v in told["verdicts"] if v["claim"] == "subdominant")["verdict"]
    if told["arithmetic"] == "exact":
        require(verdict == ("refuted" if own.dominant is None else "proved"), f"'subdominant' is {verdict}")
    if own.lead is None:
        require(rest is None or rest["ratio"] is None, f"a ratio {rest and rest['ratio']} where lambda is not a simple one of frequency 1")
        return None
    require(abs(lead["value"][0] - float(own.lead)) < within(told, 4e-15), f"lambda is {lead['value'][0]}, not {own.lead}")
    apart = abs(rest["ratio"] - float(own.mu / own.lead ** 2))
    require(abs(rest["modulus"] - float(own.mu)) < within(told, 4e-15) and apart < within(told, 1e-13), f"mu {rest['modulus']}, ratio {rest['ratio']}, not {own.mu}")
    if own.dominant is not None:
        frequencies = {f for r, _, f, _ in own.ranked[1:] if r > float(own.mu) - SAME}
        require(set(rest["frequencies"]) == frequencies, f"frequencies of mu {rest['frequencies']}, not {sorted(frequencies)}")
    return apart


def check_limit_mask(own, told):
    mine = own.limit_mask()
    given = {label_of(e): e["weight"] for e in told["limit_mask"]}
    return near_maps(given, mine, 4e-15)


def near_maps(given, mine, tolerance):
    require(set(given) <= set(mine), f"points {sorted(set(given) - set(mine), key=repr)} don't belong")
    worst = max(mine, key=lambda p: abs(given.get(p, 0.0) - mine[p]))
    apart = abs(given.get(worst, 0.0) - mine[worst])
    require(apart < tolerance, f"{worst}: {given.get(worst, 0.0)}, not {mine[worst]}: off by {apart:.3g}")
    return apart


def check_tangent_masks(own, told):
    if own.lead is None:
        require(told["tangent_masks"] is None, "tangent masks where lambda is not a simple one of frequency 1")
        return None
    require(told["tangent_masks"] is not None, "tangent masks are missing")
    return max(near_maps({label_of(e): e["weight"] for e in given}, mine, 1e-13)
               for given, mine in zip(told["tangent_masks"], own.tangent_masks()))


# ------------------------------------------------------------------------------------------------ closed meshes for the test


def cube_surface(cells):
    """The quads on the surface of a set of unit cubes, outside out."""
    cells, faces = set(cells), []
    for cell in cells:
        for axis in range(3):
            for side in (0, 1):
                beside = tuple(c + (2 * side - 1 if i == axis else 0) for i, c in enumerate(cell))
                if beside in cells:
                    continue
                u, v = (axis + 1) % 3, (axis + 2) % 3
                corners = []
                for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    corner = list(cell)
                    corner[axis] += side
                    corner[u] += a
                    corner[v] += b
                    corners.append(tuple(corner))
                faces.append(corners if side else corners[::-1])
    return renumber(faces)


def renumber(faces):
    names = {p: i for i, p in enumerate(dict.fromkeys(p for face in faces for p in face))}
    return [tuple(names[p] for p in face) for face in faces]


def torus(columns, rows, triangles):
    faces = []
    for i in range(columns):
        for j in range(rows):
            a, b, c, d = (((i + x) % columns, (j + y) % rows) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
            faces += [(a, b, c), (a, c, d)] if triangles else [(a, b, c, d)]
    return renumber(faces)


def prism(n):
    below, above = [("b", i) for i in range(n)], [("t", i) for i in range(n)]
    sides = [(below[i], below[(i + 1) % n], above[(i + 1) % n], above[i]) for i in range(n)]
    return renumber([tuple(above), tuple(below[::-1]), *sides])


def bipyramid(n):
    return renumber([face for i in range(n) for face in ((i, (i + 1) % n, "t"), ((i + 1) % n, i, "b"))])


TETRAHEDRON = [(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)]


def triangulation(rng, changes):
    """A closed surface of triangles, made from a tetrahedron by new points in faces and flips that keep all valences from 3 on."""
    faces = set(TETRAHEDRON)
    count = 4
    for _ in range(changes):
        if rng.random() < 0.3:
            a, b, c = face = rng.choice(sorted(faces))
            faces.remove(face)
            faces |= {(a, b, count), (b, c, count), (c, a, count)}
            count += 1
            continue
        mesh = Mesh(sorted(faces))
        a, b = rng.choice(mesh.edges())
        c, d = mesh.after(a, b), mesh.after(b, a)
        if (c, d) in mesh.at or (d, c) in mesh.at or min(len(mesh.fan(a)), len(mesh.fan(b))) < 4:
            continue
        faces -= {mesh.faces[mesh.left(a, b)], mesh.faces[mesh.left(b, a)]}
        faces |= {(a, d, c), (b, c, d)}
    return sorted(faces)


def polygons(rng, changes):
    """A closed surface of polygons: a random triangulation without some of its edges; faces meet in one edge at most."""
    faces = triangulation(rng, changes)
    for _ in range(changes):
        mesh = Mesh(faces)
        a, b = rng.choice(mesh.edges())
        left, right = mesh.left(a, b), mesh.left(b, a)
        if min(len(mesh.fan(a)), len(mesh.fan(b))) < 4 or len(set(faces[left]) & set(faces[right])) > 2:
            continue
        i, j = mesh.at[a, b][1], mesh.at[b, a][1]
        one, other = faces[left][i + 1:] + faces[left][:i + 1], faces[right][j + 1:] + faces[right][:j + 1]
        merged = one + other[1:-1]
        faces = [face for f, face in enumerate(faces) if f not in (left, right)] + [merged]
    return faces


def split_in_quads(faces):
    quads = []
    for f, face in enumerate(faces):
        for i, v in enumerate(face):
            quads.append((("f", f), edge(face[i - 1], v), ("v", v), edge(v, face[(i + 1) % len(face)])))
    return renumber(quads)


def test_meshes(rng):
    """By kind; each a list of names and faces."""
    bar = [(0, 0, 0), (1, 0, 0)]
    tripod = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    block = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0), (2, 1, 1)]
    triangles = [("tetrahedron", TETRAHEDRON), ("octahedron", bipyramid(4)), ("bipyramid 7", bipyramid(7)), ("bipyramid 9", bipyramid(9)),
                 ("torus", torus(5, 4, True)), *((f"random {i}", triangulation(rng, 45)) for i in range(3))]
    quads = [("cube", cube_surface([(0, 0, 0)])), ("bar", cube_surface(bar)), ("tripod", cube_surface(tripod)), ("block", cube_surface(block)),
             ("torus", torus(5, 4, False)), ("split prism 7", split_in_quads(prism(7))), ("split random", split_in_quads(triangulation(rng, 25)))]
    others = [("tetrahedron", TETRAHEDRON), ("prism 3", prism(3)), ("prism 8", prism(8)), *((f"random {i}", polygons(rng, 30)) for i in range(3))]
    return {"triangles": triangles, "quads": quads, "polygons": quads + others}


def turned_to_least(face):
    i = face.index(min(face))
    return tuple(face[i:] + face[:i])


def compare_meshes(points, faces, own_points, own_faces, tolerance):
    """Equal up to the numbers of the vertices: each point has one of the other's near by, and the faces are then the same."""
    require(len(points) == len(own_points) and len(faces) == len(own_faces),
            f"{len(points)} points and {len(faces)} faces, not {len(own_points)} and {len(own_faces)}")
    apart = np.abs(points[:, None, :] - own_points[None, :, :]).max(axis=2) if len(points) < 3000 else None
    if apart is not None:
        partner, worst = apart.argmin(axis=1), apart.min(axis=1)
    else:
        partner = np.array([np.abs(own_points - p).max(axis=1).argmin() for p in points])
        worst = np.abs(points - own_points[partner]).max(axis=1)
    require(worst.max() < tolerance, f"point {worst.argmax()} at {points[worst.argmax()]} is off by {worst.max():.3g}")
    require(len(set(partner.tolist())) == len(points), "two points are one")
    renumbered = sorted(turned_to_least(tuple(int(partner[v]) for v in face)) for face in faces)
    require(renumbered == sorted(turned_to_least(tuple(face)) for face in own_faces), "the faces are others")
    return float(worst.max())


def check_refine(program, tally, scheme, file, meshes, numpy_rng, levels=(1, 2)):
    for name, faces in meshes:
        points = numpy_rng.uniform(-1, 1, (1 + max(map(max, faces)), 3))
        mesh, own = Mesh(faces), points
        for level in range(1, max(levels) + 1):
            mesh, own, _ = scheme.refine(mesh, own, Float)
            if level not in levels or len(mesh.faces) > 8000:
                continue

            def run():
                got, _, got_faces = program.mesh("refine", file, ["--levels", str(level), *scheme.options], points, faces)
                return compare_meshes(got, got_faces, own, mesh.faces, POSITION)
            tally.check("refined meshes", f"{scheme} on '{name}', {level} levels", run)


# ------------------------------------------------------------------------------------------------ limits by refinement


class Deep:
    """The limit point and the normal at a vertex or face: by steps on the mesh until irregular ones are far, then by many more
    around it, with its own local matrix in 64 bits; points are taken from the middle and scaled again each time."""

    def __init__(self, scheme, mesh, points, place):
        around = mesh.fan(place[1]) if place[0] == "v" else mesh.faces[place[1]]
        self.n = n = len(around)
        own = local(scheme, n)
        near = points[find(mesh, scheme, place, around[0], own.labels)]
        matrix = own.matrix()
        ring = [own.labels.index((s, *((0, 0) if scheme.dual else (1, 0)))) for s in range(n)]
        self.limit, size, self.normal = np.zeros(3), 1.0, None
        for _ in range(self.steps(own)):
            middle = near[ring].mean(axis=0) if scheme.dual else near[own.labels.index("c")]
            self.limit = self.limit + size * middle
            near = near - middle
            scale = np.abs(near).max()
            if scale == 0:
                break
            near, size = matrix @ (near / scale), size * scale
        if own.dominant is not None:      # otherwise no pair dominates: there is nothing to converge to
            around = near[ring]
            total = np.cross(around, np.roll(around, -1, axis=0)).sum(axis=0)
            self.normal = total / np.linalg.norm(total)

    @staticmethod
    def steps(own):
        """So many that the ratio of mu and lambda has come to 1e-16."""
        if own.dominant is None:
            return 200
        return min(20000, 60 + math.ceil(37 / -math.log(float(own.mu / own.dominant))))


def check_limits(program, tally, scheme, file, meshes, numpy_rng, notes, most=14):
    for name, faces in meshes:
        if len(faces) > 30 and scheme.far > 3:
            continue                      # many points, far down
        points = numpy_rng.uniform(-1, 1, (1 + max(map(max, faces)), 3))
        got, normals, got_faces = program.mesh("limit", file, scheme.options, points, faces)
        mesh, fine = Mesh(faces), points
        chosen = sorted({len(mesh.fan(v)): v for v in mesh.leaving}.values())
        chosen += [v for v in sorted(mesh.leaving) if v not in chosen][:most - len(chosen)]
        track = [("v", v) for v in chosen]
        for _ in range(scheme.far * scheme.half_steps + (scheme.name == "mid-edge")):
            mesh, fine, track = scheme.refine(mesh, fine, Float, track)
        for v, place in zip(chosen, track):
            deep = Deep(scheme, mesh, fine, place)

            def run():
                require(got_faces == faces, "limit changes faces")
                apart = float(np.abs(deep.limit - got[v]).max())
                require(apart < LIMIT, f"the limit of vertex {v} (n = {deep.n}) is {got[v]}, not {deep.limit}: off by {apart:.3g}")
                return apart

            def run_normal():
                if deep.normal is None:
                    require(np.linalg.norm(normals[v]) == 0, f"vertex {v} (n = {deep.n}) has a normal")
                    notes["no normals, rightly"] += 1
                    return None
                apart = float(np.abs(deep.normal - normals[v]).max())
                require(apart < NORMAL, f"the normal of vertex {v} (n = {deep.n}) is {normals[v]}, not {deep.normal}: off by {apart:.3g}")
                return apart
            tally.check("limit points", f"{scheme} on '{name}'", run)
            tally.check("normals", f"{scheme} on '{name}'", run_normal)


# ------------------------------------------------------------------------------------------------ Kobbelt's virtual point


def check_directions(tally):
    """The virtual point is made such that the two directions give the same point at the faces of the irregular vertex, and where
    all points are regular. At the faces of the second ring that touch a spoke they differ (n = 4 apart): there it matters that
    the mean of both is taken."""
    for scheme in (s for s in SCHEMES if s.name == "kobbelt"):
        for n in VALENCES:
            def run():
                mesh, labels, _, _ = start(scheme, n, 5)
                scheme.directions.clear()
                scheme.refine(mesh, [{p: fmpq(1)} for p in labels], Exact)
                require(len(scheme.directions) > 3 * n, "no faces were seen")
                for (one, other), face in scheme.directions:
                    names = [labels[v] for v in face]
                    differ = any(one.get(p, 0) != other.get(p, 0) for p in {*one, *other})
                    spoke = sum(1 for p in names if p != "c" and p[1:] in ((1, 0), (2, 0))) == 2 and "c" not in names
                    require(differ == (spoke and n != 4), f"at the face {names} the directions {'differ' if differ else 'agree'}")
            tally.check("virtual points: directions that agree, exactly", f"{scheme}, n = {n}", run)


# ------------------------------------------------------------------------------------------------ planted errors

# A copy of a scheme's file with one weight changed (its rules still sum to 1): scheme, what stands there, what is put there.
PLANTED = [
    (Butterfly(), 'opposite = "2*w"', 'opposite = "2*w + 1/1000000"', 'ends     = "1/2"', 'ends     = "1/2 - 1/1000000"'),
    (Butterfly(), 'opposite = "2*w"', 'opposite = "2*w + 2/1000000"', 'wings    = "-w"', 'wings    = "-w - 1/1000000"'),
    (Kobbelt(), 't = "w/(8 + w)"', 't = "w/(8 + w) + 1/1000000"'),
    (Kobbelt(), '"diagonals[-2,-1,0,1]" = "-t*w/16"', '"diagonals[-1,0]" = "-t*w/8"'),
    (Kobbelt(), 'tips = "-w/16"', 'tips = "-w/16 + 1/1000000"', 'ends = "1/2 + w/16"', 'ends = "1/2 + w/16 - 1/1000000"'),
    (Kobbelt(), '"(1/2 + w/16)/2"', '"(1/2 + w/16)/2 + 1/1000000"', '"-w/32"', '"-w/32 - 1/1000000"'),
    (Sqrt3(), '"(4 - 2*cos(2*pi/n))/9"', '"(4 - 2*cos(2*pi/n))/9 + 1/1000000"'),
    (FourEight(), 'centre = "1/2"', 'centre = "1/2 + 1/1000000"', 'ring   = "1/(2*n)"', 'ring   = "(1/2 - 1/1000000)/n"'),
    (FourEight(), 'centre = "1/2"', 'centre = "(n + 1)/10"', 'ring   = "1/(2*n)"', 'ring   = "(9 - n)/(10*n)"'),
    (Midpoint(), 'repeat = "d - 1"', 'repeat = "d"'),
    (LoopAveraging(), '"n == 3" = "-1/8"', '"n == 3" = "1/4"'),
    (LoopAveraging(), '"n != 3" = "1/4"', '"n != 3" = "1/4 + 1/1000000"'),
    (MidEdge(), 'ends = "1/2"', 'ends = "1/2"'),              # nothing is changed, and nothing must be found
]


def check_planted(program, tally, meshes, seed):
    """Each planted error must be found by the matrices (or sizes), the eigenvalues or masks, and by the refined meshes."""
    folder = Path(__file__).resolve().parents[2] / "schemes"
    for number, (scheme, *changes) in enumerate(PLANTED):
        kind = "triangle" if scheme.mesh == "triangles" else "quad"
        text = (folder / kind / f"{scheme.name}.toml").read_text(encoding="utf-8")
        for old, new in zip(changes[::2], changes[1::2]):
            if old not in text:
                raise Unable(f"{scheme.name}.toml has no {old}")
            text = text.replace(old, new)
        spoilt = any(old != new for old, new in zip(changes[::2], changes[1::2]))
        file = program.folder / f"planted-{number}.toml"
        file.write_text(text.split("[[claims]]", maxsplit=1)[0], encoding="utf-8")
        for what, action in (("analysis", lambda inner: check_analysis(program, inner, scheme, file, deep=False)),
                             ("meshes", lambda inner: check_refine(program, inner, scheme, file, meshes[scheme.mesh], np.random.default_rng(seed)))):
            def run():
                inner = Tally(quiet=True)
                action(inner)
                require(bool(inner.wrong) == spoilt, f"{'not found' if spoilt else 'found where there is none'}: {inner.wrong[:3]}")
                if spoilt:
                    kinds = ", ".join(f"{kind} {count}" for kind, count in Counter(kind for kind, _ in inner.wrong).items())
                    print(f"  planted in {scheme}: {changes[1]}: found in {kinds}")
            tally.check(f"planted errors, {what}", f"{scheme}: {changes[1::2]}", run)


# ------------------------------------------------------------------------------------------------ the table


def table():
    """lambda and |mu|/lambda^2 as they are computed here; in brackets where no simple pair of frequency 1 dominates."""
    print("\nlambda and |mu|/lambda^2, computed apart")
    for scheme in SCHEMES:
        print(scheme)
        for n in range(3, 9):
            own = local(scheme, n)
            if own.dominant is None:
                led = ", ".join(f"{r:.10f} of frequency {k} ({m} times)" for r, _, k, m in own.ranked[:3])
                print(f"  {n}  no dominant pair: {led}")
            else:
                print(f"  {n}  {shown(own.dominant)}  {shown(own.mu / own.dominant ** 2)}")


def shown(x):
    return f"{round(float(x), 12):.10f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    default = Path(__file__).resolve().parents[2] / "target" / "release" / "eigenring"
    parser.add_argument("program", nargs="?", default=str(default), help="the program; target/release/eigenring if left out")
    parser.add_argument("--only", help="names of schemes, separated by commas")
    parser.add_argument("--seed", type=int, default=1, help="of the random meshes and points")
    arguments = parser.parse_args()
    names = arguments.only.split(",") if arguments.only else None
    began, tally, notes = time.monotonic(), Tally(), Counter()
    try:
        with tempfile.TemporaryDirectory() as folder:
            program = Program(arguments.program, Path(folder))
            meshes = test_meshes(random.Random(arguments.seed))
            for scheme in SCHEMES:
                if names and scheme.name not in names:
                    continue
                check_analysis(program, tally, scheme, scheme.name, deep=len(orbits(scheme)) <= 12)
                check_refine(program, tally, scheme, scheme.name, meshes[scheme.mesh], np.random.default_rng(arguments.seed))
                check_limits(program, tally, scheme, scheme.name, meshes[scheme.mesh], np.random.default_rng(arguments.seed + 1), notes)
                print(f"  {scheme}: done after {time.monotonic() - began:.0f} s", flush=True)
            if not names:
                check_directions(tally)
                check_planted(program, tally, meshes, arguments.seed)
            runs = program.count
    except (Unable, subprocess.TimeoutExpired) as error:
        print(f"the check could not be made: {error}", file=sys.stderr)
        return 2
    for what, count in tally.done.items():
        wrong = sum(1 for kind, _ in tally.wrong if kind == what)
        most = f"; differences up to {tally.largest[what]:.2g}" if tally.largest.get(what) else ""
        print(f"{what}: {count} compared, {wrong} wrong{most}")
    print(f"no normals, rightly: {notes['no normals, rightly']}; {runs} runs of the program, {time.monotonic() - began:.0f} s")
    if not names:
        table()
    return 1 if tally.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
