#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the spherical shell in fluid and compares its frequency and decay with the exact solution for small oscillations.

Usage: validation/spherical-shell/compare.py [--out DIR] [--levels F...]

Runs cases/spherical-shell/case.toml with --resolution F (default 0.7 1 1.43) into DIR/<F> (default
validation/spherical-shell/results) what is not there already, prints a table, and writes DIR/spherical-shell.png.  What is
compared is a = 2/3 (pole - equator), the amplitude of the second Legendre polynomial; see theory.py.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import theory

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import columns, root, run


def history(out):
    pole, equator = (columns(out / f"probe-{name}.csv") for name in ("pole", "equator"))
    return pole["t"], 2 / 3 * (pole["displacement_z"] - equator["displacement_x"])


def swing(t, a):
    """Decay and frequency of a = rest + A exp(-decay t) cos(frequency t + phase): for samples a time h apart
    a_{n+1} = 2 exp(-decay h) cos(frequency h) a_n - exp(-2 decay h) a_{n-1} + constant, by least squares."""
    h = 0.3
    n = np.arange(t[0] + h, t[-1] - h, 0.01)
    before, at, after = (np.interp(n + shift, t, a) for shift in (-h, 0, h))
    p, q, _ = np.linalg.lstsq(np.stack([at, before, np.ones_like(n)], axis=1), after, rcond=None)[0]
    decay = -0.5 * np.log(-q) / h
    return decay, np.arccos(0.5 * p * np.exp(decay * h)) / h


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    parser.add_argument("--levels", nargs="+", default=["0.7", "1", "1.43"])
    arguments = parser.parse_args()
    s, inviscid = theory.root(n=2, radius=1.0, thickness=0.02, young=1000.0, poisson=0.3, shell_density=5.0, density=1.0, viscosity=0.02)
    print(f"without viscosity the frequency were {inviscid / (2 * np.pi):.4f}")
    print("cells per radius | quantity | luff | theory | difference")
    figure, axis = plt.subplots(figsize=(8, 4))
    for level in arguments.levels:
        t, a = history(run(root / "cases" / "spherical-shell" / "case.toml", arguments.out / level, words=["--resolution", level]))
        late = t > 1.0  # half a unit after the push has ended
        decay, frequency = swing(t[late], a[late])
        for name, ours, theirs in (("frequency", frequency / (2 * np.pi), s.imag / (2 * np.pi)), ("decay rate", decay, -s.real)):
            print(f"{float(level) / 0.06:.1f} | {name} | {ours:.4f} | {theirs:.4f} | {100 * (ours / theirs - 1):+.1f} %")
        axis.plot(t, a, label=f"luff, R/{float(level) / 0.06:.1f}")
    first = np.argmin(np.where(late, a, 0.0))
    axis.plot(t[late], a[first] * np.exp(s.real * (t[late] - t[first])) * np.cos(s.imag * (t[late] - t[first])), "k--",
              label="theory's frequency and decay")
    axis.set(xlabel="t", ylabel="amplitude of P_2 / R")
    axis.legend()
    figure.tight_layout()
    figure.savefig(arguments.out / "spherical-shell.png", dpi=130)


main()
