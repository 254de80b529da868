#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the cylinder on a spring and compares its frequency and decay with Stokes's theory of small oscillations.

Usage: validation/sprung-cylinder/compare.py [--out DIR] [--set KEY=VALUE ...]

A cylinder of radius a that moves like exp(s t) in fluid without bound feels -m_f s^2 (1 + 4 K_1(q)/(q K_0(q))) x,
q = a sqrt(s/nu) (Stokes 1851), so that m s^2 + m_f s^2 (1 + 4 K_1(q)/(q K_0(q))) + k = 0 gives frequency and decay.

Runs cases/sprung-cylinder/case.toml into DIR (default validation/sprung-cylinder/results) unless it is there already, prints a
table, and writes DIR/sprung-cylinder.png.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import columns, root, run

viscosity, depth, density, stiffness, gravity = 0.02, 0.025, 0.5, 1.410523, 2.3


def bessel_k(n, z):
    """K_n(z) = int_0^oo exp(-z cosh t) cosh(n t) dt, by the trapezoidal rule, which converges faster than any power."""
    t = np.linspace(-6, 6, 601)
    return 0.5 * np.sum(np.exp(-z * np.cosh(t)) * np.cosh(n * t)) * (t[1] - t[0])


def theory():
    """The root s by the secant rule."""
    fluid = np.pi / 4 * depth

    def equation(s):
        q = 0.5 * np.sqrt(s / viscosity)
        return s**2 * fluid * (density + 1 + 4 * bessel_k(1, q) / (q * bessel_k(0, q))) + stiffness

    before, s = -0.5 + 6.0j, -0.5 + 6.1j
    while abs(s - before) > 1e-12:
        before, s = s, s - equation(s) * (s - before) / (equation(s) - equation(before))
    return s


def swing(t, y):
    """Decay, frequency and place of rest of y = rest + A exp(-decay t) cos(frequency t + phase): for samples a time h apart
    y_{n+1} = 2 exp(-decay h) cos(frequency h) y_n - exp(-2 decay h) y_{n-1} + constant, by least squares."""
    h = 0.2
    n = np.arange(t[0] + h, t[-1] - h, 0.01)
    y_before, y_here, y_after = (np.interp(n + shift, t, y) for shift in (-h, 0, h))
    a, b, c = np.linalg.lstsq(np.stack([y_here, y_before, np.ones_like(n)], axis=1), y_after, rcond=None)[0]
    decay = -0.5 * np.log(-b) / h
    return decay, np.arccos(0.5 * a * np.exp(decay * h)) / h, c / (1 - a - b)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    parser.add_argument("--set", dest="settings", action="append", default=[])
    arguments = parser.parse_args()
    out = run(root / "cases" / "sprung-cylinder" / "case.toml", arguments.out, arguments.settings)
    motion = columns(out / "motion-cylinder.csv")
    t, y = motion["t"], motion["centre_y"] - 0.007

    s = theory()
    late = t > 0.5  # the start is no oscillation yet
    rest = -np.pi / 4 * depth * density * gravity / stiffness
    decay, frequency, found_rest = swing(t[late], y[late])
    print("quantity | luff | theory | difference")
    for name, ours, theirs in (("frequency T", frequency / (2 * np.pi), s.imag / (2 * np.pi)),
                               ("decay rate T", decay, -s.real), ("place of rest / D", found_rest, rest)):
        print(f"{name} | {ours:.4f} | {theirs:.4f} | {100 * (ours / theirs - 1):+.1f} %")
    figure, axis = plt.subplots(figsize=(8, 4))
    axis.plot(t, y, label="luff")
    peak = np.argmax(y)
    axis.plot(t, rest + (y[peak] - rest) * np.exp(s.real * (t - t[peak])) * np.cos(s.imag * (t - t[peak])), "--",
              label="theory's frequency and decay from the largest value on")
    axis.set(xlabel="t/T", ylabel="y/D")
    axis.legend()
    figure.tight_layout()
    figure.savefig(out / "sprung-cylinder.png", dpi=130)


main()
