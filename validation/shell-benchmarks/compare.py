#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the shell benchmarks of cases/shell-benchmarks and compares them with what is published.

Usage: validation/shell-benchmarks/compare.py [NAME...] [--out DIR] [--list]

Each benchmark runs on the meshes listed here. A table is printed: where the run ended, the largest difference over the
published points as a part of the largest published value, and the last published point with what was computed there. From the
three finest meshes of a pattern follow the order p with which that value converges, by itself and not against the published one,
and what it converges to: u_n = u + c h_n^p for n = 1, 2, 3. Where two errors of opposite sign cancel on some mesh, no such p
exists; from the four finest meshes follow then p and the limit of u_n = u + a h_n^p + b h_n^(p + 2), and what a h_n^2 + b h_n^4
through the first three of them predicts for the last. Writes
DIR/<name>.png (default validation/shell-benchmarks/results). A finished run in DIR is used again.
"""
import argparse
import json
import math
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import columns, published, root


@dataclass
class Curve:
    """A displacement of a probe against the load factor, `scale` times the component, and the published one."""

    label: str
    probe: str
    component: str
    scale: float
    published: list  # of (load factor, displacement); none where only its own convergence is asked


@dataclass
class Benchmark:
    curves: list
    meshes: dict  # label -> settings of the case
    settings: dict = field(default_factory=dict)
    case: str = None  # its name, where that is another one
    limit: tuple = None  # published first maximum of the load factor, and the first curve's displacement there


def table(file, column):
    return [(float(row["load_fraction"]), float(row[column])) for row in published(file)]


def single(name):
    return [(1.0, float(row["displacement"])) for row in published("linear_shells.csv") if row["benchmark"] == name]


def first_maximum(thickness):
    rows = published("sze2004_hinged_roofs.csv")
    return next((float(r["load_fraction"]), float(r["minus_W_C"])) for r in rows if float(r["thickness"]) == thickness)


def roll_up(component):
    points = [0.1 * n for n in range(1, 11)]
    exact = {"x": lambda t: 12 * (1 - math.sin(t) / t), "z": lambda t: 12 * (1 - math.cos(t)) / t}[component]
    return [(p, exact(2 * math.pi * p)) for p in points]


def meshes(shell, *choices):
    """Settings for (pattern, divisions) pairs."""
    return {
        f"{pattern} {a} x {b}": {
            f"shell.{shell}.mesh.pattern": f'"{pattern}"',
            f"shell.{shell}.mesh.divisions": f"[{a}, {b}]",
        }
        for pattern, a, b in choices
    }


def refined(shell, patterns, sizes):
    return meshes(shell, *((pattern, n, n) for pattern in patterns for n in sizes))


def pull_out(divisions, patterns, **more):
    return Benchmark(
        [
            Curve("W_A", "force", "z", 1, table("sze2004_pullout_open_cylinder.csv", "W_A")),
            Curve("-U_B", "side", "y", -1, table("sze2004_pullout_open_cylinder.csv", "minus_U_B")),
            Curve("-U_C", "end", "y", -1, table("sze2004_pullout_open_cylinder.csv", "minus_U_C")),
        ],
        meshes("cylinder", *((pattern, n, 2 * n // 3) for pattern in patterns for n in divisions)),
        **more,
    )


def diaphragms(patterns, **more):
    return Benchmark(
        [
            Curve("-W_A", "force", "z", -1, table("sze2004_pinched_cylinder_diaphragms.csv", "minus_W_A")),
            Curve("U_B", "side", "y", 1, table("sze2004_pinched_cylinder_diaphragms.csv", "U_B")),
            Curve("-W_A, solid", "force", "z", -1, table("calculix_pinched_cylinder_diaphragms.csv", "C3D20R_minus_W_A")),
            Curve("U_B, solid", "side", "y", 1, table("calculix_pinched_cylinder_diaphragms.csv", "C3D20R_U_B")),
        ],
        meshes("cylinder", *((pattern, n, 2 * n // 3) for pattern in patterns for n in (60, 90, 120))),
        **more,
    )


def semi_cylinder(divisions, **more):
    return Benchmark(
        [Curve("-W", "force", "z", -1, table("sze2004_pinched_semicylinder.csv", "minus_W"))],
        meshes("cylinder", *((pattern, n, 4 * n // 3) for pattern, sizes in divisions.items() for n in sizes)),
        **more,
    )


def hemisphere(which=slice(None)):
    return [
        Curve("out", "out", "x", 1, table("sze2004_hemisphere_18deg_hole.csv", "V_A_out")[which]),
        Curve("in", "in", "y", -1, table("sze2004_hemisphere_18deg_hole.csv", "minus_U_B_in")[which]),
    ]


smoothed = {"shell.cylinder.membrane": '"smoothed"'}
hencky = {"shell.cylinder.material.model": '"hencky"'}
graded = {"shell.cylinder.mesh.grading": "[64, 0.015625]"}

BENCHMARKS = {
    "plate-supported": Benchmark(
        [Curve("w", "centre", "z", 1, single("plate-supported"))],
        refined("plate", ("diagonal", "irregular"), (8, 16, 32)),
    ),
    "plate-clamped": Benchmark(
        [Curve("w", "centre", "z", 1, single("plate-clamped"))],
        refined("plate", ("diagonal", "irregular"), (8, 16, 32)),
    ),
    "scordelis-lo": Benchmark(
        [Curve("-w", "edge", "z", -1, single("scordelis-lo"))],
        refined("roof", ("diagonal", "irregular"), (16, 32, 64)),
    ),
    "pinched-cylinder": Benchmark(
        [Curve("-w", "force", "z", -1, single("pinched-cylinder"))],
        refined("cylinder", ("diagonal", "irregular"), (32, 64, 128)),
    ),
    "hemisphere": Benchmark(
        [Curve("out", "out", "x", 1, single("hemisphere")), Curve("in", "in", "y", -1, single("hemisphere"))],
        refined("hemisphere", ("diagonal", "irregular"), (16, 32, 64, 128)) | meshes("hemisphere", ("diagonal", 256, 256)),
    ),
    "cantilever": Benchmark(
        [
            Curve("-u", "end", "x", -1, table("sze2004_cantilever_end_shear.csv", "minus_u")),
            Curve("w", "end", "z", 1, table("sze2004_cantilever_end_shear.csv", "w")),
        ],
        meshes("strip", *((pattern, n, n // 8) for pattern in ("alternating", "irregular") for n in (16, 32, 64))),
    ),
    "roll-up": Benchmark(
        [Curve("-u", "end", "x", -1, roll_up("x")), Curve("w", "end", "z", 1, roll_up("z"))],
        meshes("strip", *((pattern, n, n // 16) for pattern in ("alternating", "irregular") for n in (32, 64, 128))),
    ),
    "hemisphere-large": Benchmark(
        hemisphere(),
        refined("hemisphere", ("diagonal", "irregular"), (16, 32, 64, 128)),
    ),
    # Finer at the free edge, and in few steps, of which only the last is in the table.
    "hemisphere-graded": Benchmark(
        hemisphere(slice(-1, None)),
        refined("hemisphere", ("diagonal",), (32, 48, 64, 96)),
        settings={"shell.hemisphere.membrane": '"smoothed"', "shell.hemisphere.mesh.grading": "[1, 8]", "structure.steps": "5"},
        case="hemisphere-large",
    ),
    "pullout-open-cylinder": pull_out((48, 72, 108), ("alternating", "irregular")),
    "pullout-hencky": pull_out((48, 72, 108), ("alternating",), settings=hencky, case="pullout-open-cylinder"),
    "pullout-hencky-graded": pull_out((48, 72, 108), ("alternating",), settings=hencky | graded, case="pullout-open-cylinder"),
    "pullout-spread": Benchmark(
        [Curve("W_A", "force", "z", 1, []), Curve("-U_B", "side", "y", -1, []), Curve("-U_C", "end", "y", -1, [])],
        meshes("cylinder", *(("alternating", n, 2 * n // 3) for n in (33, 48, 72))),
    ),
    "pinched-cylinder-diaphragms": diaphragms(("alternating", "irregular")),
    "diaphragms-smoothed": diaphragms(("alternating",), settings=smoothed, case="pinched-cylinder-diaphragms"),
    "pinched-semicylinder": semi_cylinder({"alternating": (24, 36, 48, 72, 96), "irregular": (24, 36, 48)}),
    "semicylinder-smoothed": semi_cylinder({"alternating": (24, 36, 48, 72, 96)}, settings=smoothed, case="pinched-semicylinder"),
    "semicylinder-diagonal": Benchmark(
        [
            Curve("-W", "force", "z", -1, table("sze2004_pinched_semicylinder.csv", "minus_W")),
            Curve("-W, 19 from it", "near", "z", -1, []),
        ],
        meshes("cylinder", *(("diagonal", n, 4 * n // 3) for n in (36, 48, 72))),
        settings=smoothed,
        case="pinched-semicylinder",
    ),
    "diaphragms-spread": Benchmark(
        [Curve("-W_A", "force", "z", -1, []), Curve("U_B", "side", "y", 1, [])],
        meshes("cylinder", *(("diagonal", n, 2 * n // 3) for n in (60, 90, 120, 150))),
    ),
    "semicylinder-spread": Benchmark(
        [Curve("-W", "force", "z", -1, []), Curve("-W, half way", "half", "z", -1, []), Curve("V, side", "side", "y", 1, [])],
        meshes("cylinder", *(("diagonal", n, 4 * n // 3) for n in (36, 48, 72, 96))),
    ),
    "hinged-roof": Benchmark(
        [Curve("-w", "force", "z", -1, [])], refined("roof", ("alternating", "irregular"), (12, 24, 48)), limit=first_maximum(12.7)
    ),
    "hinged-roof-thin": Benchmark(
        [Curve("-w", "force", "z", -1, [])], refined("roof", ("alternating", "irregular"), (12, 24, 48)), limit=first_maximum(6.35)
    ),
}


def case_file(name):
    shelf = root / "cases" / "shell-benchmarks" / f"{name}.toml"
    return shelf if shelf.exists() else root / "cases" / name / "case.toml"


def run(name, settings, out):
    """Runs unless finished before; a run that fails keeps what it reached."""
    if not (out / "summary.json").exists():
        command = [root / "luff", "run", case_file(name), "--out", out, "--threads", "1"]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        started = time.perf_counter()
        with open(out.with_suffix(".log"), "w") as log:
            status = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False).returncode
        if status == 2:
            raise SystemExit(out.with_suffix(".log").read_text())
        out.with_suffix(".seconds").write_text(f"{time.perf_counter() - started:.1f}")
    return json.loads((out / "summary.json").read_text()), float(out.with_suffix(".seconds").read_text())


def path_of(curve, out):
    """Load factors and displacements along the path that was followed, from the origin."""
    probe = columns(out / f"probe-{curve.probe}.csv")
    moved = curve.scale * probe[f"displacement_{curve.component}"]
    return np.vstack([(0.0, 0.0), np.stack([probe["load_factor"], moved], axis=1)])


def computed_at(path, loads):
    """Displacements where the load factor first reaches each of these; none where it never does."""
    values = []
    for load in loads:
        reached = np.nonzero(path[:, 0] >= load * (1 - 1e-9))[0]
        if len(reached) == 0:
            values.append(math.nan)
            continue
        after = max(reached[0], 1)
        (f0, u0), (f1, u1) = path[after - 1], path[after]
        values.append(u1 if f1 == f0 else u0 + (u1 - u0) * (load - f0) / (f1 - f0))
    return np.array(values)


def report(name, mesh, curve, summary, seconds, out):
    path = path_of(curve, out)
    if not curve.published:
        print(f"{name} | {mesh} | {curve.label} | {summary['state']} at {path[:, 0].max():.3g} | | {path[-1, 1]:.5g} | | | "
              f"{seconds:.0f} s", flush=True)
        return path, path[-1, 1]
    loads, theirs = np.array(curve.published).T
    computed = computed_at(path, loads)
    reached = ~np.isnan(computed)
    worst = np.max(np.abs(computed - theirs)[reached]) / np.max(np.abs(theirs)) if reached.any() else math.nan
    last = computed[-1]
    print(
        f"{name} | {mesh} | {curve.label} | {summary['state']} at {path[:, 0].max():.3g} | {100 * worst:.2f} % | "
        f"{last:.5g} | {theirs[-1]:.5g} | {100 * (last - theirs[-1]) / np.max(np.abs(theirs)):+.2f} % | "
        f"{seconds:.0f} s",
        flush=True,
    )
    return path, last


def report_limit(name, mesh, curve, limit, summary, seconds, out):
    """The first maximum of the load, by a parabola through the three highest points along the path."""
    path = path_of(curve, out)
    top = next(n for n in range(1, len(path) - 1) if path[n, 0] > path[n + 1, 0])
    chord = np.hypot(*(np.diff(path[top - 1 : top + 2], axis=0) / path[top]).T)
    along = np.array([-chord[0], 0.0, chord[1]])
    load, moved = (np.polyfit(along, path[top - 1 : top + 2, c], 2) for c in (0, 1))
    at = -load[1] / (2 * load[0])
    highest, displacement = np.polyval(load, at), np.polyval(moved, at)
    print(
        f"{name} | {mesh} | first maximum, and {curve.label} there | {summary['state']} at {path[:, 0].max():.3g} | | "
        f"{highest:.5g}, {displacement:.5g} | {limit[0]:.5g}, {limit[1]:.5g} | {100 * (highest / limit[0] - 1):+.2f}, "
        f"{100 * (displacement / limit[1] - 1):+.2f} % | {seconds:.0f} s",
        flush=True,
    )
    return path, highest


def root_between(f, low, high):
    """Where f changes its sign, by bisection."""
    at_low = f(low)
    while high - low > 1e-6:
        middle = (low + high) / 2
        low, high = (middle, high) if f(middle) * at_low > 0 else (low, middle)
    return low


def observed_order(values, divisions):
    """(p, u) of u_n = u + c h_n^p, h_n = 1/divisions, from (u1 - u2)/(u2 - u3) = (h1^p - h2^p)/(h2^p - h3^p), which
    grows with p; none where differences change sign or fall more slowly than for any p."""
    u, h = np.array(values), divisions[-1] / np.array(divisions, float)
    ratio = lambda p: (h[0] ** p - h[1] ** p) / (h[1] ** p - h[2] ** p)
    low, high = 1e-3, 16.0
    if u[1] == u[2] or not ratio(low) < (u[0] - u[1]) / (u[1] - u[2]) < ratio(high):
        return None
    order = root_between(lambda p: ratio(p) - (u[0] - u[1]) / (u[1] - u[2]), low, high)
    return order, u[2] - (u[1] - u[2]) / (h[1] ** order - 1)


def report_order(name, mesh, label, values, divisions, reference, scale):
    """From values on three meshes, the finest last. `reference`: None where nothing is published."""
    what = "first maximum" if label is None else label
    found = observed_order(values, divisions)
    if found is None:
        coarse, middle, fine = values
        print(f"{name} | {mesh} | order of {what} | differences {middle - coarse:+.2e}, {fine - middle:+.2e}: none", flush=True)
        return
    order, limit = found
    beside = " | " if reference is None else f"{reference:.5g} | {100 * (limit - reference) / scale:+.2f} %; "
    print(
        f"{name} | {mesh} | order of {what} | {order:.2f} | converges to {limit:.6g} | {beside}"
        f"finest mesh less that {100 * (values[-1] - limit) / scale:+.3f} %",
        flush=True,
    )


def two_terms(order, divisions):
    """Columns 1, h^p, h^(p + 2)."""
    h = divisions[-1] / np.array(divisions, float)
    return np.stack([np.ones(len(h)), h**order, h ** (order + 2)], axis=1)


def orders_of_two_terms(values, divisions):
    """All p in [0.3, 5] for which u_n = u + a h_n^p + b h_n^(p + 2) on four meshes: none to two."""
    u = np.array(values) - values[-1]
    left = lambda p: np.linalg.det(np.column_stack([two_terms(p, divisions), u]))
    tried = np.linspace(0.3, 5, 236)
    signs = np.sign([left(p) for p in tried])
    return [root_between(left, *tried[n : n + 2]) for n in np.nonzero(signs[:-1] * signs[1:] < 0)[0]]


def report_two_terms(name, mesh, label, values, divisions, scale):
    """From values on four meshes, the finest last."""
    orders = " or ".join(f"{p:.2f}" for p in orders_of_two_terms(values, divisions)) or "none"
    terms = two_terms(2, divisions)
    limit, *_ = coefficients = np.linalg.solve(terms[:3], values[:3])
    predicted = terms[3] @ coefficients
    print(
        f"{name} | {mesh} | {label} by two terms | order {orders} | h^2, h^4 through the first three "
        f"converge to {limit:.6g} | and make the last {predicted:.6g}, which is {values[3]:.6g}, "
        f"{100 * (values[3] - predicted) / scale:+.4f} % off and {100 * (values[3] - values[2]) / scale:+.4f} % from the one before",
        flush=True,
    )


def report_orders(name, benchmark, found):
    """`found`: values by (pattern, label) and divisions."""
    for (pattern, label), by_divisions in found.items():
        if len(by_divisions) >= 4 and not benchmark.limit:
            finest = sorted(by_divisions)[-4:]
            report_two_terms(name, pattern, label, [by_divisions[n] for n in finest], finest, abs(by_divisions[finest[-1]]))
        divisions = sorted(by_divisions)[-3:]
        if len(divisions) < 3:
            continue
        curve = next(c for c in benchmark.curves if c.label == label)
        values = [by_divisions[n] for n in divisions]
        reference, scale = None, abs(values[-1])
        if benchmark.limit:
            reference = scale = benchmark.limit[0]
        elif curve.published:
            reference, scale = curve.published[-1][1], max(abs(value) for _, value in curve.published)
        report_order(name, pattern, None if benchmark.limit else label, values, divisions, reference, scale)


def compare(name, benchmark, out):
    figure, axis = plt.subplots(figsize=(7, 5))
    found = {}
    for number, (mesh, settings) in enumerate(benchmark.meshes.items()):
        folder = out / name / mesh.replace(" ", "-")
        folder.parent.mkdir(parents=True, exist_ok=True)
        summary, seconds = run(benchmark.case or name, {**benchmark.settings, **settings}, folder)
        for curve in benchmark.curves:
            if benchmark.limit:
                path, last = report_limit(name, mesh, curve, benchmark.limit, summary, seconds, folder)
            else:
                path, last = report(name, mesh, curve, summary, seconds, folder)
            pattern, divisions = mesh.split()[:2]
            found.setdefault((pattern, curve.label), {})[int(divisions)] = last
            axis.plot(path[:, 1], path[:, 0], color=f"C{number}", label=f"{curve.label}, {mesh}")
    report_orders(name, benchmark, found)
    if benchmark.limit:
        axis.plot(benchmark.limit[1], benchmark.limit[0], "o", color="k", fillstyle="none", label="first maximum, published")
    for curve in benchmark.curves:
        if curve.published:
            loads, theirs = zip(*curve.published)
            axis.plot(theirs, loads, "o", color="k", fillstyle="none", label=f"{curve.label}, published")
    axis.set(title=name, xlabel="displacement", ylabel="load factor")
    axis.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(out / f"{name}.png", dpi=130)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="benchmarks to run; all when none is given")
    parser.add_argument("--out", type=Path, default=here / "results")
    parser.add_argument("--list", action="store_true", help="print the names")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(BENCHMARKS))
        return
    unknown = set(arguments.names) - set(BENCHMARKS)
    if unknown:
        parser.error(f"no benchmark named {', '.join(sorted(unknown))}; --list prints the names")
    print("benchmark | mesh | what | run | largest difference | computed | published | at full load | time")
    for name in arguments.names or BENCHMARKS:
        compare(name, BENCHMARKS[name], arguments.out)


main()
