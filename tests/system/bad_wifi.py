#!/usr/bin/env python3
"""A bad wireless network between an operator and a robot's gateway: a UDP relay that loses, delays, reorders
and now and then carries nothing at all, by a seed.

usage: bad_wifi.py LISTEN_PORT ROBOT_HOST:PORT [--seed N] [--loss 0.05] [--delay-ms 100] [--jitter-ms 50]
                   [--gap-s 2 --gap-every-s 30]
A file named by --cut is looked at: while it is there, nothing passes. Each gap's begin and end (CLOCK_MONOTONIC,
s) goes to standard output, and so does what passed, at the end.
"""
import argparse
import heapq
import os
import random
import selectors
import signal
import socket
import sys
import time


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("port", type=int)
    parser.add_argument("robot")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--loss", type=float, default=0.05)
    parser.add_argument("--delay-ms", type=float, default=100.0)
    parser.add_argument("--jitter-ms", type=float, default=50.0)
    parser.add_argument("--gap-s", type=float, default=2.0)
    parser.add_argument("--gap-every-s", type=float, default=0.0, help="mean; 0: no gaps")
    parser.add_argument("--cut", default="")
    return parser.parse_args()


class Relay:
    def __init__(self, args):
        self.args = args
        self.random = random.Random(args.seed)
        host, port = args.robot.rsplit(":", 1)
        self.robot = (host, int(port))
        self.front = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.front.bind(("0.0.0.0", args.port))
        self.backs = {}  # a socket for each operator's address, so that answers find him
        self.selector = selectors.DefaultSelector()
        self.selector.register(self.front, selectors.EVENT_READ, None)
        self.waiting = []
        self.count = 0
        self.passed = self.lost = 0
        self.began = time.monotonic()
        self.told_bytes = self.told_longest = 0  # of the robot
        self.gap = None
        self.next_gap = self.after_pause(time.monotonic())

    def after_pause(self, now):
        every = self.args.gap_every_s
        return now + self.random.uniform(0.5, 1.5) * every if every else float("inf")

    def closed(self, now):
        if self.args.cut and os.path.exists(self.args.cut):
            return True
        if self.gap is None and now >= self.next_gap:
            self.gap = (now, now + self.args.gap_s)
        if self.gap and now >= self.gap[1]:
            print("gap %.6f %.6f" % self.gap, flush=True)
            self.gap, self.next_gap = None, self.after_pause(now)
        return self.gap is not None

    def take(self, data, send, now):
        delay = 1e-3 * (self.args.delay_ms + self.random.uniform(-1, 1) * self.args.jitter_ms)
        lost = self.random.random() < self.args.loss
        if lost or self.closed(now):
            self.lost += 1
            return
        self.passed += 1
        self.count += 1
        heapq.heappush(self.waiting, (now + delay, self.count, data, send))

    def back_of(self, operator):
        if operator not in self.backs:
            back = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            back.connect(self.robot)
            self.backs[operator] = back
            self.selector.register(back, selectors.EVENT_READ, operator)
        return self.backs[operator]

    def step(self):
        now = time.monotonic()
        self.closed(now)
        timeout = max(0.0, min(0.05, self.waiting[0][0] - now)) if self.waiting else 0.05
        for key, _ in self.selector.select(timeout):
            try:
                data, address = key.fileobj.recvfrom(65536)
            except OSError:
                continue
            if key.data is None:
                self.take(data, self.back_of(address).send, time.monotonic())
            else:
                operator = key.data
                self.told_bytes += len(data)
                self.told_longest = max(self.told_longest, len(data))
                self.take(data, lambda packet, to=operator: self.front.sendto(packet, to), time.monotonic())
        now = time.monotonic()
        while self.waiting and self.waiting[0][0] <= now:
            _, _, data, send = heapq.heappop(self.waiting)
            try:
                send(data)
            except OSError:
                pass


def main():
    relay = Relay(arguments())
    going = True

    def stop(*_):
        nonlocal going
        going = False

    signal.signal(signal.SIGTERM, stop)
    signal.signal(signal.SIGINT, stop)
    print("ready", flush=True)
    while going:
        relay.step()
    kB_s = 1e-3 * relay.told_bytes / (time.monotonic() - relay.began)
    print(f"passed {relay.passed} lost {relay.lost}; the robot said {kB_s:.0f} kB/s, at most "
          f"{relay.told_longest} bytes at once", flush=True)


if __name__ == "__main__":
    sys.exit(main())
