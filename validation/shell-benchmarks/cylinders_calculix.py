#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The pinched cylinder with end diaphragms (Sze, Liu & Lo 2004, section 3.6) solved by CalculiX as a thin solid.

Usage: validation/shell-benchmarks/pinched_cylinder_calculix.py [--cells 40 40] [--element C3D20R] [--grading 1 1] [--folder DIR]

An independent code and another model (no shell theory): one layer of 20-node bricks with reduced integration, or of 8-node
bricks with incompatible modes (C3D8I), St-Venant-Kirchhoff's law, an eighth as in
cases/shell-benchmarks/pinched-cylinder-diaphragms.toml. Prints -W_A and U_B beside the published table. The force acts on the
middle of the thickness, where a solid gives way locally, which U_B does not feel. Needs CalculiX (apt-get install calculix-ccx).
"""
import argparse
import csv
import math
import os
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parents[2]
radius, length, thickness, young, poisson, force = 100.0, 100.0, 1.0, 30000.0, 0.3, 3000.0
deepest = 86.0  # of -W_A under displacement control; 83.1 under full load in the table


def published():
    with open(root / "validation" / "data" / "sze2004_pinched_cylinder_diaphragms.csv") as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        return [(float(r["load_fraction"]), float(r["minus_W_A"]), float(r["U_B"])) for r in rows]


def graded(cells, growth):
    """2 cells + 1 stations in [0, 1], the last spacing `growth` times the first: corners even, middles odd."""
    ratio = growth ** (1 / (cells - 1))
    corners = [0.0]
    for n in range(cells):
        corners.append(corners[-1] + ratio**n)
    corners = [c / corners[-1] for c in corners]
    stations = [corners[0]]
    for a, b in zip(corners, corners[1:]):
        stations += [(a + b) / 2, b]
    return stations


class Grid:
    """Nodes of one layer of bricks by (around, along, through) half steps; 0, 1, 2 through the thickness."""

    def __init__(self, cells, grading, quadratic):
        self.n, self.m = 2 * cells[0], 2 * cells[1]
        self.angle = [0.5 * math.pi * s for s in graded(cells[0], grading[0])]
        self.x = [length * s for s in graded(cells[1], grading[1])]
        self.quadratic = quadratic
        self.number = {}

    def node(self, i, j, k):
        return self.number.setdefault((i, j, k), len(self.number) + 1)

    def position(self, i, j, k):
        r = radius + 0.5 * thickness * (k - 1)
        return self.x[j], r * math.sin(self.angle[i]), r * math.cos(self.angle[i])

    def elements(self):
        for i in range(0, self.n, 2):
            for j in range(0, self.m, 2):
                low = [(i, j), (i, j + 2), (i + 2, j + 2), (i + 2, j)]
                middle = [(i, j + 1), (i + 1, j + 2), (i + 2, j + 1), (i + 1, j)]
                nodes = [(*p, k) for k in (0, 2) for p in low]
                if self.quadratic:
                    nodes += [(*p, 0) for p in middle] + [(*p, 2) for p in middle] + [(*p, 1) for p in low]
                yield [self.node(*p) for p in nodes]


def support_lines(grid):
    """Symmetry in x, y and z; no motion of the middle surface in y and z at the diaphragm."""
    lines, equations = [], []
    for (i, j, k), n in list(grid.number.items()):
        lines += [f"{n},1,1"] * (j == 0) + [f"{n},2,2"] * (i == 0) + [f"{n},3,3"] * (i == grid.n)
        if j != grid.m:
            continue
        held = [c for c in (2, 3) if not (c == 2 and i == 0) and not (c == 3 and i == grid.n)]
        if k == 1:
            lines += [f"{n},{c},{c}" for c in held]
        elif k == 2 and (i, j, 1) not in grid.number:
            equations += [f"2\n{n},{c},1.,{grid.number[i, j, 0]},{c},1." for c in held]
    return lines, equations


def average_of_middle(grid, i, j):
    """Nodes whose mean is the middle surface at (i, j)."""
    return [grid.number[i, j, 1]] if (i, j, 1) in grid.number else [grid.number[i, j, k] for k in (0, 2)]


def write_drive(out, control, at_force, loads):
    """The step: all of the force, or of the displacement of where it acts, in proportion to time."""
    print("*STEP,NLGEOM,INC=2000\n*STATIC", file=out)
    if control == "force":
        print("0.025,1.,1e-5,0.025\n*CLOAD", *(f"{n},3,{-force / len(at_force)}" for n in at_force), sep="\n", file=out)
        print("*NODE PRINT,NSET=PROBES,TIME POINTS=T\nU,RF\n*END STEP", file=out)
    else:
        print("0.01,1.,1e-5,0.01\n*BOUNDARY", *(f"{n},3,3,{-deepest}" for n in at_force), sep="\n", file=out)
        print("*NODE PRINT,NSET=PROBES\nU,RF\n*END STEP", file=out)


def write_job(path, grid, kind, control, loads):
    elements = list(grid.elements())
    at_force, at_side = average_of_middle(grid, 0, 0), average_of_middle(grid, grid.n, 0)
    supports, equations = support_lines(grid)
    with open(path, "w") as out:
        print("*NODE,NSET=ALL", file=out)
        for key, n in grid.number.items():
            print(n, *(repr(x) for x in grid.position(*key)), sep=",", file=out)
        print(f"*ELEMENT,TYPE={kind},ELSET=SHELL", file=out)
        for e, nodes in enumerate(elements):
            words = [str(w) for w in (e + 1, *nodes)]
            print(",".join(words[:11]) + ("," if len(words) > 11 else ""), file=out)
            if len(words) > 11:
                print(",".join(words[11:]), file=out)
        print("*NSET,NSET=PROBES", *at_force, *at_side, sep="\n", file=out)
        print("*BOUNDARY", *supports, sep="\n", file=out)
        for equation in equations:
            print("*EQUATION", equation, sep="\n", file=out)
        print(f"*MATERIAL,NAME=M\n*ELASTIC\n{young},{poisson}\n*SOLID SECTION,ELSET=SHELL,MATERIAL=M", file=out)
        print("*TIME POINTS,NAME=T", *loads, sep="\n", file=out)
        write_drive(out, control, at_force, loads)
    return at_force, at_side


def read_probes(path):
    """[(time, {node: displacement}, {node: reaction})] of all increments that were printed."""
    increments, now = [], None
    for line in path.read_text().splitlines():
        words = line.split()
        if "time" in words:
            if line.lstrip().startswith("displacements"):
                increments.append((float(words[-1]), {}, {}))
            now = increments[-1][1 if line.lstrip().startswith("displacements") else 2]
        elif len(words) == 4 and words[0].isdigit():
            now[int(words[0])] = [float(w) for w in words[1:]]
    return increments


def path_of(increments, control, at_force, at_side):
    """(load factor, -W_A, U_B) from rest on."""
    path = [(0.0, 0.0, 0.0)]
    for now, u, reaction in increments:
        load = now if control == "force" else -sum(reaction[n][2] for n in at_force) / force
        w = -sum(u[n][2] for n in at_force) / len(at_force)
        path.append((load, w, sum(u[n][1] for n in at_side) / len(at_side)))
    return path


def at_load(path, load):
    """(-W_A, U_B) where the path first reaches the load, or none."""
    for (p0, *u0), (p1, *u1) in zip(path, path[1:]):
        if p1 >= load * (1 - 1e-9):
            return [a + (b - a) * (load - p0) / (p1 - p0) for a, b in zip(u0, u1)]
    return None


def main():
    parser = argparse.ArgumentParser(description="pinched cylinder with end diaphragms by CalculiX")
    parser.add_argument("--cells", type=int, nargs=2, default=[40, 40], help="around, along")
    parser.add_argument("--grading", type=float, nargs=2, default=[1.0, 1.0], help="last spacing over the first")
    parser.add_argument("--element", default="C3D20R", choices=["C3D20R", "C3D8I", "C3D8R"])
    parser.add_argument("--control", default="displacement", choices=["displacement", "force"])
    parser.add_argument("--folder", type=Path, default=Path("calculix"))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    table = published()
    grid = Grid(options.cells, options.grading, options.element == "C3D20R")
    probes = write_job(options.folder / "job.inp", grid, options.element, options.control, [row[0] for row in table])
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "CCX_NPROC_EQUATION_SOLVER": "1"}
    with open(options.folder / "job.log", "w") as log:
        status = subprocess.run(["ccx", "-i", "job"], cwd=options.folder, env=environment, stdout=log, check=False).returncode
    path = path_of(read_probes(options.folder / "job.dat"), options.control, *probes)
    print(f"{options.element}, {options.cells[0]} x {options.cells[1]}, grading {options.grading}, {options.control} control")
    print("load | -W_A | published | U_B | published")
    for load, w_a, u_b in table:
        computed = at_load(path, load)
        if computed:
            print(f"{load} | {computed[0]:.3f} | {w_a} | {computed[1]:.3f} | {u_b}")
    if status != 0:
        sys.exit(f"CalculiX stopped; see {options.folder / 'job.log'}")


main()
