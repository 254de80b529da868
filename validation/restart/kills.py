#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Kills a run at random instants, 200 times, and spoils its newest checkpoint, 50 times; counts what is lost.

A coupled run is made once without interruption. Another one of the same case is killed (SIGKILL) after a random time, goes
on with --restart, is killed again and so on; when it reaches its end it is compared and begins anew. Before some of the
restarts its newest checkpoint is cut short, or a random byte of it is changed, or it is emptied. A run is lost when it cannot go on,
or ends with other bytes than the uninterrupted one in any table or checkpointed field.

    validation/restart/kills.py [--luff build/release/luff] [--kills 200] [--spoilt 50] [--ranks N] [--seed N]
"""
import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_mpi_yield_when_idle="1")


def command(luff, ranks, arguments):
    start = ["mpirun", "--quiet", "-n", str(ranks)] if ranks > 1 else []
    return start + [str(luff), "run", str(ROOT / "validation/restart/flag.toml"), *arguments]


def checkpoints(run):
    return sorted(run.glob("checkpoint-*.h5"))


def spoil(file, dice):
    """Cuts the file, empties it, or changes a byte; says which."""
    size = file.stat().st_size
    kind = dice.choice(["cut", "byte", "byte", "empty"])
    if kind == "cut":
        os.truncate(file, dice.randrange(size))
    elif kind == "empty":
        os.truncate(file, 0)
    else:
        at = dice.randrange(size)
        with open(file, "r+b") as stream:
            stream.seek(at)
            byte = stream.read(1)[0]
            stream.seek(at)
            stream.write(bytes([byte ^ (1 << dice.randrange(8))]))
    return kind


def without_seconds(table):
    """Rows of steps.csv but the columns that tell seconds."""
    rows = [line.split(",") for line in table.read_text().splitlines()]
    kept = [n for n, name in enumerate(rows[0]) if not name.startswith("seconds_")]
    return [[row[n] for n in kept] for row in rows]


def differences(a, b):
    """Names of tables and series that differ."""
    wrong = []
    for file in sorted(a.rglob("*")):
        name = file.relative_to(a)
        if not file.is_file() or file.suffix not in (".csv", ".pvd", ".vtp", ".vtr", ".pvtr"):
            continue
        other = b / name
        if not other.exists():
            wrong.append(f"{name} is missing")
        elif file.name == "steps.csv":
            if without_seconds(file) != without_seconds(other):
                wrong.append(str(name))
        elif file.read_bytes() != other.read_bytes():
            wrong.append(str(name))
    return wrong


def kill_after(process, seconds, ranks):
    """True if it was still running and was killed."""
    try:
        process.wait(timeout=seconds)
        return False
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        if ranks > 1:
            time.sleep(0.5)  # ranks that mpirun started end a little later
        return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--luff", type=pathlib.Path, default=ROOT / "build/release/luff")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--spoilt", type=int, default=50)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    dice = random.Random(options.seed)
    work = pathlib.Path(tempfile.mkdtemp(prefix="luff-kills-"))
    whole, run = work / "whole", work / "run"

    began = time.time()
    subprocess.run(command(options.luff, options.ranks, ["--out", str(whole)]), check=True, env=ENVIRONMENT,
                   stdout=subprocess.DEVNULL)
    seconds = time.time() - began
    print(f"uninterrupted: {seconds:.1f} s", flush=True)

    kills = spoilt = ends = lost = passed_over = before_first = 0
    kinds = {}
    while kills < options.kills or spoilt < options.spoilt:
        if run.exists() and len(checkpoints(run)) > 1 and spoilt < options.spoilt and dice.random() < 0.5:
            kind = spoil(checkpoints(run)[-1], dice)
            kinds[kind] = kinds.get(kind, 0) + 1
            spoilt += 1
        if run.exists() and not checkpoints(run):
            before_first += 1  # killed before there was anything to go on from
            shutil.rmtree(run)
        arguments = ["--restart", str(run)] if run.exists() else ["--out", str(run)]
        process = subprocess.Popen(command(options.luff, options.ranks, arguments), env=ENVIRONMENT,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)
        killed = kill_after(process, dice.uniform(0.0, 0.5 * seconds), options.ranks)
        said = process.stdout.read()
        passed_over += said.count("is not used:")
        if killed:
            kills += 1
            continue
        if process.returncode != 0:
            lost += 1
            print(f"lost after {kills} kills and {spoilt} spoilt checkpoints: {said[-2000:]}", flush=True)
        else:
            ends += 1
            wrong = differences(whole, run)
            if wrong:
                lost += 1
                print(f"ended differently after {kills} kills: {', '.join(wrong[:5])}", flush=True)
        shutil.rmtree(run)

    print(f"kills {kills}, spoilt checkpoints {spoilt} ({', '.join(f'{v} {k}' for k, v in sorted(kinds.items()))}; "
          f"{passed_over} passed over), before the first checkpoint {before_first}, runs that ended {ends}, runs lost {lost}")
    shutil.rmtree(work)
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
