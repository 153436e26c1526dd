"""Optuna beside the search that it replaced: docs/measured.md, "Tuning beside the former search".

usage: python3 compare_tuning.py FOLDER --former SPRUNG, with the packages of python/requirements.txt
SPRUNG is the program of commit 4f1ab996, the last with `sprung experiment tune`; both look on the same plants, with
as many runs, in searches of five seeds. What is there is not done again."""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys

from sprung_study import contract
from sprung_study.search import goal_value

RUNS = 388  # of the former search: 97 sets on four plants
HELD_OUT_SEEDS = (77, 78, 79, 80)


class Mersenne64:
    """std::mt19937_64, by which the former search drew its plants."""

    def __init__(self, seed):
        self.state = [seed]
        for i in range(1, 312):
            last = self.state[-1]
            self.state.append((6364136223846793005 * (last ^ (last >> 62)) + i) & (2**64 - 1))
        self.place = 312

    def next(self):
        if self.place == 312:
            self._turn()
        x = self.state[self.place]
        self.place += 1
        x ^= (x >> 29) & 0x5555555555555555
        x ^= (x << 17) & 0x71D67FFFEDA60000
        x ^= (x << 37) & 0xFFF7EEE000000000
        return x ^ (x >> 43)

    def _turn(self):
        state = self.state
        for i in range(312):
            x = (state[i] & 0xFFFFFFFF80000000) | (state[(i + 1) % 312] & 0x7FFFFFFF)
            state[i] = state[(i + 156) % 312] ^ (x >> 1) ^ (0xB5026F5AA96619E9 if x & 1 else 0)
        self.place = 0

    def even(self):
        """In [-1, 1), as tools/lab/run/scoring.h."""
        return 2.0 * (self.next() >> 11) * 2.0**-53 - 1.0


def plants(seed, count):
    """sim.yaml's own, then drawn ones: friction within 20 %, mass 10 %, torque constant 5 %, ground 6 to 12 kN/m."""
    dice = Mersenne64(seed)
    drawn = [{"friction_scale": 1 + 0.2 * dice.even(), "mass_scale": 1 + 0.1 * dice.even(),
              "kt_scale": 1 + 0.05 * dice.even(), "ground_stiffness": 6000 + 3000 * (dice.even() + 1)}
             for _ in range(count - 1)]
    return [{}] + drawn


def text_of(plant):
    return "{" + ", ".join(f"{key}: {value!r}" for key, value in plant.items()) + "}"


def study_text(example, seed, on, held_out):
    """An example of examples/studies with other plants, seed and trials."""
    head, rest = example.split("plants:\n", 1)
    goals = rest[rest.index("  goals:"):]
    lines = "".join(f"  - {text_of(plant)}\n" for plant in on)
    held = "".join(f"      - {text_of(plant)}\n" for plant in held_out)
    trials = 100 if len(on) == 4 else 60  # more than the runs allow: bad ones are pruned
    return (f"{head}plants:\n{lines}tune:\n  trials: {trials}\n  runs: {RUNS}\n  seed: {seed}\n"
            f"  held_out:\n    plants:\n{held}{goals}")


def said(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def tuned(folder, example, seed, on, held_out):
    """Optuna's numbers."""
    out = folder / f"optuna-{len(on)}-{seed}"
    study = folder / f"optuna-{len(on)}-{seed}.yaml"
    study.write_text(study_text(example, seed, on, held_out))
    said(sys.executable, "-m", "sprung_study", "tune", study, "--out", out, "--jobs", 2)
    return json.loads((out / "tune.json").read_text())["best"], study


def formerly(folder, former, study, objective, seed):
    """The former search's numbers: of its fragment, by the way of each."""
    out = folder / f"former-{seed}"
    preset = "presets.best."
    words = sum((["--vary", f"{one['path'].removeprefix(preset)}={one['from']!r}:{one['to']!r}"]
                 for one in study["parameters"]), [])
    if not (out / "tune.yaml").exists():
        said(former, "experiment", "tune", *study["options"], "--objective", objective, *words, "--samples", 64,
             "--rounds", 2, "--plants", 4, "--tune-seed", seed, "--seed", 1000 + seed, "--out", out)
    return values_of((out / "tune.yaml").read_text())


def values_of(fragment):
    """The numbers of a nested fragment by their ways: only what that one command writes."""
    way, values = [], {}
    for line in fragment.splitlines():
        if line.startswith("#") or not line.strip():
            continue
        depth = (len(line) - len(line.lstrip())) // 2
        key, _, value = line.strip().partition(":")
        way = way[:depth] + [key]
        if value.strip():
            values[".".join(way)] = float(value.split()[0])
    return values


def costs(study, values, on):
    """On each plant, by the study's own goal."""
    worker, out = contract.Worker(study["timeout_s"]), []
    for plant in on:
        line = json.dumps({"run": 1, **{key: study[key] for key in ("experiment", "robot", "preset", "options")},
                           "parameters": values, "plant": [f"{key}={value!r}" for key, value in plant.items()],
                           "seed": 1})
        out.append(goal_value(study["tuning"]["goals"][0], [json.loads(worker.answer(line))["row"]]))
    worker.close()
    return out


def compare(folder, former, example, objective, seeds):
    folder.mkdir(parents=True, exist_ok=True)
    text = example.read_text()
    held_out = [plant for seed in HELD_OUT_SEEDS for plant in plants(seed, 4)[1:]]
    on_tuned, on_held = {}, {}
    for seed in seeds:
        on = plants(seed, 4)
        four, file = tuned(folder, text, seed, on, held_out)
        study = contract.show(str(file))
        eight, _ = tuned(folder, text, seed, plants(seed, 8), held_out)
        found = {"former": formerly(folder, former, study, objective, seed), "four": four, "eight": eight}
        for who, values in found.items():
            on_tuned.setdefault(who, []).append(statistics.mean(costs(study, values, on)))
            on_held.setdefault(who, []).append(costs(study, values, held_out))
        print(example.stem, seed, {who: f"{on_tuned[who][-1]:.2f}, {statistics.mean(on_held[who][-1]):.2f}"
                                   for who in found}, flush=True)
    own = {one["path"]: one["present"] for one in study["parameters"]}
    print(f"{example.stem}: robot.yaml's own, held out: {statistics.mean(costs(study, own, held_out)):.2f}")
    for who in on_tuned:
        means = [statistics.mean(one) for one in on_held[who]]
        pairs = sum(a <= 1.02 * b for mine, theirs in zip(on_held[who], on_held["former"]) for a, b in zip(mine, theirs))
        print(f"{example.stem}: {who}: where tuned {statistics.median(on_tuned[who]):.2f}; held out "
              f"{statistics.mean(means):.2f}, {min(means):.2f} to {max(means):.2f}; no worse than the former search "
              f"(2 %) in {pairs} of {len(means) * len(held_out)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--former", required=True)
    parser.add_argument("--seeds", type=int, default=5)
    arguments = parser.parse_args()
    examples = pathlib.Path(__file__).resolve().parents[3] / "examples/studies"
    for name, objective in (("adaptive_landing", "landing_output"), ("jump_height", "height_error")):
        compare(arguments.folder / name, arguments.former, examples / f"{name}.yaml", objective, range(arguments.seeds))


if __name__ == "__main__":
    main()
