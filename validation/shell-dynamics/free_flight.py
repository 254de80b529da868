#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Flies a free shell for 10^4 steps by each scheme in time; shows what becomes of its energy and momentum.

Usage: validation/shell-dynamics/free_flight.py [--steps N] [--out DIR]

An irregular plate of 48 triangles translates, spins, bends and twists with large amplitude, without dissipation, in steps
of 1.35e-3: three times the time in which a stretching wave crosses a triangle. Builds build/release with benchmarks, writes
DIR/free_flight.png (default validation/shell-dynamics/results) and prints a table.
"""
import argparse
import csv
import subprocess
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

root = Path(__file__).resolve().parent.parent.parent
build = root / "build" / "release"
runs = [(scheme, mass) for mass in ("lumped", "consistent") for scheme in ("newmark", "generalised-alpha", "midpoint")]


def fly(scheme, mass, steps, out):
    table = out / f"{scheme}-{mass}.csv"
    program = build / "benchmarks" / "benchmark_shell_free_flight"
    with open(table, "w") as file:
        subprocess.run([program, scheme, str(steps), "1.35e-3", mass], stdout=file, check=True)
    with open(table) as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def trend(rows):
    """Mean energy error of the last tenth against that of the second, after the first exchange of energy."""
    tenth = len(rows) // 10
    mean = lambda part: sum(row["energy"] for row in part) / len(part)
    return mean(rows[-tenth:]) - mean(rows[tenth : 2 * tenth])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=10000)
    parser.add_argument("--out", type=Path, default=Path(__file__).resolve().parent / "results")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    subprocess.run(["cmake", "-S", root, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DLUFF_BENCHMARKS=ON"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", build, "benchmark_shell_free_flight"], check=True, stdout=subprocess.DEVNULL)
    figure, axes = plt.subplots(1, 3, figsize=(13, 4))
    print("scheme | mass | largest energy error | its trend | momentum: largest, last | angular momentum: largest, last | "
          "Newton iterations per step")
    for scheme, mass in runs:
        rows = fly(scheme, mass, options.steps, options.out)
        largest = {key: max(abs(row[key]) for row in rows) for key in ("energy", "momentum", "angular_momentum")}
        both = {key: f"{largest[key]:.1e}, {abs(rows[-1][key]):.1e}" for key in largest}
        print(f"{scheme} | {mass} | {largest['energy']:.1e} | {trend(rows):+.1e} | {both['momentum']} | "
              f"{both['angular_momentum']} | {rows[-1]['newton_iterations'] / len(rows):.2f}")
        if mass == "lumped":
            for axis, key in zip(axes, largest):
                axis.semilogy([row["step"] for row in rows], [abs(row[key]) + 1e-17 for row in rows], label=scheme, lw=0.7)
                axis.set(xlabel="step", title=f"relative error of the {key.replace('_', ' ')}")
    axes[0].legend()
    figure.tight_layout()
    figure.savefig(options.out / "free_flight.png", dpi=110)


main()
