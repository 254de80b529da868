#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two cylinders of Sze, Liu & Lo (2004), pulled out (section 3.5) and pinched (3.6), solved by CalculiX as thin solids.

Usage: validation/shell-benchmarks/cylinders_calculix.py pulled|pinched [--cells 40 40] [--element C3D20R] [--grading 1 1]
           [--stiffened FACTOR] [--increment PART] [--until DISPLACEMENT] [--folder DIR]

An independent code and another model (no shell theory): one layer of 20-node bricks with reduced integration, or of 8-node
bricks with incompatible modes (C3D8I), St-Venant-Kirchhoff's law, an eighth as in
cases/shell-benchmarks/{pullout-open-cylinder,pinched-cylinder-diaphragms}.toml. Prints displacements beside the published table,
between increments on straight lines; DIR/path.csv has the increments themselves.

The force acts on the middle of the thickness, where a solid gives way locally: by shear across the thickness without bound as
the mesh is refined, and by being squeezed. --stiffened multiplies the three moduli across the thickness and leaves those of the
surface alone (Poisson's ratios between the two are zero then): a large factor makes the solid one of Kirchhoff and Love.
Needs CalculiX (apt-get install calculix-ccx).
"""
import argparse
import csv
import math
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from comparison import published


@dataclass
class Curve:
    """`sign` times displacement `component` (1 to 3) of a corner: "force", "side" (force turned by 90 degrees), "end" of it."""

    label: str
    corner: str
    component: int
    sign: float
    column: str


@dataclass
class Problem:
    radius: float
    length: float  # half of it
    thickness: float
    young: float
    poisson: float
    force: float  # a quarter of it; outwards where positive
    farthest: float  # displacement of A in its direction, under control of it
    increment: float  # of that, the largest
    diaphragm: bool
    table: str
    curves: list

    def points(self):
        return [(float(r["load_fraction"]), *(float(r[c.column]) for c in self.curves)) for r in published(self.table)]


PROBLEMS = {
    "pulled": Problem(4.953, 5.175, 0.094, 10.5e6, 0.3125, 10000.0, 2.8, 0.02, False, "sze2004_pullout_open_cylinder.csv",
                      [Curve("W_A", "force", 3, 1, "W_A"), Curve("-U_B", "side", 2, -1, "minus_U_B"),
                       Curve("-U_C", "end", 2, -1, "minus_U_C")]),
    "pinched": Problem(100.0, 100.0, 1.0, 30000.0, 0.3, -3000.0, -86.0, 0.01, True, "sze2004_pinched_cylinder_diaphragms.csv",
                       [Curve("-W_A", "force", 3, -1, "minus_W_A"), Curve("U_B", "side", 2, 1, "U_B")]),
}


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

    def __init__(self, problem, cells, grading, quadratic):
        self.problem = problem
        self.n, self.m = 2 * cells[0], 2 * cells[1]
        self.angle = [0.5 * math.pi * s for s in graded(cells[0], grading[0])]
        self.x = [problem.length * s for s in graded(cells[1], grading[1])]
        self.quadratic = quadratic
        self.number = {}

    def node(self, i, j, k):
        return self.number.setdefault((i, j, k), len(self.number) + 1)

    def position(self, i, j, k):
        r = self.problem.radius + 0.5 * self.problem.thickness * (k - 1)
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
    """Symmetry in x, y and z; no motion of the middle surface in y and z at a diaphragm."""
    lines, equations = [], []
    for (i, j, k), n in list(grid.number.items()):
        lines += [f"{n},1,1"] * (j == 0) + [f"{n},2,2"] * (i == 0) + [f"{n},3,3"] * (i == grid.n)
        if j != grid.m or not grid.problem.diaphragm:
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


def material_lines(problem, stiffened):
    """Isotropic, or with the moduli across the thickness (the first axis, along the radius) times a factor."""
    young, nu = problem.young, problem.poisson
    if stiffened == 1:
        return [f"*MATERIAL,NAME=M\n*ELASTIC\n{young},{nu}\n*SOLID SECTION,ELSET=SHELL,MATERIAL=M"]
    shear = 0.5 * young / (1 + nu)
    return ["*ORIENTATION,NAME=O,SYSTEM=CYLINDRICAL\n0.,0.,0.,1.,0.,0.\n*MATERIAL,NAME=M\n*ELASTIC,TYPE=ENGINEERING CONSTANTS",
            f"{stiffened * young},{young},{young},0.,0.,{nu},{stiffened * shear},{stiffened * shear}", f"{shear},293.",
            "*SOLID SECTION,ELSET=SHELL,MATERIAL=M,ORIENTATION=O"]


def drive_lines(problem, control, at_force, loads):
    """The step: all of the force, or of the displacement of where it acts, in proportion to time."""
    if control == "force":
        return ["*TIME POINTS,NAME=T", *loads, "*STEP,NLGEOM,INC=2000\n*STATIC", "0.025,1.,1e-5,0.025\n*CLOAD",
                *(f"{n},3,{problem.force / len(at_force)}" for n in at_force),
                "*NODE PRINT,NSET=PROBES,TIME POINTS=T\nU,RF\n*END STEP"]
    return ["*STEP,NLGEOM,INC=2000\n*STATIC", f"0.01,1.,1e-5,{problem.increment}\n*BOUNDARY",
            *(f"{n},3,3,{problem.farthest}" for n in at_force), "*NODE PRINT,NSET=PROBES\nU,RF\n*END STEP"]


def write_job(path, grid, kind, control, stiffened, loads):
    """\returns the nodes whose mean is each corner"""
    elements = list(grid.elements())
    corners = {"force": average_of_middle(grid, 0, 0), "side": average_of_middle(grid, grid.n, 0),
               "end": average_of_middle(grid, grid.n, grid.m)}
    supports, equations = support_lines(grid)
    with open(path, "w") as out:
        print("*NODE,NSET=ALL", file=out)
        for key, n in grid.number.items():
            print(n, *(f"{x:.12f}" for x in grid.position(*key)), sep=",", file=out)  # CalculiX reads 20 characters
        print(f"*ELEMENT,TYPE={kind},ELSET=SHELL", file=out)
        for e, nodes in enumerate(elements):
            words = [str(w) for w in (e + 1, *nodes)]
            print(",".join(words[:11]) + ("," if len(words) > 11 else ""), file=out)
            if len(words) > 11:
                print(",".join(words[11:]), file=out)
        print("*NSET,NSET=PROBES", *(n for nodes in corners.values() for n in nodes), sep="\n", file=out)
        print("*BOUNDARY", *supports, sep="\n", file=out)
        for equation in equations:
            print("*EQUATION", equation, sep="\n", file=out)
        print(*material_lines(grid.problem, stiffened), sep="\n", file=out)
        print(*drive_lines(grid.problem, control, corners["force"], loads), sep="\n", file=out)
    return corners


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


def path_of(problem, increments, control, corners):
    """(load factor, displacements of the curves) from rest on."""
    path = [(0.0, *(0.0 for _ in problem.curves))]
    for now, u, reaction in increments:
        load = now if control == "force" else sum(reaction[n][2] for n in corners["force"]) / problem.force
        nodes = [(curve, corners[curve.corner]) for curve in problem.curves]
        path.append((load, *(c.sign * sum(u[n][c.component - 1] for n in at) / len(at) for c, at in nodes)))
    return path


def at_load(path, load):
    """Displacements where the path first reaches the load, or none."""
    for (p0, *u0), (p1, *u1) in zip(path, path[1:]):
        if p1 >= load * (1 - 1e-9):
            return [a + (b - a) * (load - p0) / (p1 - p0) for a, b in zip(u0, u1)]
    return None


def main():
    parser = argparse.ArgumentParser(description="two cylinders of Sze, Liu & Lo (2004) by CalculiX, as solids")
    parser.add_argument("problem", choices=PROBLEMS)
    parser.add_argument("--cells", type=int, nargs=2, default=[40, 40], help="around, along")
    parser.add_argument("--grading", type=float, nargs=2, default=[1.0, 1.0], help="last spacing over the first")
    parser.add_argument("--element", default="C3D20R", choices=["C3D20R", "C3D8I", "C3D8R"])
    parser.add_argument("--stiffened", type=float, default=1.0, help="multiplies the moduli across the thickness")
    parser.add_argument("--control", default="displacement", choices=["displacement", "force"])
    parser.add_argument("--increment", type=float, help="largest, as a part of the step under displacement control")
    parser.add_argument("--until", type=float, help="displacement of A in its direction under displacement control")
    parser.add_argument("--folder", type=Path, default=Path("calculix"))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    problem = PROBLEMS[options.problem]
    problem.increment = options.increment or problem.increment
    problem.farthest = math.copysign(options.until, problem.force) if options.until else problem.farthest
    table = problem.points()
    grid = Grid(problem, options.cells, options.grading, options.element == "C3D20R")
    corners = write_job(options.folder / "job.inp", grid, options.element, options.control, options.stiffened,
                        [row[0] for row in table])
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "CCX_NPROC_EQUATION_SOLVER": "1"}
    with open(options.folder / "job.log", "w") as log:
        status = subprocess.run(["ccx", "-i", "job"], cwd=options.folder, env=environment, stdout=log, check=False).returncode
    path = path_of(problem, read_probes(options.folder / "job.dat"), options.control, corners)
    with open(options.folder / "path.csv", "w") as file:
        csv.writer(file).writerows([["load_fraction", *(curve.label for curve in problem.curves)], *path])
    print(f"{options.problem}, {options.element}, {options.cells[0]} x {options.cells[1]}, grading {options.grading}, "
          f"{options.control} control, moduli across the thickness times {options.stiffened:g}")
    print("load", *(f"{curve.label} | published" for curve in problem.curves), sep=" | ")
    for load, *theirs in table:
        computed = at_load(path, load)
        if computed:
            print(load, *(f"{u:.4f} | {p}" for u, p in zip(computed, theirs)), sep=" | ")
    if status != 0:
        sys.exit(f"CalculiX stopped; see {options.folder / 'job.log'}")


main()
