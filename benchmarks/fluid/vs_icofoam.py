#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""CPU time of a whole step of luff and of OpenFOAM's icoFoam on one core: Taylor and Green's vortex in three dimensions.

Usage: benchmarks/fluid/vs_icofoam.py [--cells 64] [--steps 5] [--repeats 3]

A periodic cube of side 2 pi, Re = 100, u = (sin x cos y cos z, -cos x sin y cos z, 0), steps of a quarter of a cell.
icoFoam: central differences, implicit Euler, PISO with two corrections, pressure to a residual of 1e-10 by the faster
of its GAMG and PCG (DIC); luff: rk3, two projections, max |div U| h/|U| <= 1e-10. The time of a step is the difference of a long and
a short run over the difference of their steps: reading, set-up and output drop out. Programs take turns, the medians
count.

Needs: ./luff build; apt-get install openfoam
"""
import argparse
import math
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

root = Path(__file__).resolve().parents[2]
# Debian keeps OpenFOAM's own settings there.
one_thread = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ, "OMP_NUM_THREADS": "1"}
viscosity = 0.01
short = 2


def head(kind, name):
    return f"FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n"


def foam_case(folder, cells, dt, solver):
    """Writes icoFoam's input but for the number of steps."""
    for sub in ("0", "constant", "system"):
        (folder / sub).mkdir(parents=True)
    side = 2 * math.pi
    corners = " ".join(f"({x} {y} {z})" for z in (0, side) for x, y in ((0, 0), (side, 0), (side, side), (0, side)))
    faces = {"xl": "(0 4 7 3)", "xh": "(1 2 6 5)", "yl": "(0 1 5 4)", "yh": "(3 7 6 2)", "zl": "(0 3 2 1)", "zh": "(4 5 6 7)"}
    pairs = {a: a[0] + ("h" if a[1] == "l" else "l") for a in faces}
    patches = " ".join(f"{a} {{ type cyclic; neighbourPatch {pairs[a]}; faces ({faces[a]}); }}" for a in faces)
    (folder / "system/blockMeshDict").write_text(head("dictionary", "blockMeshDict") + f"""
vertices ({corners});
blocks (hex (0 1 2 3 4 5 6 7) ({cells} {cells} {cells}) simpleGrading (1 1 1));
boundary ({patches});
""")
    (folder / "constant/transportProperties").write_text(
        head("dictionary", "transportProperties") + f"nu [0 2 -1 0 0 0 0] {viscosity};\n")
    (folder / "system/fvSchemes").write_text(head("dictionary", "fvSchemes") + """
ddtSchemes { default Euler; } gradSchemes { default Gauss linear; } divSchemes { default Gauss linear; }
laplacianSchemes { default Gauss linear orthogonal; } interpolationSchemes { default linear; } snGradSchemes { default orthogonal; }
""")
    pressure = ("solver GAMG; smoother GaussSeidel;" if solver == "GAMG" else "solver PCG; preconditioner DIC;")
    (folder / "system/fvSolution").write_text(head("dictionary", "fvSolution") + f"""
solvers {{ p {{ {pressure} tolerance 1e-10; relTol 0; }} pFinal {{ $p; }}
           U {{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-10; relTol 0; }} }}
PISO {{ nCorrectors 2; nNonOrthogonalCorrectors 0; pRefCell 0; pRefValue 0; }}
""")
    cyclic = " ".join(f"{a} {{ type cyclic; }}" for a in faces)
    centres = [(i + 0.5) * side / cells for i in range(cells)]
    velocity = "\n".join(f"({math.sin(x) * math.cos(y) * math.cos(z)!r} {-math.cos(x) * math.sin(y) * math.cos(z)!r} 0)"
                         for z in centres for y in centres for x in centres)
    (folder / "0/U").write_text(head("volVectorField", "U") + "dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform "
                                f"List<vector> {cells ** 3} (\n{velocity}\n);\nboundaryField {{ {cyclic} }}\n")
    (folder / "0/p").write_text(head("volScalarField", "p") + "dimensions [0 2 -2 0 0 0 0];\ninternalField uniform 0;\n"
                                f"boundaryField {{ {cyclic} }}\n")
    set_steps(folder, 1, dt)
    cpu_seconds(["blockMesh", "-case", folder])


def set_steps(folder, steps, dt):
    (folder / "system/controlDict").write_text(head("dictionary", "controlDict") + f"""
application icoFoam; startFrom startTime; startTime 0; stopAt endTime; endTime {(steps + 0.5) * dt!r}; deltaT {dt!r};
writeControl timeStep; writeInterval 1000000; runTimeModifiable false;
""")


def luff_case(path, cells, dt):
    axis = f'{{ from = 0.0, to = {2 * math.pi!r}, cells = {cells} }}'
    sides = "\n".join(f'{a}_{e} = {{ type = "periodic" }}' for a in "xyz" for e in ("min", "max"))
    path.write_text(f"""title = "Taylor and Green's vortex"
[time]
end = 1.0
step = {dt!r}
[fluid]
density = 1.0
viscosity = {viscosity}
initial.velocity = ["sin(x)*cos(y)*cos(z)", "-cos(x)*sin(y)*cos(z)", "0"]
[grid]
x = {axis}
y = {axis}
z = {axis}
[boundary]
{sides}
[pressure]
tolerance = "fast"
""")


def cpu_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    outcome = subprocess.run(command, env=one_thread, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if outcome.returncode != 0:
        sys.exit(f"{command} failed:\n{outcome.stdout[-2000:]}{outcome.stderr[-2000:]}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, default=64)
    parser.add_argument("--steps", type=int, default=5)
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    dt = 0.25 * 2 * math.pi / options.cells

    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        luff_case(folder / "case.toml", options.cells, dt)
        for solver in ("GAMG", "PCG"):
            foam_case(folder / solver, options.cells, dt, solver)

        def luff(steps):
            out = folder / f"out-{len(list(folder.iterdir()))}"
            return cpu_seconds([root / "build/release/luff", "run", folder / "case.toml", "--threads", "1", "--out", out,
                                "--set", f"time.end={steps * dt!r}"])

        def foam(solver, steps):
            set_steps(folder / solver, steps, dt)
            return cpu_seconds(["icoFoam", "-case", folder / solver])

        seconds = {"luff": [], "GAMG": [], "PCG": []}
        for _ in range(options.repeats):
            for name, times in seconds.items():
                run = luff if name == "luff" else lambda steps, solver=name: foam(solver, steps)
                times.append((run(short + options.steps) - run(short)) / options.steps)
    each = {name: 1e6 * median(times) / options.cells ** 3 for name, times in seconds.items()}
    print(f"CPU microseconds per cell and step, {options.cells}^3, one core")
    print(f"luff {each['luff']:.3f}, icoFoam with GAMG {each['GAMG']:.2f}, with PCG {each['PCG']:.2f}")
    fastest = min(("GAMG", "PCG"), key=each.get)
    ratios = [foam / ours for foam, ours in zip(seconds[fastest], seconds["luff"])]
    print(f"icoFoam ({fastest}) over luff: {median(ratios):.1f} (lowest {min(ratios):.1f}, highest {max(ratios):.1f})")


main()
