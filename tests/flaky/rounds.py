"""Runs suites round by round, remembers what happened, and tells it at the end."""

import concurrent.futures
import json
import os
import pathlib
import re
import signal
import subprocess
import threading
import time

from busy import end_with_parent

LIMIT_S = 1200.0  # for a suite: one that hangs must not take the rounds of all others
FAILED_CASE = re.compile(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)(?:, where .*)? \(\d+ ms\)$", re.MULTILINE)
SKIPPED_CASE = re.compile(r"^\[  SKIPPED \] ([\w/]+\.[\w/]+) \(\d+ ms\)$", re.MULTILINE)


class Rounds:
    def __init__(self, folder, asked):
        self._folder, self._asked = folder, asked
        self._state_file = folder / "state.json"
        self._lock = threading.Lock()
        self._running = set()
        self._stopped = False
        folder.mkdir(parents=True, exist_ok=True)
        self._state = json.loads(self._state_file.read_text()) if self._state_file.exists() else {}

    def forget(self):
        for path in self._folder.iterdir():
            path.unlink()
        self._state = {}

    def run(self, suites, end):
        """@param end in time.monotonic(): nothing begins after it."""
        stamps = {suite.name: self._stamp(suite) for suite in suites}
        for suite in suites:
            if self._of(suite).get("stamp") != stamps[suite.name]:
                self._state[suite.name] = {"stamp": stamps[suite.name], "runs": 0, "failed": {}, "skipped": {}}
        self._run_all(self._due([s for s in suites if s.realtime]), 1, end)  # first: they never wait for the time to be over
        self._run_all(self._due([s for s in suites if not s.realtime]), self._asked.jobs, end)

    def _due(self, suites):
        """@return (suite, round), one round after the other, in each the longest first: nothing waits for the last of a round."""
        due = [(s, n) for s in suites for n in range(self._of(s)["runs"] + 1, self._wanted(s) + 1)]
        return sorted(due, key=lambda d: (d[1], -self._of(d[0]).get("seconds", 0.0), d[0].name))

    def _run_all(self, due, jobs, end):
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            try:
                list(pool.map(lambda one: self._run_one(*one, end), due))
            except KeyboardInterrupt:
                self._stop()
                raise

    def _stop(self):
        with self._lock:
            self._stopped = True
            for process in self._running:
                os.killpg(process.pid, signal.SIGKILL)

    def _of(self, suite):
        return self._state.get(suite.name, {})

    def _wanted(self, suite):
        return self._asked.process_rounds if suite.processes else self._asked.rounds

    def _stamp(self, suite):
        """Another one where what the suite runs was built anew."""
        files = [pathlib.Path(suite.program)]
        if suite.processes:
            files += (self._asked.build / "bin").iterdir()
        return max(file.stat().st_mtime for file in files)

    def _run_one(self, suite, number, end):
        began = time.monotonic()
        with self._lock:
            if began > end or self._stopped:
                return
            process = _start(suite)
            self._running.add(process)
        status, output = _output(process)
        with self._lock:
            self._running.remove(process)
            if self._stopped:
                return
        seconds = time.monotonic() - began
        failed = FAILED_CASE.findall(output)
        if status not in (0, suite.skip_status) and not failed:
            failed = [f"(the suite: exit status {status})"]
        with self._lock:
            self._remember(suite, seconds, failed, SKIPPED_CASE.findall(output))
        if failed:
            path = self._folder / f"{suite.name.replace('/', '.')}.{number}.txt"
            path.write_text(output, encoding="utf-8")
            print(f"FAILED {suite.name} round {number}: {' '.join(failed)}\n       {path}", flush=True)

    def _remember(self, suite, seconds, failed, skipped):
        kept = self._of(suite)
        kept["runs"] += 1
        kept["seconds"] = seconds
        for what, cases in (("failed", failed), ("skipped", skipped)):
            for case in set(cases):
                kept[what][case] = kept[what].get(case, 0) + 1
        draft = self._state_file.with_suffix(".new")
        draft.write_text(json.dumps(self._state, indent=1), encoding="utf-8")
        draft.replace(self._state_file)

    def report(self, suites):
        """@return exit status."""
        counted = [s for s in suites if not s.realtime]
        real_time = [s for s in suites if s.realtime]
        failures = self._tell("outside realtime", counted)
        self._tell("realtime (not counted)", real_time)
        left = sum(max(0, self._wanted(s) - self._of(s)["runs"]) for s in suites)
        if left:
            print(f"{left} runs are left: call it again, it goes on from here")
        return 1 if failures else 3 if left else 0

    def _tell(self, title, suites):
        runs = sum(self._of(s)["runs"] for s in suites)
        failures = 0
        print(f"\n{title}: {len(suites)} suites, {runs} runs")
        for suite in suites:
            kept = self._of(suite)
            for case, times in sorted(kept["failed"].items()):
                print(f"  FAILED  {times} of {kept['runs']}  {suite.name}: {case}")
                failures += times
            for case, times in sorted(kept["skipped"].items()):
                print(f"  skipped {times} of {kept['runs']}  {suite.name}: {case}")
        print(f"  {failures} failures")
        return failures


def _start(suite):
    return subprocess.Popen(
        suite.command,
        cwd=suite.folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        process_group=0,  # not a session: the kernel would share the processor out by sessions, half to the busy loops
        preexec_fn=end_with_parent,
    )


def _output(process):
    """@return exit status and output. What takes too long is ended, with all that it started in its group."""
    try:
        output = process.communicate(timeout=LIMIT_S)[0]
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        output = process.communicate()[0] + f"\nended after {LIMIT_S:.0f} s\n".encode()
    return process.returncode, output.decode("utf-8", errors="replace")
