"""Runs on a cluster of Ray: a chunk a task. Scheduling, retries and machines that come and go are Ray's."""
import sys

from sprung_study.contract import Keeper, Worker, error_answer, missing, positive, show

_worker = None  # of this process of Ray, with its robots loaded


def add_arguments(parser):
    parser.add_argument("study")
    parser.add_argument("--out", required=True, help="folder of the study, on this machine")
    parser.add_argument("--address", help="of a cluster, as in ray.init; default: one of this machine")
    parser.add_argument("--cpus", type=int, help="of a cluster of this machine; default: all")
    parser.add_argument("--chunk", type=positive, default=4, help="runs in a task; some seconds are enough")


def do_chunk(lines: list[str], timeout_s: float) -> list[str]:
    global _worker
    if _worker is None or _worker.timeout_s != timeout_s:
        _worker = Worker(timeout_s)
    return [_worker.answer(line) for line in lines]


def run(arguments) -> int:
    import ray

    lines = missing(arguments.study, arguments.out)
    timeout_s = show(arguments.study)["timeout_s"]
    ray.init(address=arguments.address or "local", num_cpus=None if arguments.address else arguments.cpus,
             include_dashboard=False, log_to_driver=False, logging_level="error")
    task = ray.remote(max_retries=10)(do_chunk)  # of machines that are lost: a worker's end is an answer
    chunks = [lines[i:i + arguments.chunk] for i in range(0, len(lines), arguments.chunk)]
    waiting = {task.remote(chunk, timeout_s): chunk for chunk in chunks}
    keeper = Keeper(arguments.study, arguments.out)
    while waiting:
        done, _ = ray.wait(list(waiting), num_returns=1)
        for reference in done:
            chunk = waiting.pop(reference)
            for answer in answers_of(ray, reference, chunk):
                keeper.keep(answer)
    ray.shutdown()
    status = keeper.finish()
    print(f"{arguments.out}: {len(lines)} runs asked for" + (", some without a row" if status else ""), file=sys.stderr)
    return status


def answers_of(ray, reference, chunk: list[str]) -> list[str]:
    """What Ray gave up is said of each run of the chunk; the same command tries them again."""
    try:
        return ray.get(reference)
    except ray.exceptions.RayError as error:
        return [error_answer(line, f"Ray gave up: {str(error).splitlines()[-1]}") for line in chunk]
