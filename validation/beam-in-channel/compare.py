#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the thick plate in a channel and compares where its point A comes to rest with solids4foam's tutorial beamInCrossFlow.

Usage: validation/beam-in-channel/compare.py [--out DIR]

Runs case.toml into DIR (default validation/beam-in-channel/results/run) unless it is there already, prints a table, and writes
DIR/beam-in-channel.png.  A is on the front face, half the thickness h before the middle surface that the shell has: with d and the
slope sin(turn) of the middle surface at its height, A moves by d + h/2 (1 - cos(turn), sin(turn)).  A shell has no shear of its
section: of a beam under an even load that is left out (Timoshenko),

    w_shear/w_bending = (s - s^2/2)/((s^4 - 4 s^3 + 6 s^2)/24) E h^2/(12 k G L^2),  s = 3/4, k = 5/6, E/G = 2 (1 + 0.4).
"""
import argparse
import csv
import subprocess
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

here = Path(__file__).resolve().parent
root = here.parent.parent
thickness, height = 0.1, 0.2
published = {"x": 0.01463, "y": 0.005, "z": -0.000447}


def history(out, name):
    with open(out / f"probe-{name}.csv") as file:
        rows = list(csv.reader(file))
    return np.array([[float(v) for v in row[:4]] for row in rows[1:]])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results" / "run")
    out = parser.parse_args().out
    if not (out / "summary.json").exists():
        subprocess.run([root / "luff", "run", here / "case.toml", "--out", out], check=True)
    a, end = history(out, "a"), history(out, "end")
    slope = (end[:, 1] - a[:, 1]) / np.hypot(end[:, 1] - a[:, 1], height - 0.15 + end[:, 2] - a[:, 2])
    found = {"x": a[:, 1] + 0.5 * thickness * (1 - np.sqrt(1 - slope**2)), "y": a[:, 2] + 0.5 * thickness * slope, "z": a[:, 3]}
    late = a[:, 0] > 0.9 * a[-1, 0]
    s = 0.75
    shear = (s - s**2 / 2) / ((s**4 - 4 * s**3 + 6 * s**2) / 24) * 2.8 * thickness**2 / (12 * 5 / 6 * height**2)
    print("displacement of A | luff | published | difference")
    for key, values in found.items():
        print(f"{key} | {np.mean(values[late]):.5f} | {published[key]} | {100 * (np.mean(values[late]) / published[key] - 1):+.1f} %")
    x = np.mean(found["x"][late])
    print(f"x with the shear of a beam's section | {x * (1 + shear):.5f} | {published['x']} | {100 * (x * (1 + shear) / published['x'] - 1):+.1f} %")
    print(f"x moved by {100 * np.ptp(found['x'][late]) / x:.1f} % in the last tenth of the run")
    figure, axis = plt.subplots(figsize=(8, 4))
    for key, values in found.items():
        axis.plot(a[:, 0], values, label=key)
        axis.axhline(published[key], color="black", linestyle="--")
    axis.set(xlabel="t, s", ylabel="displacement of A, m")
    axis.legend()
    figure.tight_layout()
    figure.savefig(out / "beam-in-channel.png", dpi=130)


main()
