#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the thick plate in a channel and compares where its point A comes to rest with solids4foam's tutorial beamInCrossFlow.

Usage: validation/beam-in-channel/compare.py [--out DIR] [--set KEY=VALUE ...]

Runs case.toml into DIR/run (default validation/beam-in-channel/results) unless it is there already, prints a table, and writes
DIR/beam-in-channel.png.  The plate is half as thick as it is high: what a shell leaves out of it, the shear and the squeezing of
its section, is measured with the plate alone under an even pressure on its front, by luff (dry.toml) and by CalculiX as a solid
of 20-node bricks.  A, on the front face, half the thickness h before the middle surface, moves with its height's slope dw/dy:
(w, h/2 dw/dy) for the small w of the plate alone.
Needs CalculiX (apt-get install calculix-ccx).
"""
import argparse
import os
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import columns, run

size = {"x": 0.1, "y": 0.2, "z": 0.2}  # of half the plate, from its front, the floor and the plane of symmetry
young, poisson, pressure = 1e4, 0.4, 60.0  # as in dry.toml
published = {"x": 0.01463, "y": 0.005, "z": -0.000447}  # solids4foam, tutorials/fluidSolidInteraction/beamInCrossFlow


def displacements(table):
    """Of a point over time, or over the load."""
    return np.stack(list(columns(table).values())[:4], axis=1)


def as_a_shell(out):
    """x and y of A of the plate alone."""
    a, below, above = (displacements(out / f"probe-{name}.csv")[-1] for name in ("a", "below", "above"))
    return a[1], 0.5 * size["x"] * (above[1] - below[1]) / (0.0125 + above[2] - below[2])


def as_a_solid(folder, cells=(8, 16, 16)):
    """The same by CalculiX: bricks with nodes at half steps; 1 to 3 are x, y and z."""
    folder.mkdir(parents=True, exist_ok=True)
    number = {}

    def node(*at):
        return number.setdefault(at, len(number) + 1)

    bricks = []
    for i, j, k in np.ndindex(*cells):
        i, j, k = 2 * i, 2 * j, 2 * k
        low = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]
        middle = [(i + 1, j), (i + 2, j + 1), (i + 1, j + 2), (i, j + 1)]
        places = [(*p, k) for p in low] + [(*p, k + 2) for p in low] + [(*p, k) for p in middle]
        places += [(*p, k + 2) for p in middle] + [(*p, k + 1) for p in low]
        bricks.append([node(*p) for p in places])
    front = [e + 1 for e, (i, _, _) in enumerate(np.ndindex(*cells)) if i == 0]
    a = node(0, 3 * cells[1] // 2, 3 * cells[2] // 2)
    with open(folder / "job.inp", "w") as job:
        print("*NODE,NSET=ALL", file=job)
        for at, n in number.items():
            print(n, *(f"{size[d] * s / (2 * c):.10f}" for d, s, c in zip("xyz", at, cells)), sep=",", file=job)
        print("*ELEMENT,TYPE=C3D20R,ELSET=E", file=job)
        for e, nodes in enumerate(bricks):
            words = [str(w) for w in (e + 1, *nodes)]
            print(",".join(words[:11]) + ",", ",".join(words[11:]), sep="\n", file=job)
        print(f"*MATERIAL,NAME=M\n*ELASTIC\n{young},{poisson}\n*SOLID SECTION,ELSET=E,MATERIAL=M\n*NSET,NSET=A\n{a}\n*BOUNDARY", file=job)
        for (_, j, k), n in number.items():
            print(*([f"{n},1,3"] if j == 0 else [f"{n},3,3"] if k == 0 else []), sep="\n", end="\n" if j * k == 0 else "", file=job)
        print("*STEP,NLGEOM\n*STATIC\n0.5,1.\n*DLOAD", *(f"{e},P6,{pressure}" for e in front), "*NODE PRINT,NSET=A\nU\n*END STEP", sep="\n", file=job)
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "CCX_NPROC_EQUATION_SOLVER": "1"}
    subprocess.run(["ccx", "-i", "job"], cwd=folder, env=environment, stdout=subprocess.DEVNULL, check=True)
    rows = [line.split() for line in (folder / "job.dat").read_text().splitlines()]
    return [[float(w) for w in row[1:]] for row in rows if len(row) == 4 and row[0] == str(a)][-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    parser.add_argument("--set", dest="settings", action="append", default=[])
    arguments = parser.parse_args()
    a = displacements(run(here / "case.toml", arguments.out / "run", arguments.settings) / "probe-a.csv")
    shell, solid = as_a_shell(run(here / "dry.toml", arguments.out / "dry")), as_a_solid(arguments.out / "solid")
    print(f"A alone under {pressure:g} Pa | as a shell | as a solid | ratio")
    for key, ours, theirs in zip("xy", shell, solid):
        print(f"{key} | {ours:.5f} | {theirs:.5f} | {theirs / ours:.3f}")
    print("A in the flow | luff | published | difference | times the ratio")
    late = a[:, 0] > 0.9 * a[-1, 0]
    figure, axis = plt.subplots(figsize=(8, 4))
    for n, key in enumerate("xyz"):
        u = np.mean(a[late, 1 + n])
        line = f"{key} | {u:.6f} | {published[key]} | {100 * (u / published[key] - 1):+.1f} %"
        if key != "z":
            line += f" | {100 * (u * solid[n] / shell[n] / published[key] - 1):+.1f} %"
        print(line)
        axis.plot(a[:, 0], a[:, 1 + n], label=key)
        axis.axhline(published[key], color="black", linestyle="--")
    print(f"x moved by {100 * np.ptp(a[late, 1]) / np.mean(a[late, 1]):.1f} % in the last tenth of the run")
    axis.set(xlabel="t, s", ylabel="displacement of A, m")
    axis.legend()
    figure.tight_layout()
    figure.savefig(arguments.out / "beam-in-channel.png", dpi=130)


main()
