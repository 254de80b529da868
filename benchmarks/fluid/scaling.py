#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What ranks say to each other in a step, a model of it fitted to measurements, and the efficiency that it expects on more of them.

    benchmarks/fluid/scaling.py [--cells 32 48 64 96] [--rounds 3] [--out DIR]

Runs benchmark_fluid_scaling on 2 and 4 ranks into DIR (default benchmarks/fluid/results) unless its output is there already,
prints the counts of messages, bytes and reductions beside those of the model, fits the waiting, prints expected efficiencies,
and draws DIR/scaling.png: weak up to 4096 ranks with 64^3, 96^3, 128^3 cells on each of them in a cube, strong with 512^3 in all.

Counts per rank and step, K cycles of the multigrid, v_l sweeps down and up on the levels l that ranks share, faces of A_l cells, q
messages in an exchange (two for each axis along which blocks split the grid; only y and z are split):

    exchanges   17.25 + K (sum (4 v_l + 2) + s)       s = 1 where y is split: conjugate gradients' direction, else 0
    bytes       8 x 30.5 A_0' + 4 K (sum (2 v_l + 1) A_l + s A_0)    summed over the q sides; doubles with edges, A' = (n + 2)(m + 2);
                                                      one colour of single precision, both for s
    reductions  21.75 + 3 K of a few numbers, and K sums of the first level that is no longer shared, padded to rows of 32

17.25 and 30.5 are the exchanges of the momentum's fields and how many fields they hold (a quarter is of what happens every
fourth step); the rest counts the calls in src/poisson. Time per step of a rank with c seconds a cell:

    t = c n^3 (1 + w) + K c' repeated + m a + b/B + (reductions) l log2 P + K (2 l log2 P + 2 g/B) + S sigma

a, B, l latency, bandwidth and a reduction's time for each doubling of ranks; c' = 9 ns a cell and cycle
(docs/numerics/poisson.md) on the levels that every rank repeats; g the bytes of a gathered level, S how often ranks wait for
each other (exchanges, reductions, gatherings). sigma and w, what a wait costs at least and how much later than the mean the
slowest rank comes, are fitted to t on two ranks, c being the cost of two runs side by side that do not talk.

On the cluster: NODE_RANKS ranks a node in the order of the grid's blocks, whose messages share one port of NODE_BYTES when
they leave it. Nothing above 4 ranks was measured.

Needs: cmake --preset release -DLUFF_BENCHMARKS=ON && cmake --build build/release
"""

import argparse
import math
import os
import pathlib
import re
import statistics
import subprocess

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
PROGRAM = HERE.parents[1] / "build/release/benchmarks/benchmark_fluid_scaling"
SHARED_CELLS = 20000  # as src/poisson/multigrid.cpp
CYCLE = 9e-9  # seconds a cell and cycle
NODE_RANKS = 128  # two processors of 64 cores
NODE_BYTES = 25e9  # one port of 200 Gbit/s (HDR InfiniBand)
LATENCY = 2e-6  # of a message between nodes, of a step of a reduction


def output(ranks, cells, rounds, folder):
    file = folder / f"{ranks}-{cells}.txt"
    if not file.exists():
        folder.mkdir(parents=True, exist_ok=True)
        # Ranks with a core of their own spin on it: who yields gives it to other programs for milliseconds. The others must yield.
        own_core = ranks <= os.cpu_count()
        command = ["mpirun", "--allow-run-as-root", "--mca", "mpi_yield_when_idle", "0" if own_core else "1"]
        command += ["--bind-to", "core"] if own_core else ["--oversubscribe"]
        command += ["-n", str(ranks), str(PROGRAM), str(cells), str(rounds)]
        environment = os.environ | {"OMP_NUM_THREADS": "1"}
        file.write_text(subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout)
    return file.read_text()


def numbers(text):
    """What a run printed: costs in seconds per cell, counts per step and rank, latencies in seconds."""
    found = {}
    for name in ("alone", "side by side", "weak", "strong"):
        found[name] = {"cost": 1e-6 * float(re.search(rf"^{name} +([\d.]+) us", text, re.M)[1])}
        said = re.search(rf"^{name} .*; ([\d.]+) messages, ([\d.]+) kB, ([\d.]+) reductions, ([\d.]+) gatherings with ([\d.]+) kB",
                         text, re.M)
        if said:
            names = ("messages", "bytes", "reductions", "cycles", "gathered")
            found[name] |= {n: float(v) * (1e3 if n in ("bytes", "gathered") else 1) for n, v in zip(names, said.groups())}
    machine = re.search(r"a message ([\d.]+) us, ([\d.]+) GB/s; a reduction ([\d.]+) us", text)
    found["machine"] = {"latency": 1e-6 * float(machine[1]), "bandwidth": 1e9 * float(machine[2]),
                        "reduction": 1e-6 * float(machine[3])}
    return found


def blocks(ranks, shape):
    """Blocks along y and z with the smallest surface, as src/parallel/decomposition.cpp."""
    pairs = [(ranks // pz, pz) for pz in range(1, ranks + 1) if ranks % pz == 0]
    return min(pairs, key=lambda p: (p[0] - 1) * shape[2] + (p[1] - 1) * shape[1])


def sweeps(cells, finest_cells):
    """Down and up on a level, as src/poisson/multigrid.cpp."""
    return 2 if cells > finest_cells / 4 else 3 if cells > finest_cells / 32 else 4


def levels(shape, split):
    """Cells of a block along each axis on the levels that are shared, and all cells of the first that is not."""
    local = [shape[0], shape[1] / split[0], shape[2] / split[1]]
    shared = []
    while True:
        shared.append(local)
        local = [max(1, math.ceil(n / 2)) for n in local]
        whole = [local[0], local[1] * split[0], local[2] * split[1]]
        if math.prod(whole) <= SHARED_CELLS:
            return shared, whole


def counts(ranks, shape, cycles):
    """Messages, bytes, reductions, bytes of a gathering, waits and repeated cells of a rank in a step."""
    split = blocks(ranks, shape)
    shared, repeated = levels(shape, split)
    along_y = split[0] > 1
    visits = [2 * sweeps(math.prod(level), math.prod(shared[0])) + 1 for level in shared]  # exchanges of each colour
    exchanges = 17.25 + cycles * (2 * sum(visits) + along_y)
    data, sides = 0.0, 0
    for axis in (1, 2):
        if split[axis - 1] == 1:
            continue
        sides += 2
        n, m = shared[0][0], shared[0][3 - axis]
        faces = [level[0] * level[3 - axis] for level in shared]
        swept = sum(v * face for v, face in zip(visits, faces))
        data += 2 * (8 * 30.5 * (n + 2) * (m + 2) + 4 * cycles * (swept + along_y * faces[0]))
    row = 32 * math.ceil((math.ceil(repeated[0] / 2) + 2) / 16)
    return {"messages": sides * exchanges, "bytes": data, "reductions": 21.75 + 3 * cycles,
            "gathered": cycles * 4 * row * (repeated[1] + 2) * (repeated[2] + 2),
            "waits": exchanges + 21.75 + 4 * cycles, "repeated": math.prod(repeated) * 8 / 7, "split": split}


def parts(n, ranks, cycles, latency, bandwidth, reduction):
    """Seconds of a rank in a step by what they go into."""
    depth = math.log2(ranks)
    return {"messages' latency": n["messages"] * latency, "their bytes": n["bytes"] / bandwidth,
            "reductions": n["reductions"] * reduction * depth,
            "gatherings": cycles * 2 * reduction * depth + 2 * n["gathered"] / bandwidth,
            "repeated levels": (1 - 1 / ranks) * cycles * CYCLE * n["repeated"]}


def talk(*of):
    return sum(parts(*of).values())


def check_counts(measured):
    print("ranks, cells | messages: counted, model | kB: counted, model | reductions | gathered kB: counted, model")
    for (ranks, cells), found in measured.items():
        for name, shape in (("weak", (cells, cells, cells * ranks)), ("strong", (cells,) * 3)):
            said = found[name]
            n = counts(ranks, shape, said["cycles"])
            print(f"{ranks}, {cells}^3 {name} | {said['messages']:.1f}, {n['messages']:.1f} | {1e-3 * said['bytes']:.0f}, "
                  f"{1e-3 * n['bytes']:.0f} | {said['reductions']:.2f}, {n['reductions']:.2f} | {1e-3 * said['gathered']:.0f}, "
                  f"{1e-3 * n['gathered']:.0f}")


def fit_waiting(measured):
    """sigma and w by least squares of the relative error of t on two ranks."""
    rows, rest, lines = [], [], []
    for (ranks, cells), found in measured.items():
        if ranks != 2:
            continue
        for name, shape in (("weak", (cells, cells, cells * 2)), ("strong", (cells,) * 3)):
            said, machine = found[name], found["machine"]
            own = math.prod(shape) / 2
            work, t = own * found["side by side"]["cost"], own * said["cost"]
            n = counts(2, shape, said["cycles"])
            told = talk(n, 2, said["cycles"], machine["latency"], machine["bandwidth"], machine["reduction"])
            rows.append([n["waits"] / t, work / t])
            rest.append((t - work - told) / t)
            lines.append((f"{cells}^3 {name}", t, work, told, n["waits"]))
    (sigma, w), *_ = np.linalg.lstsq(np.array(rows), np.array(rest), rcond=None)
    print("two ranks | ms a step, measured | of that work | messages and repeated levels | model")
    for name, t, work, told, waits in lines:
        model = work * (1 + w) + told + sigma * waits
        print(f"{name} | {1e3 * t:.1f} | {1e3 * work:.1f} | {1e3 * told:.2f} | {1e3 * model:.1f} ({100 * (model / t - 1):+.0f} %)")
    print(f"a wait {1e6 * sigma:.0f} us, and {100 * w:.0f} % of the work")
    return sigma, w


def leaving(split):
    """Which part of a rank's messages leaves its node, ranks being numbered along z first."""
    ranks = split[0] * split[1]
    if ranks <= NODE_RANKS:
        return 0.0
    if split[1] >= NODE_RANKS:
        return 0.5
    return 0.5 * split[1] / NODE_RANKS


def on_cluster(ranks, edge, cycles, machine):
    """What `parts` takes for a cube of edge^3 cells."""
    n = counts(ranks, (edge,) * 3, cycles)
    away = leaving(n["split"])
    per_byte = (1 - away) / machine["bandwidth"] + away * NODE_RANKS / NODE_BYTES
    many = ranks > NODE_RANKS
    latency = LATENCY if many else machine["latency"]
    reduction = LATENCY if many else machine["reduction"]
    return n, ranks, cycles, latency, 1 / per_byte, reduction


def expected(ranks, edge, c, cycles, machine, sigma=0.0, w=0.0):
    """Seconds of a step of a cube of edge^3 cells."""
    own = edge**3 / ranks
    if ranks == 1:
        return own * c
    of = on_cluster(ranks, edge, cycles, machine)
    return own * c * (1 + w) + talk(*of) + sigma * of[0]["waits"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cells", type=int, nargs="+", default=[32, 48, 64, 96])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--out", type=pathlib.Path, default=HERE / "results")
    options = parser.parse_args()
    measured = {(ranks, cells): numbers(output(ranks, cells, options.rounds if ranks == 2 else 1, options.out))
                for ranks in (2, 4) for cells in options.cells}
    check_counts(measured)
    sigma, w = fit_waiting(measured)
    two = [found for (ranks, _), found in measured.items() if ranks == 2]
    c = two[-1]["side by side"]["cost"]
    cycles = statistics.mean(found["weak"]["cycles"] for found in two)
    machine = {key: statistics.median(found["machine"][key] for found in two) for key in two[0]["machine"]}
    shared = [100 * found["alone"]["cost"] / found["side by side"]["cost"] for found in two]
    print("two side by side that do not talk, of one alone: "
          + ", ".join(f"{cells}³ {share:.0f} %" for cells, share in zip(options.cells, shared)))
    print(f"a message {1e6 * machine['latency']:.2f} us, {1e-9 * machine['bandwidth']:.1f} GB/s, a reduction "
          f"{1e6 * machine['reduction']:.2f} us; {1e6 * c:.3f} us a cell, {cycles:.1f} cycles a step")
    ranks = [2**e for e in range(13)]
    curves = {}
    for waits, what in (((0.0, 0.0), "no waiting"), ((sigma, w), "with the waiting of two ranks")):
        for cells in (64, 96, 128):
            curves[f"weak, {cells}³ each", what] = [
                c * cells**3 / expected(p, cells * p ** (1 / 3), c, cycles, machine, *waits) for p in ranks]
        curves["strong, 512³", what] = [c * 512**3 / (p * expected(p, 512, c, cycles, machine, *waits)) for p in ranks]
    for (name, what), values in curves.items():
        print(f"{name}, {what}: " + ", ".join(f"{p}: {100 * e:.0f} %" for p, e in zip(ranks, values)))
    for p in (128, 1024, 4096):
        shares = parts(*on_cluster(p, 96 * p ** (1 / 3), cycles, machine))
        print(f"{p} ranks, 96³ each: work {1e3 * c * 96**3:.0f} ms; " + ", ".join(f"{k} {1e3 * v:.1f}" for k, v in shares.items()))
    plot(options.out / "scaling.png", ranks, curves, measured)


def plot(file, ranks, curves, measured):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(11, 4), sharey=True)
    colours = {}
    for (name, what), values in curves.items():
        axis = axes[1 if name.startswith("strong") else 0]
        style = {"base": 2, "label": f"{name}, {what}"}
        if name in colours:
            axis.semilogx(ranks, values, "--", color=colours[name], **style)
        else:
            (line,) = axis.semilogx(ranks, values, "-", **style)
            colours[name] = line.get_color()
    for name, axis in zip(("weak", "strong"), axes):
        points = [found["side by side"]["cost"] / found[name]["cost"] for (p, _), found in measured.items() if p == 2]
        sizes = ", ".join(f"{cells}³" for p, cells in measured if p == 2)
        axis.plot([2] * len(points), points, "ko", ms=4, label=f"measured on two ranks, upwards: {sizes}")
        axis.set(xlabel="ranks; lines: the model", ylim=(0, 1.05))
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7, loc="lower left")
    axes[0].set_ylabel("efficiency")
    figure.tight_layout()
    figure.savefig(file, dpi=110)


if __name__ == "__main__":
    main()
