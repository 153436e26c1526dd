"""A simulated robot that runs for a moment and is recorded."""

import os
import subprocess
import sys
import time

import lcm

import programs


class Robot:
    """Up in lock-step, no faster than real time, while this is entered; its log is `log` afterwards."""

    def __init__(self, folder, name, place):
        place.mkdir(parents=True)
        self._folder, self._name, self._place = folder, name, place
        self.sprung = folder / "sprung"
        self.environment = {"SPRUNG_RUN_DIR": str(place), "SPRUNG_STATE_DIR": str(place)}
        self.lcm_url = programs.random_lcm_url()

    def __enter__(self):
        self._up = programs.Program(
            self._folder,
            ["sprung", "up", self._name, "--sim", "--clock", "lockstep", "--speed", "1", "--plain", "--log", self._place,
             "--lcm-url", self.lcm_url],
            self._place / "said.txt", self.environment,
        )  # fmt: skip
        self.wait_for(lambda: self.ask("status").returncode == 0, "the robot to be up")
        return self

    def __exit__(self, *_):
        self._up.stop(60)
        self.log = next(self._place.glob("*.lcm"))

    def run(self, *words, **more):
        environment = {**os.environ, **self.environment, **more}
        return subprocess.run([str(word) for word in words], env=environment, capture_output=True, text=True, timeout=60)

    def ask(self, *words):
        return self.run(self.sprung, *words)

    def wait_for(self, true, what, seconds=60.0):
        end = time.monotonic() + seconds
        while not true():
            if time.monotonic() > end or not self._up.running():
                sys.exit(f"languages: waited for {what}; sprung up said:\n{self._up.said()}")
            time.sleep(0.05)


def newest_messages(log):
    """{channel: encoded message} of an LCM log."""
    messages = {event.channel: event.data for event in lcm.EventLog(str(log), "r")}
    messages.pop("LCM_SELF_TEST", None)  # LCM's own, no message
    return messages
