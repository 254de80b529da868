#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the lid-driven cavity at Re = 1000 and compares the profiles through its middle with published ones.

Usage: validation/cavity/compare.py [plane] [cube] [--cells N] [--out DIR]

plane: the two-dimensional cavity against Botella & Peyret (1998), spectral, and Ghia, Ghia & Shin (1982).
cube: the cubic cavity, half of it up to its plane of symmetry, against Albensoeder & Kuhlmann (2005), spectral.
Writes DIR/cavity.png (default validation/cavity/results) and prints a table; 1 is the speed of the lid.
"""
import argparse
import csv
import subprocess
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = Path(__file__).resolve().parent
root = here.parent.parent

CASE = """title = "Lid-driven cavity, Re = 1000"
[time]
end = {end}
step = 1.0
cfl = 1.0
[fluid]
density = 1.0
viscosity = 1e-3
[grid]
x = {{ from = 0.0, to = 1.0, cells = {cells} }}
y = {{ from = 0.0, to = 1.0, cells = {cells} }}
z = {{ from = 0.0, to = {depth}, cells = {layers} }}
[boundary]
x_min = {{ type = "wall" }}
x_max = {{ type = "wall" }}
y_min = {{ type = "wall" }}
y_max = {{ type = "wall", value = [1.0, 0.0, 0.0] }}
z_min = {{ type = "{ends}" }}
z_max = {{ type = "symmetry" }}
[pressure]
tolerance = "fast"
"""


def table(name, place, value):
    with open(root / "validation" / "data" / f"{name}.csv") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [(float(row[place]), float(row[value])) for row in rows]


def inside(points):
    return [point for point in points if 0.0 < point[0] < 1.0]


def references(case):
    """Profiles (u along y at x = 1/2, v along x at y = 1/2) by source."""
    if case == "plane":
        return {
            "Botella & Peyret 1998": {"u": table("botella_peyret1998_Re1000_u", "y", "u"),
                                      "v": table("botella_peyret1998_Re1000_v", "x", "v")},
            "Ghia et al. 1982": {"u": table("ghia1982_u", "y", "u_Re1000"), "v": table("ghia1982_v", "x", "v_Re1000")},
        }
    v = [(x, -u) for x, u in table("albensoeder2005_u_on_y", "X_lidtop", "u_cube")]
    return {
        "Albensoeder & Kuhlmann 2005": {"u": table("albensoeder2005_v_on_x", "Y_lidtop", "v_cube"), "v": v},
    }


def probe_name(component, s):
    return f"{component}-{s}".replace(".", "_")


def write_case(case, cells, end, out):
    depth, layers, ends = (1.0 / cells, 1, "symmetry") if case == "plane" else (0.5, cells // 2, "wall")
    text = CASE.format(end=end, cells=cells, depth=depth, layers=layers, ends=ends)
    middle = 0.5 * depth if case == "plane" else 0.5
    for source in references(case).values():
        for component, points in source.items():
            for s, _ in inside(points):
                place = [0.5, s, middle] if component == "u" else [s, 0.5, middle]
                name = probe_name(component, s)
                if f'"{name}"' not in text:
                    text += f'[[output.probe]]\nname = "{name}"\npoint = {place}\n'
    out.mkdir(parents=True, exist_ok=True)
    (out / "case.toml").write_text(text)


def probe(run, component, s):
    """Last value, and how far it moved over the last tenth of the run."""
    with open(run / f"probe-{probe_name(component, s)}.csv") as file:
        rows = list(csv.reader(file))
    column = next(n for n, head in enumerate(rows[0]) if head.startswith("velocity_" + "xy"["uv".index(component)]))
    return float(rows[-1][column]), abs(float(rows[-1][column]) - float(rows[-len(rows) // 10][column]))


def compare(case, cells, end, out, axes):
    folder = out / f"{case}-{cells}"
    run = folder / "run"
    if not (run / "summary.json").exists():
        write_case(case, cells, end, folder)
        subprocess.run([root / "luff", "run", folder / "case.toml", "--out", run], check=True)
    for source, profiles in references(case).items():
        for component, points in profiles.items():
            computed = [(s, value, *probe(run, component, s)) for s, value in inside(points)]
            errors = [abs(found - value) for _, value, found, _ in computed]
            largest = max(abs(value) for _, value, _, _ in computed)
            mean = (sum(e * e for e in errors) / len(errors)) ** 0.5
            drift = max(d for *_, d in computed)
            print(f"{case} {cells} | {component} | largest {100 * max(errors):.2f} %, rms {100 * mean:.2f} % of the lid's "
                  f"speed (largest value {largest:.3f}) | still moving {100 * drift:.3f} % | {source}")
            axis = axes["uv".index(component)]
            axis.plot([s for s, *_ in computed], [found for _, _, found, _ in computed], "-", lw=1)
            axis.plot(*zip(*points), ".", label=source)
            axis.set(title=case, xlabel="y" if component == "u" else "x", ylabel=component)
            axis.legend(fontsize=7)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", default=["plane", "cube"])
    parser.add_argument("--cells", type=int, help="along an edge; default 128 and 96")
    parser.add_argument("--out", type=Path, default=here / "results")
    options = parser.parse_args()
    figure, axes = plt.subplots(len(options.cases), 2, figsize=(9, 4 * len(options.cases)), squeeze=False)
    for case, row in zip(options.cases, axes):
        cells = options.cells or {"plane": 128, "cube": 96}[case]
        compare(case, cells, {"plane": 70.0, "cube": 40.0}[case], options.out, row)
    figure.tight_layout()
    figure.savefig(options.out / "cavity.png", dpi=130)


main()
