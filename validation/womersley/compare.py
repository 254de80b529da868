#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Sends an oscillating flow rate through a plane channel and compares velocities with Womersley's solution.

Usage: validation/womersley/compare.py [--cells N] [--out DIR]

Between plates at y = -1 and 1, per depth, for Q(t) = 2 cos(2 pi t) and alpha = sqrt(omega/nu) = 4, 10, 18.8 (an aorta):

  u = Re{ (1 - cosh(s y)/cosh(s))/(1 - tanh(s)/s) exp(i omega t) },   s = sqrt(i) alpha.

The inlet has profile = "womersley", the outlet is an outflow. Writes DIR/womersley.png (default validation/womersley/results)
and prints a table: the largest error over two periods and the section, as a part of the largest velocity.
"""
import argparse
import cmath
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import columns, run_text

OMEGA = 2.0 * math.pi

CASE = """title = "Oscillating channel flow, alpha = {alpha}"
[time]
end = 2.0
step = {step}
[fluid]
density = 1.0
viscosity = {viscosity}
initial.velocity = ["{start}", 0.0, 0.0]
[grid]
x = {{ from = 0.0, to = 4.0, cells = 8 }}
y = {{ from = -1.0, to = 1.0, cells = {cells} }}
z = {{ from = 0.0, to = 1.0, cells = 1 }}
[boundary]
x_min = {{ type = "velocity", flow_rate = "2*cos(2*pi*t)", profile = "womersley", period = 1.0 }}
x_max = {{ type = "outflow" }}
y_min = {{ type = "wall" }}
y_max = {{ type = "wall" }}
z_min = {{ type = "symmetry" }}
z_max = {{ type = "symmetry" }}
"""


def places(cells):
    """Centres of cells, all those near the walls and every third between: nothing is interpolated."""
    h = 2.0 / cells
    return [-1.0 + h * (n + 0.5) for n in sorted({*range(6), *range(0, cells, 3), *range(cells - 6, cells)})]


def amplitude(alpha, y):
    s = cmath.sqrt(1j) * alpha
    return (1.0 - cmath.cosh(s * y) / cmath.cosh(s)) / (1.0 - cmath.tanh(s) / s)


def start_formula(alpha):
    """Re of the amplitude as a formula of y: cosh(b (1 + i) y) = cosh(b y) cos(b y) + i sinh(b y) sin(b y)."""
    s = cmath.sqrt(1j) * alpha
    mean = 1.0 / (1.0 - cmath.tanh(s) / s)
    wall = -mean / cmath.cosh(s)
    b = alpha / math.sqrt(2.0)
    return (f"{mean.real:.15g} + ({wall.real:.15g})*cosh({b:.15g}*y)*cos({b:.15g}*y)"
            f" - ({wall.imag:.15g})*sinh({b:.15g}*y)*sin({b:.15g}*y)")


def text_of(alpha, cells):
    viscosity = OMEGA / alpha**2
    step = min(0.005, 0.4 * (2.0 / cells) ** 2 / viscosity)
    text = CASE.format(alpha=alpha, step=2.0 / math.ceil(2.0 / step), viscosity=viscosity, cells=cells, start=start_formula(alpha))
    return text + "".join(f'[[output.probe]]\nname = "y{n}"\npoint = [2.0, {y}, 0.5]\n' for n, y in enumerate(places(cells)))


def history(folder, n):
    probe = columns(folder / f"probe-y{n}.csv")
    return list(zip(probe["t"], probe["velocity_x"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=64, help="across the channel")
    parser.add_argument("--out", type=Path, default=here / "results")
    options = parser.parse_args()
    alphas = [4.0, 10.0, 18.8]
    figure, axes = plt.subplots(1, len(alphas), figsize=(11, 4))
    for alpha, axis in zip(alphas, axes):
        folder = run_text(text_of(alpha, options.cells), options.out / f"alpha-{alpha}-{options.cells}")
        histories = [history(folder, n) for n in range(len(places(options.cells)))]
        error, largest = 0.0, 0.0
        for y, values in zip(places(options.cells), histories):
            for t, u in values:
                exact = (amplitude(alpha, y) * cmath.exp(1j * OMEGA * t)).real
                error, largest = max(error, abs(u - exact)), max(largest, abs(exact))
        print(f"alpha {alpha} | {options.cells} cells | largest error {100 * error / largest:.2f} % of {largest:.3f}")
        for phase in (1.0, 1.125, 1.25, 1.375):
            at = min(range(len(histories[0])), key=lambda m: abs(histories[0][m][0] - phase))
            t = histories[0][at][0]
            fine = [-1.0 + 0.01 * m for m in range(201)]
            axis.plot([(amplitude(alpha, y) * cmath.exp(1j * OMEGA * t)).real for y in fine], fine, "k-", lw=0.8)
            axis.plot([values[at][1] for values in histories], places(options.cells), ".", label=f"t = {phase}")
        axis.set(title=f"alpha = {alpha}", xlabel="u", ylabel="y")
    axes[0].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(options.out / "womersley.png", dpi=130)


main()
