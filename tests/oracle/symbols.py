#!/usr/bin/env python3
"""Checks what Eigenring says of regular meshes against sympy.

The masks are written down here from the papers; sympy multiplies and factors the symbols. Compared with the `regular` part of
`eigenring analyze SCHEME --format json`: every coefficient, the symbol as a product, the smoothing factors with their multiplicities (all
irreducible factors of the form 1 + z^v), the order of the sum rules (derivatives of the symbol at the points of {1, -1}^2), and the degree of
polynomials that are reproduced (by the definition, on symbolic polynomials).

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
    from sympy import Poly, Rational, diff, expand, factor_list, sympify
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
    return {(i + first, j + first): a * b for (i, a), (j, b) in product(enumerate(line), enumerate(line))}


def masks():
    ring = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)]
    loop = triangles({(0, 0): Rational(5, 8), **{p: Rational(1, 16) for p in ring}},
                     {(0, 0): Rational(3, 8), (1, 0): Rational(3, 8), (0, 1): Rational(1, 8), (1, -1): Rational(1, 8)})
    edge = {(0, 0): Rational(1, 2), (1, 0): Rational(1, 2), (0, 1): Rational(1, 8), (1, -1): Rational(1, 8)}
    edge |= {p: -Rational(1, 16) for p in [(-1, 1), (1, 1), (0, -1), (2, -1)]}
    quarter = lambda numbers, over: [Rational(n, over) for n in numbers]
    return {
        "loop": loop,
        "loop-warren": loop,
        "modified-butterfly": triangles({(0, 0): Rational(1)}, edge),
        "catmull-clark": tensor(quarter([1, 4, 6, 4, 1], 8), -2),
        "doo-sabin": tensor(quarter([1, 3, 3, 1], 4), -1),
        "catmull-clark-biquadratic": tensor(quarter([1, 3, 3, 1], 4), -1),
    }


def symbol_of(mask):
    return sum(weight * z1 ** i * z2 ** j for (i, j), weight in mask.items())


def smoothing_factors(mask):
    low = [min(p[axis] for p in mask) for axis in (0, 1)]
    _, factors = factor_list(expand(symbol_of(mask) * z1 ** -low[0] * z2 ** -low[1]))
    found, rest = {}, 1
    for factor, times in factors:
        terms = Poly(factor, z1, z2).terms()
        if len(terms) == 2 and terms[0][1] == terms[1][1]:
            v = tuple(a - b for a, b in zip(terms[0][0], terms[1][0]))
            found[max(v, (-v[0], -v[1]))] = times
        else:
            rest *= factor ** times
    return found, rest


def sum_rules(mask):
    """The largest k for which all derivatives of order below k vanish at the points other than (1, 1), where coefficients sum to 4."""
    symbol, order = symbol_of(mask), 0
    if sympify(symbol.subs({z1: 1, z2: 1})) != 4:
        return 0
    others = [(1, -1), (-1, 1), (-1, -1)]
    while all(sympify(diff(symbol, *([z1] * (order - i) + [z2] * i)).subs({z1: a, z2: b}) if order else symbol.subs({z1: a, z2: b})) == 0
              for i in range(order + 1) for a, b in others):
        order += 1
    return order


def reproduction(mask, shift):
    degree = -1
    while True:
        for i in range(degree + 2):
            sample = lambda u, v: (u ** (degree + 1 - i)) * v ** i
            for coset in product((0, 1), repeat=2):
                # the new point alpha = coset + 2 (x, y), old points beta = (alpha - gamma)/2
                made = sum(w * sample(x + Rational(coset[0] - g[0], 2) + shift[0], y + Rational(coset[1] - g[1], 2) + shift[1])
                           for g, w in mask.items() if all((g[axis] - coset[axis]) % 2 == 0 for axis in (0, 1)))
                there = sample(x + (Rational(coset[0]) + shift[0]) / 2, y + (Rational(coset[1]) + shift[1]) / 2)
                if expand(made - there) != 0:
                    return degree
        degree += 1


def check(program, name, mask):
    output = subprocess.run([program, "analyze", name, "--valence", "5", "--format", "json"], capture_output=True, text=True, check=True)
    own = json.loads(output.stdout)["regular"]
    first, wrong = own["mask"]["first"], []
    told = {(first[0] + i, first[1] + j): Rational(*map(int, (Fraction(w).numerator, Fraction(w).denominator)))
            for j, row in enumerate(own["mask"]["rows"]) for i, w in enumerate(row)}
    if {p: w for p, w in told.items() if w != 0} != mask:
        wrong.append("mask")
    if expand(sympify(own["symbol"].replace("^", "**")) - symbol_of(mask)) != 0:
        wrong.append("symbol")
    found, kernel = smoothing_factors(mask)
    if found != {tuple(f["direction"]): f["times"] for f in own["factors"]}:
        wrong.append(f"factors: {found}")
    if expand(kernel - sympify(own["kernel"].replace("^", "**"))) != 0 and expand(kernel + sympify(own["kernel"].replace("^", "**"))) != 0:
        wrong.append(f"kernel: {kernel}")
    if sum_rules(mask) != own["sum_rules"]:
        wrong.append(f"sum rules: {sum_rules(mask)}")
    shift = [Rational(*map(int, s.split("/"))) if "/" in s else Rational(int(s)) for s in own["shift"]]
    if reproduction(mask, shift) != own["reproduction_degree"]:
        wrong.append(f"reproduction: {reproduction(mask, shift)}")
    print(f"{name}: {'; '.join(wrong) if wrong else 'mask, symbol, factors, kernel, sum rules and reproduction agree'}")
    return not wrong


def main():
    default = Path(__file__).resolve().parents[2] / "target" / "release" / "eigenring"
    program = sys.argv[1] if len(sys.argv) > 1 else str(default)
    try:
        results = [check(program, name, mask) for name, mask in masks().items()]
    except (OSError, subprocess.CalledProcessError, ValueError) as error:
        print(f"the check could not be made: {error}", file=sys.stderr)
        sys.exit(2)
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
