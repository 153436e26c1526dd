"""python3 -m sprung_study COMMAND: each a module with add_arguments(parser) and run(arguments)."""
import argparse
import importlib
import sys

COMMANDS = {
    "ray": ("ray_engine", "the runs that are missing, on a cluster of Ray"),
    "slurm": ("slurm_engine", "the runs that are missing, as an array of Slurm"),
    "tune": ("tune", "looks for the best numbers by Optuna"),
    "growth": ("growth", "time against workers, from what the runs took"),
    "parquet": ("parquet", "table.parquet of a study's folder"),
}


def main() -> int:
    parser = argparse.ArgumentParser(prog="python3 -m sprung_study", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    for name, (module, what) in COMMANDS.items():
        command = commands.add_parser(name, help=what, description=what)
        importlib.import_module(f"sprung_study.{module}").add_arguments(command)
    arguments = parser.parse_args()
    module = importlib.import_module(f"sprung_study.{COMMANDS[arguments.command][0]}")
    try:
        return module.run(arguments)
    except (RuntimeError, OSError, ImportError, ValueError) as error:
        remedy = " (pip install -r python/requirements.txt)" if isinstance(error, ImportError) else ""
        # `sprung study collect` says what it hears on standard output.
        print(f"{error}{remedy}", file=sys.stdout if arguments.command == "parquet" else sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
