"""What tests/python/engines/run measures and demands; docs/studies.md says what the words mean."""
import argparse
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import threading
import time

PYTHON, SPRUNG = sys.executable, os.environ["SPRUNG"]
KILLS = 20
EXPERIMENT = "experiment: jump\nrobot: single_leg\n"
SHORT = EXPERIMENT + "options: {mode: hybrid}\n"  # a sixth of a second
PARAMETERS = """parameters:
  presets.best.hybrid_landing.stiffness.z: {from: 400 N/m, to: 3000 N/m}
  presets.best.hybrid_landing.damping.z: {from: 20 N s/m, to: 100 N s/m}
"""


def say(text):
    print(f"engines: {text}", flush=True)


def run(*words, **more):
    return subprocess.run([str(word) for word in words], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          **more)


def done(*words, **more):
    result = run(*words, **more)
    assert result.returncode == 0, f"{words}: {result.returncode}\n{result.stdout}"
    return result.stdout


def rows(folder):
    return {file.name: file.read_bytes() for file in (pathlib.Path(folder) / "rows").glob("*.json")}


def same(one, other):
    assert rows(one) == rows(other), f"{one} and {other} differ"


class Bench:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def study(self, name, text):
        path = self.folder / f"{name}.yaml"
        path.write_text(f"study: {name}\n{text}")
        return path

    def out(self, name):
        return self.folder / name

    def local(self, study, name, jobs):
        return done(SPRUNG, "study", "run", study, "-j", jobs, "--out", self.out(name))

    def engine(self, engine, study, name, *more):
        return done(PYTHON, "-m", "sprung_study", engine, study, "--out", self.out(name), *more)

    def timed(self, act, *arguments):
        begin = time.monotonic()
        act(*arguments)
        return time.monotonic() - begin


def kill_workers(until, count, counted):
    """`sprung study worker`s by chance, while there are any."""
    dice = random.Random(1)
    while not until.is_set() and len(counted) < count:
        time.sleep(dice.uniform(0.1, 0.5))
        found = run("pgrep", "-f", f"^{SPRUNG} study worker$").stdout.split()
        if found:
            os.kill(int(dice.choice(found)), signal.SIGKILL)
            counted.append(1)


def while_killing(act, count):
    until, counted = threading.Event(), []
    killer = threading.Thread(target=kill_workers, args=(until, count, counted))
    killer.start()
    act()
    until.set()
    killer.join()
    return len(counted)


def same_bytes(bench, runs):
    study = bench.study("all", SHORT + PARAMETERS + f"samples: {runs}\n")
    times = {"one worker": bench.timed(bench.local, study, "one", 1), "two workers": bench.timed(bench.local, study, "two", 2)}
    times["Ray, two"] = bench.timed(bench.engine, "ray", study, "ray", "--cpus", 2)
    times["Slurm, two"] = bench.timed(bench.engine, "slurm", study, "slurm", "--chunk", max(5, runs // 20), "--wait")
    for name in ("two", "ray", "slurm"):
        same(bench.out("one"), bench.out(name))
    assert len(rows(bench.out("one"))) == runs
    say(f"{runs} runs, same bytes; " + ", ".join(f"{name} {value:.1f} s" for name, value in times.items()))
    return study


def killed(bench, study, few):
    kills = while_killing(lambda: bench.local(study, "killed", 2), KILLS)
    same(bench.out("one"), bench.out("killed"))
    say(f"workers killed {kills} times under `study run`: complete, same bytes")
    kills = while_killing(lambda: bench.engine("ray", few, "killed_ray", "--cpus", 2), KILLS)
    same(bench.out("few"), bench.out("killed_ray"))
    say(f"workers killed {kills} times under Ray: complete, same bytes")


def joins_late(bench, study):
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    engine = subprocess.Popen([PYTHON, "-m", "sprung_study", "ray", study, "--out", bench.out("late"), "--address",
                               cluster.address])
    time.sleep(4.0)
    cluster.add_node(num_cpus=1)
    assert engine.wait() == 0
    cluster.shutdown()
    same(bench.out("few"), bench.out("late"))
    say("a machine that joins Ray late: same bytes")


def hangs_and_fails(bench):
    text = SHORT + "plants: [{}, {no_such: 1}]\n"
    refused = run(SPRUNG, "study", "show", bench.study("refused", text))
    assert refused.returncode == 1 and "no_such" in refused.stdout, refused.stdout
    study = bench.study("hangs", SHORT + "seeds: 1..3\ntimeout: 20 ms\n")
    result = run(SPRUNG, "study", "run", study, "--out", bench.out("hangs"))
    assert result.returncode == 1 and "longer than" in result.stdout, result.stdout
    result = run(PYTHON, "-m", "sprung_study", "ray", study, "--out", bench.out("hangs"), "--cpus", 2)
    assert result.returncode == 1, result.stdout
    table = run(SPRUNG, "study", "collect", bench.out("hangs"))
    assert table.returncode == 1 and "missing: 1..3" in table.stdout and "longer than" in table.stdout, table.stdout
    study.write_text(study.read_text().replace("20 ms", "60 s"))
    bench.local(study, "hangs", 2)
    assert len(rows(bench.out("hangs"))) == 3
    say("runs that take too long are said by number, and done when they may take longer")


def full_disk(bench, study):
    small = bench.out("small")
    small.mkdir()
    if run("mount", "-t", "tmpfs", "-o", "size=120k", "none", small).returncode != 0:
        return say("SKIPPED: no small disk can be mounted here")
    result = run(SPRUNG, "study", "run", study, "-j", 2, "--out", small / "out")
    assert result.returncode == 1 and "make room" in result.stdout, result.stdout
    kept = len(rows(small / "out"))
    done("mount", "-o", "remount,size=64m", small)
    bench.local(study, "small/out", 2)
    same(bench.out("few"), small / "out")
    done("umount", small)
    say(f"a full disk after {kept} rows is said; with room the same bytes")


def parquet(bench):
    import pyarrow.parquet

    done(SPRUNG, "study", "collect", bench.out("one"))
    table = pyarrow.parquet.read_table(bench.out("one") / "table.parquet")
    kept = {number: json.loads(text) for number, text in rows(bench.out("one")).items()}
    assert table.num_rows == len(kept)
    name = "jump.hybrid.height"
    assert table.schema.field(name).metadata[b"unit"] == b"mm"
    for number, value in zip(table["run"].to_pylist(), table[name].to_pylist()):
        assert value == next(row["value"] for row in kept[f"{number}.json"]["rows"] if row["name"] == name)
    say("table.parquet has the rows' numbers to the bit, with units")


def tunes(bench):
    text = (SHORT + PARAMETERS + "draws: 1..2\ntune:\n  trials: 10\n  validate: {draws: 5}\n  finalists: 2\n"
            "  held_out: {draws: 8..9}\n  goals:\n"
            "    - {name: landing, over: worst, of: [{row: jump.hybrid.landing_knee_output_torque, unreached: 500}]}\n")
    study = bench.study("tuned", text)
    bench.engine("tune", study, "tuned_1", "--jobs", 1)
    bench.engine("tune", study, "tuned_2", "--jobs", 2)
    same(bench.out("tuned_1"), bench.out("tuned_2"))
    one, two = (json.loads((bench.out(name) / "tune.json").read_text()) for name in ("tuned_1", "tuned_2"))
    assert one == two and len(one["held_out"]["best"]) == 2, (one, two)
    search = subprocess.Popen([PYTHON, "-m", "sprung_study", "tune", study, "--out", bench.out("tuned_3")],
                              stderr=subprocess.DEVNULL)
    time.sleep(4.0)
    search.kill()
    search.wait()
    bench.engine("tune", study, "tuned_3")
    three = json.loads((bench.out("tuned_3") / "tune.json").read_text())
    assert three["trials"]["COMPLETE"] + three["trials"]["PRUNED"] == 10, three
    assert "What matters" in (bench.out("tuned_1") / "tune.html").read_text()
    several = text.replace("  validate: {draws: 5}\n  finalists: 2\n", "") + (
        "    - {name: height, want: most, over: mean, of: [{row: jump.hybrid.height, unreached: 0}]}\n")
    bench.engine("tune", bench.study("traded", several), "traded", "--jobs", 2)
    assert "What is traded" in (bench.out("traded") / "tune.html").read_text()
    say("Optuna: the same search with one worker and two, goes on after it was killed, several goals")


def overhead(bench, runs):
    study = bench.study("second", EXPERIMENT + f"preset: paper\nseeds: 1..{runs}\n")
    local = bench.timed(bench.local, study, "second_local", 2)
    ray = bench.timed(bench.engine, "ray", study, "second_ray", "--cpus", 2, "--chunk", 2)
    slurm = bench.timed(bench.engine, "slurm", study, "second_slurm", "--chunk", runs // 4, "--wait")
    lines = (bench.out("second_local") / "times.jsonl").read_text().splitlines()
    service = sum(json.loads(line)["wall_s"] for line in lines)
    print(done(PYTHON, "-m", "sprung_study", "growth", bench.out("second_local"), "--dispatch", "0.004"))
    say(f"{runs} runs of {service / runs:.2f} s on two workers: `study run` {local:.1f} s, {2 * local / service - 1:+.1%} "
        f"over the runs themselves; Ray {ray:.1f} s, {ray / local - 1:+.1%}; Slurm {slurm:.1f} s, {slurm / local - 1:+.1%}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder")
    parser.add_argument("--runs", type=int, default=60)
    parser.add_argument("--overhead-runs", type=int, default=0)
    arguments = parser.parse_args()
    bench = Bench(arguments.folder)
    study = same_bytes(bench, arguments.runs)
    parquet(bench)
    few = bench.study("few", SHORT + PARAMETERS + "samples: 60\n")
    bench.local(few, "few", 2)
    killed(bench, study, few)
    joins_late(bench, few)
    hangs_and_fails(bench)
    full_disk(bench, few)
    tunes(bench)
    if arguments.overhead_runs:
        overhead(bench, arguments.overhead_runs)
    say("all green")


if __name__ == "__main__":
    main()
