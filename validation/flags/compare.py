#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the two-dimensional flags and compares amplitude and frequency of the tip with reference.csv.

Usage: validation/flags/compare.py [--out DIR]

Writes DIR/flags.png (default validation/flags/results) and prints a table.
"""
import argparse
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import columns, published, root, run


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    out = parser.parse_args().out
    references = published(here / "reference.csv")
    figure, axes = plt.subplots(len(references), 1, figsize=(8, 6))
    print("case | quantity | computed | reference | difference | source")
    for axis, row in zip(axes, references):
        case = row["case"]
        folder = run(root / "cases" / case / "case.toml", out / case)
        tip, history = json.loads((folder / "summary.json").read_text())["probes"]["tip"], columns(folder / "probe-tip.csv")
        for quantity, key in (("peak to peak / L", "peak_to_peak"), ("frequency L/U", "frequency")):
            reference = float(row[key])
            difference = 100 * (tip[key] / reference - 1)
            print(f"{case} | {quantity} | {tip[key]:.4f} | {reference} | {difference:+.1f} % | {row['source']}")
        axis.plot(history["t"], history["displacement_y"])
        axis.set(title=case, xlabel="t U/L", ylabel="tip displacement y/L")
    figure.tight_layout()
    figure.savefig(out / "flags.png", dpi=130)


main()
