"""Tuning: Optuna asks for numbers and is told what they cost; the runs between are the contract's.

Trials are asked for in batches of a fixed size, and a batch is told in the order of its trials: the same search
whatever the number of workers. What a trial needs stands in the study's folder as rows, so that a search that was
interrupted goes on with what it has."""
import difflib
import json
import math
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue

from sprung_study import contract, tune_page

BATCH = 4
EVEN_SHARE = 0.6  # of the trials fill the ranges evenly, before the search believes what it has seen
JUDGED_AFTER = 3  # plants
VALIDATED = 800_000_000  # numbers of runs from here on are of finalists, on the plants of `validate`
HELD_OUT = 900_000_000  # and these of the best and of robot.yaml's own numbers, on plants that are held out


def add_arguments(parser):
    parser.add_argument("study", help="with a section `tune`")
    parser.add_argument("--out", required=True, help="folder of the study")
    parser.add_argument("--jobs", type=int, default=1, help="workers on this machine; 0: one for each core")
    parser.add_argument("--storage", help="database of Optuna, e.g. sqlite:///tune.db; default: a journal in the folder")
    parser.add_argument("--trials", type=int, help="in all, those that are there included; default: the study's")


def four_digits(value: float) -> float:
    """So that robot.yaml can hold what was tried."""
    return float(f"{value:.4g}")


def term_cost(term: dict, rows: dict) -> float:
    value = rows.get(term["row"])
    if value is None:
        return term["unreached"]
    if "about" in term:
        value = abs(value - term["about"])
    return term["weight"] * max(0.0, value - term["above"]) if term["above"] > -1e300 else term["weight"] * value


def plant_cost(goal: dict, row: dict) -> float:
    rows = {one["name"]: one["value"] for one in row["rows"]}
    return sum(term_cost(term, rows) for term in goal["of"])


def goal_value(goal: dict, rows: list[dict]) -> float:
    costs = [plant_cost(goal, row) for row in rows]
    if goal["over"] == "mean":
        return math.fsum(costs) / len(costs)
    return max(costs) if goal["want"] == "least" else min(costs)


class Runs:
    """Rows of a study's folder, made where they are missing."""

    def __init__(self, study_file: str, out: str, study: dict, jobs: int):
        self._study, self._rows = study, Path(out) / "rows"
        contract.claim(study_file, out)
        self._keeper = contract.Keeper(study_file, out)
        self._idle = SimpleQueue()
        for _ in range(jobs):
            self._idle.put(contract.Worker(study["timeout_s"]))
        self._threads = ThreadPoolExecutor(jobs)

    def line(self, number: int, parameters: dict, plant: list, seed: int) -> str:
        study = self._study
        keys = {key: study[key] for key in ("experiment", "robot", "preset", "options")}
        return json.dumps({"run": number, "study": study["hash"], **keys, "parameters": parameters, "plant": plant,
                           "seed": seed})

    def rows(self, lines: list[str]) -> list[dict]:
        """In the order of the lines. Raises RuntimeError where the machine gave no row: that is no cost of numbers."""
        futures = [self._threads.submit(self._answer, line) for line in lines]
        rows = []
        for future, line in zip(futures, lines):
            answer = future.result()
            if "kept" not in answer:
                self._keeper.keep(json.dumps(answer))
            if "row" not in answer:
                raise RuntimeError(f"run {contract.number_of(line)} has no row: {answer['error']}; "
                                   "the same command goes on")
            rows.append(answer["row"])
        return rows

    def _answer(self, line: str) -> dict:
        kept = self._rows / f"{contract.number_of(line)}.json"
        if kept.exists():
            row = json.loads(kept.read_text())
            if row["parameters"] == json.loads(line)["parameters"]:
                return {"row": row, "kept": True}
        worker = self._idle.get()
        try:
            return json.loads(worker.answer(line))
        finally:
            self._idle.put(worker)

    def close(self):
        self._threads.shutdown()
        while not self._idle.empty():
            self._idle.get().close()
        self._keeper.finish()


class Search:
    def __init__(self, study: dict, runs: Runs, optuna_study):
        self.study, self.runs, self.optuna_study = study, runs, optuna_study
        self.goals = study["tuning"]["goals"]
        self.prunes = study["tuning"]["prunes"] and len(self.goals) == 1

    def asked(self) -> dict:
        """A trial with its numbers, as they are tried."""
        trial = self.optuna_study.ask()
        values = {one["path"]: four_digits(trial.suggest_float(one["path"], one["from"], one["to"],
                                                               log=one["logarithmic"]))
                  for one in self.study["parameters"]}
        return {"trial": trial, "values": values, "rows": []}

    def batch(self, size: int):
        """Plant by plant, all trials of the batch at once; those that are bad by then are left."""
        alive = tried = [self.asked() for _ in range(size)]
        for place in range(len(self.study["plants"])):
            lines = [line for one in alive for line in self.lines(one, place)]
            rows = self.runs.rows(lines)
            seeds = len(self.study["seeds"])
            for i, one in enumerate(alive):
                one["rows"] += rows[i * seeds:(i + 1) * seeds]
                one["trial"].set_user_attr("runs", len(one["rows"]))
            self.refuse_unknown_rows(alive[0])
            alive = [one for one in alive if not self.is_pruned(one, place)]
            if not alive:
                break
        for one in tried:
            self.tell(one, one in alive)

    def lines(self, one: dict, place: int) -> list[str]:
        seeds, plants = self.study["seeds"], self.study["plants"]
        first = one["trial"].number * len(plants) * len(seeds) + place * len(seeds) + 1
        return [self.runs.line(first + i, one["values"], plants[place], seed) for i, seed in enumerate(seeds)]

    def is_pruned(self, one: dict, place: int) -> bool:
        if not self.prunes or place + 1 == len(self.study["plants"]):
            return False
        one["trial"].report(goal_value(self.goals[0], one["rows"]), place)
        return one["trial"].should_prune()

    def refuse_unknown_rows(self, one: dict):
        """A name that no run has would be `unreached` for ever."""
        known = {row["name"] for rows in one["rows"] for row in rows["rows"]}
        for goal in self.goals:
            for term in goal["of"]:
                if known and term["row"] not in known:
                    near = difflib.get_close_matches(term["row"], known, 1)
                    raise RuntimeError(f"goal {goal['name']}: no run has a row {term['row']}" +
                                       (f"; {near[0]}?" if near else ""))

    def tell(self, one: dict, is_whole: bool):
        import optuna

        if not is_whole:
            return self.optuna_study.tell(one["trial"], state=optuna.trial.TrialState.PRUNED)
        self.optuna_study.tell(one["trial"], [goal_value(goal, one["rows"]) for goal in self.goals])

    def judged(self, values: dict, plants: list, first: int) -> list[list[dict]]:
        """For each plant its rows, a seed each."""
        seeds, out = self.study["seeds"], []
        for place, plant in enumerate(plants):
            numbers = range(first + place * len(seeds), first + (place + 1) * len(seeds))
            out.append(self.runs.rows([self.runs.line(n, values, plant, seed) for n, seed in zip(numbers, seeds)]))
        return out

    def held_out(self, values: dict, first: int) -> list[list[float]]:
        """For each held-out plant what each goal comes to."""
        judged = self.judged(values, self.study["tuning"]["held_out"], first)
        return [[goal_value(goal, rows) for goal in self.goals] for rows in judged]

    def best(self) -> dict:
        plants = self.study["tuning"]["validate"]
        return self.best_finalist(plants) if plants else best_values(self.optuna_study, self.goals)

    def best_finalist(self, plants: list) -> dict:
        """What is best on a few plants is partly so by luck: the first few are asked once more, on others."""
        goal = self.goals[0]
        sign = 1.0 if goal["want"] == "least" else -1.0
        whole = [t for t in self.optuna_study.trials if t.state.name == "COMPLETE"]
        first = sorted(whole, key=lambda t: sign * t.values[0])[:self.study["tuning"]["finalists"]]

        def value(trial):
            values, begin = rounded(trial.params), VALIDATED + trial.number * 10_000
            seen = self.judged(values, self.study["plants"], trial.number * len(self.study["plants"]) *
                               len(self.study["seeds"]) + 1)
            rows = [row for one in seen + self.judged(values, plants, begin) for row in one]
            return sign * goal_value(goal, rows)

        return rounded(min(first, key=value).params)


def rounded(params: dict) -> dict:
    return {path: four_digits(value) for path, value in params.items()}


def open_search(study: dict, storage: str | None, out: str):
    """The search that is there, or a new one that begins with robot.yaml's own numbers."""
    import optuna
    from optuna.storages import JournalStorage
    from optuna.storages.journal import JournalFileBackend

    optuna.logging.set_verbosity(optuna.logging.WARNING)
    kept = storage or JournalStorage(JournalFileBackend(str(Path(out) / "optuna.journal")))
    origin = json.loads((Path(out) / "study.json").read_text())
    name = f"{study['study']} {study['hash']} {origin['version']} {origin['files']}"
    tuning = study["tuning"]
    directions = ["minimize" if goal["want"] == "least" else "maximize" for goal in tuning["goals"]]
    known = name in optuna.study.get_all_study_names(kept)
    count = len(optuna.load_study(study_name=name, storage=kept).trials) if known else 0
    even = round(EVEN_SHARE * tuning["trials"])
    sampler = optuna.samplers.TPESampler(seed=tuning["seed"] + count, n_startup_trials=even, multivariate=True,
                                         constant_liar=True)
    search = optuna.create_study(study_name=name, storage=kept, sampler=sampler, directions=directions,
                                 pruner=optuna.pruners.MedianPruner(8, n_warmup_steps=JUDGED_AFTER - 1), load_if_exists=True)
    if not known:
        for values in first_sets(study, even):
            search.enqueue_trial(values)
    take_up_interrupted(search, optuna)
    return search


def first_sets(study: dict, count: int) -> list[dict]:
    """robot.yaml's own numbers, then points of Roberts' sequence (tools/lab/study/even_points.h), shifted by the
    seed."""
    parameters = study["parameters"]
    own = {one["path"]: one["present"] for one in parameters if one["from"] <= one["present"] <= one["to"]}
    first = study["tuning"]["seed"] * count
    return [own] + [{one["path"]: at_share(one, share) for one, share in zip(parameters, even_point(len(parameters), n))}
                    for n in range(first, first + count - 1)]


def even_point(dimensions: int, n: int) -> list[float]:
    ratio = 2.0
    for _ in range(64):
        ratio = (1.0 + ratio) ** (1.0 / (dimensions + 1.0))
    return [(0.5 + n * ratio ** -(i + 1)) % 1.0 for i in range(dimensions)]


def at_share(one: dict, share: float) -> float:
    low, high = one["from"], one["to"]
    value = low * (high / low) ** share if one["logarithmic"] else low + share * (high - low)
    return min(max(four_digits(value), low), high)


def take_up_interrupted(search, optuna):
    """Trials that a search was in when it ended: told as failed, and their numbers asked for again."""
    for trial in search.get_trials(states=(optuna.trial.TrialState.RUNNING,)):
        search.tell(trial.number, state=optuna.trial.TrialState.FAIL)
        if trial.params:
            search.enqueue_trial(trial.params)


def best_values(search, goals: list) -> dict:
    """Of several goals: the one of the front that is least off, each goal counted from its best to its worst there."""
    trials = search.best_trials
    spans = [(min(t.values[i] for t in trials), max(t.values[i] for t in trials)) for i in range(len(goals))]

    def off(trial):
        total = 0.0
        for value, (low, high), goal in zip(trial.values, spans, goals):
            share = (value - low) / (high - low) if high > low else 0.0
            total += share if goal["want"] == "least" else 1.0 - share
        return total

    return rounded(min(trials, key=off).params)


def fragment(study: dict, values: dict) -> str:
    """The keys as robot.yaml would hold them, nested; an item of a list is to be changed in its place."""
    units = {one["path"]: one["unit"] for one in study["parameters"]}
    tree: dict = {}
    items = ""
    for path, value in values.items():
        *way, last = path.split(".")
        if any(part.isdigit() for part in path.split(".")):
            items += f"# {path}: {value:g} {units[path]}".strip() + "\n"
            continue
        place = tree
        for key in way:
            place = place.setdefault(key, {})
        place[last] = f"{value:g} {units[path]}".strip()

    def lines(node, depth):
        for key, value in node.items():
            if isinstance(value, dict):
                yield "  " * depth + f"{key}:"
                yield from lines(value, depth + 1)
            else:
                yield "  " * depth + f"{key}: {value}"

    return items + "".join(line + "\n" for line in lines(tree, 0))


def run(arguments) -> int:
    study = contract.show(arguments.study)
    if "tuning" not in study:
        raise RuntimeError(f"{arguments.study} has no section `tune` (docs/studies.md)")
    runs = Runs(arguments.study, arguments.out, study, arguments.jobs or os.cpu_count())
    optuna_study = open_search(study, arguments.storage, arguments.out)
    search = Search(study, runs, optuna_study)
    wanted = arguments.trials or study["tuning"]["trials"]
    try:
        while (left := trials_left(study, optuna_study, wanted)) > 0:
            search.batch(min(BATCH, left))
            print(f"\r{wanted - left} of {wanted} trials", end="", file=sys.stderr, flush=True)
        print(file=sys.stderr)
        best = search.best()
        present = {one["path"]: one["present"] for one in study["parameters"]}
        held_out = {"present": search.held_out(present, HELD_OUT + 1),
                    "best": search.held_out(best, HELD_OUT + 500_001)} if study["tuning"]["held_out"] else {}
    finally:
        runs.close()
    write_results(arguments, study, optuna_study, best, held_out)
    return 0


def set_words(values: dict) -> str:
    return " ".join(f"--set {path}={value:g}" for path, value in values.items())


def trials_left(study: dict, optuna_study, wanted: int) -> int:
    trials = optuna_study.trials
    budget = study["tuning"]["runs"]
    if 0 < budget <= sum(t.user_attrs.get("runs", 0) for t in trials):
        return 0
    return wanted - sum(t.state.is_finished() and t.state.name != "FAIL" for t in trials)


def write_results(arguments, study, optuna_study, best: dict, held_out: dict):
    out = Path(arguments.out)
    line = f"python3 -m sprung_study tune {arguments.study} --out {arguments.out}"
    (out / "best.yaml").write_text(f"# {line}\n# sprung experiment {study['experiment']} {set_words(best)}\n" +
                                   fragment(study, best))
    names = [goal["name"] for goal in study["tuning"]["goals"]]
    made = sum(t.user_attrs.get("runs", 0) for t in optuna_study.trials)
    counts = {state: sum(t.state.name == state for t in optuna_study.trials) for state in ("COMPLETE", "PRUNED", "FAIL")}
    summary = {"study": study["study"], "hash": study["hash"], "goals": names, "trials": counts, "runs": made, "best": best,
               "best_trials": [{"number": t.number, "values": t.values, "numbers": rounded(t.params)}
                               for t in optuna_study.best_trials],
               "plants_held_out": study["tuning"]["held_out"], "held_out": held_out}
    (out / "tune.json").write_text(json.dumps(summary, indent=1) + "\n")
    (out / "tune.html").write_text(tune_page.page(study, optuna_study, summary, line))
    print(f"{out}/tune.html, tune.json, best.yaml")
    print(fragment(study, best), end="")
    for place, plant in enumerate(study["tuning"]["held_out"] if held_out else []):
        said = "; ".join(f"{name} {held_out['present'][place][i]:.4g} -> {held_out['best'][place][i]:.4g}"
                         for i, name in enumerate(names))
        print(f"held out {' '.join(plant)}: {said}")
