#!/usr/bin/env python3
"""Checks Eigenring's reports against an independent computer algebra system (FLINT, by python-flint).

Nothing here is shared with the program. Real meshes are built around an extraordinary vertex (or face) and refined by
the rules of the literature with exact weights; labels are found again by walking along the edges of the refined mesh;
the local subdivision matrix is read off; its eigenvalues, Jordan blocks and masks are then worked out exactly and compared
with the JSON of `eigenring analyze SCHEME --valence 3..12 --format json --digits 40`. See README.md beside this file.

    python3 tests/oracle/check.py [path/to/eigenring]
    python3 tests/oracle/check.py --self-test [path/to/eigenring]

Exit status: 0 all agree, 1 something doesn't, 2 the check could not be made.
"""

import copy
import json
import math
import re
import subprocess
import sys
import time
from fractions import Fraction
from pathlib import Path

try:
    import flint
    from flint import arb, arb_mat, arb_poly, fmpq, fmpq_mat, fmpq_poly, fmpz, fmpz_poly
    import sympy
except ImportError as error:
    sys.exit(f"{error}: pip install python-flint sympy")

flint.ctx.prec = 400                      # bits of every enclosure: some 120 decimals
CLOSE = arb(10) ** -60                    # enclosures must agree to this many decimals
DIGITS = 40                               # decimals asked of the program
VALENCES = range(3, 13)


class Mismatch(Exception):
    """What the program says is not what was found here."""


class Unable(Exception):
    """The check itself could not be made."""


def require(holds, message):
    if not holds:
        raise Mismatch(message)


# ------------------------------------------------------------------------------------------------ exact numbers
#
# Weights and most eigenvalues lie in K = Q(c), c = 2 cos(2 pi/n): polynomials in c modulo the minimal polynomial of c.
# Others lie in K(sqrt d) with d in K: pairs a + b sqrt d.


class Field:
    """Q(2 cos(2 pi/order)); the order is n or a multiple of it, for schemes whose weights need more."""

    def __init__(self, n, order=None):
        self.n, self.order = n, order or n
        self.modulus = fmpq_poly(list(fmpz_poly.cos_minpoly(self.order)))
        self.c = 2 * (2 * arb.pi() / self.order).cos()
        self.zero, self.one = self.rational(0), self.rational(1)

    def rational(self, q):
        return Num(self, fmpq_poly([fmpq(q)]))

    def cos(self, turn):
        """cos(2 pi turn) for a fraction of a turn; None if it isn't seen to lie in the field."""
        for shift, sign in ((Fraction(0), 1), (Fraction(1, 2), -1)):
            steps = (turn + shift) * self.order
            if steps.denominator == 1:
                return self.chebyshev(int(steps) % self.order) * fmpq(sign, 2)
        special = {0: fmpq(1), 1: fmpq(1, 2), 2: fmpq(-1, 2), 3: fmpq(-1)}
        sixth, quarter = turn % 1 * 6, turn % 1 * 4
        if sixth.denominator == 1:
            return self.rational(special[min(int(sixth), 6 - int(sixth))])
        return self.zero if quarter.denominator == 1 else None

    def chebyshev(self, m):
        """2 cos(2 pi m/order)."""
        before, now = self.rational(2), Num(self, fmpq_poly([0, 1]) % self.modulus)
        if m == 0:
            return before
        c = now
        for _ in range(m - 1):
            before, now = now, now * c - before
        return now

    def enclose(self, poly):
        value = arb(0)
        for coefficient in reversed(list(poly)):
            value = value * self.c + arb(coefficient)
        return value

    def invert(self, poly):
        gcd, inverse, _ = poly.xgcd(self.modulus)
        if poly == 0 or gcd.degree() != 0:
            raise ZeroDivisionError
        return inverse % self.modulus


class Num:
    """a + b sqrt d, with a, b, d in the field; b = 0 and d unset for elements of the field."""

    __slots__ = ("field", "a", "b", "d")

    def __init__(self, field, a, b=fmpq_poly([]), d=None):
        self.field, self.a, self.b = field, a, b
        self.d = d if b != 0 else None

    def _with(self, other):
        if not isinstance(other, Num):
            other = self.field.rational(other)
        if self.d is not None and other.d is not None and self.d != other.d:
            raise Unable("two different square roots in one exact computation")
        return other, self.d if self.d is not None else other.d

    def __add__(self, other):
        other, d = self._with(other)
        return Num(self.field, self.a + other.a, self.b + other.b, d)

    __radd__ = __add__

    def __neg__(self):
        return Num(self.field, -self.a, -self.b, self.d)

    def __sub__(self, other):
        other, d = self._with(other)
        return Num(self.field, self.a - other.a, self.b - other.b, d)

    def __rsub__(self, other):
        return self.field.rational(other) - self

    def __mul__(self, other):
        other, d = self._with(other)
        m = self.field.modulus
        if d is None:
            return Num(self.field, self.a * other.a % m)
        a = (self.a * other.a + self.b * other.b % m * d) % m
        return Num(self.field, a, (self.a * other.b + self.b * other.a) % m, d)

    __rmul__ = __mul__

    def _norm(self):
        m = self.field.modulus
        return (self.a * self.a - (self.b * self.b % m * self.d if self.d is not None else 0)) % m

    def is_zero(self):
        """True or false of the real number, also when sqrt d is itself an element of the field."""
        if self.b == 0:
            return self.a == 0
        if self._norm() != 0:
            return False
        return bool(self.enclosure().contains(0))        # then it is 0 or 2a, which the enclosure tells apart

    def inverse(self):
        if self.b == 0:
            return Num(self.field, self.field.invert(self.a))
        if self.is_zero():
            raise ZeroDivisionError
        norm = self._norm()
        if norm == 0:
            return Num(self.field, self.field.invert(2 * self.a))
        i, m = self.field.invert(norm), self.field.modulus
        return Num(self.field, self.a * i % m, -self.b * i % m, self.d)

    def __truediv__(self, other):
        other, _ = self._with(other)
        return self * other.inverse()

    def __pow__(self, exponent):
        result = self.field.one
        for _ in range(abs(exponent)):
            result = result * self
        return result if exponent >= 0 else result.inverse()

    def sqrt(self):
        require(self.b == 0, "a square root within a square root")
        q = self.as_rational()
        if q is not None and q >= 0:
            top, below = q.p.isqrt(), q.q.isqrt()
            if top * top == q.p and below * below == q.q:
                return self.field.rational(fmpq(top, below))
        return Num(self.field, fmpq_poly([]), fmpq_poly([1]), self.a)

    def as_rational(self):
        return fmpq(self.a[0]) if self.b == 0 and self.a.degree() <= 0 else None

    def enclosure(self):
        value = self.field.enclose(self.a)
        return value if self.b == 0 else value + self.field.enclose(self.b) * self.field.enclose(self.d).sqrt()


# ------------------------------------------------------------------------------------------------ formulas
#
# A reader of its own for the `exact` and `formula` strings: + - * / ^, parentheses, cos, sqrt, pi, n, k.

TOKEN = re.compile(r"\s*(\d+\.\d+|\d+|[a-z]+|[-+*/^()])")


def tokens(text):
    found, at = [], 0
    while at < len(text.rstrip()):
        match = TOKEN.match(text, at)
        require(match, f"can't read {text!r} at {text[at:]!r}")
        found.append(match.group(1))
        at = match.end()
    return found


def evaluate(text, field, n=None, k=None):
    """The exact value of a formula, as a Num."""
    left = tokens(text)
    names = {"n": n, "k": k}

    def peek():
        return left[0] if left else None

    def take(expected=None):
        require(left and expected in (None, left[0]), f"can't read {text!r}: expected {expected}")
        return left.pop(0)

    # `number` makes a number; within cos, pi stands for 1, and numbers are fractions
    def total(number):
        value = product(number)
        while peek() in ("+", "-"):
            value = value + product(number) if take() == "+" else value - product(number)
        return value

    def product(number):
        value = signed(number)
        while peek() in ("*", "/"):
            value = value * signed(number) if take() == "*" else value / signed(number)
        return value

    def signed(number):
        if peek() == "-":
            take()
            return -signed(number)
        value = atom(number)
        if peek() == "^":
            take()
            negative = peek() == "-" and bool(take())
            exponent = int(take())
            value = value ** (-exponent if negative else exponent)
        return value

    def atom(number):
        token = take()
        if token == "(":
            value = total(number)
            take(")")
        elif token == "cos":
            take("(")
            turns_of_pi = total(Fraction)
            take(")")
            value = field.cos(turns_of_pi / 2)
            if value is None:
                raise Unable(f"{text!r} has a cosine outside Q(cos(2 pi/{field.order}))")
        elif token == "sqrt":
            take("(")
            value = total(number).sqrt()
            take(")")
        elif token == "pi" and number is Fraction:
            value = Fraction(1)
        elif token in names and names[token] is not None:
            value = number(names[token])
        else:
            require(token[0].isdigit(), f"can't read {text!r}: unknown name {token!r}")
            value = number(Fraction(token))
        return value

    def field_number(x):
        x = Fraction(x)
        return field.rational(fmpq(x.numerator, x.denominator))

    result = total(field_number)
    require(not left, f"can't read {text!r}: {left[:1]} is left over")
    return result


# ------------------------------------------------------------------------------------------------ meshes
#
# A mesh is a list of faces, each a counter-clockwise cycle of vertices; `at` maps every vertex to its old points with
# weights (the identity, before refinement). Only what is complete is refined: the mesh shrinks at its boundary.


class Mesh:
    def __init__(self, faces):
        self.faces = faces
        self.after, self.face_of = {}, {}
        for number, face in enumerate(faces):
            for i, a in enumerate(face):
                b = face[(i + 1) % len(face)]
                self.face_of[a, b] = number
                self.after[a, b] = face[(i + 2) % len(face)]
        self.vertices = {v for face in faces for v in face}
        self.fans = {v: self._fan(v) for v in self.vertices}

    def before(self, a, b):
        """The vertex before a in the face on the left of a -> b."""
        face = self.faces[self.face_of[a, b]]
        return face[face.index(a) - 1]

    def turn(self, v, neighbour):
        """The neighbour of v that comes counter-clockwise after the given one."""
        return self.before(v, neighbour)

    def _fan(self, v):
        """The neighbours of an interior vertex, counter-clockwise; None at the boundary."""
        start = next(b for (a, b) in self._out(v))
        fan, now = [], start
        while True:
            fan.append(now)
            if (v, now) not in self.face_of:
                return None
            now = self.turn(v, now)
            if now == start:
                return fan

    def _out(self, v):
        if not hasattr(self, "_edges_out"):
            self._edges_out = {}
            for edge in self.face_of:
                self._edges_out.setdefault(edge[0], []).append(edge)
        return self._edges_out.get(v, [])

    def inner_edges(self):
        return [(a, b) for (a, b) in self.face_of if (b, a) in self.face_of]


def triangle_patch(n, rings):
    """An extraordinary vertex of valence n: in sector s the points i e_s + j e_(s+1), i >= 1, j >= 0."""

    def point(s, i, j):
        if i == 0:
            return ("c",) if j == 0 else (((s + 1) % n), j, 0)
        return (s % n, i, j)

    faces = []
    for s in range(n):
        for i in range(rings):
            for j in range(rings - i):
                faces.append((point(s, i, j), point(s, i + 1, j), point(s, i, j + 1)))
                if i + j + 2 <= rings:
                    faces.append((point(s, i + 1, j), point(s, i + 1, j + 1), point(s, i, j + 1)))
    return Mesh(faces)


def quad_patch(n, rings):
    """An extraordinary vertex of valence n in a mesh of quads."""

    def point(s, i, j):
        if i == 0:
            return ("c",) if j == 0 else (((s + 1) % n), j, 0)
        return (s % n, i, j)

    return Mesh([
        (point(s, i, j), point(s, i + 1, j), point(s, i + 1, j + 1), point(s, i, j + 1))
        for s in range(n) for i in range(rings) for j in range(rings)
    ])


def dual_patch(n, rings):
    """A face with n corners in a mesh of quads with valence 4: from corner s, i edges beyond corner s+1 -> s, j beyond s-1 -> s."""
    faces = [tuple((s, 0, 0) for s in range(n))]
    for s in range(n):
        following = (s + 1) % n
        for i in range(rings):
            faces.append(((s, 0, i), (s, 0, i + 1), (following, i + 1, 0), (following, i, 0)))
            for j in range(rings):
                faces.append(((s, i, j), (s, i + 1, j), (s, i + 1, j + 1), (s, i, j + 1)))
    return Mesh(faces)


def walk(mesh, arrived, v, steps):
    """Straight on, as often as told, from a vertex that was reached from `arrived`. None beyond the mesh."""
    for _ in range(steps):
        if v is None or mesh.fans.get(v) is None:
            return None, None
        fan = mesh.fans[v]
        onward = fan[(fan.index(arrived) + len(fan) // 2) % len(fan)]
        arrived, v = v, onward
    return arrived, v


def left(mesh, arrived, v):
    """The neighbour of v on the left: the next but straight on, counter-clockwise."""
    if v is None or mesh.fans.get(v) is None:
        return None
    fan = mesh.fans[v]
    return fan[(fan.index(arrived) + len(fan) // 2 + 1) % len(fan)]


def name_vertices(mesh, dual, centre, spokes, reach):
    """Labels of the points by walking: i edges along spoke s, then turned left once, j edges."""
    named = {} if dual else {("c",): centre}
    n = len(spokes)
    for s in range(n):
        for i in range(0 if dual else 1, reach + 1):
            for j in range(reach + 1):
                if dual:
                    start = spokes[s]
                    arrived, v = walk(mesh, spokes[(s + 1) % n], start, i)
                    if i == 0:
                        _, v = walk(mesh, spokes[s - 1], start, j)
                    elif j > 0:
                        turned = left(mesh, arrived, v)
                        _, v = walk(mesh, v, turned, j - 1) if turned is not None else (None, None)
                else:
                    arrived, v = walk(mesh, centre, spokes[s], i - 1)
                    if j > 0:
                        turned = left(mesh, arrived, v)
                        _, v = walk(mesh, v, turned, j - 1) if turned is not None else (None, None)
                if v is not None:
                    named[s, i, j] = v
    return named


# ------------------------------------------------------------------------------------------------ schemes


def combine(parts):
    """The weighted sum of sparse rows."""
    total = {}
    for weight, row in parts:
        for point, w in row.items():
            total[point] = total[point] + weight * w if point in total else weight * w
    return {point: w for point, w in total.items() if not w.is_zero()}


class Scheme:
    """A scheme's rules at one n. `rows` gives every vertex of a mesh as a sparse combination of the first mesh's."""

    kind = "triangles"
    beyond = 1                        # weights lie in Q(cos(2 pi/lcm(n, beyond)))

    def __init__(self, field):
        self.field, self.n = field, field.n

    def q(self, a, b=1):
        return self.field.rational(fmpq(a, b))

    def cos(self, j):
        return self.field.cos(Fraction(j, self.n))


class Triangles(Scheme):
    def refine(self, mesh, rows):
        new = {}
        for v, fan in mesh.fans.items():
            if fan:
                new["v", v] = self.vertex(rows, v, fan)
        edge_names = {}
        for a, b in mesh.inner_edges():
            name = edge_names.setdefault(frozenset((a, b)), ("e", a, b))
            if name not in new:
                row = self.edge(mesh, rows, a, b)
                if row is not None:
                    new[name] = row
        faces = []
        for a, b, c in mesh.faces:
            ab, bc, ca = (edge_names.get(frozenset(e)) for e in ((a, b), (b, c), (c, a)))
            a, b, c = (("v", x) for x in (a, b, c))
            for face in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)):
                if all(x in new for x in face):
                    faces.append(face)
        return Mesh(faces), new


class Loop(Triangles):
    """C. Loop, 1987."""

    def beta(self):
        inner = self.q(3, 8) + self.cos(1) / 4
        return (self.q(5, 8) - inner * inner) / self.n

    def vertex(self, rows, v, fan):
        m = len(fan)
        beta = self.beta() if m == self.n else self.q(1, 16)
        return combine([(self.q(1) - m * beta, rows[v])] + [(beta, rows[u]) for u in fan])

    def edge(self, mesh, rows, a, b):
        c, d = mesh.after[a, b], mesh.after[b, a]
        ends, across = self.q(3, 8), self.q(1, 8)
        return combine([(ends, rows[a]), (ends, rows[b]), (across, rows[c]), (across, rows[d])])


class LoopWarren(Loop):
    """J. Warren, 1995: simpler weights at the vertex."""

    def beta(self):
        return self.q(3, 16) if self.n == 3 else self.q(3, 8 * self.n)


class Butterfly(Triangles):
    """D. Zorin, P. Schroeder, W. Sweldens, 1996, with the eight-point stencil of Dyn, Levin and Gregory, 1990."""

    def vertex(self, rows, v, fan):
        return rows[v]

    def edge(self, mesh, rows, a, b):
        if self.n != 6:
            told = [x for x in ((a, b), (b, a)) if mesh.fans[x[0]] and len(mesh.fans[x[0]]) == self.n]
            if told:
                require(len(told) == 1, "an edge with two extraordinary ends in a patch with one")
                return self.irregular(mesh, rows, *told[0])
        c, d = mesh.after[a, b], mesh.after[b, a]
        wings = []
        for x, y in ((a, c), (c, b), (b, d), (d, a)):         # edges with the triangle a b c or b a d on one side
            wing = mesh.after.get((x, y))
            if wing is None or wing in (a, b):
                wing = mesh.after.get((y, x))
            if wing is None or wing in (a, b):
                return None
            wings.append(wing)
        half, eighth, wing = self.q(1, 2), self.q(1, 8), self.q(-1, 16)
        return combine([(half, rows[a]), (half, rows[b]), (eighth, rows[c]), (eighth, rows[d])]
                       + [(wing, rows[x]) for x in wings])

    def irregular(self, mesh, rows, v, towards):
        fan = mesh.fans[v]
        start = fan.index(towards)
        fan = fan[start:] + fan[:start]
        n = self.n
        if n == 3:
            ring = [self.q(5, 12), self.q(-1, 12), self.q(-1, 12)]
        elif n == 4:
            ring = [self.q(3, 8), self.q(0), self.q(-1, 8), self.q(0)]
        else:
            ring = [(self.q(1, 4) + self.cos(j) + self.cos(2 * j) / 2) / n for j in range(n)]
        return combine([(self.q(3, 4), rows[v])] + [(w, rows[u]) for w, u in zip(ring, fan)])


class CatmullClark(Scheme):
    """E. Catmull and J. Clark, 1978."""

    kind = "quads"

    def refine(self, mesh, rows):
        new, edge_names = {}, {}
        for number, face in enumerate(mesh.faces):
            new["f", number] = combine([(self.q(1, len(face)), rows[v]) for v in face])
        for a, b in mesh.inner_edges():
            name = edge_names.setdefault(frozenset((a, b)), ("e", a, b))
            f, g = (new["f", mesh.face_of[e]] for e in ((a, b), (b, a)))
            quarter = self.q(1, 4)
            new[name] = combine([(quarter, rows[a]), (quarter, rows[b]), (quarter, f), (quarter, g)])
        for v, fan in mesh.fans.items():
            if fan:
                new["v", v] = self.vertex(mesh, rows, new, v, fan)
        faces = []
        for number, face in enumerate(mesh.faces):
            for i, v in enumerate(face):
                after = edge_names.get(frozenset((v, face[(i + 1) % len(face)])))
                before = edge_names.get(frozenset((v, face[i - 1])))
                quad = (("v", v), after, ("f", number), before)
                if all(x in new for x in quad):
                    faces.append(quad)
        return Mesh(faces), new


    def vertex(self, mesh, rows, new, v, fan):
        m = len(fan)
        share = self.q(1, m * m)                             # of the mean of m points, divided by m
        parts = [(self.q(m - 2, m), rows[v])] + [(share, rows[u]) for u in fan]
        return combine(parts + [(share, new["f", mesh.face_of[v, u]]) for u in fan])


class Dual(Scheme):
    kind = "dual"

    def refine(self, mesh, rows):
        new = {}
        for number, face in enumerate(mesh.faces):
            for i, v in enumerate(face):
                own = face[i:] + face[:i]
                new[v, number] = combine([(self.weight(j, len(face)), rows[u]) for j, u in enumerate(own)])
        faces = [tuple((v, number) for v in face) for number, face in enumerate(mesh.faces)]
        done = set()
        for a, b in mesh.inner_edges():
            if (b, a) not in done:
                done.add((a, b))
                f, g = mesh.face_of[a, b], mesh.face_of[b, a]
                faces.append(((b, f), (a, f), (a, g), (b, g)))
        for v, fan in mesh.fans.items():
            if fan:
                faces.append(tuple((v, mesh.face_of[v, u]) for u in fan))
        return Mesh(faces), new


class DooSabin(Dual):
    """D. Doo and M. Sabin, 1978."""

    def weight(self, j, m):
        cos = self.field.cos(Fraction(j, m))
        return (3 + 2 * cos) / (4 * m) + (self.q(1, 4) if j == 0 else self.q(0))


class Biquadratic(Dual):
    """E. Catmull and J. Clark, 1978: the mean of the vertex, the midpoints of its two edges in the face, and the centroid."""

    def weight(self, j, m):
        mean = self.q(1, 4 * m)
        if j == 0:
            return self.q(1, 4) + 2 * self.q(1, 8) + mean
        return self.q(1, 8) + mean if j in (1, m - 1) else mean


class LoopSqrt2(Loop):
    """A scheme of this check, schemes/loop-sqrt2.toml: 1 and eigenvalues outside Q(cos(2 pi/n)), a bare multiple of one cosine."""

    beyond = 8

    def beta(self):
        return 2 * self.field.cos(Fraction(1, 8)) / (3 * self.n)

    def vertex(self, rows, v, fan):
        m = len(fan)
        beta = 2 * self.field.cos(Fraction(1, 8)) / (3 * m)
        return combine([(self.q(1) - m * beta, rows[v])] + [(beta, rows[u]) for u in fan])


SCHEMES = {
    "loop": Loop,
    "loop-warren": LoopWarren,
    "catmull-clark": CatmullClark,
    "doo-sabin": DooSabin,
    "catmull-clark-biquadratic": Biquadratic,
    "modified-butterfly": Butterfly,
}
OWN_SCHEMES = {"loop-sqrt2": LoopSqrt2}


def scheme_of(name, n):
    kind = {**SCHEMES, **OWN_SCHEMES}[name]
    return kind(Field(n, math.lcm(n, kind.beyond)))


def file_of(name):
    """What the program is told: a name of its catalogue, or a file beside this one."""
    return name if name in SCHEMES else str(Path(__file__).resolve().parent / "schemes" / f"{name}.toml")


PATCHES = {"triangles": (triangle_patch, 5), "quads": (quad_patch, 4), "dual": (dual_patch, 4)}


def first_mesh(scheme):
    build, rings = PATCHES[scheme.kind]
    mesh = build(scheme.n, rings)
    return mesh, {v: {v: scheme.field.one} for v in mesh.vertices}


def refined_names(scheme, mesh, fine, reach):
    """Labels of the points of the refined mesh, walked from where the centre and its spokes have gone."""
    n = scheme.n
    if scheme.kind == "dual":
        centre, spokes = None, [((s, 0, 0), 0) for s in range(n)]      # the central face is face 0
    else:
        centre = ("v", ("c",))
        spokes = []
        for s in range(n):
            ends = {("e", ("c",), (s, 1, 0)), ("e", (s, 1, 0), ("c",))}
            spokes.append(next(v for v in ends if v in fine.vertices))
    return name_vertices(fine, scheme.kind == "dual", centre, spokes, reach)


class Local:
    """The local subdivision matrix over a set of points, from one refinement of a mesh."""

    def __init__(self, scheme, orbits):
        self.scheme, self.field, self.n = scheme, scheme.field, scheme.n
        mesh, rows = first_mesh(scheme)
        dual = scheme.kind == "dual"
        spokes = [(s, 0, 0) if dual else (s, 1, 0) for s in range(self.n)]
        walked = name_vertices(mesh, dual, None if dual else ("c",), spokes, 2)
        for label, v in walked.items():
            require(label == v or label[1:] == (0, 0), f"the patch is laid out wrongly: {label} is at {v}")
        fine, new = scheme.refine(mesh, rows)
        names = refined_names(scheme, mesh, fine, max(i + j for i, j in orbits))
        self.orbits = orbits
        self.points = ([] if dual else [("c",)]) + [(s, i, j) for s in range(self.n) for i, j in orbits]
        self.index = {p: i for i, p in enumerate(self.points)}
        self.rows = []
        for p in self.points:
            row = new[names[p]]
            beyond = [q for q in row if q not in self.index]
            require(not beyond, f"the points are not invariant: {p} is made of {beyond[:3]}")
            self.rows.append(row)
        self.check_rotation()

    def check_rotation(self):
        def turned(p):
            return p if p == ("c",) else ((p[0] + 1) % self.n, *p[1:])

        for p, row in zip(self.points, self.rows):
            other = self.rows[self.index[turned(p)]]
            require(len(row) == len(other) and all((other[turned(q)] - w).is_zero() for q, w in row.items()),
                    "the matrix doesn't commute with the rotation")
            require((sum(row.values(), self.field.zero) - 1).is_zero(), f"the row of {p} doesn't sum to 1")

    def rational_matrix(self):
        entries = []
        for row in self.rows:
            dense = [fmpq(0)] * len(self.points)
            for q, w in row.items():
                value = w.as_rational()
                if value is None:
                    return None
                dense[self.index[q]] = value
            entries.append(dense)
        return fmpq_mat(entries)

    def arb_matrix(self):
        size = len(self.points)
        entries = [[arb(0)] * size for _ in range(size)]
        for i, row in enumerate(self.rows):
            for q, w in row.items():
                entries[i][self.index[q]] = w.enclosure()
        return arb_mat(entries)

    def block(self, k):
        """S on the real functions of frequencies k and n - k, over the field.

        Such a function is told by its values on sectors 0 and 1, x_(s+1) = 2 cos(2 pi k/n) x_s - x_(s-1); for k = 0 and
        k = n/2 by those on sector 0. These spaces are invariant, since S commutes with the rotation, and their sum is everything.
        """
        field, n, t = self.field, self.n, len(self.orbits)
        with_centre = 1 if k == 0 and self.points[0] == ("c",) else 0
        if k == 0 or 2 * k == n:
            seeds = [[field.rational((1 if k == 0 else -1) ** s)] for s in range(n)]
        else:
            twice = 2 * self.cos(k)
            seeds = [[field.one, field.zero], [field.zero, field.one]]
            while len(seeds) < n:
                seeds.append([twice * x - y for x, y in zip(seeds[-1], seeds[-2])])
        free = len(seeds[0])
        size = with_centre + free * t
        orbit_at = {o: i for i, o in enumerate(self.orbits)}
        told = ([("c",)] if with_centre else []) + [(s, i, j) for s in range(free) for i, j in self.orbits]
        matrix = []
        for p in told:
            line = [field.zero] * size
            for q, w in self.rows[self.index[p]].items():
                if q == ("c",):
                    if with_centre:
                        line[0] = line[0] + w
                    continue
                for f in range(free):
                    at = with_centre + f * t + orbit_at[q[1:]]
                    line[at] = line[at] + w * seeds[q[0]][f]
            matrix.append(line)
        return matrix

    def cos(self, k):
        return self.field.cos(Fraction(k, self.n))


# ------------------------------------------------------------------------------------------------ exact linear algebra


def rank(matrix):
    rows = [list(row) for row in matrix]
    found = 0
    for column in range(len(rows[0])):
        pivot = next((i for i in range(found, len(rows)) if not rows[i][column].is_zero()), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        inverse = rows[found][column].inverse()
        for i in range(found + 1, len(rows)):
            if not rows[i][column].is_zero():
                factor = rows[i][column] * inverse
                rows[i] = [x - factor * y if not y.is_zero() else x for x, y in zip(rows[i], rows[found])]
        found += 1
    return found


def times(a, b):
    columns = list(zip(*b))
    zero = a[0][0].field.zero
    return [[sum((x * y for x, y in zip(row, column) if x.a != 0 or x.b != 0), zero) for column in columns] for row in a]


def jordan(matrix, value):
    """(algebraic, geometric, largest Jordan block) of a number in a square matrix: ranks of the powers of matrix - value."""
    size = len(matrix)
    shifted = [[x - value if i == j else x for j, x in enumerate(row)] for i, row in enumerate(matrix)]
    nullities, power = [], shifted
    while True:
        nullity = size - rank(power)
        if nullities and nullity == nullities[-1] or nullity == 0:
            break
        nullities.append(nullity)
        if nullity == size:
            break
        power = times(power, shifted)
    return (nullities[-1], nullities[0], len(nullities)) if nullities else (0, 0, 0)


# ------------------------------------------------------------------------------------------------ comparisons


def near(a, b, within=CLOSE):
    return bool(abs(a - b) < within)


def check_decimal(shown, value, where):
    """The decimal is the value rounded to its last digit (an exact tie may go either way)."""
    require(shown is not None, f"{where}: no decimal")
    match = re.fullmatch(r"(-?)(\d+)\.(\d+)", shown)
    require(match and len(match.group(3)) == DIGITS, f"{where}: {shown!r} has not {DIGITS} decimals")
    q = fmpq(int(match.group(1) + match.group(2) + match.group(3)), fmpz(10) ** DIGITS)
    half = fmpq(1, 2 * fmpz(10) ** DIGITS)
    exact = value.as_rational()
    if exact is not None:
        require(abs(exact - q) <= half, f"{where}: decimal {shown} is not {exact} rounded")
    else:
        off = abs(value.enclosure() - arb(q))
        require(bool(off < arb(half)), f"{where}: decimal {shown} is not {value.enclosure().str(50, radius=False)} rounded")


def check_float(shown, value, where, units=4):
    exact = value.enclosure() if isinstance(value, Num) else value
    allowed = units * (abs(exact) * arb(2) ** -52 + arb(2) ** -60)
    require(bool(abs(arb(shown) - exact) < allowed), f"{where}: {shown!r} is not {exact.str(20, radius=False)}")


def label_of(entry):
    return ("c",) if "orbit" not in entry else (entry["sector"], *entry["orbit"])


def label_text(p):
    return "c" if p == ("c",) else f"{p[0]}:{p[1]},{p[2]}"


def pair(k, n):
    """How often one eigenvalue of the complex block counts among frequencies k and n - k."""
    return 1 if k == 0 or 2 * k == n else 2


class Oracle:
    """What was found here for one scheme and n, and the comparison with a report. Results are kept between comparisons."""

    def __init__(self, name, n, orbits):
        self.name, self.n = name, n
        self.scheme = scheme_of(name, n)
        self.field = self.scheme.field
        self.local = Local(self.scheme, orbits)
        self.blocks = {k: self.local.block(k) for k in range(n // 2 + 1)}
        self.known = {}

    def structure(self, k, text):
        if (k, text) not in self.known:
            value = evaluate(text, self.field, n=self.n, k=k)
            self.known[k, text] = (value, jordan(self.blocks[k], value))
        return self.known[k, text]

    # (a), (b), (e): the eigenvalues of every frequency, exactly
    def check_eigenvalues(self, report):
        where = f"{self.name}, n = {self.n}"
        require(report["arithmetic"] == "exact", f"{where}: arithmetic is {report['arithmetic']!r}")
        require(report["size"] == len(self.local.points), f"{where}: size {report['size']}, here {len(self.local.points)}")
        found = {k: 0 for k in self.blocks}
        values = {k: [] for k in self.blocks}
        for e in report["eigenvalues"]:
            k = e["frequency"]
            at = f"{where}, frequency {k}, eigenvalue {e['exact']}"
            require(k in self.blocks, f"{at}: no such frequency")
            value, (algebraic, geometric, largest) = self.structure(k, e["exact"])
            require(algebraic > 0, f"{at}: not an eigenvalue")
            require(e["algebraic"] == algebraic, f"{at}: algebraic multiplicity {e['algebraic']}, exactly {algebraic}")
            require(e["geometric"] == geometric, f"{at}: geometric multiplicity {e['geometric']}, exactly {geometric}")
            require(e["jordan"] == largest, f"{at}: largest Jordan block {e['jordan']}, exactly {largest}")
            require(not any(near(value.enclosure(), x.enclosure()) for x, _ in values[k]), f"{at}: told twice")
            check_decimal(e["decimal"], value, at)
            check_float(e["value"][0], value, at)
            require(e["value"][1] == 0, f"{at}: an imaginary part")
            if e["formula"] is not None:
                formula = evaluate(e["formula"], self.field, n=self.n, k=k)
                require(near(formula.enclosure(), value.enclosure()), f"{at}: its formula {e['formula']} is another number")
            found[k] += algebraic
            values[k].append((value, algebraic))
        for k, block in self.blocks.items():
            require(found[k] == len(block), f"{where}, frequency {k}: {found[k]} eigenvalues told of {len(block)}")
        order = [abs(evaluate(e["exact"], self.field).enclosure()) for e in report["eigenvalues"]]
        require(all(not bool(a < b) for a, b in zip(order, order[1:])), f"{where}: eigenvalues are not in order")
        self.check_whole(values, where)
        return values

    # the characteristic polynomial of the whole matrix, without frequencies: over Q where it is rational, else enclosed
    def check_whole(self, values, where):
        merged = []
        for value, algebraic in (pair for k in values for pair in values[k]):
            for i, (other, count) in enumerate(merged):
                if near(value.enclosure(), other):
                    merged[i] = (other, count + algebraic)
                    break
            else:
                merged.append((value.enclosure(), algebraic))
        if not hasattr(self, "whole"):
            rational = self.local.rational_matrix()
            if rational is not None:
                roots = []
                _, factors = rational.charpoly().factor()
                for factor, times_ in factors:
                    for root, _ in fmpz_poly([int(c) for c in (factor * factor.denom())]).complex_roots():
                        require(root.imag.contains(0), f"{where}: a complex eigenvalue")
                        roots.append((root.real, times_))
                self.whole = ("roots", roots)
            else:
                self.whole = ("enclosed", self.local.arb_matrix().charpoly())
        how, what = self.whole
        if how == "roots":
            require(len(what) == len(merged), f"{where}: {len(what)} different eigenvalues of the whole matrix, {len(merged)} told")
            for root, count in what:
                told = sum(c for v, c in merged if near(v, root))
                require(told == count, f"{where}: {root.str(20, radius=False)} is {count}-fold in the whole matrix, told {told}-fold")
        else:
            product = arb_poly([1])
            for value, count in merged:
                product *= arb_poly([-value, 1]) ** count
            for i in range(len(self.local.points) + 1):
                require(near(product[i], what[i]), f"{where}: coefficient {i} of the characteristic polynomial differs")

    # (c): the formulas for every n
    def check_formulas(self, everywhere, values, notes):
        n = self.n
        if everywhere is None or n < everywhere["from"] or n in excepted(everywhere):
            return 0
        a, b = everywhere["size"]
        require(a + b * n == len(self.local.points), f"{self.name}: size {a} + {b} n is not right at n = {n}")
        groups = {f["k"]: f["eigenvalues"] for f in everywhere["frequencies"]}
        compared = 0
        for k in self.blocks:
            special = "n/2" if 2 * k == n and "n/2" in groups else str(k) if str(k) in groups else "other"
            where = f"{self.name}, all valences, n = {n}, frequency {k} ({special!r})"
            require(special in groups, f"{where}: no formulas")
            told = []
            for e in groups[special]:
                value = evaluate(e["formula"], self.field, n=n, k=k).enclosure()
                meets = next((t for t in told if near(t[0], value)), None)
                if meets:
                    meets[1].append(e)
                else:
                    told.append((value, [e]))
                compared += 1
            require(len(told) == len(values[k]), f"{where}: {len(told)} different values of formulas, {len(values[k])} eigenvalues")
            for value, algebraic in values[k]:
                here = next((t[1] for t in told if near(t[0], value.enclosure())), None)
                require(here, f"{where}: no formula gives {value.enclosure().str(20, radius=False)}")
                count = pair(k, n)
                require(sum(e["algebraic"] for e in here) * count == algebraic,
                        f"{where}: the multiplicity of {' and '.join(e['formula'] for e in here)} is {algebraic}")
                _, geometric, largest = jordan(self.blocks[k], value) if len(here) > 1 else self.of(k, value)
                if len(here) == 1:
                    e = here[0]
                    require(e["geometric"] * count == geometric, f"{where}: {e['formula']} has geometric multiplicity {geometric}")
                    require(e["jordan"] == largest, f"{where}: {e['formula']} has a Jordan block of size {largest}")
                elif largest != max(e["jordan"] for e in here):
                    notes.append(f"{where}: {' and '.join(e['formula'] for e in here)} meet in a Jordan block of size {largest}")
        if everywhere.get("subdominant"):
            value = evaluate(everywhere["subdominant"]["formula"], self.field, n=n, k=1).enclosure()
            require(near(value, self.subdominant(values)), f"{self.name}, all valences, n = {n}: lambda is another number")
        compared += self.check_formula_mask(everywhere)
        return compared

    def of(self, k, value):
        for (at, _), (known, structure) in self.known.items():
            if at == k and near(known.enclosure(), value.enclosure()):
                return structure
        raise Unable("an eigenvalue without a structure")

    def subdominant(self, values):
        rest = [v.enclosure() for k in values for v, _ in values[k] if not near(v.enclosure(), arb(1))]
        best = rest[0]
        for v in rest:
            if bool(abs(v) > abs(best)):
                best = v
        return best

    def orbit_names(self, report):
        return {e["at"]: tuple(e["orbit"]) if "orbit" in e else None
                for e in report["limit_mask"] + (report.get("tangent_forms") or [])}

    def check_formula_mask(self, everywhere):
        compared = 0
        mask = everywhere.get("limit_mask")
        if mask:
            vector = [self.field.zero] * len(self.local.points)
            for e in mask:
                weight = evaluate(e["formula"], self.field, n=self.n)
                for p in self.points_at(e["at"]):
                    vector[self.local.index[p]] = weight
            self.check_left(vector, self.field.one, f"{self.name}, limit mask for all n at n = {self.n}")
            require((sum(vector, self.field.zero) - 1).is_zero(), f"{self.name}: the limit mask for all n doesn't sum to 1 at n = {self.n}")
            compared += len(mask)
        forms = everywhere.get("tangent_forms")
        if forms:
            value = evaluate(everywhere["subdominant"]["formula"], self.field, n=self.n)
            told = [(self.orbit(e["at"]), *(evaluate(e[w]["formula"], self.field, n=self.n) for w in ("own", "next"))) for e in forms]
            self.check_forms(told, value, f"{self.name}, tangent forms for all n at n = {self.n}")
            compared += 2 * len(forms)
        return compared

    # (d): masks as left eigenvectors
    def points_at(self, name):
        orbit = self.orbit(name)
        return [("c",)] if orbit is None else [(s, *orbit) for s in range(self.n)]

    def orbit(self, name):
        if name == "centre":
            return None
        dual = self.scheme.kind == "dual"
        known = {"ring": (0, 0) if dual else (1, 0), "diagonals": (1, 1)}
        return known[name] if name in known else tuple(int(x) for x in name.split(","))

    def check_left(self, vector, value, where):
        """u S = value u, exactly."""
        image = [self.field.zero] * len(vector)
        for weight, row in zip(vector, self.local.rows):
            if not weight.is_zero():
                for q, w in row.items():
                    i = self.local.index[q]
                    image[i] = image[i] + weight * w
        for p, x, y in zip(self.local.points, image, vector):
            require((x - value * y).is_zero(), f"{where}: not an eigenvector at {label_text(p)}")

    def check_forms(self, forms, value, where):
        """The point (s, orbit) has the weight own cos(2 pi s/n) + next cos(2 pi (s+1)/n); also with s - 1 in place of s.

        The eigenvectors of frequency 1 are two-dimensional; that the ring has own = 1 and next = 0 picks one."""
        ring = [form[1:] for form in forms if form[0] == self.orbit("ring")]
        require(len(ring) == 1 and (ring[0][0] - 1).is_zero() and ring[0][1].is_zero(), f"{where}: not 1 and 0 at the ring")
        for turn in (0, 1):
            vector = [self.field.zero] * len(self.local.points)
            for orbit, own, following in forms:
                for s in range(self.n):
                    weight = own * self.local.cos(s - turn) + following * self.local.cos(s + 1 - turn)
                    vector[self.local.index[s, *orbit]] = weight
            require(not all(w.is_zero() for w in vector), f"{where}: all 0")
            self.check_left(vector, value, where)

    def check_masks(self, report, values):
        where = f"{self.name}, n = {self.n}"
        vector = [self.field.zero] * len(self.local.points)
        for e in report["limit_mask"]:
            p, at = label_of(e), f"{where}, limit mask, {label_text(label_of(e))}"
            weight = evaluate(e["exact"], self.field)
            require(p in self.points_at(e["at"]), f"{at}: not at {e['at']}")
            require(vector[self.local.index[p]].is_zero(), f"{at}: told twice")
            check_decimal(e["decimal"], weight, at)
            check_float(e["weight"], weight, at)
            vector[self.local.index[p]] = weight
        self.check_left(vector, self.field.one, f"{where}, limit mask")
        require((sum(vector, self.field.zero) - 1).is_zero(), f"{where}: the limit mask doesn't sum to 1")

        value = evaluate(report["subdominant"]["exact"], self.field)
        at = f"{where}, subdominant {report['subdominant']['exact']}"
        require(near(value.enclosure(), self.subdominant(values)), f"{at}: not the largest after 1")
        check_decimal(report["subdominant"]["decimal"], value, at)
        check_float(report["subdominant"]["value"][0], value, at)
        if report["subdominant"]["formula"] is not None:
            formula = evaluate(report["subdominant"]["formula"], self.field, n=self.n, k=1)
            require(near(formula.enclosure(), value.enclosure()), f"{at}: its formula is another number")
        forms = []
        require(report["tangent_forms"], f"{where}: no tangent forms")
        for e in report["tangent_forms"]:
            both = []
            for which in ("own", "next"):
                weight = evaluate(e[which]["exact"], self.field)
                check_decimal(e[which]["decimal"], weight, f"{where}, tangent form at {e['at']}, {which}")
                check_float(e[which]["value"][0], weight, f"{where}, tangent form at {e['at']}, {which}")
                both.append(weight)
            require(tuple(e["orbit"]) == self.orbit(e["at"]), f"{where}: {e['at']} has the orbit {e['orbit']}")
            forms.append((tuple(e["orbit"]), *both))
        self.check_forms(forms, value, f"{where}, tangent forms")
        self.check_tangent_masks(report, forms, where)
        self.check_map(report, value, where)
        self.check_next(report, value, values, where)

    def check_tangent_masks(self, report, forms, where):
        told = {orbit: (own.enclosure(), following.enclosure()) for orbit, own, following in forms}
        turn = 2 * arb.pi() / self.n
        for mask, wave in zip(report["tangent_masks"], (arb.cos, arb.sin)):
            seen = set()
            for e in mask:
                s, orbit = e["sector"], tuple(e["orbit"])
                own, following = told.get(orbit, (arb(0), arb(0)))
                exact = own * wave(turn * s) + following * wave(turn * (s + 1))
                require(bool(abs(exact - arb(e["weight"])) < arb(10) ** -14), f"{where}, tangent mask at {s}:{orbit}: {e['weight']}")
                seen.add((s, orbit))
            require(all((s, o) in seen for o in told for s in range(self.n)), f"{where}: a tangent mask lacks points")

    def check_map(self, report, value, where):
        """The characteristic map is a pair of right eigenvectors, (1, 0) at point 0 of the ring. Floats."""
        xy = {label_of(e): e["xy"] for e in report["characteristic_map"]}
        if self.scheme.kind != "dual":
            require(("c",) not in xy, f"{where}: the centre is in the characteristic map")
            xy["c",] = [0.0, 0.0]
        require(set(xy) == set(self.local.points), f"{where}: the characteristic map has other points")
        largest = max(abs(v) for p in xy.values() for v in p)
        scale = float(value.enclosure())
        rows = self.float_rows()
        for p, row in zip(self.local.points, rows):
            for c in (0, 1):
                image = sum(w * xy[q][c] for q, w in row.items())
                require(abs(image - scale * xy[p][c]) < 1e-12 * largest, f"{where}, characteristic map at {label_text(p)}")
        first = xy[0, 0, 0] if self.scheme.kind == "dual" else xy[0, 1, 0]
        require(abs(first[0] - 1) < 1e-13 and abs(first[1]) < 1e-13, f"{where}: the characteristic map doesn't start at (1, 0)")

    def float_rows(self):
        if not hasattr(self, "floats"):
            self.floats = [{q: float(w.enclosure()) for q, w in row.items()} for row in self.local.rows]
        return self.floats

    def check_next(self, report, value, values, where):
        """subsubdominant: the largest modulus after 1 and the pair."""
        told = report["subsubdominant"]
        rest = []
        for k in values:
            for v, count in values[k]:
                count -= 1 if near(v.enclosure(), arb(1)) and k == 0 else 0
                count -= 2 if near(v.enclosure(), value.enclosure()) and k == 1 else 0
                if count > 0:
                    rest.append((k, abs(v.enclosure()), v))
        largest = rest[0][1]
        for _, modulus, _ in rest:
            largest = modulus if bool(modulus > largest) else largest
        here = [(k, v) for k, modulus, v in rest if near(modulus, largest)]
        self.check_verdicts(report, value, largest, where)
        mu = evaluate(told["exact"], self.field)
        require(near(mu.enclosure(), largest), f"{where}: subsubdominant {told['exact']} is not {largest.str(20, radius=False)}")
        require(told["frequencies"] == sorted({k for k, _ in here}), f"{where}: subsubdominant in frequencies {told['frequencies']}")
        require(told["jordan"] == max(self.of(k, v)[2] for k, v in here), f"{where}: subsubdominant has the Jordan block {told['jordan']}")
        check_float(told["modulus"], largest, f"{where}, subsubdominant")
        check_float(told["ratio"], largest / value.enclosure() ** 2, f"{where}, subsubdominant ratio", units=16)
        for which in ("cup", "saddle"):
            part = report["curvature"][which]
            if part is not None:
                exact = evaluate(part["exact"], self.field).enclosure()
                check_float(part["value"], exact, f"{where}, {which}", units=256)
                check_float(part["ratio"], exact / value.enclosure() ** 2, f"{where}, {which} ratio", units=256)
                k = 0 if which == "cup" else 2
                require(any(near(v.enclosure(), exact) for v, _ in values[k]), f"{where}: {which} is no eigenvalue of frequency {k}")

    def check_verdicts(self, report, value, largest, where):
        """Two conditions that exact eigenvalues decide: 1 dominates, and so does lambda, a simple pair of frequency 1, after it."""
        verdicts = {v["claim"]: v["verdict"] for v in report["verdicts"]}
        modulus = value.enclosure()
        pair_dominates = self.of(1, value)[0] == 2 and bool(modulus > largest)
        for claim, holds in (("1 dominates", bool(abs(modulus) < 1)), ("subdominant", pair_dominates and bool(modulus > 0))):
            want = "proved" if holds else "refuted"
            require(verdicts.get(claim) == want, f"{where}: the condition '{claim}' is {verdicts.get(claim)}, here {want}")

    def check_matrix(self, printed):
        where = f"{self.name}, n = {self.n}, matrix"
        labels = printed["labels"]
        require(sorted(labels) == sorted(map(label_text, self.local.points)), f"{where}: other labels")
        columns = {label: i for i, label in enumerate(labels)}
        for p, row in zip(self.local.points, self.float_rows()):
            line = list(printed["rows"][columns[label_text(p)]])
            for q, w in row.items():
                at = columns[label_text(q)]
                require(abs(line[at] - w) < 1e-15, f"{where}: {line[at]} at {label_text(p)}, {label_text(q)}; exactly {w}")
                line[at] = 0
            require(not any(line), f"{where}: more entries at {label_text(p)}")


def excepted(everywhere):
    """The valences that the formulas leave out."""
    left_out = everywhere.get("except")
    return [] if left_out is None else left_out if isinstance(left_out, list) else [left_out]


# ------------------------------------------------------------------------------------------------ the neighbourhood's size


def influence(name, n, levels=3):
    """The orbits of points that the points of the refined meshes over the faces around the centre are made of."""
    scheme = scheme_of(name, n)
    mesh, rows = first_mesh(scheme)
    needed = set()
    for _ in range(levels):
        fine, new = scheme.refine(mesh, rows)
        names = refined_names(scheme, mesh, fine, 2 ** (_ + 1) if scheme.kind != "dual" else 2 ** (_ + 1) - 1)
        reach = 2 ** (_ + 1)
        old = {v: label for label, v in names.items()}
        for label, v in names.items():
            inside = label == ("c",) or (label[1] + label[2] <= reach if scheme.kind == "triangles" else
                                         max(label[1:]) <= (reach if scheme.kind == "quads" else reach - 1))
            if inside:
                needed |= set(new[v])
        # rename, so that the next step finds the centre and its spokes again; keep what is near
        keep = {v: old[v] for v in fine.vertices if v in old}
        more = {v: ("x", i) for i, v in enumerate(sorted((v for v in fine.vertices if v not in keep), key=repr))}
        rename = {**keep, **more}
        faces = [tuple(rename[v] for v in face) for face in fine.faces]
        if scheme.kind == "dual":
            central = tuple((s, 0, 0) for s in range(n))
            faces.sort(key=lambda f: set(f) != set(central))
            faces[0] = central
        mesh = Mesh(faces)
        rows = {rename[v]: new[v] for v in fine.vertices}
    return sorted({p[1:] for p in needed if p != ("c",)})


# ------------------------------------------------------------------------------------------------ published values


def published(n):
    """What the literature says, each with its source, as (scheme, what, value)."""
    turn = 2 * arb.pi() / n
    c = turn.cos()
    beta = (arb(5) / 8 - (arb(3) / 8 + c / 4) ** 2) / n
    root = ((c + 1) * (c + 9)).sqrt()
    yield "loop", "lambda", arb(3) / 8 + c / 4, "Loop 1987"
    yield "loop", "cup", (arb(3) / 8 + c / 4) ** 2, "Loop 1987"
    yield "loop", "limit centre", 1 / (1 + 8 * n * beta / 3), "Hoppe et al. 1994"
    yield "loop-warren", "lambda", arb(3) / 8 + c / 4, "Loop 1987"
    yield "loop-warren", "limit centre", 1 / (1 + (arb(3) / 2 if n == 3 else arb(1))), "Hoppe et al. 1994"
    yield "catmull-clark", "lambda", (5 + c + root) / 16, "Ball and Storry 1988"
    yield "catmull-clark", "limit centre", arb(n) / (n + 5), "Halstead et al. 1993"
    yield "catmull-clark", "limit ring", arb(4) / (n * (n + 5)), "Halstead et al. 1993"
    yield "catmull-clark", "limit diagonals", arb(1) / (n * (n + 5)), "Halstead et al. 1993"
    yield "doo-sabin", "lambda", arb(1) / 2, "Doo and Sabin 1978"
    if n >= 5:
        yield "doo-sabin", "saddle", arb(1) / 4, "Doo and Sabin 1978"
    yield "doo-sabin", "limit ring", arb(1) / n, "Doo and Sabin 1978"
    yield "catmull-clark-biquadratic", "lambda", arb(1) / 2 + c / 4, "Prautzsch and Chen 2011"
    yield "modified-butterfly", "lambda", arb(1) / 2, "Zorin et al. 1996"


def reported(report, what, field):
    if what == "lambda":
        text = report["subdominant"]["exact"]
    elif what in ("cup", "saddle"):
        text = report["curvature"][what]["exact"]
    else:
        at = what.removeprefix("limit ")
        text = next(e["exact"] for e in report["limit_mask"] if e["at"] == at)
    return text, evaluate(text, field).enclosure()


def check_published(reports, show=True):
    """(f)"""
    lines = {}
    for n in VALENCES:
        for name, what, value, source in published(n):
            if name not in reports:
                continue
            report = next(v for v in reports[name]["valences"] if v["n"] == n)
            text, told = reported(report, what, Field(n))
            require(near(told, value), f"{name}, n = {n}, {what}: {text}, but {source} has {value.str(20, radius=False)}")
            lines.setdefault((name, what, source), []).append(value)
    if "doo-sabin" in reports:
        for report in reports["doo-sabin"]["valences"]:
            n = report["n"]
            for e in report["eigenvalues"]:
                if e["exact"] == "1/4":
                    k = e["frequency"]
                    want = 2 if 2 <= k <= n - 2 and 2 * k != n else 1
                    require(e["jordan"] == want, f"doo-sabin, n = {n}: the Jordan block of 1/4 in frequency {k} is {want}")
    if show:
        print("\npublished values, all found in the reports (here n = 3, 5, 8, 12)")
        for (name, what, source), values in lines.items():
            first = [values[n - (12 - len(values) + 1)] for n in (3, 5, 8, 12) if n >= 12 - len(values) + 1]
            print(f"  {name:26}{what:17}{source:24}" + "  ".join(v.str(12, radius=False) for v in first))


# ------------------------------------------------------------------------------------------------ the whole


def run(program, *arguments):
    try:
        done = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=300)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Unable(f"{program}: {error}; build it with cargo build --release, or give its path") from error
    if done.returncode != 0:
        raise Unable(f"{program} {' '.join(arguments)} failed with {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def load(program, name, valences="3..12"):
    return run(program, "analyze", file_of(name), "--valence", valences, "--format", "json", "--digits", str(DIGITS))


def orbits_of(report):
    found = []
    for e in report["characteristic_map"]:
        if tuple(e["orbit"]) not in found:
            found.append(tuple(e["orbit"]))
    return found


def compare(name, document, oracles, notes, matrices=None):
    """Every comparison of one document. Oracles are made when they are missing, and kept."""
    formulas = 0
    for report in document["valences"]:
        n = report["n"]
        require(report["characteristic_map"], f"{name}, n = {n}: no characteristic map")
        if n not in oracles:
            oracles[n] = Oracle(name, n, orbits_of(report))
        oracle = oracles[n]
        try:
            values = oracle.check_eigenvalues(report)
            oracle.check_masks(report, values)
            formulas += oracle.check_formulas(document.get("all_valences"), values, notes)
        except (KeyError, TypeError) as error:
            raise Mismatch(f"{name}, n = {n}: a value is missing or null ({error})") from error
        if matrices is not None:
            oracle.check_matrix(matrices(n))
    return formulas


def check_scheme(program, name, notes):
    started = time.monotonic()
    document = load(program, name)
    told = [v["n"] for v in document["valences"]]
    require(told == list(VALENCES), f"{name}: valences {told}")
    require(document.get("all_valences") or name in OWN_SCHEMES, f"{name}: no formulas for all valences")
    formulas = compare(name, document, {}, notes, lambda n: run(program, "matrix", file_of(name), "--valence", str(n), "--format", "json"))
    for n in (3, 4, 5):
        orbits = sorted(orbits_of(next(v for v in document["valences"] if v["n"] == n)))
        seen = influence(name, n)
        require(seen == orbits, f"{name}, n = {n}: points that influence the surface around the centre: {seen}, told {orbits}")
    count = sum(e["algebraic"] for v in document["valences"] for e in v["eigenvalues"])
    print(f"{name:28}{len(told):9}{count:13}{formulas:10}{time.monotonic() - started:9.1f}", flush=True)
    return document


def check_all(program):
    """Every scheme, also after a mismatch in another; the mismatches are told together."""
    reports, notes, mismatches = {}, [], []
    print(f"{'scheme':28}{'valences':>9}{'eigenvalues':>13}{'formulas':>10}{'seconds':>9}")
    for name in [*SCHEMES, *OWN_SCHEMES]:
        try:
            reports[name] = check_scheme(program, name, notes)
        except Mismatch as mismatch:
            mismatches.append(str(mismatch))
            print(f"{name:28}{'differs':>9}", flush=True)
    check_published(reports)
    for note in notes:
        print("note:", note)
    check_sympy()
    if mismatches:
        raise Mismatch("\n          ".join(mismatches))


def check_sympy():
    """FLINT and this file's arithmetic against SymPy, on one block: Catmull-Clark at n = 5, frequency 0."""
    oracle = Oracle("catmull-clark", 5, [(1, 0), (1, 1)])
    block = oracle.blocks[0]
    matrix = sympy.Matrix([[sympy.Rational(int(x.as_rational().p), int(x.as_rational().q)) for x in row] for row in block])
    want = {sympy.Integer(1): 1, sympy.Rational(1, 5) + sympy.sqrt(6) / 20: 1, sympy.Rational(1, 5) - sympy.sqrt(6) / 20: 1}
    require({sympy.simplify(v): m for v, m in matrix.eigenvals().items()} == want, "SymPy finds other eigenvalues for Catmull-Clark, n = 5")


# ------------------------------------------------------------------------------------------------ the check's own test


def corruptions(document):
    """(what is changed, the changed document), one by one."""

    def changed(what, change):
        copied = copy.deepcopy(document)
        change(copied)
        return what, copied

    def last(digits):
        return digits[:-1] + str((int(digits[-1]) + 1) % 10)

    def each(v):
        return v["valences"][-1]

    everywhere = document["all_valences"]
    for i in range(len(document["valences"][-1]["eigenvalues"])):
        for key, change in (
            ("exact", lambda e: e.update(exact=e["exact"] + " + 1/1000000000000000000000000000000")),
            ("algebraic", lambda e: e.update(algebraic=e["algebraic"] + 1)),
            ("geometric", lambda e: e.update(geometric=e["geometric"] + 1)),
            ("jordan", lambda e: e.update(jordan=e["jordan"] + 1)),
            ("frequency", lambda e: e.update(frequency=0 if e["frequency"] else 1)),
            ("decimal", lambda e: e.update(decimal=last(e["decimal"]))),
            ("value", lambda e: e.update(value=[e["value"][0] + 1e-13, 0.0])),
            ("formula", lambda e: e.update(formula=f"({e['formula']}) + 1/10^50")),
        ):
            yield changed(f"eigenvalue {i}: {key}", lambda d, i=i, c=change: c(each(d)["eigenvalues"][i]))
        yield changed(f"eigenvalue {i} left out", lambda d, i=i: each(d)["eigenvalues"].pop(i))
    for i in range(len(document["valences"][-1]["limit_mask"])):
        yield changed(f"limit mask {i}: exact", lambda d, i=i: each(d)["limit_mask"][i].update(exact="1/1000"))
        yield changed(f"limit mask {i}: decimal", lambda d, i=i: each(d)["limit_mask"][i].update(decimal=last(each(d)["limit_mask"][i]["decimal"])))
    for i in range(len(document["valences"][-1]["tangent_forms"])):
        for which in ("own", "next"):
            def change(d, i=i, which=which):
                form = each(d)["tangent_forms"][i][which]
                form["exact"] = f"({form['exact']}) + 1/100"
            yield changed(f"tangent form {i}: {which}", change)
            def change(d, i=i, which=which):
                form = each(d)["tangent_forms"][i][which]
                form["decimal"] = last(form["decimal"])
            yield changed(f"tangent form {i}: {which}, decimal", change)
    for g, group in enumerate(everywhere["frequencies"]):
        for i in range(len(group["eigenvalues"])):
            def change(d, g=g, i=i):
                e = d["all_valences"]["frequencies"][g]["eigenvalues"][i]
                e["formula"] = f"({e['formula']}) + 1/10^50"
            yield changed(f"all valences, frequency {group['k']}, formula {i}", change)
            for key in ("algebraic", "geometric", "jordan"):
                def change(d, g=g, i=i, key=key):
                    d["all_valences"]["frequencies"][g]["eigenvalues"][i][key] += 1
                yield changed(f"all valences, frequency {group['k']}, eigenvalue {i}: {key}", change)
    for i in range(len(everywhere["limit_mask"])):
        yield changed(f"all valences, limit mask {i}", lambda d, i=i: d["all_valences"]["limit_mask"][i].update(formula="1/n^3"))
    for i in range(len(everywhere["tangent_forms"])):
        yield changed(f"all valences, tangent form {i}", lambda d, i=i: d["all_valences"]["tangent_forms"][i]["next"].update(formula="1/n^3"))
    yield changed("all valences, subdominant", lambda d: d["all_valences"]["subdominant"].update(formula="1/2 + 1/n^3"))
    yield changed("size", lambda d: each(d).update(size=each(d)["size"] + 1))
    yield changed("size for all n", lambda d: d["all_valences"].update(size=[2, 3]))
    yield changed("subdominant: exact", lambda d: each(d)["subdominant"].update(exact="1/8"))
    yield changed("subsubdominant: exact", lambda d: each(d)["subsubdominant"].update(exact="1/7"))
    yield changed("subsubdominant: frequencies", lambda d: each(d)["subsubdominant"].update(frequencies=[1]))
    yield changed("subsubdominant: jordan", lambda d: each(d)["subsubdominant"].update(jordan=4))
    for which in ("cup", "saddle"):
        if each(document)["curvature"][which]:
            yield changed(which, lambda d, which=which: each(d)["curvature"][which].update(exact="1/7"))
    yield changed("ratio", lambda d: each(d)["subsubdominant"].update(ratio=each(d)["subsubdominant"]["ratio"] * 1.0000001))
    for i, verdict in enumerate(each(document)["verdicts"]):
        if verdict["claim"] in ("1 dominates", "subdominant"):
            yield changed(f"verdict on '{verdict['claim']}'", lambda d, i=i: each(d)["verdicts"][i].update(verdict="undecided"))
    yield changed("characteristic map", lambda d: each(d)["characteristic_map"][1].update(xy=[1.5, 0.25]))
    yield changed("tangent mask", lambda d: each(d)["tangent_masks"][0][1].update(weight=0.3))


def self_test(program):
    """Every single corruption of a report must be found."""
    tried = 0
    for name in SCHEMES:
        document = load(program, name, "8")
        oracles, notes = {}, []
        compare(name, document, oracles, notes)
        for what, corrupted in corruptions(document):
            tried += 1
            try:
                compare(name, corrupted, oracles, [])
            except (Mismatch, ZeroDivisionError):
                continue
            raise Mismatch(f"self-test: {name}: a changed {what!r} was not found")
    print(f"self-test: {tried} corrupted reports, each found")


def main():
    arguments = [a for a in sys.argv[1:] if a != "--self-test"]
    root = Path(__file__).resolve().parents[2]
    program = arguments[0] if arguments else str(root / "target" / "release" / "eigenring")
    if len(arguments) > 1 or arguments and arguments[0].startswith("-"):
        print(__doc__.strip())
        return 2
    try:
        if "--self-test" in sys.argv[1:]:
            self_test(program)
        else:
            check_all(program)
            print("all agree")
    except Mismatch as mismatch:
        print(f"MISMATCH: {mismatch}", file=sys.stderr)
        return 1
    except Unable as unable:
        print(f"can't check: {unable}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
