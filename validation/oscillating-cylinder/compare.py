#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the cylinder that swings in fluid at rest and compares its force and the velocity around it with Duetsch et al. (1998).

Usage: validation/oscillating-cylinder/compare.py [--out DIR] [--set KEY=VALUE ...]

Runs cases/oscillating-cylinder/case.toml into DIR (default validation/oscillating-cylinder/results) unless it is there
already, prints a table, and writes DIR/oscillating-cylinder.png.
"""
import argparse
import sys
import xml.etree.ElementTree
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
period = 5.0


def morison(phase, drag):
    """C_d and C_m of F/(rho U^2 D/2) = -C_d u|u| - C_m (pi/2) du/dt, u = -cos(2 pi phase), by least squares."""
    u = -np.cos(2 * np.pi * phase)
    a = 2 * np.pi / period * np.sin(2 * np.pi * phase)
    return np.linalg.lstsq(np.stack([-u * abs(u), -a * np.pi / 2], axis=1), drag, rcond=None)[0]


def compare_force(axis, t, drag):
    rows = published("dutsch1998_inline_force_KC5_Re100.csv")
    points = np.array([[float(row["t_over_T"]), float(row["Cd"])] for row in rows])
    points = points[points[:, 0].argsort()]
    phase = np.linspace(0, 1, 400, endpoint=False)
    measured = np.interp(phase, points[:, 0], points[:, 1], period=1)
    last = np.interp(t[-1] - period + period * phase, t, drag)
    print("quantity | luff | published | difference")
    for n in range(round(t[-1] / (0.5 * period))):
        half = (t >= 0.5 * period * n) & (t < 0.5 * period * (n + 1))
        peak = abs(drag[half]).max()
        print(f"peak of half period {n + 1} | {peak:.3f} | {measured.max():.3f} | {100 * (peak / measured.max() - 1):+.1f} %")
    print(f"rms of the difference, last period, over the peak | | | {100 * np.sqrt(np.mean((last - measured) ** 2)) / measured.max():.1f} %")
    for name, ours, theirs in zip(("C_d", "C_m"), morison(phase, last), morison(phase, measured)):
        print(f"Morison's {name} | {ours:.3f} | {theirs:.3f} | {100 * (ours / theirs - 1):+.1f} %")
    axis.plot(phase, last, label="luff")
    axis.plot(points[:, 0], points[:, 1], "k.", ms=3, label="Duetsch et al. 1998")
    axis.set(xlabel="t/T", ylabel="$F/(\\rho U^2 D/2)$")
    axis.legend()


def fields_at(out, wanted):
    """Centres, velocity and the mask of the fluid at the written instant nearest to `wanted`."""
    series = xml.etree.ElementTree.parse(out / "fields.pvd").getroot().iter("DataSet")
    entry = min(series, key=lambda e: abs(float(e.get("timestep")) - wanted))
    reader = vtk.vtkXMLRectilinearGridReader()
    reader.SetFileName(str(out / entry.get("file")))
    reader.Update()
    grid = reader.GetOutput()
    x, y = (vtk_to_numpy(c) for c in (grid.GetXCoordinates(), grid.GetYCoordinates()))
    shape = (len(y) - 1, len(x) - 1)
    u = vtk_to_numpy(grid.GetCellData().GetArray("velocity"))
    return 0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1]), [u[:, d].reshape(shape) for d in range(2)]


def compare_profiles(axes, out, end):
    rows = published("dutsch1998_profiles.csv")
    differences = {"u": [], "v": []}
    for axis, phase in zip(axes, (180, 210, 330)):
        x, y, velocity = fields_at(out, end - period + period * phase / 360)
        for component, values in zip("uv", velocity):
            for station in sorted({row["x_over_D"] for row in rows}):
                points = np.array([[float(r["y_over_D"]), float(r["vel_over_Um"])] for r in rows
                                   if (r["component"], float(r["phase_deg"]), r["x_over_D"]) == (component, phase, station)])
                if len(points) == 0:
                    continue
                line = np.array([np.interp(float(station), x, row) for row in values])
                differences[component].extend(np.interp(points[:, 0], y, line) - points[:, 1])
                if component == "u":
                    axis.plot(line, y, lw=1)
                    axis.plot(points[:, 1], points[:, 0], ".", ms=3, color=axis.lines[-1].get_color())
        axis.set(title=f"u at {phase} degrees", xlabel="u/U", ylabel="y/D", ylim=(-1.5, 1.5))
    for component, values in differences.items():
        print(f"profiles of {component}: rms of the difference over U | | | {100 * np.sqrt(np.mean(np.square(values))):.1f} % of {len(values)} points")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    parser.add_argument("--set", dest="settings", action="append", default=[])
    arguments = parser.parse_args()
    out = run(root / "cases" / "oscillating-cylinder" / "case.toml", arguments.out, arguments.settings)
    forces = columns(out / "forces-cylinder.csv")
    t, drag = forces["t"], forces["force_x"] / (0.5 * depth)
    figure, axes = plt.subplots(1, 4, figsize=(15, 4))
    compare_force(axes[0], t, drag)
    compare_profiles(axes[1:], out, t[-1])
    figure.tight_layout()
    figure.savefig(out / "oscillating-cylinder.png", dpi=130)


main()
