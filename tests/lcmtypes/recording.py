"""One real message of each channel: simulated robots run for a moment, commanded by the examples, and recorded."""

import os
import pathlib
import random
import struct
import subprocess
import sys
import time

TOP = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = TOP / "examples/operator"
_EVENT_SYNC = 0xEDA1DA01


class Robot:
    """A simulated robot that is up while this is entered; its log is `log` afterwards."""

    def __init__(self, programs, name, folder):
        folder.mkdir(parents=True)
        self._sprung, self._name, self._folder = str(programs / "sprung"), name, folder
        self.environment = {**os.environ, "SPRUNG_RUN_DIR": str(folder), "SPRUNG_STATE_DIR": str(folder)}
        self.lcm_url = f"udpm://239.255.{random.randint(1, 254)}.{random.randint(1, 254)}:{random.randint(16384, 32767)}?ttl=0"

    def __enter__(self):
        arguments = ["--sim", "--clock", "lockstep", "--speed", "1", "--plain", "--log", str(self._folder)]
        with open(self._folder / "said.txt", "w", encoding="utf-8") as said:
            self._up = subprocess.Popen(
                [self._sprung, "up", self._name, *arguments, "--lcm-url", self.lcm_url],
                env=self.environment, stdout=said, stderr=said,
            )  # fmt: skip
        self.wait_for(lambda: self.ask("status").returncode == 0, "the robot to be up")
        return self

    def __exit__(self, *_):
        self._up.terminate()
        self._up.wait(60)
        self.log = next(self._folder.glob("*.lcm"))

    def ask(self, *words):
        return subprocess.run([self._sprung, *words], env=self.environment, capture_output=True, text=True, timeout=60)

    def wait_for(self, true, what, seconds=60.0):
        end = time.monotonic() + seconds
        while not true():
            if time.monotonic() > end or self._up.poll() is not None:
                sys.exit(f"languages: waited for {what}; sprung up said:\n{(self._folder / 'said.txt').read_text()}")
            time.sleep(0.05)


def events(log):
    """{channel: encoded message}, the newest of each, by the format of LCM's event logs."""
    data, at, out = log.read_bytes(), 0, {}
    while at < len(data):
        sync, _, _, name, size = struct.unpack_from(">IqqII", data, at)
        assert sync == _EVENT_SYNC, f"{log} is no LCM log at byte {at}"
        at += 28
        out[data[at : at + name].decode()] = data[at + name : at + name + size]
        at += name + size
    return out
