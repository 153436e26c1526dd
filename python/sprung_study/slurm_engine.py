"""Runs as an array of Slurm, a chunk a task: each is `sprung study run --runs A..B` on a shared folder."""
import os
import subprocess
import sys
from pathlib import Path
from shlex import quote

from sprung_study.contract import missing, number_of, positive, program, show

LARGEST_ARRAY = 1000  # Slurm's usual MaxArraySize is 1001


def add_arguments(parser):
    parser.add_argument("study", help="file, seen by every node under this path")
    parser.add_argument("--out", required=True, help="folder of the study, seen by every node")
    parser.add_argument("--chunk", type=positive, default=50, help="runs in a task: minutes, not seconds")
    parser.add_argument("--cpus", type=int, default=1, help="of a task")
    parser.add_argument("--sbatch", action="append", default=[], metavar="OPTION",
                        help="handed on, e.g. --sbatch=--partition=short; may be repeated")
    parser.add_argument("--wait", action="store_true", help="until all tasks have ended")


def chunk_size(runs: int, asked: int) -> int:
    """At least what was asked, and so that the array is not too long."""
    return max(asked, -(-runs // LARGEST_ARRAY))


def array_of(numbers: list[int], chunk: int) -> str:
    """Chunks that have a run to do: "0,3,4"."""
    return ",".join(str(n) for n in sorted({(number - 1) // chunk for number in numbers}))


def script(study: str, out: str, chunk: int, runs: int) -> str:
    return f"""#!/bin/bash
first=$((SLURM_ARRAY_TASK_ID * {chunk} + 1))
last=$((first + {chunk} - 1))
[ $last -le {runs} ] || last={runs}
exec {quote(program())} study run {quote(study)} --runs $first..$last --jobs ${{SLURM_CPUS_PER_TASK:-1}} --out {quote(out)}
"""


def run(arguments) -> int:
    study, out = str(Path(arguments.study).resolve()), str(Path(arguments.out).resolve())
    numbers = [number_of(line) for line in missing(study, out)]
    if not numbers:
        print(f"{out}: no run is missing", file=sys.stderr)
        return 0
    runs = show(study)["runs"]
    chunk = chunk_size(runs, arguments.chunk)
    logs = Path(out) / "slurm"
    logs.mkdir(exist_ok=True)
    words = ["sbatch", "--parsable", "--requeue", f"--array={array_of(numbers, chunk)}", "--job-name=sprung-study",
             f"--cpus-per-task={arguments.cpus}", f"--output={logs}/%a.txt", "--export=ALL", *arguments.sbatch]
    if arguments.wait:
        words.append("--wait")
    done = subprocess.run(words, input=script(study, out, chunk, runs), text=True, stdout=subprocess.PIPE,
                          env=os.environ)
    if done.returncode != 0:
        left = len(missing(study, out))
        raise RuntimeError(f"{left} runs have no row; see {logs} and `sprung study collect {out}`; "
                           "the same command tries them again")
    print(f"{out}: job {done.stdout.strip()}, {len(numbers)} runs in chunks of {chunk}", file=sys.stderr)
    return 0
