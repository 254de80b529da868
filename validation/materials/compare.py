#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Biaxial curves of the laws, through the solver's own code, against the computed table of May-Newman & Yin's law and
the measured curves of aortic leaflets (another tissue than the constants').

Usage: validation/materials/compare.py [--out DIR]

Builds the program that evaluates the laws if need be, prints two tables and writes DIR/materials.png (default
validation/materials/results). The materials are those of materials.toml.
"""
import argparse
import csv
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import published, root

build = root / "build/release"


def computed():
    """{(material, protocol): columns} of stretches and Cauchy stresses along and across the fibre."""
    configure = ["cmake", "-S", root, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DLUFF_VALIDATION=ON"]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", build, "validation_materials_biaxial"], check=True, stdout=subprocess.DEVNULL)
    program = build / "validation/validation_materials_biaxial"
    table = subprocess.run([program, here / "materials.toml"], check=True, capture_output=True, text=True).stdout
    curves = {}
    for row in csv.DictReader(table.splitlines()):
        numbers = [float(row[k]) for k in ("stretch_along", "stretch_across", "stress_along", "stress_across")]
        curves.setdefault((row["material"], row["protocol"]), []).append(numbers)
    return {key: np.array(values).T for key, values in curves.items()}


def compare_with_table(curves):
    print("equibiaxial stretch against the computed table (same constants, another code)")
    print("material | rows | largest difference along | across")
    table = published("maynewman_yin1998_equibiaxial_computed.csv")
    for material in ("anterior", "posterior"):
        along, _, *stresses = curves[material, "stretch"]
        differences = []
        for row in table:
            stretch = float(row["stretch"])
            if row["leaflet"] != material or stretch == 1:
                continue
            i = np.argmin(abs(along - stretch))
            references = [1e3 * float(row["sigma_fibre_kPa"]), 1e3 * float(row["sigma_cross_kPa"])]
            differences.append([abs(s[i] / r - 1) for s, r in zip(stresses, references)])
        print(f"{material} | {len(differences)} | " + " | ".join(f"{d:.1e}" for d in np.max(differences, axis=0)))


def measured():
    """{direction: (stretch, stress)} of the aortic leaflet."""
    table = published("maynewman2009_biaxial.csv")
    return {
        direction: np.array([[float(r["stretch"]), float(r["stress_Pa"])] for r in table if r["direction"] == direction]).T
        for direction in ("circ", "rad")
    }


def compare_with_experiment(curves, experiment):
    print("\nstretch at equal stress both ways, along (circumferential) and across (radial) the fibre")
    print("stress, Pa | measured, aortic | anterior, mitral | posterior, mitral | anterior with c10 = 1 kPa")
    for stress in (500, 1000, 2000):
        cells = []
        pair = [np.interp(stress, s, x) for x, s in (experiment["circ"], experiment["rad"])]
        cells.append("{:.3f}, {:.3f}".format(*pair))
        for material in ("anterior", "posterior", "anterior-c10"):
            along, across, sigma, _ = curves[material, "tension"]
            cells.append(f"{np.interp(stress, sigma, along):.3f}, {np.interp(stress, sigma, across):.3f}")
        print(f"{stress} | " + " | ".join(cells))


def draw(curves, experiment, file):
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5))
    table = published("maynewman_yin1998_equibiaxial_computed.csv")
    colours = {"anterior": "C0", "posterior": "C1", "pericardium": "C2", "rubber": "0.6"}
    for material, colour in colours.items():
        along, _, *stresses = curves[material, "stretch"]
        for stress, style, direction in zip(stresses, ("-", "--"), ("along", "across")):
            axes[0].semilogy(along[1:], stress[1:] / 1e3, style, color=colour, label=f"{material}, {direction}")
        points = [(float(r["stretch"]), float(r["sigma_fibre_kPa"]), float(r["sigma_cross_kPa"]))
                  for r in table if r["leaflet"] == material and float(r["stretch"]) > 1]
        for column in (1, 2):
            axes[0].plot([p[0] for p in points], [p[column] for p in points], ".", color=colour, markersize=4)
    axes[0].set(title="equal stretch (points: computed table)", xlabel="stretch", ylabel="Cauchy stress, kPa",
                xlim=(1, 1.3), ylim=(1e-3, 1e4))
    for material in ("anterior", "posterior", "anterior-c10"):
        along, across, sigma, _ = curves[material, "tension"]
        line, = axes[1].plot(along, sigma / 1e3, "-", label=f"{material} (mitral), along")
        axes[1].plot(across, sigma / 1e3, "--", color=line.get_color(), label=f"{material} (mitral), across")
    for (direction, (stretch, stress)), mark in zip(experiment.items(), ("ko", "k^")):
        axes[1].plot(stretch, stress / 1e3, mark, markersize=4, label=f"measured (aortic), {direction}")
    axes[1].set(title="equal stress", xlabel="stretch", ylabel="stress, kPa", xlim=(1, 1.7), ylim=(0, 5))
    for axis in axes:
        axis.legend(fontsize=7)
        axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(file, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=here / "results")
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    curves, experiment = computed(), measured()
    compare_with_table(curves)
    compare_with_experiment(curves, experiment)
    draw(curves, experiment, out / "materials.png")


main()
