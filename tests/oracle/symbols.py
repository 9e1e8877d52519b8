#!/usr/bin/env python3
"""Checks what Eigenring says of regular meshes against sympy.

The masks are written down here from the papers; sympy multiplies and factors the symbols. Compared with the `regular` part of
`eigenring analyze SCHEME --format json`: every coefficient, the symbol as a product, the smoothing factors with their multiplicities (all
irreducible factors of the form 1 + z^v, or 1 + z^v + z^2v for ternary steps), the order of the sum rules (derivatives of the symbol where z1 and z2 are roots of unity),
and the degree of polynomials that are reproduced (by the definition, on symbolic polynomials). Where one step turns the lattice, the masks of two are multiplied.

    python3 tests/oracle/symbols.py [path/to/eigenring]

Exit status: 0 all agree, 1 something doesn't, 2 the check could not be made.
"""

import json
import subprocess
import sys
from fractions import Fraction
from itertools import product
from pathlib import Path

try:
    import sympy
    from sympy import Poly, Rational, expand, factor_list, sympify
except ImportError as error:
    print(f"{error}: pip install sympy", file=sys.stderr)
    sys.exit(2)

z1, z2, x, y = sympy.symbols("z1 z2 x y")


def triangles(vertex, edge):
    """The mask of a scheme on triangles: weights by the old point relative to the new vertex, and to the start of a new edge along (1, 0)."""
    turn = lambda p: (-p[1], p[0] + p[1])
    mask = {}
    for old, weight in vertex.items():
        mask[(-2 * old[0], -2 * old[1])] = weight
    for turns in range(3):
        direction, points = (1, 0), dict(edge)
        for _ in range(turns):
            direction, points = turn(direction), {turn(p): w for p, w in points.items()}
        for old, weight in points.items():
            mask[(direction[0] - 2 * old[0], direction[1] - 2 * old[1])] = weight
    return mask


def tensor(line, first):
    pairs = product(enumerate(line), enumerate(line))
    return {(i + first, j + first): a * b for (i, a), (j, b) in pairs if a * b != 0}


def twice(mask, matrix, turn):
    """Two steps, a(z) a(z^M), with the new points named anew by a turn."""
    image = lambda m, p: (m[0][0] * p[0] + m[0][1] * p[1], m[1][0] * p[0] + m[1][1] * p[1])
    product_of = {}
    for p, w in mask.items():
        for q, v in mask.items():
            r = image(matrix, q)
            r = image(turn, (p[0] + r[0], p[1] + r[1]))
            product_of[r] = product_of.get(r, 0) + w * v
    return product_of


def moved(mask, by):
    return {(p[0] + by[0], p[1] + by[1]): w for p, w in mask.items()}


def masks():
    """By scheme the number m of the dilation matrix m I and the mask."""
    ring = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)]
    loop = triangles({(0, 0): Rational(5, 8), **{p: Rational(1, 16) for p in ring}},
                     {(0, 0): Rational(3, 8), (1, 0): Rational(3, 8), (0, 1): Rational(1, 8), (1, -1): Rational(1, 8)})
    edge = {(0, 0): Rational(1, 2), (1, 0): Rational(1, 2), (0, 1): Rational(1, 8), (1, -1): Rational(1, 8)}
    edge |= {p: -Rational(1, 16) for p in [(-1, 1), (1, 1), (0, -1), (2, -1)]}
    butterfly = triangles({(0, 0): Rational(1)}, edge)
    quarter = lambda numbers, over: [Rational(n, over) for n in numbers]
    root3 = ((1, -1), (1, 2))
    step = {p: Rational(1, 3) for p in ring} | {(0, 0): Rational(2, 3)}
    step |= {(p[0] - p[1], p[0] + 2 * p[1]): Rational(1, 18) for p in ring}
    midpoints = {(i, j): Rational(1, 2) for i in (0, 1) for j in (0, 1)}
    root2 = ((1, -1), (1, 1))
    # Velho and Zorin 2001: a face point is the mean of four corners, an old vertex keeps half and takes an eighth of each old neighbour
    four_eight = {(0, 0): Rational(1, 2)}
    four_eight |= {p: Rational(1, 4) for p in [(1, 0), (0, 1), (-1, 0), (0, -1)]}
    four_eight |= {p: Rational(1, 8) for p in [(1, 1), (-1, 1), (-1, -1), (1, -1)]}
    return {
        "loop": (2, loop),
        "loop-warren": (2, loop),
        "butterfly": (2, butterfly),
        "modified-butterfly": (2, butterfly),
        "sqrt3": (3, twice(step, root3, ((1, 0), (0, 1)))),
        "catmull-clark": (2, tensor(quarter([1, 4, 6, 4, 1], 8), -2)),
        "midpoint": (2, tensor(quarter([1, 4, 6, 4, 1], 8), -2)),
        "kobbelt": (2, tensor(quarter([-1, 0, 9, 16, 9, 0, -1], 16), -3)),
        "four-eight": (2, twice(four_eight, root2, ((1, 0), (0, 1)))),
        "doo-sabin": (2, tensor(quarter([1, 3, 3, 1], 4), -1)),
        "catmull-clark-biquadratic": (2, tensor(quarter([1, 3, 3, 1], 4), -1)),
        "mid-edge": (2, moved(twice(midpoints, root2, ((1, 0), (0, 1))), (0, -1))),
    }


def symbol_of(mask):
    return sum(weight * z1 ** i * z2 ** j for (i, j), weight in mask.items())


def smoothing_factors(m, mask):
    low = [min(p[axis] for p in mask) for axis in (0, 1)]
    _, factors = factor_list(expand(symbol_of(mask) * z1 ** -low[0] * z2 ** -low[1]))
    found, rest = {}, 1
    for factor, times in factors:
        terms = Poly(factor, z1, z2).terms()
        points = sorted(p for p, _ in terms)
        v = tuple(b - a for a, b in zip(points[0], points[1])) if len(points) > 1 else (0, 0)
        line = [(points[0][0] + k * v[0], points[0][1] + k * v[1]) for k in range(m)]
        if points == line and len({w for _, w in terms}) == 1:
            found[v] = times
        else:
            rest *= factor ** times
    return found, rest


def sum_rules(m, mask):
    """The largest k for which all derivatives of order below k vanish where z1, z2 are m-th roots of unity, not both 1; m is a prime. A rational
    combination of the powers of such a root is 0 exactly when its coefficients are equal."""
    falling = lambda n, times: sympy.prod([n - i for i in range(times)])

    def vanishes(a, b, p, q):
        sums = [Rational(0)] * m
        for (i, j), w in mask.items():
            sums[(a * i + b * j) % m] += w * falling(i, p) * falling(j, q)
        return len(set(sums)) == 1

    order, others = 0, [(a, b) for a, b in product(range(m), repeat=2) if (a, b) != (0, 0)]
    while all(vanishes(a, b, order - q, q) for q in range(order + 1) for a, b in others):
        order += 1
    return order


def reproduction(m, mask, shift):
    degree = -1
    while True:
        for i in range(degree + 2):
            sample = lambda u, v: (u ** (degree + 1 - i)) * v ** i
            for coset in product(range(m), repeat=2):
                # the new point alpha = coset + m (x, y), old points beta = (alpha - gamma)/m
                made = sum(w * sample(x + Rational(coset[0] - g[0], m) + shift[0], y + Rational(coset[1] - g[1], m) + shift[1])
                           for g, w in mask.items() if all((g[axis] - coset[axis]) % m == 0 for axis in (0, 1)))
                there = sample(x + (Rational(coset[0]) + shift[0]) / m, y + (Rational(coset[1]) + shift[1]) / m)
                if expand(made - there) != 0:
                    return degree
        degree += 1


def check(program, name, m, mask):
    output = subprocess.run([program, "analyze", name, "--valence", "5", "--format", "json"], capture_output=True, text=True, check=True)
    own = json.loads(output.stdout)["regular"]
    first, wrong = own["mask"]["first"], []
    told = {(first[0] + i, first[1] + j): Rational(*map(int, (Fraction(w).numerator, Fraction(w).denominator)))
            for j, row in enumerate(own["mask"]["rows"]) for i, w in enumerate(row)}
    if own["dilation"] != [[m, 0], [0, m]]:
        wrong.append("dilation")
    least = lambda mask: moved(mask, [-min(p[axis] for p in mask) for axis in (0, 1)])
    told = {p: w for p, w in told.items() if w != 0}
    if told != mask:
        wrong.append("mask" if least(told) != least(mask) else "place of the mask")
    if expand(sympify(own["symbol"].replace("^", "**")) - symbol_of(mask)) != 0:
        wrong.append("symbol")
    found, kernel = smoothing_factors(m, mask)
    if found != {tuple(f["direction"]): f["times"] for f in own["factors"]}:
        wrong.append(f"factors: {found}")
    if expand(kernel - sympify(own["kernel"].replace("^", "**"))) != 0 and expand(kernel + sympify(own["kernel"].replace("^", "**"))) != 0:
        wrong.append(f"kernel: {kernel}")
    if sum_rules(m, mask) != own["sum_rules"]:
        wrong.append(f"sum rules: {sum_rules(m, mask)}")
    shift = [Rational(*map(int, s.split("/"))) if "/" in s else Rational(int(s)) for s in own["shift"]]
    if reproduction(m, mask, shift) != own["reproduction_degree"]:
        wrong.append(f"reproduction: {reproduction(m, mask, shift)}")
    print(f"{name}: {'; '.join(wrong) if wrong else 'mask, symbol, factors, kernel, sum rules and reproduction agree'}")
    return not wrong


def main():
    default = Path(__file__).resolve().parents[2] / "target" / "release" / "eigenring"
    program = sys.argv[1] if len(sys.argv) > 1 else str(default)
    try:
        results = [check(program, name, m, mask) for name, (m, mask) in masks().items()]
    except (OSError, subprocess.CalledProcessError, ValueError) as error:
        print(f"the check could not be made: {error}", file=sys.stderr)
        sys.exit(2)
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
