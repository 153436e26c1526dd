#!/usr/bin/env python3
"""How soon an emergency stop of a page acts: from its text to the text that no drive has power. The robot
stands up anew each time. usage: estop_times.py ADDRESS [STOPS]   ADDRESS is what sprung console prints
"""

import base64
import json
import os
import re
import socket
import struct
import sys
import time

ALIVE_S = 0.3
PATIENCE_S = 30.0


class Page:
    """A page without a browser."""

    def __init__(self, address):
        port, path = re.match(r"http://127\.0\.0\.1:(\d+)(/.*)", address).groups()
        self.socket = socket.create_connection(("127.0.0.1", int(port)))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        lines = [
            f"GET {path}live HTTP/1.1", f"Host: 127.0.0.1:{port}", "Upgrade: websocket", "Connection: Upgrade",
            "Sec-WebSocket-Version: 13", f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}",
            "Sec-WebSocket-Protocol: sprung.v1", "", "",
        ]  # fmt: skip
        self.socket.sendall("\r\n".join(lines).encode())
        self.file = self.socket.makefile("rb")
        while self.file.readline() != b"\r\n":
            pass
        self.alive_s = 0.0
        self.requests = 0

    def send(self, message):
        """Below 126 bytes; a mask of zeros leaves the text as it is."""
        text = json.dumps(message).encode()
        self.socket.sendall(bytes([0x81, 0x80 | len(text), 0, 0, 0, 0]) + text)

    def receive(self):
        """The next message; None where it is a frame."""
        head = self.file.read(2)
        size = head[1] & 127
        if size >= 126:
            size = struct.unpack(*((">H", self.file.read(2)) if size == 126 else (">Q", self.file.read(8))))[0]
        data = self.file.read(size)
        return json.loads(data) if head[0] & 15 == 1 else None

    def until(self, condition):
        end_s = time.monotonic() + PATIENCE_S
        while time.monotonic() < end_s:
            if time.monotonic() - self.alive_s > ALIVE_S:
                self.send({"type": "alive"})
                self.alive_s = time.monotonic()
            message = self.receive()
            if message is not None and condition(message):
                return message
        raise SystemExit("estop_times: the robot does not do what it should")

    def ask(self, command):
        """@return the first answer, or the last one of `clear`."""
        self.requests += 1
        self.send({"type": "request", "id": self.requests, "command": command})
        return self.until(lambda m: m["type"] == "reply" and m["id"] == self.requests and (m["over"] or command != "clear"))


def has_power(message):
    return message["type"] == "state" and all(a["power"] == "operation enabled" for a in message["actuators"])


def main():
    page = Page(sys.argv[1])
    page.until(lambda m: m["type"] == "state")
    times_ms = []
    for _ in range(int(sys.argv[2]) if len(sys.argv) > 2 else 200):
        while page.ask("stand")["outcome"] == "refused":
            page.ask("clear")
        page.until(has_power)
        begin_s = time.monotonic()
        page.send({"type": "estop"})
        page.until(lambda m: m["type"] == "estop" and m["state"] == "confirmed")
        times_ms.append(1e3 * (time.monotonic() - begin_s))
    times_ms.sort()
    p50, p99 = (times_ms[min(len(times_ms) - 1, int(share * len(times_ms)))] for share in (0.5, 0.99))
    print(f"{len(times_ms)} emergency stops: p50 {p50:.1f} ms, p99 {p99:.1f} ms, longest {times_ms[-1]:.1f} ms")


main()
