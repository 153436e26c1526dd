"""robot.yaml as `sprung robot show` types it out."""

import pathlib
import subprocess

import yaml

from programs import TOP


class _Loader(yaml.SafeLoader):
    """As YAML 1.2 has it: `on` is a word, not a truth."""

    yaml_implicit_resolvers = {
        first: [
            (tag, pattern) for tag, pattern in found if tag != "tag:yaml.org,2002:bool" or first in "tTfF"
        ]
        for first, found in yaml.SafeLoader.yaml_implicit_resolvers.items()
    }


def robot_file(robot, folder):
    """robot.yaml typed out; folder: where the programs are."""
    shown = subprocess.run(
        [str(pathlib.Path(folder) / "sprung"), "robot", "show", str(TOP / "robots" / robot)],
        capture_output=True,
        text=True,
        check=True,
    )
    return yaml.load(shown.stdout, _Loader)
