#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the sphere in a stream and compares drag, lift, frequency and wake length with published figures.

Usage: validation/sphere/compare.py [--re RE ...] [--spacing H] [--wake X] [--end T] [--out DIR]

Half a sphere of diameter 1, immersed, on a plane of symmetry z = 0, in a stream U = 1: the wake at Re = 300 has such a plane.
At Re = 100 it is steady; at Re = 300 the initial velocity has a cross-stream part behind the sphere, which starts the shedding.
Writes DIR/sphere.png (default validation/sphere/results) and prints a table.
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
from comparison import columns, published, run_text

REAR, CENTRE_Y = 0.503, 0.007
quantities = {"Cd_mean": "C_d", "Cl_mean": "C_l", "St": "St", "L_over_D": "wake length/D"}

CASE = """title = "Sphere in a stream, Re = {reynolds}"
[time]
end = {end}
step = 0.03
cfl = 0.9
[fluid]
density = 1.0
viscosity = {viscosity}
initial.velocity = [1.0, "{nudge}*exp(-(x-1.5)^2-y^2-z^2)", 0.0]
[grid]
x = {{ from = -10.0, to = 20.0, cells = {along}, refine = {{ from = -0.8, to = {wake}, spacing = {spacing} }} }}
y = {{ from = -10.0, to = 10.0, cells = {high}, refine = {{ from = -0.76, to = 0.76, spacing = {spacing} }} }}
z = {{ from = 0.0, to = 10.0, cells = {deep}, refine = {{ from = 0.0, to = 0.76, spacing = {spacing} }} }}
[boundary]
x_min = {{ type = "velocity", value = [1.0, 0.0, 0.0] }}
x_max = {{ type = "outflow" }}
y_min = {{ type = "slip" }}
y_max = {{ type = "slip" }}
z_min = {{ type = "symmetry" }}
z_max = {{ type = "slip" }}
[[body]]
name = "sphere"
mesh = {{ shape = "sphere-cap", centre = [0.003, 0.007, 0], axis = [0, 0, 1], radius = 0.5, polar = {{ from = 0, to = 90 }}, rings = 24 }}
closed = true
[output]
fields = {{ every = {every}, what = ["velocity", "pressure", "vorticity", "q_criterion"] }}
shells = {{ every = {every} }}
plots = true
[pressure]
tolerance = "fast"
"""


def references(re):
    return [row for row in published("sphere_static.csv") if float(row["Re"]) == re]


def text_of(re, spacing, wake, end):
    equal = [round(length / spacing) for length in (0.8 + wake, 1.52, 0.76)]
    finer = 0.04 / spacing  # cells in the stretched parts go with it: the same growth in less of a cell
    return CASE.format(reynolds=f"{re:g}", viscosity=1 / re, end=end, every=10.0, nudge=0.0 if re < 210 else 0.2,
                       spacing=spacing, wake=wake, along=equal[0] + round(76 * finer), high=equal[1] + round(40 * finer),
                       deep=equal[2] + round(20 * finer))


def coefficients(out):
    """t, C_d, C_l of the whole sphere: twice what the half of it feels."""
    forces = columns(out / "forces-sphere.csv")
    scale = 2 / (0.5 * np.pi / 4)
    return forces["t"], scale * forces["force_x"], scale * forces["force_y"]


def wake_length(out):
    """Where u changes sign behind the sphere on its axis, from its rear, in the last fields."""
    reader = vtk.vtkXMLRectilinearGridReader()
    reader.SetFileName(str(sorted((out / "fields").glob("fields_*.vtr"))[-1]))
    reader.Update()
    grid = reader.GetOutput()
    x, y = (vtk_to_numpy(c) for c in (grid.GetXCoordinates(), grid.GetYCoordinates()))
    x, y = 0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1])
    first_layer = vtk_to_numpy(grid.GetCellData().GetArray("velocity"))[: len(x) * len(y), 0].reshape(len(y), len(x))
    line = np.array([np.interp(CENTRE_Y, y, column) for column in first_layer.T])
    n = np.flatnonzero((x > REAR + 0.1) & (line > 0))[0]
    return x[n - 1] - line[n - 1] * (x[n] - x[n - 1]) / (line[n] - line[n - 1]) - REAR


def measured(re, out):
    t, drag, lift = coefficients(out)
    if re < 210:
        return {"Cd_mean": drag[-1], "L_over_D": wake_length(out)}, (t, drag, lift)
    # From minimum to minimum of the lift, whose amplitude is modulated: its mean isn't crossed in every period.
    even = np.arange(t[0], t[-1], 0.05)
    smooth = np.convolve(np.interp(even, t, lift), np.full(11, 1 / 11), "same")
    swing = np.interp(t, even, np.gradient(smooth))
    ups = np.flatnonzero((swing[:-1] < 0) & (swing[1:] >= 0) & (t[1:] > 0.6 * t[-1]))
    crossings = t[ups] - swing[ups] * (t[ups + 1] - t[ups]) / (swing[ups + 1] - swing[ups])
    window = (t >= crossings[0]) & (t <= crossings[-1])  # whole periods
    steps = np.gradient(t)[window]
    return {
        "Cd_mean": np.average(drag[window], weights=steps),
        "Cl_mean": abs(np.average(lift[window], weights=steps)),
        "St": (len(crossings) - 1) / (crossings[-1] - crossings[0]),
    }, (t, drag, lift)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    parser.add_argument("--re", type=float, nargs="+", default=[100, 300])
    parser.add_argument("--spacing", type=float, default=0.05, help="of the cells around the sphere, in its diameter")
    parser.add_argument("--wake", type=float, default=2.0, help="up to where they go behind its centre")
    parser.add_argument("--end", type=float, help="of the runs; default 40 at Re = 100, 110 at Re = 300")
    arguments = parser.parse_args()
    figure, axes = plt.subplots(len(arguments.re), 1, figsize=(8, 3 * len(arguments.re)), squeeze=False)
    print("Re | quantity | luff | published | from")
    for axis, re in zip(axes[:, 0], arguments.re):
        text = text_of(re, arguments.spacing, arguments.wake, arguments.end or (40.0 if re < 210 else 110.0))
        values, (t, drag, lift) = measured(re, run_text(text, arguments.out / f"re{re:g}-{arguments.spacing:g}"))
        for key, value in values.items():
            rows = [row for row in references(re) if row[key]]
            print(f"{re:g} | {quantities[key]} | {value:.4f} | {', '.join(row[key] for row in rows)} | "
                  f"{'; '.join(row['source'] for row in rows)}")
        axis.plot(t, drag, label="$C_d$")
        axis.plot(t, lift, label="$C_l$")
        axis.set(title=f"Re = {re:g}", xlabel="t U/D", ylim=(-0.2, 1.5))
        axis.legend()
    figure.tight_layout()
    figure.savefig(arguments.out / "sphere.png", dpi=130)


main()
