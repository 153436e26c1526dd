#!/usr/bin/env python3
"""How long this machine kept a process that was due from running, said when it is ended (tests/support/stall_watch.h
is the same for tests in C++). A test in real time that fails beside it is begun again by .ci/second-try.

usage: stall_watch.py MORE_THAN_MS      says nothing where the longest stall was shorter
"""
import os
import signal
import sys
import time

NAP_S = 0.001


def main():
    most_ms = float(sys.argv[1])
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(os.sched_get_priority_max(os.SCHED_FIFO)))
    except PermissionError:
        pass  # as good as it can be
    longest_ms = 0.0

    def end(*_):
        if longest_ms > most_ms:
            print("the machine stalled for %.0f ms, longer than real time bears" % longest_ms, flush=True)
        sys.exit(0)

    signal.signal(signal.SIGTERM, end)
    while True:
        due = time.monotonic() + NAP_S
        time.sleep(NAP_S)
        longest_ms = max(longest_ms, 1e3 * (time.monotonic() - due))


if __name__ == "__main__":
    main()
