"""The contract from Python: programs of sprung, asked by lines. No study is read here, no row written."""
import json
import os
import shutil
import subprocess
import threading
from pathlib import Path


def program() -> str:
    """$SPRUNG, else `sprung` on the path, else that of this source tree."""
    built = Path(__file__).resolve().parents[2] / "build/release/bin/sprung"
    found = os.environ.get("SPRUNG") or shutil.which("sprung") or (str(built) if built.exists() else None)
    if not found:
        raise RuntimeError("there is no program sprung: build it, or say where it is with SPRUNG=/path/to/sprung")
    return found


def positive(text: str) -> int:
    """A type of argparse."""
    if int(text) < 1:
        raise ValueError(text)
    return int(text)


def _said(*words: str) -> str:
    done = subprocess.run([program(), "study", *words], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip() or f"sprung study {' '.join(words)}: status {done.returncode}")
    return done.stdout


def show(study: str) -> dict:
    """The study, checked."""
    return json.loads(_said("show", study))


def claim(study: str, out: str):
    """The folder is this study's from now on, or an error."""
    _said("keep", study, "--out", out)


def missing(study: str, out: str) -> list[str]:
    """Lines of the runs that have no row in the folder; claims the folder for the study."""
    return _said("expand", study, "--missing", out).splitlines()


def number_of(line: str) -> int:
    return json.loads(line)["run"]


def error_answer(line: str, why: str) -> str:
    return json.dumps({"run": number_of(line), "error": why})


TRIES = 10  # of a run whose worker ends: as `sprung study run`


class Worker:
    """One `sprung study worker`. A run that takes too long ends it; the next run gets another."""

    def __init__(self, timeout_s: float):
        self.timeout_s = timeout_s
        self._process = None

    def ask(self, line: str) -> str:
        """The answer's line. Raises RuntimeError where the worker ends in the middle of the run."""
        if self._process is None or self._process.poll() is not None:
            self._process = subprocess.Popen([program(), "study", "worker"], stdin=subprocess.PIPE,
                                             stdout=subprocess.PIPE, text=True)
        process, late = self._process, threading.Event()

        def end():
            late.set()
            process.kill()

        timer = threading.Timer(self.timeout_s, end)
        timer.start()
        try:
            process.stdin.write(line + "\n")
            process.stdin.flush()
            answer = process.stdout.readline()
        except BrokenPipeError:
            answer = ""
        finally:
            timer.cancel()
        if answer.endswith("\n"):
            return answer.rstrip("\n")
        self.close()
        if late.is_set():
            return error_answer(line, f"took longer than {self.timeout_s:g} s and was stopped (timeout of the study)")
        raise RuntimeError(f"the worker ended in the middle of run {number_of(line)}")

    def answer(self, line: str) -> str:
        """The answer's line: an error where every worker ended in the middle of the run."""
        for _ in range(TRIES):
            try:
                return self.ask(line)
            except RuntimeError as error:
                why = str(error)
        return error_answer(line, f"{why}, {TRIES} times")

    def close(self):
        if self._process is not None:
            self._process.kill()
            self._process.communicate()
        self._process = None


class Keeper:
    """`sprung study keep`: answers go to the folder one by one, each whole or not there."""

    def __init__(self, study: str, out: str):
        self._process = subprocess.Popen([program(), "study", "keep", study, "--out", out], stdin=subprocess.PIPE,
                                         text=True)

    def keep(self, answer: str):
        try:
            self._process.stdin.write(answer + "\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            raise RuntimeError("nothing more can be kept, for the reason above") from None

    def finish(self) -> int:
        """0: every answer was a row; 1: some were none, as it has said."""
        try:
            self._process.stdin.close()
        except BrokenPipeError:
            pass  # it has ended: its last words follow
        return self._process.wait()
