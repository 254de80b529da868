#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs two-dimensional flags and a plate that swings out on three grids or more, cells and time step together, and prints the
observed order of amplitude and frequency of the tip.

Usage: validation/convergence/compare.py [CASE...] [--edges partial] [--levels N N N...] [--out DIR]

CASE is flag-2d, inverted-flag-2d, plate, plate-small or plate-inviscid; all of them without one.  Each level has 1.5 times the
cells of the one before, everywhere, and steps shorter by as much.  With values a, b, c of three in turn the order is
log((a - b)/(b - c))/log(1.5), the value for h = 0 Richardson's c + (c - b)/(1.5^p - 1) of the last three.  Of the flags, peak to peak
is the mean over the whole periods of a window; of flag-2d there are an early and a late one.  Amplitude, frequency and
decay of the plate (plate.toml) are those of the damped oscillation A exp(-s t) cos(2 pi f t) nearest to what it does once
the push is over; `plate-small` is pushed a two-thousandth as far, so that its links never change, `plate-inviscid` likewise in a fluid
with a two-hundredth of the viscosity.

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
from comparison import columns, refined_axis, root, run

ratio = 1.5
windows = {
    "flag-2d": ((16.5, 24.0), (24.0, 42.0)),
    "inverted-flag-2d": ((12.0, 40.0),),
    "plate": ((1.2, 5.6),),
    "plate-small": ((1.2, 5.6),),
    "plate-inviscid": ((1.2, 5.6),),
}


def is_plate(case):
    return case.startswith("plate")


def flag_settings(case, cells):
    """The same grid but for its spacing: 80 x 60 cells with 16 on the flag."""
    return [
        "grid.x=" + refined_axis(-4.0, 10.0, 5 * cells, (-1.0, 2.0), 1.0 / cells),
        "grid.y=" + refined_axis(-4.0, 4.0, 15 * cells // 4, (-1.0, 1.0), 1.0 / cells),
        f"shell.flag.mesh.divisions=[{cells}, 1]",
        "coupling.tolerance=1e-7",
        f"time.end={windows[case][-1][1]}",
    ]


def plate_settings(case, cells):
    """The same grid but for its spacing: 56 x 40 cells with 16 on the plate."""
    load = 'shell.plate.load=[{ where = { box = [[-1, -1, -1], [2, 2, 1]] }, traction = ["t < 1 ? 0.001*sin(pi*t)^2 : 0", 0, 0] }]'
    return [
        "grid.x=" + refined_axis(-3.0, 3.0, 7 * cells // 2, (-1.0, 1.0), 1.0 / cells),
        "grid.y=" + refined_axis(0.0, 3.0, 5 * cells // 2, (0.0, 1.5), 1.0 / cells),
        f"shell.plate.mesh.divisions=[{cells}, 1]",
        *([load] if case != "plate" else []),
        *(["fluid.viscosity=0.0001"] if case == "plate-inviscid" else []),
    ]


def history(case, cells, edges, out):
    """Time and deflection of the tip; of a run that fails, up to there."""
    file = here / "plate.toml" if is_plate(case) else root / "cases" / case / "case.toml"
    changes = plate_settings(case, cells) if is_plate(case) else flag_settings(case, cells)
    changes += [f"time.step={0.24 / cells:.10g}", "output.plots=false", f"immersed.edges={edges}"]
    tip = columns(run(file, out, changes, check=False) / "probe-tip.csv")
    return tip["t"], tip["displacement_x" if is_plate(case) else "displacement_y"]


def rises(t, y):
    """Instants where y rises through the middle of its range."""
    y = y - 0.5 * (y.max() + y.min())
    up = np.flatnonzero((y[:-1] < 0) & (y[1:] >= 0))
    return t[up] - y[up] * (t[up + 1] - t[up]) / (y[up + 1] - y[up])


def swing(t, y, window):
    """Peak to peak, the mean over whole periods, frequency, and how many periods there are."""
    late = (t >= window[0]) & (t <= window[1])
    t, y = t[late], y[late]
    at = rises(t, y)
    heights = [np.ptp(y[(t >= a) & (t <= b)]) for a, b in zip(at[:-1], at[1:])]
    return {"peak to peak / L": np.mean(heights), "frequency L/U": (len(at) - 1) / (at[-1] - at[0]), "periods": len(heights)}


def swing_out(t, y, window, lag=0.5):
    """Amplitude at the beginning of the window, frequency and decay of a damped oscillation, for which
    y(t + lag) = a y(t) + b y(t - lag): a = 2 exp(-s lag) cos(2 pi f lag), b = -exp(-2 s lag) [prony_1795_essai]."""

    def fit(terms, values):
        return np.linalg.lstsq(np.stack(terms, axis=1), values, rcond=None)[0]

    def at(time):
        return np.interp(time, t, y)

    now = np.linspace(window[0] + lag, window[1] - lag, 200)
    a, b = fit([at(now), at(now - lag)], at(now + lag))
    decay, omega = -np.log(-b) / (2.0 * lag), np.arccos(a / (2.0 * np.sqrt(-b))) / lag
    time = np.linspace(*window, 400)
    envelope = np.exp(-decay * (time - window[0]))
    amplitude = np.hypot(*fit([envelope * np.cos(omega * time), envelope * np.sin(omega * time)], at(time)))
    return {"amplitude / L": amplitude, "frequency": omega / (2.0 * np.pi), "decay": decay}


def order(values):
    """Of three values in turn, and what they converge to."""
    a, b, c = values
    if (a - b) * (b - c) <= 0 or abs(b - c) >= 0.9 * abs(a - b):
        return None, None
    p = np.log((a - b) / (b - c)) / np.log(ratio)
    return p, c + (c - b) / (ratio**p - 1)


def summary(values):
    """The orders of three values each in turn, what the last three converge to, and how far the last is from it."""
    found = [order(values[n : n + 3]) for n in range(len(values) - 2)]
    orders = ", ".join("none" if p is None else f"{p:.2f}" for p, _ in found)
    limit = found[-1][1]
    return f"{orders} | | " if limit is None else f"{orders} | {limit:.4g} | {100 * (values[-1] / limit - 1):+.1f} %"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE", default=list(windows))
    parser.add_argument("--edges", choices=("whole", "partial"), default="whole")
    parser.add_argument("--levels", nargs="+", type=int, default=[16, 24, 36], metavar="N", help="cells per length, three or more")
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    if len(arguments.levels) < 3 or any(b != ratio * a for a, b in zip(arguments.levels, arguments.levels[1:])):
        parser.error("--levels takes three or more, each 1.5 times the one before")
    if arguments.out is None:
        arguments.out = here / "results" / ("partial" if arguments.edges == "partial" else "")
    figure, axes = plt.subplots(len(arguments.cases), 1, figsize=(9, 4 * len(arguments.cases)), squeeze=False)
    print("case | quantity | " + " | ".join(f"L/{n}" for n in arguments.levels) + " | orders | h = 0 | finest off by")
    for case, axis in zip(arguments.cases, axes[:, 0]):
        runs = [history(case, cells, arguments.edges, arguments.out / f"{case}-{cells}") for cells in arguments.levels]
        for cells, (t, y) in zip(arguments.levels, runs):
            axis.plot(t, y, label=f"L/{cells}")
        axis.set(title=case, xlabel="t U/L", ylabel="tip deflection / L")
        axis.legend()
        for window in windows[case]:
            found = [(swing_out if is_plate(case) else swing)(t, y, window) for t, y in runs]
            for quantity in found[0]:
                values = [level[quantity] for level in found]
                tail = "| | " if quantity == "periods" else summary(values)
                print(f"{case}, t = {window[0]} to {window[1]} | {quantity} | " + " | ".join(f"{v:.4g}" for v in values) + f" | {tail}")
        print(f"{case} | ends at t | " + " | ".join(f"{t[-1]:.1f}" for t, _ in runs) + " | | |")
    figure.tight_layout()
    figure.savefig(arguments.out / "convergence.png", dpi=130)


main()
