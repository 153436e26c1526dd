"""Tuning: Optuna asks for numbers and is told what they cost; the runs between are the contract's."""
import json
import os
import sys
from pathlib import Path

from sprung_study import contract, tune_page
from sprung_study.search import BATCH, HELD_OUT, Runs, Search, as_tried, open_search, trials_left


def add_arguments(parser):
    parser.add_argument("study", help="with a section `tune`")
    parser.add_argument("--out", required=True, help="folder of the study")
    parser.add_argument("--jobs", type=int, default=1, help="workers on this machine; 0: one for each core")
    parser.add_argument("--storage", help="database of Optuna, e.g. sqlite:///tune.db; default: a journal in the folder")
    parser.add_argument("--trials", type=int, help="in all, those that are there included; default: the study's")


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
        if not any(t.state.name == "COMPLETE" for t in optuna_study.trials):
            raise RuntimeError("no set of numbers was tried on every plant: more trials, please")
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


def write_results(arguments, study, optuna_study, best: dict, held_out: dict):
    out = Path(arguments.out)
    line = f"python3 -m sprung_study tune {arguments.study} --out {arguments.out}"
    (out / "best.yaml").write_text(f"# {line}\n# sprung experiment {study['experiment']} {set_words(best)}\n" +
                                   fragment(study, best))
    names = [goal["name"] for goal in study["tuning"]["goals"]]
    made = sum(t.user_attrs.get("runs", 0) for t in optuna_study.trials)
    counts = {state: sum(t.state.name == state for t in optuna_study.trials) for state in ("COMPLETE", "PRUNED", "FAIL")}
    summary = {"study": study["study"], "hash": study["hash"], "goals": names, "trials": counts, "runs": made, "best": best,
               "best_trials": [{"number": t.number, "values": t.values, "numbers": as_tried(study, t.params)}
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
