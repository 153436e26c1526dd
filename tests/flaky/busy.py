"""Busy loops, and processes that end with this one however it ends."""

import ctypes
import signal
import subprocess
import sys

_PR_SET_PDEATHSIG = 1
_LIBC = ctypes.CDLL(None)


def end_with_parent():
    """For subprocess's preexec_fn."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


class Busy:
    """So many processes that want all of a processor each, at the usual priority."""

    def __init__(self, count):
        self._count = count
        self._loops = []

    def __enter__(self):
        for _ in range(self._count):
            loop = subprocess.Popen([sys.executable, "-c", "while True: pass"], preexec_fn=end_with_parent)
            self._loops.append(loop)
        return self

    def __exit__(self, *_):
        for loop in self._loops:
            loop.kill()
            loop.wait()
