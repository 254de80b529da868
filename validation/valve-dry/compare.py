#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases/valve-dry and the closing test and compares them with the prototype's figures.

Usage: validation/valve-dry/compare.py [--out DIR]

Writes DIR/valve.png, the open area against time (default validation/valve-dry/results), and prints a table. The open area
is the part of the disk of the wall's radius that no triangle covers, seen along the axis, on 240 x 240 points.
"""
import argparse
import json
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import columns, root, run

WALL = 0.0127  # radius [m]

# What our own prototype measured on the same mesh (another code, Newmark with the same damping); no one else's figures.
PROTOTYPE = {
    "open area, largest": 0.90,
    "ms to an open area of 0.2": 12.7,
    "ms to 90 % of the open area that is held": 23.9,
    "Newton iterations per step": 3.5,
    "steps that failed": 0,
    "edges through triangles": 0,
}
PROTOTYPE_CLOSING = {"Newton iterations per step": 3.1, "most in a step": 5, "steps that failed": 0,
                     "edges through triangles": 0}


def computed_steps(case, out):
    run(root / "cases/valve-dry" / case, out)
    return columns(out / "steps.csv"), json.loads((out / "summary.json").read_text())


def instants(out):
    """Time, points and triangles of every written instant."""
    for entry in xml.parse(out / "shell-valve.pvd").iter("DataSet"):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(out / entry.get("file")))
        reader.Update()
        data = reader.GetOutput()
        corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        yield float(entry.get("timestep")), vtk_to_numpy(data.GetPoints().GetData()), corners


def open_area(points, triangles, n=240):
    centre = (np.arange(n) + 0.5) * 2 * WALL / n - WALL
    x, y = np.meshgrid(centre, centre, indexing="ij")
    covered = np.zeros((n, n), bool)
    for a, b, c in points[triangles][:, :, :2]:
        area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        if area == 0:
            continue
        low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
        i, j = (slice(*np.searchsorted(centre, (low[d], high[d])) + np.array([0, 1])) for d in range(2))
        u = ((b[0] - x[i, j]) * (c[1] - y[i, j]) - (c[0] - x[i, j]) * (b[1] - y[i, j])) / area
        v = ((c[0] - x[i, j]) * (a[1] - y[i, j]) - (a[0] - x[i, j]) * (c[1] - y[i, j])) / area
        covered[i, j] |= (u >= 0) & (v >= 0) & (u + v <= 1)
    disk = x**2 + y**2 < WALL**2
    return 1 - (covered & disk).sum() / disk.sum()


def first_time(t, area, level):
    k = next(i for i, a in enumerate(area) if a >= level)
    return t[k - 1] + (level - area[k - 1]) / (area[k] - area[k - 1]) * (t[k] - t[k - 1])


def solver(steps, summary):
    return {"Newton iterations per step": np.mean(steps["newton_iterations"]),
            "most in a step": max(steps["newton_iterations"]),
            "steps that failed": 0 if summary["state"] == "finished" else 1,
            "steps halved": summary["halved_steps"],
            "edges through triangles": summary["contact"]["crossings"],
            "smallest gap [mm]": 1e3 * summary["contact"]["smallest_gap"]}


def table(title, computed, reference):
    print(f"{title} | luff | prototype")
    for quantity, value in computed.items():
        print(f"{quantity} | {value:.3g} | {reference.get(quantity, '')}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    out = parser.parse_args().out
    steps, summary = computed_steps("case.toml", out / "cycle")
    t, area = zip(*((t, open_area(points, triangles)) for t, points, triangles in instants(out / "cycle")))
    held = area[min(range(len(t)), key=lambda i: abs(t[i] - 0.05))]
    computed = {"open area, largest": max(area), "open area that is held": held, "open area at the end": area[-1],
                "ms to an open area of 0.2": 1e3 * first_time(t, area, 0.2),
                "ms to 90 % of the open area that is held": 1e3 * first_time(t, area, 0.9 * held)}
    table("10 mmHg, then -80 mmHg", computed | solver(steps, summary), PROTOTYPE)
    table("closing from rest", solver(*computed_steps("closing.toml", out / "closing")), PROTOTYPE_CLOSING)

    figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 6), sharex=True)
    upper.plot(1e3 * np.array(t), area)
    upper.set(ylabel="open area / area of the wall")
    lower.plot(1e3 * steps["t"], steps["newton_iterations"], linewidth=0.7)
    lower.set(xlabel="t [ms]", ylabel="Newton iterations")
    figure.tight_layout()
    figure.savefig(out / "valve.png", dpi=130)


main()
