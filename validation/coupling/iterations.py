#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Coupling iterations per step against mass ratio and acceleration, as a table.

Usage: validation/coupling/iterations.py [MASS_RATIO ...]     (default 1 0.1 0.01)
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

here = Path(__file__).resolve().parent
luff = here.parent.parent / "luff"


def shell_of(mass_ratio):
    """Thickness, density and Young's modulus for K_B = E h^3/12 = 0.01, rho h = M and E h = 1000 max(M, 0.1)."""
    stretching = 1000.0 * max(mass_ratio, 0.1)
    thickness = math.sqrt(12.0 * 0.01 / stretching)
    return thickness, mass_ratio / thickness, stretching / thickness


def run(mass_ratio, *settings):
    thickness, density, young = shell_of(mass_ratio)
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "run"
        command = [luff, "run", here / "pinned-flag.toml", "--out", out, "--threads", "1"]
        for key, value in {"thickness": thickness, "density": density, "material.young": young}.items():
            command += ["--set", f"shell.0.{key}={value!r}"]
        for setting in settings:
            command += ["--set", setting]
        status = subprocess.run(command, capture_output=True, text=True).returncode
        summary = json.loads((out / "summary.json").read_text())
    if status != 0:
        return f"failed at t = {summary['t']:.2f}"
    return f"{summary['mean_coupling_iterations']:.2f} ({summary['max_coupling_iterations']}), {summary['halved_steps']} halved"


print("mass ratio | IQN-ILS mean (max) | Aitken mean (max) | loose")
for mass_ratio in [float(a) for a in sys.argv[1:]] or [1.0, 0.1, 0.01]:
    row = [
        run(mass_ratio),
        run(mass_ratio, "coupling.acceleration='aitken'"),
        run(mass_ratio, "coupling.scheme='loose'", "time.end=2.0"),
    ]
    print(f"{mass_ratio:g} | " + " | ".join(row), flush=True)
