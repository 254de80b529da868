#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bound of the efficiency of a step on many ranks, from what benchmark_fluid_scaling counts and measures, and its plot.

    benchmarks/fluid/scaling.py [--cells 64 ...] [--rounds 3] [--plot FILE]

Runs the benchmark on 2 and 4 ranks, prints what it measured and counted, and the weak efficiency that these alone would leave. A step of
n^3 cells on each of P ranks costs

    t(P) = (n^3 + repeated) c + m a + b/B + r l log2 P,     efficiency n^3 c(1)/t(P),

c the cost of a cell, alone for P = 1 and with neighbours on the same memory for more; m messages of b bytes in all at a
latency a and a bandwidth B; r reductions, whose time l log2 P grows with the depth of a tree; repeated, the cells of the
levels of the multigrid that are so small that every rank works on all of them.

Counted: m, b, r on two ranks, and on four that share one cube as 2 x 2 pencils; a face of a pencil of n^3 cells has twice as
many cells as theirs, and m grows with the number of levels that ranks share. Measured: c, a, B, l, on the cores that are
there. Extrapolated: everything above 4 ranks, as if every rank had a core, and a message took as long as here.

It is a bound: ranks that wait for each other, and caches that are cold after a wait, are not in it.

Needs: cmake --preset release -DLUFF_BENCHMARKS=ON && cmake --build build/release
"""

import argparse
import math
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/release/benchmarks/benchmark_fluid_scaling"
SHARED_CELLS = 20000  # as src/poisson/multigrid.cpp


def run(ranks, cells, rounds):
    command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks), str(PROGRAM), str(cells), str(rounds)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def numbers(text):
    """What a run printed: costs in microseconds per cell, counts per step and rank, latencies in seconds."""
    found = {}
    for name in ("alone", "side by side", "weak", "strong"):
        cost = re.search(rf"^{name} +([\d.]+) us.*outside MPI ([\d.]+)", text, re.M)
        found[name] = {"all": float(cost[1]), "outside": float(cost[2])}
        counts = re.search(rf"^{name} .*; (\d+) messages, (\d+) kB, (\d+) reductions", text, re.M)
        if counts:
            found[name] |= {"messages": int(counts[1]), "bytes": 1e3 * int(counts[2]), "reductions": int(counts[3])}
    latency = re.search(r"a message ([\d.]+) us, ([\d.]+) GB/s; a reduction ([\d.]+) us", text)
    found["message"], found["reduction"] = 1e-6 * float(latency[1]), 1e-6 * float(latency[3])
    found["bandwidth"] = 1e9 * float(latency[2])
    return found


def levels_shared_out(cells, ranks):
    """How many levels of the multigrid ranks share, and the cells of the first one that each of them repeats."""
    level, count = cells**3 * ranks, 0
    while level > SHARED_CELLS:
        level /= 8
        count += 1
    return count, level


def efficiency(two, four, cells, ranks):
    """The model: weak efficiency of `cells` cubed on each of `ranks` ranks."""
    if ranks == 1:
        return 1.0
    counts = two["weak"] if ranks == 2 else four["strong"]
    counted_levels, _ = levels_shared_out(cells, 2 if ranks == 2 else 1)
    levels, first_repeated = levels_shared_out(cells, ranks)
    messages = counts["messages"] * levels / counted_levels
    data = counts["bytes"] * (1 if ranks == 2 else 2)
    repeated = (1 - 1 / ranks) * first_repeated * 8 / 7  # and the coarser ones
    work = 1e-6 * two["side by side"]["all"] * (cells**3 + repeated)
    talk = messages * two["message"] + data / two["bandwidth"]
    talk += counts["reductions"] * two["reduction"] * math.log2(ranks)
    return 1e-6 * two["alone"]["all"] * cells**3 / (work + talk)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cells", type=int, nargs="+", default=[64])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--plot", type=pathlib.Path)
    options = parser.parse_args()
    ranks = [2**e for e in range(13)]
    curves = {}
    for cells in options.cells:
        texts = [run(2, cells, options.rounds), run(4, cells, 1)]  # of four, the counts are all that is used
        print(*texts, sep="", end="")
        two, four = (numbers(text) for text in texts)
        curves[cells] = [efficiency(two, four, cells, p) for p in ranks]
        print(f"{cells}^3 cells a rank, at most: " + ", ".join(f"{p}: {100 * e:.0f} %" for p, e in zip(ranks, curves[cells])))
    if options.plot:
        plot(options.plot, ranks, curves)


def plot(file, ranks, curves):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6, 3.6))
    for cells, values in curves.items():
        (line,) = axes.semilogx(ranks[:3], values[:3], "o-", base=2, label=f"{cells}³ cells a rank")
        axes.semilogx(ranks[2:], values[2:], "--", base=2, color=line.get_color())
    axes.set_xlabel("ranks; dashed: extrapolated")
    axes.set_ylabel("weak efficiency, at most")
    axes.set_ylim(0, 1.05)
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(file, dpi=120)


if __name__ == "__main__":
    main()
