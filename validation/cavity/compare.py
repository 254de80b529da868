#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the lid-driven cavity at Re = 1000 and compares the profiles through its middle with published ones.

Usage: validation/cavity/compare.py [plane] [cube] [--cells N] [--out DIR]

plane: the two-dimensional cavity against Botella & Peyret (1998), spectral, and Ghia, Ghia & Shin (1982).
cube: the cubic cavity, half of it up to its plane of symmetry, against Albensoeder & Kuhlmann (2005), spectral.
Writes DIR/cavity.png (default validation/cavity/results) and prints a table; 1 is the speed of the lid.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import columns, published, run_text

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


def profile(name, place, value):
    return [(float(row[place]), float(row[value])) for row in published(name)]


def inside(points):
    return [point for point in points if 0.0 < point[0] < 1.0]


def references(case):
    """Profiles (u along y at x = 1/2, v along x at y = 1/2) by source."""
    if case == "plane":
        return {
            "Botella & Peyret 1998": {"u": profile("botella_peyret1998_Re1000_u.csv", "y", "u"),
                                      "v": profile("botella_peyret1998_Re1000_v.csv", "x", "v")},
            "Ghia et al. 1982": {"u": profile("ghia1982_u.csv", "y", "u_Re1000"), "v": profile("ghia1982_v.csv", "x", "v_Re1000")},
        }
    v = [(x, -u) for x, u in profile("albensoeder2005_u_on_y.csv", "X_lidtop", "u_cube")]
    return {
        "Albensoeder & Kuhlmann 2005": {"u": profile("albensoeder2005_v_on_x.csv", "Y_lidtop", "v_cube"), "v": v},
    }


def probe_name(component, s):
    return f"{component}-{s}".replace(".", "_")


def text_of(case, cells, end):
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
    return text


def probe(run, component, s):
    """Last value, and how far it moved over the last tenth of the run."""
    velocity = columns(run / f"probe-{probe_name(component, s)}.csv")["velocity_" + "xy"["uv".index(component)]]
    return velocity[-1], abs(velocity[-1] - velocity[-len(velocity) // 10])


def compare(case, cells, end, out, axes):
    run = run_text(text_of(case, cells, end), out / f"{case}-{cells}")
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
