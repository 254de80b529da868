#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drives a flow round a coiled pipe and compares its friction with White's correlation.

Usage: validation/dean/compare.py [--deans DE ...] [--cells N] [--along N] [--out DIR]

A whole turn of a pipe of radius a = 1/2, its centreline a circle of radius R = 10: a ring without ends, so that the flow is
developed everywhere. The force G R/r along it, r the distance from the axis of the coil, is what a pressure that falls by G per
length of the centreline does. With U the mean velocity that comes of it, De = 2 a U/nu sqrt(a/R), friction over that of the
straight pipe at the same flow rate

  f_c/f_s = G a^2/(8 nu U)   against   1/(1 - [1 - (11.6/De)^0.45]^2.222)   [white_1929_streamline].

Writes DIR/dean.png (default validation/dean/results) and prints a table.
"""
import argparse
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import vtk
from vtk.util.numpy_support import vtk_to_numpy

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import run_text

A, R = 0.5, 10.0

CASE = """title = "Developed flow in a coiled pipe, De near {dean}"
[time]
end = {end}
step = 0.2
cfl = 1.0
[fluid]
density = 1.0
viscosity = {viscosity}
initial.velocity = ["-{start}*y/sqrt(x^2+y^2)", "{start}*x/sqrt(x^2+y^2)", 0.0]
body_force = ["-{force}*y/(x^2+y^2)", "{force}*x/(x^2+y^2)", 0.0]
[grid]
kind = "bent-pipe"
radius = 0.5
across = {cells}
start = [10.0, 0.0, 0.0]
direction = [0.0, 1.0, 0.0]
along = {{ cells = {along} }}
[[grid.piece]]
bend = {{ radius = 10.0, angle = 360, towards = [-1, 0, 0] }}
[boundary]
xi_min = {{ type = "wall" }}
xi_max = {{ type = "wall" }}
eta_min = {{ type = "wall" }}
eta_max = {{ type = "wall" }}
zeta_min = {{ type = "periodic" }}
zeta_max = {{ type = "periodic" }}
[pressure]
tolerance = "fast"
[output]
fields = {{ every = {every}, what = ["velocity"] }}
"""


def white(dean):
    return 1.0 / (1.0 - (1.0 - (11.6 / dean) ** 0.45) ** 2.222)


def mean_velocity(file):
    """Volume of the fluid that passes a section per time, over the circle's area: mean over the ring's sections."""
    reader = vtk.vtkXMLStructuredGridReader()
    reader.SetFileName(str(file))
    size = vtk.vtkCellSizeFilter()
    size.SetInputConnection(reader.GetOutputPort())
    centres = vtk.vtkCellCenters()
    centres.SetInputConnection(size.GetOutputPort())
    centres.Update()
    data = centres.GetOutput()
    x = vtk_to_numpy(data.GetPoints().GetData())
    u = vtk_to_numpy(data.GetPointData().GetArray("velocity"))
    volume = vtk_to_numpy(data.GetPointData().GetArray("Volume"))
    r = (x[:, 0] ** 2 + x[:, 1] ** 2) ** 0.5
    along = (u[:, 1] * x[:, 0] - u[:, 0] * x[:, 1]) / r
    # A cell of volume V is a piece V/(r dtheta) of the section: sum over the ring of u V/r = 2 pi Q.
    return float((along * volume / r).sum()) / (2.0 * math.pi) / (math.pi * A**2)


def computed(dean, cells, along, out):
    viscosity = 2.0 * A / (dean / math.sqrt(A / R))
    G = 8.0 * viscosity / A**2 * white(dean)
    # Six times 1/rate of the slowest decay of axial velocity in a straight pipe, rate = 5.78 nu/a^2.
    end = 6.0 * A**2 / (5.78 * viscosity)
    start = "2*(1-4*((sqrt(x^2+y^2)-10)^2+z^2))"
    text = CASE.format(dean=dean, end=end, every=end / 4, viscosity=viscosity, start=start, force=G * R, cells=cells, along=along)
    files = sorted((run_text(text, out / f"de-{dean}-{cells}-{along}") / "fields").glob("fields_*.vts"))
    before, U = mean_velocity(files[-2]), mean_velocity(files[-1])
    return 2.0 * A * U / viscosity * math.sqrt(A / R), G * A**2 / (8.0 * viscosity * U), abs(U - before) / U


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=36, help="from wall to wall")
    parser.add_argument("--along", type=int, default=24, help="cells along the whole turn")
    parser.add_argument("--deans", type=int, nargs="*", default=[50, 100, 200])
    parser.add_argument("--out", type=Path, default=here / "results")
    options = parser.parse_args()
    points = []
    for dean in options.deans:
        found, ratio, drift = computed(dean, options.cells, options.along, options.out)
        points.append((found, ratio))
        print(f"De {found:.1f} | {options.cells} cells across, {options.along} along | f_c/f_s {ratio:.4f} | White {white(found):.4f} | "
              f"{100 * (ratio / white(found) - 1):+.2f} % | U moved by {100 * drift:.2f} % over the last quarter")
    figure, axis = plt.subplots(figsize=(5, 4))
    deans = [15.0 * 1.05**n for n in range(70)]
    axis.loglog(deans, [white(d) for d in deans], "k-", lw=0.8, label="White 1929")
    axis.plot(*zip(*points), "o", label="luff")
    axis.set(xlabel="De", ylabel="f_c/f_s")
    axis.legend()
    figure.tight_layout()
    figure.savefig(options.out / "dean.png", dpi=130)


main()
