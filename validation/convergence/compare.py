#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the two-dimensional flags on three grids, cells and time step together, and prints the observed order of amplitude
and frequency of the tip.

Usage: validation/convergence/compare.py [--edges partial] [--out DIR] [CASE...]

Each level has 1.5 times the cells of the one before, everywhere, and steps shorter by as much.  With values a, b, c from
coarse to fine the order is log((a - b)/(b - c))/log(1.5), the value for h = 0 Richardson's c + (c - b)/(1.5^p - 1).
Peak to peak is the mean over the whole periods of a window; of the flag there are an early and a late one.

With --edges partial the flag's edges cover parts of faces (`immersed.edges`).

Runs into DIR/<case>-<cells per length> (default validation/convergence/results, or results/partial) what is not there yet,
prints a table, and writes DIR/convergence.png.
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

ratio = 1.5
levels = (16, 24, 36)  # cells per length
windows = {"flag-2d": ((16.5, 24.0), (24.0, 42.0)), "inverted-flag-2d": ((12.0, 40.0),)}


def settings(cells, edges):
    """The same grid but for its spacing: 80 x 60 cells with 16 on the flag."""
    line = "{{ from = {}, to = {}, cells = {}, refine = {{ from = {}, to = {}, spacing = {:.10g} }} }}"
    return [
        "grid.x=" + line.format(-4.0, 10.0, 5 * cells, -1.0, 2.0, 1.0 / cells),
        "grid.y=" + line.format(-4.0, 4.0, 15 * cells // 4, -1.0, 1.0, 1.0 / cells),
        f"shell.flag.mesh.divisions=[{cells}, 1]",
        f"time.step={0.24 / cells:.10g}",
        "output.plots=false",
        "coupling.tolerance=1e-7",
        f"immersed.edges={edges}",
    ]


def history(case, cells, edges, out):
    """Time and y of the tip; of a run that fails, up to there."""
    changes = settings(cells, edges) + [f"time.end={windows[case][-1][1]}"]
    tip = columns(run(root / "cases" / case / "case.toml", out, changes, check=False) / "probe-tip.csv")
    return tip["t"], tip["displacement_y"]


def rises(t, y):
    """Instants where y rises through the middle of its range."""
    y = y - 0.5 * (y.max() + y.min())
    up = np.flatnonzero((y[:-1] < 0) & (y[1:] >= 0))
    return t[up] - y[up] * (t[up + 1] - t[up]) / (y[up + 1] - y[up])


def swing(t, y, window):
    """Peak to peak, the mean over whole periods, and frequency."""
    late = (t >= window[0]) & (t <= window[1])
    t, y = t[late], y[late]
    at = rises(t, y)
    heights = [np.ptp(y[(t >= a) & (t <= b)]) for a, b in zip(at[:-1], at[1:])]
    return np.mean(heights), (len(at) - 1) / (at[-1] - at[0]), len(heights)


def order(values):
    a, b, c = values
    if (a - b) * (b - c) <= 0 or abs(b - c) >= 0.9 * abs(a - b):
        return None, None
    p = np.log((a - b) / (b - c)) / np.log(ratio)
    return p, c + (c - b) / (ratio**p - 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE", default=list(windows))
    parser.add_argument("--edges", choices=("whole", "partial"), default="whole")
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    if arguments.out is None:
        arguments.out = here / "results" / ("partial" if arguments.edges == "partial" else "")
    figure, axes = plt.subplots(len(arguments.cases), 1, figsize=(9, 4 * len(arguments.cases)), squeeze=False)
    print("case | quantity | " + " | ".join(f"L/{n}" for n in levels) + " | order | h = 0 | finest off by")
    for case, axis in zip(arguments.cases, axes[:, 0]):
        found, ends = {window: [] for window in windows[case]}, []
        for cells in levels:
            t, y = history(case, cells, arguments.edges, arguments.out / f"{case}-{cells}")
            for window in found:
                found[window].append(swing(t, y, window))
            ends.append(t[-1])
            axis.plot(t, y, label=f"L/{cells}")
        axis.set(title=case, xlabel="t U/L", ylabel="tip displacement y/L")
        axis.legend()
        for window, levels_found in found.items():
            span = f"{case}, t = {window[0]} to {window[1]}"
            for n, quantity in enumerate(("peak to peak / L", "frequency L/U")):
                values = [level[n] for level in levels_found]
                p, limit = order(values)
                tail = "none: changes do not fall | | " if p is None else f"{p:.2f} | {limit:.4f} | {100 * (values[2] / limit - 1):+.1f} %"
                print(f"{span} | {quantity} | " + " | ".join(f"{v:.4f}" for v in values) + f" | {tail}")
            print(f"{span} | periods | " + " | ".join(str(level[2]) for level in levels_found) + " | | |")
        print(f"{case} | ends at t | " + " | ".join(f"{t:.1f}" for t in ends) + " | | |")
    figure.tight_layout()
    figure.savefig(arguments.out / "convergence.png", dpi=130)


main()
