# SPDX-License-Identifier: BSD-3-Clause
"""Published tables, runs of luff that are made once, and the tables that runs write: what the comparisons in the folders here share.

A script of a folder takes it from the folder above its own:

    here = Path(__file__).resolve().parent
    sys.path.insert(0, str(here.parent))
    from comparison import columns, published, root, run
"""
import csv
import subprocess
from pathlib import Path

import numpy as np

root = Path(__file__).resolve().parent.parent


def published(file):
    """Rows of a table of validation/data, or of one with a path of its own, as {column: word}; lines that begin with # are remarks."""
    with open(root / "validation" / "data" / file) as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def run(case, out, changes=(), words=(), check=True):
    """Runs luff on `case` into `out` with --set for each of the changes and further words, unless the run is there already.

    Returns `out`. A run that fails raises CalledProcessError, with check=False it leaves what it reached."""
    if not (out / "summary.json").exists():
        settings = [word for change in changes for word in ("--set", change)]
        subprocess.run([root / "luff", "run", case, "--out", out, *settings, *words], check=check)
    return out


def run_text(text, folder):
    """Runs the case of this text, which becomes folder/case.toml, into folder/run unless that is there already, and returns it."""
    out = folder / "run"
    if not (out / "summary.json").exists():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "case.toml").write_text(text)
    return run(folder / "case.toml", out)


def refined_axis(low, high, cells, zone, spacing):
    """An axis of a box grid from low to high, for --set grid.x=..., with cells of a spacing within a zone (from, to)."""
    refined = f"{{ from = {zone[0]}, to = {zone[1]}, spacing = {spacing:.10g} }}"
    return f"{{ from = {low}, to = {high}, cells = {cells}, refine = {refined} }}"


def columns(table):
    """{name without its unit: values} of a table that a run wrote; cells without a value are NaN."""
    with open(table) as file:
        names, *rows = csv.reader(file)
    values = np.array([[float(word) if word else np.nan for word in row] for row in rows]).reshape(len(rows), len(names))
    return {name.split(" [")[0]: values[:, n] for n, name in enumerate(names)}
