#!/usr/bin/env python3
"""Figures of measure_remote from a robot's log, the relay's gaps and the probe's times.
usage: remote_figures.py cut|estop|walk FOLDER EPOCH_US"""
import csv
import sys

STANDING, WALKING, FALLEN = "2", "11", "12"


def rows(folder):
    with open(f"{folder}/log.csv") as file:
        for row in csv.DictReader(file):
            yield row


def column(row, name):
    return next(value for key, value in row.items() if key.startswith(name))


def states(folder, name):
    """(time s, value) whenever it changes."""
    out, last = [], None
    for row in rows(folder):
        value = column(row, name)
        if value not in ("", last):
            out.append((float(column(row, "time")), value))
            last = value
    return out


def percentile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))]


def gaps(folder, epoch_us):
    out = []
    for line in open(f"{folder}/wifi.txt"):
        if line.startswith("gap "):
            out.append(tuple(float(word) - 1e-6 * epoch_us for word in line.split()[1:]))
    return out


def probe_times(folder, word, epoch_us):
    return [1e-6 * (int(line.split()[1]) - epoch_us)
            for line in open(f"{folder}/probe.txt") if line.startswith(word + " ")]


def value_at(changes, time_s):
    value = None
    for at, now in changes:
        if at > time_s:
            break
        value = now
    return value


def first_after(changes, time_s, wanted):
    return next((at for at, value in changes if at >= time_s and value == wanted), None)


def cuts(folder, epoch_us):
    motion = states(folder, "MOTION_STATE.state")
    took = []
    for begin, _ in gaps(folder, epoch_us):
        if value_at(motion, begin) != WALKING:
            continue
        stands = first_after(motion, begin, STANDING)
        took.append(float("inf") if stands is None else stands - begin)
    falls = sum(1 for _, value in motion if value == FALLEN)
    within = sum(1 for value in took if value <= 2.0)
    print(f"link cut while walking: {len(took)} times; stands after {percentile(took, 0.5):.2f} s (median), "
          f"{max(took):.2f} s (worst); within 2 s {within} of {len(took)}; falls {falls}")
    return within == len(took) and falls == 0


def estops(folder, epoch_us):
    causes = states(folder, "SAFETY_STATE.cause")
    gone = gaps(folder, epoch_us)
    free, across = [], []
    for said in probe_times(folder, "estop", epoch_us):
        acts = next((at for at, _ in causes if at >= said), None)
        took = float("inf") if acts is None else acts - said
        gap = next((gap for gap in gone if gap[0] - 0.15 <= said <= gap[1]), None)
        if gap is None:
            free.append(took)
        else:
            across.append(said + took - gap[1])
    print(f"estop outside gaps: {len(free)} times; acts after {1e3 * percentile(free, 0.5):.0f} ms (median), "
          f"{1e3 * percentile(free, 0.99):.0f} ms (p99), {1e3 * max(free):.0f} ms (worst)")
    if across:
        print(f"estop in gaps: {len(across)} times; acts {1e3 * max(across):.0f} ms after the gap (worst)")
    return percentile(free, 0.99) <= 0.3 and all(late <= 0.3 for late in across)


def walk(folder, epoch_us):
    motion = states(folder, "MOTION_STATE.state")
    gone = gaps(folder, epoch_us)
    end = probe_times(folder, "end", epoch_us)[0]
    falls = sum(1 for _, value in motion if value == FALLEN)
    walked, unexplained, last = 0.0, 0, None
    for (at, value), (until, _) in zip(motion, motion[1:] + [(end, None)]):
        if at >= end:
            break
        if value == WALKING:
            walked += until - at
        elif last == WALKING and not any(begin <= at <= finish + 2.0 for begin, finish in gone):
            unexplained += 1
        last = value
    print(f"walked {walked:.0f} s over it with {len(gone)} gaps of 2 s: falls {falls}, "
          f"stops that no gap explains {unexplained}")
    return falls == 0 and unexplained == 0


if __name__ == "__main__":
    what, folder, epoch_us = sys.argv[1], sys.argv[2], int(sys.argv[3])
    good = {"cut": cuts, "estop": estops, "walk": walk}[what](folder, epoch_us)
    sys.exit(0 if good else 1)
