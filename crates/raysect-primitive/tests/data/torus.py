"""Writes torus.txt: where rays cross tori, by exact rational arithmetic on the rays and radii as they are.

Crossings are the roots of the quartic, counted by Sturm's sequences; the margin of a ray is the least distance of the
surface from the places where the quartic is level, over the major radius: below some roundings a count may differ.

    python3 torus.py > torus.txt
"""

import math
import pathlib
import random
import sys
from decimal import Decimal, getcontext
from fractions import Fraction as F

sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "raysect-math/tests/data"))
from polynomials import real_roots, slope, square_free, trim  # noqa: E402

getcontext().prec = 60


def decimal(x):
    return Decimal(x.numerator) / Decimal(x.denominator)


def product(p, q):
    out = [F(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            out[i + j] += a * b
    return out


def quartic(major, minor, o, d, shift):
    """In s, from the place `shift` on."""
    R, r = F(major), F(minor)
    o, d = [F(a) + F(b) * shift for a, b in zip(o, d)], [F(b) for b in d]
    squares = [[a * a, 2 * a * b, b * b] for a, b in zip(o, d)]
    rho = [a + b for a, b in zip(squares[0], squares[1])]
    whole = [a + b for a, b in zip(rho, squares[2])]
    whole[0] += R * R - r * r
    out = product(whole, whole)
    for i in range(3):
        out[i] -= 4 * R * R * rho[i]
    return trim(out)


def surface_distance(major, minor, o, d, t):
    x, y, z = (decimal(F(a) + F(b) * t) for a, b in zip(o, d))
    across = (x * x + y * y).sqrt() - Decimal(major)
    return (across * across + z * z).sqrt() - Decimal(minor)


def cosine(major, o, d, t):
    """Between the ray and the normal."""
    x, y, z = (decimal(F(a) + F(b) * t) for a, b in zip(o, d))
    rho = (x * x + y * y).sqrt()
    n = [x * (rho - Decimal(major)) / rho, y * (rho - Decimal(major)) / rho, z]
    d = [Decimal(c) for c in d]
    dot = sum(a * b for a, b in zip(n, d))
    return dot / (sum(a * a for a in n) * sum(a * a for a in d)).sqrt()


def emit(kind, major, minor, o, d):
    squared = sum(F(c) ** 2 for c in d)
    # Near the closest approach, where the roots are small and quickly found.
    shift = F(float(-sum(F(a) * F(b) for a, b in zip(o, d)) / squared))
    p = quartic(major, minor, o, d, shift)
    roots = sorted(r + shift for f, k in square_free(p) for r in real_roots(f) for _ in range(k))
    level = [r + shift for f, _ in square_free(slope(p)) for r in real_roots(f)]
    margin = min(abs(surface_distance(major, minor, o, d, t)) for t in level) / Decimal(major)
    words = [kind, major, minor, *o, *d, f"{margin:.3e}", ";"]
    for t in roots:
        words += [float(t), f"{cosine(major, o, d, t):.6e}"]
    print(*words)


def unit(rng):
    while True:
        v = [rng.uniform(-1, 1) for _ in range(3)]
        length = math.sqrt(sum(c * c for c in v))
        if 0.1 < length < 1:
            return [c / length for c in v]


def on_surface(rng, major, minor):
    """A point and its normal."""
    phi, theta = rng.uniform(0, math.tau), rng.uniform(0, math.tau)
    n = [math.cos(theta) * math.cos(phi), math.cos(theta) * math.sin(phi), math.sin(theta)]
    circle = [major * math.cos(phi), major * math.sin(phi), 0.0]
    return [c + minor * k for c, k in zip(circle, n)], n


def tangent(rng, n):
    v = unit(rng)
    dot = sum(a * b for a, b in zip(v, n))
    v = [a - dot * b for a, b in zip(v, n)]
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def main():
    rng = random.Random(1)
    print("# Where rays cross tori, written by torus.py with exact rational arithmetic.")
    print("# kind, major and minor radius, origin, direction, margin; then pairs of distance and cosine, ascending.")
    ratios = (1e-4, 1e-2, 0.1, 0.4, 0.7, 0.95, 0.999)
    for number in range(280):
        ratio, scale = ratios[number % 7], 10 ** rng.uniform(-9, 9)
        major, minor = scale, scale * ratio
        far = 10 ** rng.choice((0.3, 1, 2, 4, 6)) * major
        aim, n = on_surface(rng, major, minor)
        d = unit(rng)
        o = [a - far * b for a, b in zip(aim, d)]
        length = 10 ** rng.uniform(-2, 2)
        emit("random", major, minor, o, [c * length for c in d])
    for number in range(210):
        ratio, scale = ratios[number % 7], 10 ** rng.uniform(-9, 9)
        major, minor = scale, scale * ratio
        aim, n = on_surface(rng, major, minor)
        off = rng.choice((-1, 1)) * 10 ** rng.uniform(-14, -2) * minor
        aim = [a + off * b for a, b in zip(aim, n)]
        far = rng.choice((0.0, 1.0, 100.0)) * major
        d = tangent(rng, n)
        emit("grazing", major, minor, [a - far * b for a, b in zip(aim, d)], d)
    for number in range(105):
        ratio, scale = ratios[number % 7], 10 ** rng.uniform(-9, 9)
        major, minor = scale, scale * ratio
        aim, _ = on_surface(rng, major, minor)
        axis = number % 3
        d = [0.0, 0.0, 0.0]
        d[axis] = rng.choice((-1.0, 1.0))
        if number % 5 == 0:
            aim[(axis + 1) % 3] = 0.0
        if number % 5 == 1:
            aim[2] = 0.0
        if number % 5 == 2:
            d[(axis + 1) % 3] = 1e-17
        emit("axis", major, minor, [a - 3 * major * b for a, b in zip(aim, d)], d)
    for number in range(56):  # along the tube
        ratio, scale = ratios[number % 7], 10 ** rng.uniform(-9, 9)
        major, minor = scale, scale * ratio
        d = [rng.uniform(-1, 1) * ratio * ratio, 1.0, rng.uniform(-1, 1) * ratio * ratio]
        o = [major + rng.uniform(-1.5, 1.5) * minor, -3 * major, rng.uniform(-1, 1) * minor]
        emit("along", major, minor, o, d)
    for number in range(28):  # through the centre, almost touching the tube twice
        ratio, scale = ratios[number % 7], 10 ** rng.uniform(-9, 9)
        major, minor = scale, scale * ratio
        angle = math.asin(ratio) * (1 + rng.choice((-1, 1)) * 10 ** rng.uniform(-13, -2))
        d = [math.cos(angle), 0.0, math.sin(angle)]
        emit("double", major, minor, [-4 * major * c for c in d], d)


if __name__ == "__main__":
    main()
