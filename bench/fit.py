#!/usr/bin/env python3
"""Fits the polynomials of src/math/elementary and prints them, with pi and ln 2 in parts.

Each is the best polynomial for a relative error, by Remez's exchange; its coefficients are rounded to double.
Needs Debian's python3-mpmath.
"""
import mpmath as mp

mp.mp.prec = 240


def fit(name, f, weight, low, high, degree):
    """Prints the coefficients of the polynomial whose largest |weight * error| from low to high is least."""
    low, high, count = mp.mpf(low), mp.mpf(high), degree + 2
    spread = lambda n: [(low + high) / 2 - (high - low) / 2 * mp.cos(mp.pi * i / (n - 1)) for i in range(n)]
    values = [(x, f(x), weight(x)) for x in spread(201 + 40 * degree) if abs(x) > 1e-12]
    nodes = [min(values, key=lambda v: abs(v[0] - node)) for node in spread(count)]
    for _ in range(30):
        rows = mp.matrix([[x ** j for j in range(count - 1)] + [(-1) ** i / w] for i, (x, _, w) in enumerate(nodes)])
        found = list(mp.lu_solve(rows, mp.matrix([v for _, v, _ in nodes])))
        error = lambda v: v[2] * (mp.polyval(found[-2::-1], v[0]) - v[1])
        peaks = []  # where the error is largest between its changes of sign
        for v in values:
            if not peaks or (error(peaks[-1]) > 0) != (error(v) > 0):
                peaks.append(v)
            elif abs(error(v)) > abs(error(peaks[-1])):
                peaks[-1] = v
        while len(peaks) > count:
            peaks.pop(0 if abs(error(peaks[0])) < abs(error(peaks[-1])) else -1)
        if len(peaks) < count or max(abs(error(v)) for v in peaks) < abs(found[-1]) * mp.mpf('1.01'):
            break
        nodes = peaks
    found = [mp.mpf(float(c)) for c in found[:-1]] + [0]  # rounded
    print(f'// {name}: 2^{float(mp.log(max(abs(error(v)) for v in values), 2)):.1f}')
    print(', '.join(float(c).hex() for c in found[:-1]))


def parts(name, value, bits, count):
    out = []
    for _ in range(count - 1):
        step = mp.mpf(2) ** (mp.floor(mp.log(abs(value), 2)) + 1 - bits)
        part = mp.floor(value / step) * step
        out.append(float(part).hex())
        value -= part
    print(f'// {name}\n' + ', '.join(out + [float(value).hex()]))


if __name__ == '__main__':
    parts('pi / 2', mp.pi / 2, 33, 3)
    parts('pi', mp.pi, 53, 2)
    parts('ln 2', mp.log(2), 42, 2)
    parts('ln 2 / 128', mp.log(2) / 128, 35, 2)
    parts('1 / ln 2', 1 / mp.log(2), 53, 2)
    parts('1 / ln 10', 1 / mp.log(10), 53, 2)
    parts('ln(2 pi) / 2', mp.log(2 * mp.pi) / 2, 53, 2)
    parts('2 / sqrt(pi)', 2 / mp.sqrt(mp.pi), 53, 2)
    mp.mp.prec = 1400
    bits = int(mp.floor(2 / mp.pi * mp.mpf(2) ** 1216))
    print('// 2 / pi\n' + ', '.join(f'0x{bits >> (1216 - 32 * (i + 1)) & 0xffffffff:08x}' for i in range(38)))
    mp.mp.prec = 240

    root = mp.sqrt
    odd = lambda g: lambda z: (g(root(z)) - root(z)) / root(z) ** 3  # g(x) = x + x^3 p(x^2), where g is odd
    byOdd = lambda g: lambda z: root(z) ** 3 / g(root(z))
    quarter = (mp.pi / 4 * mp.mpf('1.0001')) ** 2
    fit('sin r = r + r^3 p(r^2)', odd(mp.sin), byOdd(mp.sin), 0, quarter, 5)
    fit('cos r = 1 - r^2 / 2 + r^4 p(r^2)', lambda z: (mp.cos(root(z)) - 1 + z / 2) / z ** 2, lambda z: z ** 2, 0, quarter, 5)
    reach = mp.log(2) / 256 * mp.mpf('1.01')
    fit('exp r = 1 + r + r^2 p(r), relative to exp r', lambda r: (mp.exp(r) - 1 - r) / r ** 2, lambda r: r ** 2, -reach, reach, 3)
    fit('exp r = 1 + r + r^2 p(r), relative to exp r - 1', lambda r: (mp.exp(r) - 1 - r) / r ** 2, lambda r: abs(r ** 2 / mp.expm1(r)), -reach, reach, 4)
    near = mp.mpf('0.00585')
    fit('log(1 + r) = r + r^2 p(r)', lambda r: (mp.log1p(r) - r) / r ** 2, lambda r: abs(r ** 2 / mp.log1p(r)), -near, near, 5)
    fit('log(1 + r) = r - r^2 / 2 + r^3 p(r)', lambda r: (mp.log1p(r) - r + r ** 2 / 2) / r ** 3,
        lambda r: abs(r ** 3 / mp.log1p(r)), -near, near, 5)
    fit('atan t = t + t^3 p(t^2), t up to 1/8', odd(mp.atan), byOdd(mp.atan), 0, mp.mpf('1.001') / 64, 6)
    fit('atan t = t + t^3 p(t^2), t up to 1/32', odd(mp.atan), byOdd(mp.atan), 0, mp.mpf('1.001') / 1024, 3)
    fit('asin x = x + x^3 p(x^2)', odd(mp.asin), byOdd(mp.asin), 0, mp.mpf('0.2501'), 12)
    fit('cbrt x = p(x)', mp.cbrt, lambda x: 1 / mp.cbrt(x), 1, 8, 4)
    fit('erf x = 2 x / sqrt(pi) + x^3 p(x^2)', lambda z: (mp.erf(root(z)) - 2 / mp.sqrt(mp.pi) * root(z)) / root(z) ** 3,
        lambda z: root(z) ** 3 / mp.erf(root(z)), 0, mp.mpf(0.75) ** 2, 9)
    def scaledTail(t):  # t = (x - 3) / (x + 3)
        x = 3 * (1 + t) / (1 - t)
        return mp.exp(x * x) * mp.erfc(x) * (1 + x)

    low, high = ((x - 3) / (x + 3) for x in (mp.mpf(0.74), mp.mpf(29)))
    fit('erfc x = e^(-x^2) p(t) / (1 + x)', scaledTail, lambda t: 1 / scaledTail(t), low, high, 22)
