"""Writes polynomials.txt: polynomials in double precision with their real roots, by exact rational arithmetic.

Multiplicities come from the square-free factors (Yun), counts from Sturm's sequences, roots by bisection; nothing is
rounded but the coefficients when they are made, and the roots when they are written.

    python3 polynomials.py > polynomials.txt
"""

import random
from fractions import Fraction as F


def trim(p):
    while p and p[-1] == 0:
        p = p[:-1]
    return p


def value(p, x):
    v = F(0)
    for c in reversed(p):
        v = v * x + c
    return v


def slope(p):
    return [i * c for i, c in enumerate(p)][1:]


def divide(p, q):
    p, out = list(p), [F(0)] * max(len(p) - len(q) + 1, 0)
    for i in reversed(range(len(out))):
        out[i] = p[i + len(q) - 1] / q[-1]
        for j, c in enumerate(q):
            p[i + j] -= out[i] * c
    return trim(out), trim(p[: len(q) - 1])


def gcd(p, q):
    while q:
        p, q = q, divide(p, q)[1]
    return [c / p[-1] for c in p]


def square_free(p):
    """Pairs (factor, multiplicity)."""
    out, k = [], 1
    c = gcd(p, slope(p))
    w = divide(p, c)[0]
    while len(w) > 1:
        y = gcd(w, c)
        factor = divide(w, y)[0]
        if len(factor) > 1:
            out.append((factor, k))
        w, c, k = y, divide(c, y)[0], k + 1
    return out


def sturm(p):
    chain = [p, slope(p)]
    while True:
        rest = divide(chain[-2], chain[-1])[1]
        if not rest:
            return chain
        chain.append([-c for c in rest])


def changes(chain, x):
    signs = [v > 0 for v in (value(p, x) for p in chain) if v != 0]
    return sum(a != b for a, b in zip(signs, signs[1:]))


def real_roots(p):
    """Roots of a square-free polynomial, far closer than rounding."""
    if p[0] == 0:
        return real_roots(p[1:]) + [F(0)] if len(p) > 2 else [F(0)]
    chain = sturm(p)
    reach = 1 + max(abs(c / p[-1]) for c in p[:-1])
    pending, out = [(-reach, F(0)), (F(0), reach)], []
    while pending:
        a, b = pending.pop()
        count = changes(chain, a) - changes(chain, b)
        if count == 0:
            continue
        small = min(abs(a), abs(b))
        if count == 1 and small > 0 and b - a < small / 2**70:
            out.append((a + b) / 2)
            continue
        if count == 1 and value(p, b) == 0:
            out.append(b)
            continue
        m = middle(a, b)
        pending += [(a, m), (m, b)]
    return out


def middle(a, b):
    """Half-way in size, if the ends are far apart, so that few steps are needed."""
    small, large = sorted((abs(a), abs(b)))
    if small == 0:
        small = large / 2**64
    if large / small < 4:
        return (a + b) / 2
    bits = ((large.numerator.bit_length() - large.denominator.bit_length())
            + (small.numerator.bit_length() - small.denominator.bit_length())) // 2
    m = F(2) ** bits
    return m if b > 0 else -m


def show(x):
    try:
        return repr(float(x))
    except OverflowError:
        return "inf" if x > 0 else "-inf"


def emit(kind, coefficients):
    """Coefficients from the highest degree on, as floats."""
    p = trim([F(c) for c in reversed(coefficients)])
    if len(p) < 2:
        return
    roots = sorted((r, k) for factor, k in square_free(p) for r in real_roots(factor))
    left = " ".join(repr(c) for c in coefficients)
    print(kind, left, ";", " ".join(f"{show(r)} {k}" for r, k in roots))


def product(roots, lead=1):
    p = [F(lead)]
    for r in roots:
        p = [a - F(r) * b for a, b in zip(p + [F(0)], [F(0)] + p)]
    return p


def main():
    rng = random.Random(1)
    print("# Polynomials and their real roots, written by polynomials.py with exact rational arithmetic.")
    print("# kind, coefficients from the highest degree on; then pairs of root and multiplicity, ascending.")
    for degree in (2, 3, 4):
        for _ in range(30):
            emit("random", [rng.uniform(-1, 1) for _ in range(degree + 1)])
        for _ in range(30):
            emit("orders", [rng.choice((-1, 1)) * 10 ** rng.uniform(-20, 20) for _ in range(degree + 1)])
        for _ in range(20):
            emit("range", [rng.choice((-1, 1)) * 10 ** rng.uniform(-300, 300) for _ in range(degree + 1)])
        for _ in range(30):
            emit("dyadic", [float(c) for c in product([F(rng.randint(-1023, 1023), 64) for _ in range(degree)])])
        for _ in range(30):  # clustered: exact for up to 12 bits a root
            at = rng.randint(-900, 900)
            roots = [F(at + rng.randint(-2, 2), 2 ** rng.randint(0, 9)) for _ in range(degree)]
            if rng.random() < 0.6:
                roots = [F(at + rng.randint(-2, 2), 512) for _ in range(degree)]
            emit("cluster", [float(c) for c in product(roots)])
        for _ in range(60):  # nearly double: how many roots are left is for the rounded coefficients to say
            gap = 10 ** rng.uniform(-11, -3)
            roots = [rng.uniform(-2, 2) for _ in range(degree)]
            roots[1] = roots[0] * (1 + gap)
            if degree == 4 and rng.random() < 0.3:
                roots[3] = roots[2] * (1 + 10 ** rng.uniform(-11, -3))
            emit("near", [float(c) for c in product(roots)])
        for _ in range(20):  # nearly triple and quadruple
            gap = 10 ** rng.uniform(-7, -2)
            at = rng.uniform(-2, 2)
            emit("bundle", [float(c) for c in product([at * (1 + gap * rng.uniform(-1, 1)) for _ in range(degree)])])
        for _ in range(20):
            lead = rng.choice((0.0, 5e-324, 1e-310, 1e-300, -1e-200, 1e-30))
            emit("lead", [lead] + [rng.uniform(-1, 1) for _ in range(degree)])
        for _ in range(20):  # sizes of everyday shapes in units from femtometres to light-years
            unit = 10 ** rng.uniform(-15, 16)
            emit("unit", [float(c) for c in product([F(rng.uniform(-2, 2)) * F(unit) for _ in range(degree)])])
    for coefficients in ([1.0, 0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0, -1.0], [1.0, 0.0, 0.0, 0.0, 1.0],
                         [1.0, 0.0, -2.0, 0.0, 1.0], [1.0, -4.0, 6.0, -4.0, 1.0], [1.0, -3.0, 3.0, -1.0],
                         [0.0, 0.0, 0.0, 2.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [1.0, -2.0, 1.0],
                         [1.0, 0.0, -1.0, 0.0, 0.0], [1e308, 1e308, -1e308], [1e-308, 1e-308, -1e-308],
                         [1e300, 1e-300, -1e300, 1e-300], [1e-300, 0.0, 1e300, 0.0, -1e-300],
                         [1e-300, 0.0, -1e300, 0.0, 1e-300]):
        emit("special", coefficients)


if __name__ == "__main__":
    main()
