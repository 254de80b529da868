#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Kernels that are to run on GPUs are written for them, also where there is no nvcc to say so (the preset cuda compiles them).
# Usage: kernels_test.sh SOURCE_FOLDER
set -euo pipefail
python3 - "$1" <<'END'
import re
import sys
from pathlib import Path

seen, faults = 0, []
for folder in ("parallel", "operators", "poisson", "fluid"):
    for path in sorted((Path(sys.argv[1]) / "src" / folder).glob("*.cpp")):
        text = path.read_text()
        if path.name == "petsc_solver.cpp":  # stays on the host
            continue
        for call in re.finditer(r"\b(?:for_each_cell|sum_cells|max_cells)\(", text):
            head = text[call.end():].split("{")[0]  # up to the body of the kernel
            if "](" not in head.replace(" ", "") and "LUFF_KERNEL" not in head:
                continue  # a kernel with a name of its own
            seen += 1
            place = f"{path}:{text[:call.start()].count(chr(10)) + 1}"
            if "LUFF_KERNEL" not in head:
                faults.append(f"{place}: a kernel without LUFF_KERNEL")
            if re.search(r"\[[^\]]*\w *= ", head):
                faults.append(f"{place}: a kernel whose capture has an initialiser, which nvcc refuses")
print("\n".join(faults) or f"{seen} kernels")
sys.exit(1 if faults or seen < 15 else 0)
END
