#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""CPU time of one Newton iteration (assembly, factorisation, solve) of luff and of CalculiX on the same triangles.

Usage: benchmarks/shell/vs_calculix.py [--divisions 16 50 158] [--elements S3 S6] [--repeats 3] [--increments 4]

A hinged square plate, L = 1, h = 0.01, E = 1e6, nu = 0.3, under a follower pressure that deflects it by 1.26 h; irregular
triangles. CalculiX solves it with S3 and S6 elements (*STATIC, NLGEOM), on the same triangles, one thread, its own
direct solver. Its time of one iteration is the difference of two runs, in one and in several load increments, divided by
the difference of their iterations: reading, set-up and output are in both and drop out. luff's is that of Newton's
method without the one analysis of the matrix, printed by benchmark_shell_newton. Programs take turns, the medians count.

Needs: cmake --preset release -DLUFF_BENCHMARKS=ON && cmake --build build/release; apt-get install calculix-ccx
"""
import argparse
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

root = Path(__file__).resolve().parents[2]
one_thread = {**os.environ, "OMP_NUM_THREADS": "1", "CCX_NPROC_EQUATION_SOLVER": "1", "NUMBER_OF_CPUS": "1"}


def read_mesh(path):
    numbers = path.read_text().split()
    vertices, triangles = int(numbers[0]), int(numbers[1])
    x = [float(number) for number in numbers[2:2 + 3 * vertices]]
    t = [int(number) for number in numbers[2 + 3 * vertices:]]
    return list(zip(x[0::3], x[1::3], x[2::3])), list(zip(t[0::3], t[1::3], t[2::3]))


def with_middles(vertices, triangles):
    """Six-node triangles: a node in the middle of every side."""
    vertices, middle, elements = list(vertices), {}, []
    for a, b, c in triangles:
        sides = []
        for i, j in ((a, b), (b, c), (c, a)):
            key = min(i, j), max(i, j)
            if key not in middle:
                middle[key] = len(vertices)
                vertices.append(tuple((p + q) / 2 for p, q in zip(vertices[i], vertices[j])))
            sides.append(middle[key])
        elements.append((a, b, c, *sides))
    return vertices, elements


def write_job(path, kind, vertices, triangles, increments):
    if kind == "S6":
        vertices, triangles = with_middles(vertices, triangles)
    edge = [n for n, (x, y, _) in enumerate(vertices) if x in (0, 1) or y in (0, 1)]
    nodes = "\n".join(f"{n + 1},{x!r},{y!r},{z!r}" for n, (x, y, z) in enumerate(vertices))
    elements = "\n".join(",".join(str(n) for n in (e + 1, *(v + 1 for v in t))) for e, t in enumerate(triangles))
    path.write_text(f"""*NODE,NSET=ALL
{nodes}
*ELEMENT,TYPE={kind},ELSET=PLATE
{elements}
*NSET,NSET=EDGE
{os.linesep.join(str(n + 1) for n in edge)}
*BOUNDARY
EDGE,1,3
*MATERIAL,NAME=M
*ELASTIC
1e6,0.3
*SHELL SECTION,ELSET=PLATE,MATERIAL=M
0.01
*STEP,NLGEOM,INC=1000
*STATIC,DIRECT
{1 / increments},1.
*DLOAD
PLATE,P,1.0
*NODE PRINT,NSET=ALL,FREQUENCY=1000
U
*END STEP
""")


def cpu_seconds(command, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, env=one_thread, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{command[0]} failed:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def rows_of_numbers(path, length):
    for line in path.read_text().splitlines():
        words = line.split()
        if len(words) == length and words[0].isdigit():
            yield words


def run_calculix(folder, kind, vertices, triangles, increments):
    """CPU seconds, iterations, largest deflection."""
    write_job(folder / "job.inp", kind, vertices, triangles, increments)
    seconds, _ = cpu_seconds(["ccx", "-i", "job"], folder)
    iterations = sum(int(words[3]) for words in rows_of_numbers(folder / "job.sta", 7))
    deflection = max(abs(float(words[3])) for words in rows_of_numbers(folder / "job.dat", 4))
    return seconds, iterations, deflection


def calculix_iteration(folder, kind, mesh, increments):
    """CPU seconds per iteration, deflection."""
    seconds, iterations, deflection = zip(*(run_calculix(folder, kind, *mesh, n) for n in (1, increments)))
    return (seconds[1] - seconds[0]) / (iterations[1] - iterations[0]), deflection[1]


def measure(divisions, options):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        luff, peers = [], {kind: [] for kind in options.elements}
        for _ in range(options.repeats):
            program = str(options.benchmark.resolve())
            _, line = cpu_seconds([program, str(divisions), str(options.increments), "plate.mesh"], folder)
            luff.append(json.loads(line))
            mesh = read_mesh(folder / "plate.mesh")
            for kind, results in peers.items():
                results.append(calculix_iteration(folder, kind, mesh, options.increments))
    return luff, peers


def report(luff, peers):
    own = {key: median(result[key] for result in luff) for key in luff[0]}
    print(f"{own['triangles']} triangles")
    print(f"  luff         {1e3 * own['iteration']:9.2f} ms (residual {1e3 * own['residual']:.2f}, tangent "
          f"{1e3 * own['tangent']:.2f}, factorisation and solve {1e3 * own['linear']:.2f})   deflection "
          f"{own['deflection']:.6f}")
    for kind, results in peers.items():
        ratios = [seconds / result["iteration"] for (seconds, _), result in zip(results, luff)]
        print(f"  CalculiX {kind}  {1e3 * median(seconds for seconds, _ in results):9.2f} ms: {median(ratios):6.1f} times "
              f"luff's ({min(ratios):.1f} to {max(ratios):.1f})   deflection {results[0][1]:.6f}")


def main():
    parser = argparse.ArgumentParser(description="time of a Newton iteration against CalculiX")
    parser.add_argument("--divisions", type=int, nargs="+", default=[16, 50, 158], help="2 n^2 triangles each")
    parser.add_argument("--elements", nargs="+", default=["S3", "S6"], choices=["S3", "S6"])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--increments", type=int, default=4, help="of the longer run, at least 2")
    parser.add_argument("--benchmark", type=Path, default=root / "build/release/benchmarks/benchmark_shell_newton")
    options = parser.parse_args()
    if shutil.which("ccx") is None:
        sys.exit("CalculiX is missing: apt-get install calculix-ccx")
    if not options.benchmark.exists():
        sys.exit(f"{options.benchmark} is missing: configure with -DLUFF_BENCHMARKS=ON and build")
    for divisions in options.divisions:
        report(*measure(divisions, options))


main()
