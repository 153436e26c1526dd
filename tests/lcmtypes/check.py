#!/usr/bin/env python3
"""check.py BIN_FOLDER: what tests/lcmtypes/run does once a current LCM is there.

Two robots are recorded; then a program in each language, for each version of LCM, decodes and encodes a message of every
channel. A row each. Exit status: 0 all that this machine can build has every message alike; 1 something has not."""

import dataclasses
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile

import languages
import recording
import refusals
from programs import TOP

EXAMPLES = TOP / "examples/operator"
DEBIANS = pathlib.Path("/usr/bin/lcm-gen")


@dataclasses.dataclass
class Lcm:
    generator: str
    jar: pathlib.Path
    c_flags: list
    c_libraries: list
    environment: dict

    def __post_init__(self):
        self.help = self.ask("--help")
        self.version = re.search(r"\d+\.\d+\.\d+", self.ask("--version"))[0]

    def ask(self, option):
        done = subprocess.run([self.generator, option], capture_output=True, text=True, env=self.environment)
        return done.stdout + done.stderr


def lcm_versions():
    """Debian's, where it is there, and the one of this Python's environment."""
    top = pathlib.Path(sysconfig.get_paths()["platlib"])
    libraries = top / "lib"
    found = [Lcm(str(DEBIANS), pathlib.Path("/usr/share/java/lcm.jar"), [], ["-llcm"], {})] if DEBIANS.exists() else []
    found.append(
        Lcm(str(top / "bin/lcm-gen"), top / "share/java/lcm.jar", ["-I", str(top / "include")],
            ["-L", str(libraries), "-llcm", f"-Wl,-rpath,{libraries}"], {"LD_LIBRARY_PATH": str(libraries)})
    )  # fmt: skip
    return found


def generate(lcm, options, folder):
    files = sorted((TOP / "lcmtypes").glob("*.lcm"))
    done = subprocess.run(
        [lcm.generator, *options, *map(str, files)], cwd=folder, capture_output=True, text=True, env=lcm.environment
    )
    assert done.returncode == 0, done.stdout + done.stderr


def with_battery(name, folder):
    """The robot's folder with a battery in robot.yaml: then AUXILIARY_STATE is sent, though none answers."""
    copy = folder / "robots" / name
    shutil.copytree(TOP / "robots" / name, copy)
    file = copy / "robot.yaml"
    file.write_text(file.read_text() + "battery: {bus: fl, node: 20}\n")
    return copy


def record(programs, lcm, folder):
    """{channel: message}: of test_axis, which has a torque sensor, and of pegasus, which has an IMU, is commanded by the
    Python example and heard by the C++ one."""
    python, listener = folder / "python", folder / "listener"
    python.mkdir()
    listener.mkdir()
    generate(lcm, languages.Python.options, python)
    generate(lcm, languages.Cpp.options, listener)
    subprocess.run(
        ["c++", "-std=c++17", "-Wall", "-Wextra", "-Wno-unused-parameter", "-I", str(listener), *lcm.c_flags,
         str(EXAMPLES / "listener.cpp"), *lcm.c_libraries, "-o", str(listener / "listener")], check=True,
    )  # fmt: skip
    with recording.Robot(programs, "test_axis", folder / "test_axis") as axis:
        pass  # up means that cycles have been counted
    with recording.Robot(programs, with_battery("pegasus", folder), folder / "pegasus") as robot:
        use_examples(robot, python, listener / "listener", folder / "heard.txt")
        sys.path.insert(0, str(python))
        refusals.check(robot, folder / "pegasus")
        assert robot.ask("fault", "fl_knee_motor", "current-offset", "--value", "0").returncode == 0
    messages = {**recording.newest_messages(axis.log), **recording.newest_messages(robot.log)}
    named = set(re.findall(r'"([A-Z_]+)"', (TOP / "lcmtypes/channels.h").read_text()))
    assert set(messages) == named, f"recorded, and in channels.h: {set(messages) ^ named} is in one of them only"
    return messages


def use_examples(robot, messages, listener, heard):
    def command(word):
        example = [sys.executable, EXAMPLES / "command_robot.py", word]
        return robot.run(robot.sprung, "run", "--", *example, PYTHONPATH=str(messages))

    with open(heard, "w", encoding="utf-8") as file:
        listening = subprocess.Popen([str(listener), robot.lcm_url], stdout=file)
    try:
        refused = command("stand")
        assert refused.returncode == 1 and "not referenced" in refused.stdout, refused
        unknown = command("sitt")
        assert unknown.returncode != 0 and "home|stand|jump" in unknown.stderr and "Traceback" not in unknown.stderr, unknown
        for word in ("home", "stand"):
            done = command(word)
            assert done.returncode == 0 and re.match(r"[\w-]+: \w", done.stdout), done
        robot.wait_for(lambda: "stands" in heard.read_text(), "the listener to see it stand")
    finally:
        listening.terminate()
        listening.wait()
    assert "safety: operational" in heard.read_text(), heard.read_text()


def types_of(messages):
    """{type: channel}, by the fingerprint that each message begins with."""
    import sprung_msgs  # pylint: disable=import-outside-toplevel

    by_fingerprint = {
        getattr(sprung_msgs, name)._get_packed_fingerprint(): name for name in dir(sprung_msgs) if name.endswith("_t")
    }
    return {by_fingerprint[data[:8]]: channel for channel, data in messages.items()}


def differences(name, expected, found):
    """Fields of a message that differ; "size" where it cannot be read."""
    if expected == found:
        return []
    import sprung_msgs  # pylint: disable=import-outside-toplevel

    if len(expected) != len(found):
        return ["size"]
    kind = getattr(sprung_msgs, name)
    one, other = kind.decode(expected), kind.decode(found)
    fields = [field for field in kind.__slots__ if repr(getattr(one, field)) != repr(getattr(other, field))]
    return fields or ["bytes"]


def check(language, lcm, messages, types, folder):
    """Nothing where it is well, else what is not; raises languages.Missing where it cannot be asked."""
    if language.options[0] not in lcm.help:
        raise languages.Missing(f"this lcm-gen has no {language.options[0]}")
    folder.mkdir(parents=True)
    generate(lcm, language.options, folder)
    run = language().build(folder, sorted(types), lcm)
    data = folder / "messages"
    data.mkdir()
    for name, channel in types.items():
        (data / name).write_bytes(messages[channel])
    done = subprocess.run([*run, str(data)], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        return f"{done.stdout}{done.stderr}"
    inexact = getattr(language, "inexact", set())
    wrong = []
    for name, channel in types.items():
        differing = differences(name, messages[channel], (data / f"{name}.again").read_bytes())
        wrong += [f"{name}.{field}" for field in differing if field not in inexact]
    if wrong:
        return f"not alike: {', '.join(wrong)}"
    return "" if done.stdout.strip() == languages.SAYS else f"constants are {done.stdout.strip()}"


def main():
    programs = pathlib.Path(sys.argv[1]).resolve()
    failed = False
    with tempfile.TemporaryDirectory(prefix="sprung-languages-") as temporary:
        folder = pathlib.Path(temporary)
        versions = lcm_versions()
        messages = record(programs, versions[0], folder)
        types = types_of(messages)
        print(f"languages: {len(types)} types on {len(messages)} channels; the examples command and listen")
        for lcm in versions:
            for language in languages.LANGUAGES:
                label = f"{language.__name__:8s} lcm-gen {lcm.version}"
                try:
                    why = check(language, lcm, messages, types, folder / lcm.version / language.__name__)
                except languages.Missing as missing:
                    print(f"{label}  skipped: {missing}")
                    continue
                except AssertionError as error:
                    why = str(error)
                failed = failed or bool(why)
                print(f"{label}  {'every message alike' if not why else 'FAILED: ' + why}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
