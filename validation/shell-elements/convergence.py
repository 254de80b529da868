#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Convergence of the shell's curvatures (qavg, patch4, hinge) and of the smoothed membrane on four patterns of meshes.

Usage: validation/shell-elements/convergence.py [--program PROGRAM] [--largest N] [--csv FILE] [--figure FILE]

Runs benchmark_shell_elements (configure with -DLUFF_BENCHMARKS=ON) or reads what it wrote before with --csv, prints the
errors with the order between the last two meshes and over all, and draws them.
"""
import argparse
import csv
import math
import subprocess
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = Path(__file__).resolve().parent
root = here.parent.parent

colours = {"qavg": "tab:blue", "patch4": "tab:orange", "hinge": "tab:green", "qavg+smoothed": "tab:purple"}
titles = {
    "supported-plate": "supported plate, volume",
    "scordelis-lo": "Scordelis-Lo roof, sag",
    "pinched-hemisphere": "pinched hemisphere",
}
flat = {"supported-plate", "clamped-plate", "plate-frequency"}  # held in their plane: the membrane does nothing


def compute(program, largest, file):
    file.parent.mkdir(parents=True, exist_ok=True)
    with open(file, "w") as out:
        subprocess.run([program, str(largest)], stdout=out, check=True)


def read(file):
    """{(benchmark, mesh, element): {n: [errors of each random mesh]}}"""
    errors = defaultdict(lambda: defaultdict(list))
    with open(file) as lines:
        for row in csv.DictReader(lines):
            if row["element"] == "qavg+smoothed" and row["benchmark"] in flat:
                continue
            key = row["benchmark"], row["mesh"], row["element"]
            errors[key][int(row["n"])].append(float(row["computed_over_reference"]) - 1)
    return errors


def root_mean_square(values):
    return math.sqrt(sum(v * v for v in values) / len(values))


def order(errors, coarse, fine):
    ratio = root_mean_square(errors[coarse]) / root_mean_square(errors[fine])
    return math.log(ratio) / math.log(fine / coarse)


def print_table(errors):
    """Mean error in per cent of the reference; orders of the root mean square over random meshes."""
    last = None
    for (benchmark, mesh, element), by_n in errors.items():
        ns = sorted(by_n)
        if benchmark != last:
            heads = "".join(f"{f'n = {n}':>11}" for n in ns)
            print(f"\n{benchmark:33}{heads}   order {ns[-2]}-{ns[-1]}  {ns[0]}-{ns[-1]}")
            last = benchmark
        means = "".join(f"{100 * sum(by_n[n]) / len(by_n[n]):+10.3f}%" for n in ns)
        print(f"  {mesh:13}{element:18}{means}{order(by_n, ns[-2], ns[-1]):14.2f}{order(by_n, ns[0], ns[-1]):7.2f}")


def draw(errors, file):
    meshes = list(dict.fromkeys(mesh for _, mesh, _ in errors))
    figure, axes = plt.subplots(len(titles), len(meshes), figsize=(10, 7), sharex=True, sharey="row")
    for row, benchmark in zip(axes, titles):
        for axis, mesh in zip(row, meshes):
            for element, colour in colours.items():
                by_n = errors.get((benchmark, mesh, element))
                if by_n:
                    ns = sorted(by_n)
                    axis.loglog(ns, [100 * root_mean_square(by_n[n]) for n in ns], "o-", ms=3, color=colour, label=element)
            start = 100 * root_mean_square(errors[benchmark, mesh, "qavg"][ns[0]])
            axis.loglog(ns, [start * (ns[0] / n) ** 2 for n in ns], "k:", lw=1, label="second order")
            axis.set_xticks(ns, ns)
            axis.minorticks_off()
            axis.grid(alpha=0.3)
        row[0].set_ylabel(titles[benchmark] + "\nerror [%]")
    for axis, mesh in zip(axes[0], meshes):
        axis.set_title(mesh)
    for axis in axes[-1]:
        axis.set_xlabel("elements along a side, n")
    handles, labels = axes[-1][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=len(labels), frameon=False)
    figure.tight_layout(rect=(0, 0.04, 1, 1))
    figure.savefig(file, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=root / "build/release/benchmarks/benchmark_shell_elements")
    parser.add_argument("--largest", type=int, default=64, help="divisions of the finest mesh")
    parser.add_argument("--csv", type=Path, help="use the results in this file instead of computing them")
    parser.add_argument("--figure", type=Path, default=here / "results" / "convergence.png")
    options = parser.parse_args()
    results = options.csv or here / "results" / "elements.csv"
    if not options.csv:
        compute(options.program, options.largest, results)
    errors = read(results)
    print_table(errors)
    options.figure.parent.mkdir(parents=True, exist_ok=True)
    draw(errors, options.figure)
    print(f"\n{options.figure}")


if __name__ == "__main__":
    main()
