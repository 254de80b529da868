#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Coupling iterations per step against mass ratio and scheme, as a table.

Usage: validation/coupling/iterations.py [--steps N] [--schemes quasi-newton aitken loose] [MASS_RATIO ...]
"""
import argparse
import json
import math
import subprocess
import tempfile
from pathlib import Path

here = Path(__file__).resolve().parent
luff = here.parent.parent / "luff"
time_step = 0.01  # of pinned-flag.toml

settings_of = {
    "quasi-newton": [],
    "aitken": ["coupling.acceleration='aitken'"],
    "loose": ["coupling.scheme='loose'"],
}


def shell_of(mass_ratio):
    """Thickness, density and Young's modulus for K_B = E h^3/12 = 0.01, rho h = M and E h = 1000 max(M, 0.1)."""
    stretching = 1000.0 * max(mass_ratio, 0.1)
    thickness = math.sqrt(12.0 * 0.01 / stretching)
    return thickness, mass_ratio / thickness, stretching / thickness


def run(mass_ratio, steps, settings):
    thickness, density, young = shell_of(mass_ratio)
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "run"
        command = [luff, "run", here / "pinned-flag.toml", "--out", out, "--threads", "1"]
        for key, value in {"thickness": thickness, "density": density, "material.young": young}.items():
            command += ["--set", f"shell.0.{key}={value!r}"]
        for setting in [f"time.end={steps * time_step!r}", *settings]:
            command += ["--set", setting]
        status = subprocess.run(command, capture_output=True, text=True).returncode
        summary = json.loads((out / "summary.json").read_text())
    if status != 0:
        return f"failed at t = {summary['t']:.2f}"
    return f"{summary['mean_coupling_iterations']:.2f} ({summary['max_coupling_iterations']}), {summary['halved_steps']} halved"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mass_ratios", nargs="*", type=float, default=[1.0, 0.1, 0.01])
    parser.add_argument("--steps", type=int, default=60)
    parser.add_argument("--schemes", nargs="+", choices=list(settings_of), default=list(settings_of))
    options = parser.parse_args()
    print(" | ".join(["mass ratio", *options.schemes]) + "     mean (max) iterations, steps halved")
    for mass_ratio in options.mass_ratios:
        row = [run(mass_ratio, options.steps, settings_of[scheme]) for scheme in options.schemes]
        print(f"{mass_ratio:g} | " + " | ".join(row), flush=True)


if __name__ == "__main__":
    main()
