#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the flexible plate in a cross-flow and compares drag and place of the tip with experiment and computation.

Usage: validation/flexible-plate/compare.py [--out DIR] [--levels F...] [--end T]

Runs cases/flexible-plate/case.toml with --resolution F (default 1) up to T (default 30) into DIR/<cells per width>
(default validation/flexible-plate/results) unless it is there already, prints a table, and writes DIR/flexible-plate.png.
Values are means over the last two thirds of the run, with the largest departure from them in it.  Drag is that of half a plate, doubled.
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
from comparison import columns, published, root, run

length = 5.0


def histories(out):
    """Drag by traction, place of the tip, all over time; and drag by momentum where it was audited."""
    forces, tip, audit = (columns(out / f"{name}.csv") for name in ("forces-plate", "probe-tip", "audit"))
    scale = 2 / (0.5 * length)
    found = {"Cd": scale * forces["force_x"], "Dx_over_b": tip["displacement_x"], "Dz_over_b": -tip["displacement_z"]}
    return tip["t"], found, (audit["t"], scale * audit["by_momentum_plate_x"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    parser.add_argument("--levels", nargs="+", default=["1"])
    parser.add_argument("--end", type=float, default=30.0)
    arguments = parser.parse_args()
    references = published("flexible_plate_crossflow.csv")
    figure, axes = plt.subplots(3, 1, figsize=(8, 9), sharex=True)
    print("cells per width | quantity | luff | +- | " + " | ".join(row["source"] for row in references) + " | differences")
    for level in arguments.levels:
        cells = f"{10 * float(level):.1f}"
        case = root / "cases" / "flexible-plate" / "case.toml"
        out = run(case, arguments.out / cells, [f"time.end={arguments.end}"], ["--resolution", level])
        t, found, (instants, by_momentum) = histories(out)
        late = t > t[-1] / 3
        for axis, (key, values) in zip(axes, found.items()):
            mean, swing = np.mean(values[late]), np.max(np.abs(values[late] - np.mean(values[late])))
            theirs = [float(row[key]) for row in references]
            print(f"{cells} | {key} | {mean:.3f} | {swing:.3f} | " + " | ".join(map(str, theirs)) + " | " +
                  ", ".join(f"{100 * (mean / value - 1):+.1f} %" for value in theirs))
            axis.plot(t, values, label=f"b/{cells}")
            axis.set_ylabel(key)
        print(f"{cells} | Cd by momentum | {np.mean(by_momentum[instants > t[-1] / 3]):.3f} | | | |")
    for axis, key in zip(axes, found):
        for row, style in zip(references, ("k--", "k:")):
            axis.plot([0, t[-1]], 2 * [float(row[key])], style, label=row["source"])
    axes[0].set_ylim(0.0, 3.0)
    axes[0].legend()
    axes[-1].set_xlabel("t U/b")
    figure.tight_layout()
    figure.savefig(arguments.out / "flexible-plate.png", dpi=130)


main()
