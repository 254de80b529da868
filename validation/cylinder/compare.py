#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the cylinder in a stream and compares drag, lift, frequency and wake length with published figures.

Usage: validation/cylinder/compare.py [--out DIR] [--re RE ...] [--spacing H] [--set KEY=VALUE ...]

Runs cases/cylinder/case.toml with other viscosities and spacings into DIR/re<RE>-<H> (default validation/cylinder/results) unless
it is there already, prints a table, and writes DIR/cylinder.png. With the spacing all cells get finer, in the same proportion.
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
from comparison import columns, published, root, run

depth = 0.04
quantities = {"Cd_mean": "C_d", "Cd_amp": "C_d amplitude", "Cl_amp": "C_l amplitude", "St": "St", "L_over_D": "wake length/D"}


def references(re):
    return [row for row in published("cylinder_static.csv") if float(row["Re"]) == re]


def finer(spacing):
    """The case's grid, time step and surface with other cells in the section."""
    factor = 0.04 / spacing
    return [f"grid.{axis}.refine.spacing={spacing}" for axis in "xy"] + [
        f"grid.x.cells={round(186 * factor)}", f"grid.y.cells={round(130 * factor)}", f"time.step={0.5 * spacing}",
        f"body.cylinder.mesh.divisions=[{round(96 * factor)}, 1]"]


def changes(re, spacing):
    return [f"fluid.viscosity={1 / re}", 'pressure.tolerance="fast"'] + finer(spacing) + (["time.end=80"] if re < 47 else [])


def coefficients(out):
    forces = columns(out / "forces-cylinder.csv")
    scale = 1 / (0.5 * depth)
    return forces["t"], scale * forces["force_x"], scale * forces["force_y"]


def wake_length(out):
    """Where u changes sign on the centre line behind the cylinder, from its rear, in the last fields."""
    last = sorted((out / "fields").glob("fields_*.vtr"))[-1]
    reader = vtk.vtkXMLRectilinearGridReader()
    reader.SetFileName(str(last))
    reader.Update()
    grid = reader.GetOutput()
    x, y = (vtk_to_numpy(c) for c in (grid.GetXCoordinates(), grid.GetYCoordinates()))
    x, y = 0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1])
    u = vtk_to_numpy(grid.GetCellData().GetArray("velocity"))[:, 0].reshape(len(y), len(x))
    centre_y, rear = 0.007, 0.503
    j = np.searchsorted(y, centre_y) - 1
    w = (centre_y - y[j]) / (y[j + 1] - y[j])
    line = (1 - w) * u[j] + w * u[j + 1]
    behind = np.flatnonzero((x > rear + 0.1) & (line > 0))
    n = behind[0]
    return x[n - 1] - line[n - 1] * (x[n] - x[n - 1]) / (line[n] - line[n - 1]) - rear


def measured(re, out):
    t, drag, lift = coefficients(out)
    if re < 47:
        return {"Cd_mean": drag[-1], "L_over_D": wake_length(out)}, (t, drag, lift)
    late = t > 0.6 * t[-1]
    ups = np.flatnonzero((lift[:-1] < 0) & (lift[1:] >= 0) & late[1:])
    crossings = t[ups] - lift[ups] * (t[ups + 1] - t[ups]) / (lift[ups + 1] - lift[ups])
    window = (t >= crossings[0]) & (t <= crossings[-1])  # whole periods
    steps = np.gradient(t)[window]
    return {
        "Cd_mean": np.average(drag[window], weights=steps),
        "Cd_amp": 0.5 * np.ptp(drag[window]),
        "Cl_amp": 0.5 * np.ptp(lift[window]),
        "St": (len(crossings) - 1) / (crossings[-1] - crossings[0]),
    }, (t, drag, lift)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    parser.add_argument("--re", type=float, nargs="+", default=[40, 100, 200])
    parser.add_argument("--spacing", type=float, default=0.04, help="of the cells around the cylinder, in its diameter")
    parser.add_argument("--set", dest="settings", action="append", default=[])
    arguments = parser.parse_args()
    figure, axes = plt.subplots(len(arguments.re), 1, figsize=(8, 3 * len(arguments.re)), squeeze=False)
    print("Re | quantity | luff | published | from")
    for axis, re in zip(axes[:, 0], arguments.re):
        out = arguments.out / f"re{re:g}-{arguments.spacing:g}"
        run(root / "cases" / "cylinder" / "case.toml", out, changes(re, arguments.spacing) + arguments.settings)
        values, (t, drag, lift) = measured(re, out)
        for key, value in values.items():
            rows = [row for row in references(re) if row[key]]
            theirs = ", ".join(row[key] for row in rows)
            print(f"{re:g} | {quantities[key]} | {value:.4f} | {theirs} | {'; '.join(row['source'] for row in rows)}")
        axis.plot(t, drag, label="$C_d$")
        axis.plot(t, lift, label="$C_l$")
        axis.set(title=f"Re = {re:g}", xlabel="t U/D", ylim=(-1, 2))
        axis.legend()
    figure.tight_layout()
    figure.savefig(arguments.out / "cylinder.png", dpi=130)


main()
