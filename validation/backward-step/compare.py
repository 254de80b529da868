#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the plane flow over a backward-facing step and compares where it separates and reattaches.

Usage: validation/backward-step/compare.py [--reynolds RE ...] [--cells N] [--out DIR]

A channel of height 1 (twice the step h) that begins ten step heights before the step with a parabola of mean velocity 1 between
the step and the upper wall; Re = 2 h U/nu. The step is a sheet along y = 1/2 and x = 0; the fluid below and before it is sealed
off; the outflow is 50 h behind it. Against Erturk (2008), finite differences, the inlet 20 h before the step: where the flow
separates and reattaches, and at Re = 800 the profiles of u and v at x/h = 6, 14, 30; and against the experiment of Armaly et al.
(1983) at the nearest Re (expansion 1.94, three-dimensional above Re of about 400). Positions are zeros of the walls' shear stress
(output.walls), in step heights. Writes DIR/backward-step.png (default validation/backward-step/results) and prints a table.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import published, run_text

H_STEP = 0.5

CASE = """title = "Backward-facing step, Re = {reynolds}"
[time]
end = {end}
step = 0.05
cfl = 1.0
[fluid]
density = 1.0
viscosity = {viscosity}
initial.velocity = ["x > 0 ? 3*y*(1-y) : (y > 0.5 ? 24*(1-y)*(y-0.5) : 0)", 0.0, 0.0]
[grid]
x = {{ from = -5.0, to = 25.0, cells = {along}, refine = {{ from = -0.5, to = {fine}, spacing = {spacing} }} }}
y = {{ from = 0.0, to = 1.0, cells = {cells} }}
z = {{ from = 0.0, to = {spacing}, cells = 1 }}
[boundary]
x_min = {{ type = "velocity", value = ["y > 0.5 ? 24*(1-y)*(y-0.5) : 0", 0.0, 0.0] }}
x_max = {{ type = "outflow" }}
y_min = {{ type = "wall" }}
y_max = {{ type = "wall" }}
z_min = {{ type = "symmetry" }}
z_max = {{ type = "symmetry" }}
[pressure]
tolerance = "fast"
[[body]]
name = "top"
mesh = {{ shape = "rectangle", origin = [-4.999, 0.5, 0], a = [4.999, 0, 0], b = [0, 0, {spacing}], divisions = [1, 1] }}
[[body]]
name = "face"
mesh = {{ shape = "rectangle", origin = [0, 0.001, 0], a = [0, 0.499, 0], b = [0, 0, {spacing}], divisions = [1, 1] }}
[output]
walls = {{ every = {every} }}
fields = {{ every = {end}, what = ["velocity"] }}
"""


def shear_along(file, side):
    """[(x/h, shear)] along a wall, downstream of the step."""
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    centres = vtk.vtkCellCenters()
    centres.SetInputConnection(reader.GetOutputPort())
    centres.Update()
    data = centres.GetOutput()
    x = vtk_to_numpy(data.GetPoints().GetData())[:, 0]
    shear = vtk_to_numpy(data.GetPointData().GetArray("shear_stress"))[:, 0]
    sides = vtk_to_numpy(data.GetPointData().GetArray("side"))
    return sorted((a / H_STEP, s) for a, s, w in zip(x, shear, sides) if w == side and a > 0.0)


def zeros(points, rising):
    found = []
    for (a, s), (b, t) in zip(points, points[1:]):
        if (s < 0.0 <= t) if rising else (s >= 0.0 > t):
            found.append(a - s * (b - a) / (t - s))
    return found


def positions(file):
    """X1, and X2, X3 of the eddy on the upper wall if there is one: the first zeros from the step on, the corner's eddy passed over."""
    lower, upper = shear_along(file, 2), shear_along(file, 3)
    apart = zeros(upper, rising=False)[:1]
    return zeros([point for point in lower if point[0] > 1.0], rising=True)[:1] + (
        apart + [x for x in zeros(upper, rising=True) if x > apart[0]][:1] if apart else [])


def velocity_along(folder, x_over_h):
    """y, u, v of the last fields at the centres of cells, straight between the two columns beside x."""
    reader = vtk.vtkXMLRectilinearGridReader()
    reader.SetFileName(str(sorted((folder / "run" / "fields").glob("fields_*.vtr"))[-1]))
    reader.Update()
    grid = reader.GetOutput()
    x, y = (vtk_to_numpy(c) for c in (grid.GetXCoordinates(), grid.GetYCoordinates()))
    x, y = 0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1])
    velocity = vtk_to_numpy(grid.GetCellData().GetArray("velocity")).reshape(len(y), len(x), 3)
    return y, *(np.array([np.interp(x_over_h * H_STEP, x, row) for row in velocity[:, :, d]]) for d in range(2))


def compare_profiles(folder, axis):
    """Differences from Erturk's profiles, values of ours from a cubic through the four nearest centres."""
    rows = [row for row in published("backward_step_Re800_profiles.csv") if row["source"] == "Erturk2008"]
    for station in (6, 14, 30):
        y, *velocity = velocity_along(folder, station)
        points = [(float(row["y_over_H"]), float(row["u"]), float(row["v"])) for row in rows
                  if float(row["x_over_h"]) == station and 0.0 < float(row["y_over_H"]) < 1.0]
        for n, component in enumerate("uv"):
            ours = [cubic(y, velocity[n], point[0]) for point in points]
            theirs = np.array([point[1 + n] for point in points])
            print(f"Re 800 | {component} at x/h = {station} | largest difference {100 * max(abs(ours - theirs)):.2f} %, rms "
                  f"{100 * np.sqrt(np.mean((ours - theirs) ** 2)):.2f} % of U | largest value {max(abs(theirs)):.3f} | Erturk")
        axis.plot(velocity[0], y, "-", lw=1, label=f"x/h = {station}")
        axis.plot([point[1] for point in points], [point[0] for point in points], ".", color=axis.lines[-1].get_color())
    axis.set(xlabel="u/U", ylabel="y/H", title="Re 800; dots: Erturk 2008")
    axis.legend()


def cubic(x, values, at):
    """Lagrange's cubic through the four points around."""
    first = min(max(np.searchsorted(x, at) - 2, 0), len(x) - 4)
    near = range(first, first + 4)
    return sum(values[m] * np.prod([(at - x[k]) / (x[m] - x[k]) for k in near if k != m]) for m in near)


def computed(reynolds, cells, out):
    folder = out / f"re-{reynolds}-{cells}"
    end = 0.5 * reynolds
    # Along the channel; across it cells are 1/cells wide. At Re = 800 the shear layers amplify what disturbs them: cells
    # stay as long as they are down to the outflow.
    spacing, fine, growing = (2.5 / cells, 25.0, 30) if reynolds > 500 else (2.0 / cells, 6.0, 60)
    text = CASE.format(reynolds=reynolds, end=end, every=end / 8, viscosity=1.0 / reynolds, cells=cells, fine=fine,
                       spacing=spacing, along=round((fine + 0.5) / spacing) + growing)
    files = sorted((run_text(text, folder) / "walls").glob("walls_*.vtp"))
    return positions(files[-1]), positions(files[-2]), files[-1], folder


def reference(reynolds):
    for row in published("erturk2008_backward_step.csv"):
        if int(row["Re"]) == reynolds:
            return [float(row[name]) for name in ("X1", "X2", "X3")]
    raise SystemExit(f"Erturk (2008) has no Re = {reynolds}")


def measured(reynolds):
    """Re and X1 of the experiment nearest to it."""
    rows = [(float(row["Re"]), float(row["X1_over_h"])) for row in published("armaly1983_backward_step.csv")]
    return min(rows, key=lambda row: abs(row[0] - reynolds))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reynolds", type=int, nargs="*", default=[400, 800])
    parser.add_argument("--cells", type=int, default=64, help="across the channel")
    parser.add_argument("--out", type=Path, default=here / "results")
    options = parser.parse_args()
    figure, (axis, profiles) = plt.subplots(1, 2, figsize=(12, 4), width_ratios=(2, 1))
    for reynolds in options.reynolds:
        now, before, file, folder = computed(reynolds, options.cells, options.out)
        for name, x, was, theirs in zip(("X1", "X2", "X3"), now, before, reference(reynolds)):
            print(f"Re {reynolds} | {options.cells} cells | {name}/h {x:.3f} | Erturk {theirs} | "
                  f"{100 * (x / theirs - 1):+.2f} % | moved by {x - was:+.3f} over the last eighth")
        print("Re {} | X1/h {:.3f} | Armaly et al., Re {}: {}".format(reynolds, now[0], *measured(reynolds)))
        if reynolds == 800:
            compare_profiles(folder, profiles)
        for side, style in ((2, "-"), (3, "--")):
            axis.plot(*zip(*shear_along(file, side)), style, lw=1, label=f"Re {reynolds}, side {side}")
    axis.axhline(0.0, color="k", lw=0.5)
    axis.set(xlabel="x/h", ylabel="shear stress on the wall", xlim=(0, 35))
    axis.legend()
    figure.tight_layout()
    figure.savefig(options.out / "backward-step.png", dpi=130)


main()
