#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Cost of a whole coupled step of the three-dimensional flag on one core, and where it goes.

Usage: benchmarks/coupled_step.py [STEPS]     (default 50)

Prints CPU time per cell and step (the difference of a long and a short run, so that start-up does not count) and the
share of the immersed boundary (search, stencils, loads) and the shell.
"""
import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parent.parent
steps = int(sys.argv[1]) if len(sys.argv) > 1 else 50
first = 10


def run(n, out):
    command = [root / "luff", "run", root / "cases/flag/case.toml", "--threads", "1", "--out", out,
               "--set", f"time.end={0.02 * n!r}", "--set", "output.plots=false", "--set", "output.fields.every=100.0",
               "--set", "output.shells.every=100.0"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, json.loads((out / "summary.json").read_text())


with tempfile.TemporaryDirectory() as folder:
    start, _ = run(first, Path(folder) / "short")
    total, summary = run(first + steps, Path(folder) / "long")

phases = {name: seconds for name, seconds in summary["phases"].items() if name != "output"}
everything = sum(phases.values())
sheet = sum(phases[name] for name in ("search", "cut_cells", "loads", "shell"))
print(f"{1e6 * (total - start) / (steps * summary['cells']):.2f} us per cell and step (CPU, {summary['cells']:.0f} cells, "
      f"{summary['mean_coupling_iterations']:.2f} coupling iterations a step)")
print(f"{100 * sheet / everything:.1f} % of it: immersed boundary (search, stencils, loads) and shell")
for name, seconds in phases.items():
    print(f"  {name:10s} {100 * seconds / everything:5.1f} %")
