#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the two-dimensional flags and compares amplitude and frequency of the tip with reference.csv.

Usage: validation/flags/compare.py [--out DIR]

Writes DIR/flags.png (default validation/flags/results) and prints a table.
"""
import argparse
import csv
import json
import subprocess
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = Path(__file__).resolve().parent
root = here.parent.parent


def references():
    with open(here / "reference.csv") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {row["case"]: row for row in rows}


def run(case, out):
    if not (out / "summary.json").exists():
        subprocess.run([root / "luff", "run", root / "cases" / case / "case.toml", "--out", out], check=True)
    summary = json.loads((out / "summary.json").read_text())
    with open(out / "probe-tip.csv") as file:
        table = list(csv.reader(file))
    y = table[0].index("displacement_y [length]")
    return summary["probes"]["tip"], [(float(row[0]), float(row[y])) for row in table[1:]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    out = parser.parse_args().out
    figure, axes = plt.subplots(len(references()), 1, figsize=(8, 6))
    print("case | quantity | computed | reference | difference | source")
    for axis, (case, row) in zip(axes, references().items()):
        tip, history = run(case, out / case)
        for quantity, key in (("peak to peak / L", "peak_to_peak"), ("frequency L/U", "frequency")):
            reference = float(row[key])
            difference = 100 * (tip[key] / reference - 1)
            print(f"{case} | {quantity} | {tip[key]:.4f} | {reference} | {difference:+.1f} % | {row['source']}")
        axis.plot(*zip(*history))
        axis.set(title=case, xlabel="t U/L", ylabel="tip displacement y/L")
    figure.tight_layout()
    figure.savefig(out / "flags.png", dpi=130)


main()
