#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmarks FSI2, FSI3, CFD3 and CSM1 of Turek and Hron and compares them with the published figures.

Usage: validation/turek-hron/compare.py [--out DIR] [--set KEY=VALUE ...] [NAME...]

Runs cases/turek-hron/case.toml, which is FSI3, and with other keys FSI2, into DIR/<NAME> (default
validation/turek-hron/results) unless it is there already, prints a table, and writes DIR/turek-hron.png.  Two runs show where the
differences come from: CSM1, the beam alone under its weight (csm1.toml), and CFD3, the flow around a flag that is rigid
(rigid.toml), once a body as thick as it is and once a sheet.  FSI3-sheet is FSI3 with a beam that the flow sees as a sheet.

Means and amplitudes are (largest + smallest)/2 and (largest - smallest)/2 of each period, as in the benchmark, averaged over
the periods of the last `window` seconds.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from comparison import columns, published, root, run

depth = 0.005
inflow = 'boundary.x_min.value=["(t < 1 ? 0.5*(1 - cos(pi*t)) : 1)*6*y*(0.41 - y)/0.1681", 0.0, 0.0]'
sheet = ('body.beam.mesh={ shape = "rectangle", origin = [0.25, 0.2, 0], a = [0.35, 0, 0], b = [0, 0, 0.005], divisions = [70, 1] }')
elastic, rigid = root / "cases" / "turek-hron" / "case.toml", here / "rigid.toml"
cases = {
    "CFD3": {"file": rigid, "published": "CFD3", "set": [], "window": 2.0},
    "CFD3-sheet": {"file": rigid, "published": "CFD3", "set": [sheet, "body.beam.closed=false"], "window": 2.0},
    "FSI3": {"file": elastic, "published": "FSI3", "set": [], "window": 1.0},
    "FSI3-sheet": {"file": elastic, "published": "FSI3", "set": ['shell.beam.wetted="middle"'], "window": 1.0},
    "FSI2": {"file": elastic, "published": "FSI2", "window": 3.0,
             "set": [inflow, "shell.beam.density=10000", "shell.beam.material.young=1.4e6", "time.end=12", "time.step=0.004"]},
}


def histories(out):
    """Displacement of the tip in mm where it moves, drag and lift of cylinder and beam together in N/m."""
    beam, cylinder = (columns(out / f"forces-{name}.csv") for name in ("beam", "cylinder"))
    found = {"drag": (beam["force_x"] + cylinder["force_x"]) / depth, "lift": (beam["force_y"] + cylinder["force_y"]) / depth}
    if (out / "probe-tip.csv").exists():
        tip = columns(out / "probe-tip.csv")
        found = {"ux": 1e3 * tip["displacement_x"], "uy": 1e3 * tip["displacement_y"]} | found
    return beam["t"], found


def audited_drag(out, start):
    """Mean drag by the momentum of the fluid; the boxes around beam and cylinder overlap: both are of both together."""
    audit = columns(out / "audit.csv")
    late = audit["t"] >= start
    return np.mean(audit["by_momentum_cylinder_x"][late]) / depth


def smooth(t, y, width):
    """Mean over `width`, on instants evenly apart."""
    even = np.linspace(t[0], t[-1], 1 + int((t[-1] - t[0]) / 1e-3))
    samples = max(1, int(width / 1e-3))
    return even, np.convolve(np.interp(even, t, y), np.ones(samples) / samples, mode="same")


def rises(t, y):
    y = y - 0.5 * (y.max() + y.min())
    up = np.flatnonzero((y[:-1] < 0) & (y[1:] >= 0))
    return t[up] - y[up] * (t[up + 1] - t[up]) / (y[up + 1] - y[up])


def swing(t, y, periods):
    """Mean, amplitude and frequency, from extremes within each period."""
    spans = [y[(t >= a) & (t <= b)] for a, b in zip(periods[:-1], periods[1:])]
    mean = np.mean([0.5 * (s.max() + s.min()) for s in spans])
    amplitude = np.mean([0.5 * (s.max() - s.min()) for s in spans])
    inner = (t >= periods[0]) & (t <= periods[-1])
    at = rises(t[inner], y[inner])
    return mean, amplitude, (len(at) - 1) / (at[-1] - at[0])


def dry(out):
    """The beam alone under its weight: CSM1."""
    tip = columns(run(here / "csm1.toml", out / "csm1") / "probe-tip.csv")
    return {"ux": 1e3 * tip["displacement_x"][-1], "uy": 1e3 * tip["displacement_y"][-1]}


def row(name, quantity, ours, reference):
    theirs = float(reference)
    print(f"{name} | {quantity} | {ours:.4g} | {theirs:.4g} | {100 * (ours / theirs - 1):+.1f} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", default=list(cases))
    parser.add_argument("--out", type=Path, default=here / "results")
    parser.add_argument("--set", dest="settings", action="append", default=[])
    arguments = parser.parse_args()
    references = {row["case"]: row for row in published("turek_hron.csv")}
    print("case | quantity | luff | published | difference")
    for key, ours in dry(arguments.out).items():
        row("CSM1", f"{key}, mm", ours, references["CSM1"][f"{key}_mean_mm"])
    figure, axes = plt.subplots(len(arguments.names), 1, figsize=(9, 3.5 * len(arguments.names)), squeeze=False)
    for name, axis in zip(arguments.names, axes[:, 0]):
        case = cases[name]
        out = run(case["file"], arguments.out / name.lower(), case["set"] + arguments.settings)
        t, found = histories(out)
        late = t >= t[-1] - case["window"]
        leading = "uy" if "uy" in found else "lift"
        periods = rises(t[late], found[leading][late])
        reference = references[case["published"]]
        for key, series in found.items():
            # Forces without the pulses of single cells that change sides: means over a fiftieth of a period.
            moves = key in ("ux", "uy")
            unit, width = ("mm", 0.0) if moves else ("N/m", 0.02 * np.mean(np.diff(periods)))
            mean, amplitude, frequency = swing(*smooth(t[late], series[late], width), periods)
            row(name, f"{key}, mean, {unit}", mean, reference[f"{key}_mean_mm" if moves else f"{key}_mean"])
            row(name, f"{key}, amplitude, {unit}", amplitude, reference[f"{key}_amp"])
            if moves or key == leading:
                row(name, f"{key}, frequency, Hz", frequency, reference[f"{key}_f"])
        row(name, "drag by momentum, mean, N/m", audited_drag(out, t[-1] - case["window"]), reference["drag_mean"])
        axis.plot(t, found[leading], label="luff")
        mean, amplitude = (float(reference[key]) for key in (("uy_mean_mm", "uy_amp") if leading == "uy" else ("lift_mean", "lift_amp")))
        for sign in (-1, 1):
            axis.axhline(mean + sign * amplitude, color="black", linestyle="--", label="published extremes" if sign > 0 else None)
        axis.set(title=name, xlabel="t, s", ylabel="tip displacement y, mm" if leading == "uy" else "lift, N/m")
        axis.legend(loc="upper left")
    figure.tight_layout()
    figure.savefig(arguments.out / "turek-hron.png", dpi=130)


main()
