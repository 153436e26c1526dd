"""Starts sprung's real processes on a CAN bus and an LCM network of their own, and leaves none behind."""

import ctypes
import os
import pathlib
import random
import signal
import socket
import subprocess

TOP = pathlib.Path(__file__).resolve().parents[2]
_PR_SET_PDEATHSIG = 1
_LIBC = ctypes.CDLL(None)


_RESERVED = []  # as long as this process lives


def own_port():
    """A UDP port that nobody else has: runtime/own_port.cpp, by the same names in the kernel's abstract space."""
    while True:
        port = random.randrange(16384, 32768)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("", port))
            except OSError:
                continue
        name = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        try:
            name.bind(f"\0sprung-port-{port}")
        except OSError:
            name.close()
            continue
        _RESERVED.append(name)
        return port


def random_bus():
    """python-can's arguments for a bus of our own; hop limit 0 keeps its frames on this machine."""
    group = f"239.74.{random.randint(1, 254)}.{random.randint(1, 254)}"
    return {
        "interface": "udp_multicast",
        "channel": group,
        "port": own_port(),
        "hop_limit": 0,
    }


def address(bus):
    """The same bus in sprung's words."""
    return f"udp:{bus['channel']}:{bus['port']}"


def random_lcm_url():
    group = f"239.255.{random.randint(1, 254)}.{random.randint(1, 254)}"
    return f"udpm://{group}:{own_port()}?ttl=0"


def _die_with_parent():
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)


class Program:
    """A running program of sprung; what it says goes to a file."""

    def __init__(self, folder, arguments, log, environment=None):
        self.log = log
        with open(log, "w", encoding="utf-8") as out:
            self._process = subprocess.Popen(
                [str(pathlib.Path(folder) / arguments[0]), *map(str, arguments[1:])],
                stdout=out,
                stderr=subprocess.STDOUT,
                env={**os.environ, **(environment or {})},
                preexec_fn=_die_with_parent,
            )

    def running(self):
        return self._process.poll() is None

    def said(self):
        return pathlib.Path(self.log).read_text(encoding="utf-8", errors="replace")

    def stop(self, timeout_s=20.0):
        """@return the exit status; a program that does not end by itself is ended, and that is an error."""
        if self.running():
            self._process.send_signal(signal.SIGINT)
        try:
            return self._process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
            raise AssertionError(f"it did not end; it said:\n{self.said()}") from None


def start_simulated_drives(folder, robot, buses, log):
    """sprung-sim-drives alone, in real time, as `sprung up` starts it.

    @param buses name of each bus, and python-can's arguments for it.
    @return the program; and the LCM URL and session that it listens to."""
    lcm_url, session = random_lcm_url(), random.getrandbits(40)
    arguments = [
        "sprung-sim-drives",
        "--robot",
        TOP / "robots" / robot,
        "--session",
        session,
        "--lcm-url",
        lcm_url,
        "--clock",
        "realtime",
        "--rt-policy",
        "off",
        "--no-truth",
        "--simulation",
        "--no-key",
    ]
    for name, bus in buses.items():
        arguments += ["--can", f"{name}={address(bus)}"]
    return Program(folder, arguments, log), lcm_url, session
