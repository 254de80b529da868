#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Moves a plate over the grid at several angles and places, and prints mean and noise of its drag coefficient.

Usage: validation/moving-plate/compare.py [--edges partial] [--spacing H] [--step DT] [--waves A] [--out DIR]

The flow is smooth in time; what a running cubic over 4h/U leaves of the drag after t = 0.8 is noise of the grid: single links
change hands at single instants.  Forces are those of forces-plate.csv, at the ends of steps, with pressures interpolated between the
middles of steps.  With --waves the grid is a curvilinear one, whose nodes are moved by up to A: cells along and across the way differ in
size by up to 1.8 pi A and are skewed; with A = 0 it is the same box, given by its nodes.

Runs into DIR (default validation/moving-plate/results) what is not there yet, prints a table, and writes DIR/drag.png.
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
from comparison import columns, refined_axis, run

settled = 0.8
# Angle, place, and the noise of the two-dimensional prototype of this scheme with its first law of the offset, the baseline.
plates = (
    (90, (0.007, 0.003), 0.556),
    (70, (0.007, 0.003), 0.137),
    (70, (0.02, 0.02), 0.110),
    (45, (0.007, 0.003), 0.265),
    (45, (0.02, 0.01), 0.617),
    (20, (0.007, 0.003), 0.194),
    (20, (0.01, 0.017), 0.283),
)


def case_file(arguments):
    """That of this folder, or one whose sides have the names of a curvilinear grid's."""
    if arguments.waves is None:
        return here / "case.toml"
    text = (here / "case.toml").read_text()
    for box, mapped in (("x", "xi"), ("y", "eta"), ("z", "zeta")):
        text = text.replace(f"\n{box}_min", f"\n{mapped}_min").replace(f"\n{box}_max", f"\n{mapped}_max")
    arguments.out.mkdir(parents=True, exist_ok=True)
    file = arguments.out / "curvilinear.toml"
    file.write_text(text)
    return file


def grid_settings(arguments):
    if arguments.waves is None:
        return []
    wave = "sin(pi * x) * sin(pi * y)"
    return [
        'grid.kind="mapped-box"',
        f'grid.map=["x + {arguments.waves} * {wave}", "y + {0.8 * arguments.waves} * {wave}", "z"]',
    ]


def settings(angle, place, arguments):
    h = arguments.spacing
    return grid_settings(arguments) + [
        "grid.x=" + refined_axis(-5.0, 4.0, round(4.0 / h) + 32, (-2.8, 1.2), h),
        "grid.y=" + refined_axis(-3.0, 3.0, round(1.6 / h) + 34, (-0.8, 0.8), h),
        f"body.plate.mesh.divisions=[{round(1.0 / h)}, 1]",
        f"body.plate.rotate.angle={angle}",
        f"body.plate.translate=[{place[0]}, {place[1]}, 0]",
        f"time.step={arguments.step}",
        f"immersed.edges={arguments.edges}",
        "output.plots=false",
    ]


def noise(t, c, window):
    """Root mean square of what a cubic over the window leaves in its middle."""
    half = round(0.5 * window / (t[1] - t[0]))
    weights = np.linalg.pinv(np.vander(np.arange(-half, half + 1) / half, 4, increasing=True))[0]
    left = c[half:-half] - np.convolve(c, weights[::-1], "valid")
    return np.sqrt(np.mean(left[t[half:-half] > settled + 0.5 * window] ** 2))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--edges", choices=("whole", "partial"), default="whole")
    parser.add_argument("--spacing", type=float, default=0.04, metavar="H", help="of the cells around the plate")
    parser.add_argument("--step", type=float, default=0.005, metavar="DT")
    parser.add_argument("--waves", type=float, metavar="A", help="on a curvilinear grid")
    parser.add_argument("--out", type=Path, default=here / "results")
    arguments = parser.parse_args()
    case = case_file(arguments)
    figure, axis = plt.subplots(figsize=(9, 6))
    print("angle | place | mean C_d | noise | prototype's first law")
    for angle, place, prototype in plates:
        name = f"{angle}-{place[0]}-{place[1]}-{arguments.edges}-{arguments.spacing}-{arguments.step}"
        if arguments.waves is not None:
            name += f"-{arguments.waves}"
        forces = columns(run(case, arguments.out / name, settings(angle, place, arguments)) / "forces-plate.csv")
        t, c = forces["t"], 2.0 * forces["force_x"] / 0.04
        window = 4.0 * arguments.spacing
        print(f"{angle} | {place} | {c[t > settled].mean():.3f} | {noise(t, c, window):.3f} | {prototype}")
        axis.plot(t[t > settled], c[t > settled], label=f"{angle} degrees, {place}", lw=0.8)
    axis.set(xlabel="t U/L", ylabel="drag coefficient")
    axis.legend()
    figure.tight_layout()
    figure.savefig(arguments.out / "drag.png", dpi=130)


main()
