"""The search of `tune`: what a set of numbers costs, and the trials by which Optuna looks for the least.

Trials are asked for in batches of a fixed size, and a batch is told in the order of its trials: the same search
whatever the number of workers. What a trial needs stands in the study's folder as rows, so that a search that was
interrupted goes on with what it has."""
import difflib
import json
import math
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue

from sprung_study import contract

BATCH = 4
JUDGED_AFTER = 3  # plants
VALIDATED = 800_000_000  # numbers of runs from here on are of finalists, on the plants of `validate`
HELD_OUT = 900_000_000  # and these of the best and of robot.yaml's own numbers, on plants that are held out


def as_tried(study: dict, params: dict) -> dict:
    """In four digits, so that robot.yaml can hold them, and within their ranges."""
    return {one["path"]: min(max(float(f"{params[one['path']]:.4g}"), one["from"]), one["to"])
            for one in study["parameters"]}


def term_cost(term: dict, rows: dict) -> float:
    value = rows.get(term["row"])
    if value is None:
        return term["unreached"]
    if "about" in term:
        value = abs(value - term["about"])
    if "above" in term:
        value = max(0.0, value - term["above"])
    return term["weight"] * value


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
        for one in self.study["parameters"]:
            trial.suggest_float(one["path"], one["from"], one["to"], log=one["logarithmic"])
        return {"trial": trial, "values": as_tried(self.study, trial.params), "rows": []}

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
        return self.best_finalist(plants) if plants else self.least_off()

    def best_finalist(self, plants: list) -> dict:
        """What is best on a few plants is partly so by luck: the first few are asked once more, on others."""
        goal = self.goals[0]
        sign = 1.0 if goal["want"] == "least" else -1.0
        whole = [t for t in self.optuna_study.trials if t.state.name == "COMPLETE"]
        first = sorted(whole, key=lambda t: sign * t.values[0])[:self.study["tuning"]["finalists"]]

        def value(trial):
            values, begin = as_tried(self.study, trial.params), VALIDATED + trial.number * 10_000
            seen = self.judged(values, self.study["plants"], trial.number * len(self.study["plants"]) *
                               len(self.study["seeds"]) + 1)
            rows = [row for one in seen + self.judged(values, plants, begin) for row in one]
            return sign * goal_value(goal, rows)

        return as_tried(self.study, min(first, key=value).params)

    def least_off(self) -> dict:
        """Of the front the one that is least off, each goal counted from its best to its worst there."""
        trials = self.optuna_study.best_trials
        spans = [(min(t.values[i] for t in trials), max(t.values[i] for t in trials)) for i in range(len(self.goals))]

        def off(trial):
            total = 0.0
            for value, (low, high), goal in zip(trial.values, spans, self.goals):
                share = (value - low) / (high - low) if high > low else 0.0
                total += share if goal["want"] == "least" else 1.0 - share
            return total

        return as_tried(self.study, min(trials, key=off).params)


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
    first_sets = tuning["first_sets"]
    sampler = optuna.samplers.TPESampler(seed=tuning["seed"] + count, n_startup_trials=len(first_sets),
                                         multivariate=True, constant_liar=True)
    search = optuna.create_study(study_name=name, storage=kept, sampler=sampler, directions=directions,
                                 pruner=optuna.pruners.MedianPruner(8, n_warmup_steps=JUDGED_AFTER - 1),
                                 load_if_exists=True)
    if not known:
        for values in first_sets:
            search.enqueue_trial(dict(zip((one["path"] for one in study["parameters"]), values)))
    take_up_interrupted(search, optuna)
    return search


def take_up_interrupted(search, optuna):
    """Trials that a search was in when it ended: told as failed, and their numbers asked for again."""
    for trial in search.get_trials(states=(optuna.trial.TrialState.RUNNING,)):
        search.tell(trial.number, state=optuna.trial.TrialState.FAIL)
        if trial.params:
            search.enqueue_trial(trial.params)


def trials_left(study: dict, optuna_study, wanted: int) -> int:
    trials = optuna_study.trials
    budget = study["tuning"]["runs"]
    if 0 < budget <= sum(t.user_attrs.get("runs", 0) for t in trials):
        return 0
    return wanted - sum(t.state.is_finished() and t.state.name != "FAIL" for t in trials)
