"""Time against workers: arrivals simulated with what runs, dispatch and keeping took; and what saturates first.

One driver hands out runs and keeps rows, one after the other; workers compute meanwhile. Service times are those of
the study's times.jsonl, in their order, again and again."""
import heapq
import json
from itertools import cycle, islice
from pathlib import Path


def add_arguments(parser):
    parser.add_argument("folder", help="of a study that has run")
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--most", type=int, default=64, help="workers")
    parser.add_argument("--start", type=float, default=0.0, help="s until a worker has its first run")
    parser.add_argument("--dispatch", type=float, required=True,
                        help="s of the driver for each run: hand out, read, keep (measured: docs/measured.md)")
    parser.add_argument("--chunk", type=int, default=1, help="runs that are handed out at once")


def time_of(line: str):
    try:
        return json.loads(line)["wall_s"]
    except (ValueError, KeyError, TypeError):
        return None  # a line that was cut short: a full disk, many writers


def service_times(folder: str) -> list[float]:
    lines = (Path(folder) / "times.jsonl").read_text().splitlines()
    times = [time for line in lines if (time := time_of(line)) is not None]
    if not times:
        raise RuntimeError(f"{folder}/times.jsonl has no times: run the study first")
    return times


def makespan(times: list[float], workers: int, dispatch_s: float, start_s: float, chunk: int = 1) -> float:
    """When the last row is kept. The driver is a queue of one; a worker waits for it with what it has done."""
    free = [(start_s, worker) for worker in range(workers)]
    heapq.heapify(free)
    driver = end = 0.0
    for first in range(0, len(times), chunk):
        part = times[first:first + chunk]
        ready, worker = heapq.heappop(free)
        driver = max(driver, ready) + dispatch_s * len(part)
        finished = driver + sum(part)
        end = max(end, finished)
        heapq.heappush(free, (finished, worker))
    return end


def run(arguments) -> int:
    measured = service_times(arguments.folder)
    times = list(islice(cycle(measured), arguments.runs))
    alone = makespan(times, 1, arguments.dispatch, arguments.start, arguments.chunk)
    mean = sum(times) / len(times)
    print(f"{len(times)} runs of {mean:.3f} s in the mean, {arguments.dispatch * 1e3:.2f} ms of the driver for each")
    print("workers  time (s)  speed-up  share of ideal")
    workers = 1
    while workers <= arguments.most:
        time = makespan(times, workers, arguments.dispatch, arguments.start, arguments.chunk)
        print(f"{workers:7d}  {time:8.1f}  {alone / time:8.1f}  {alone / time / workers:14.2f}")
        workers *= 2
    if arguments.dispatch > 0:
        print(f"the driver is busy all the time from {mean / arguments.dispatch:.0f} workers on")
    return 0
