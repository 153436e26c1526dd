#!/usr/bin/env python3
"""check.py BIN_FOLDER: what tests/lcmtypes/run does once a current LCM is there.

Prints a row for each language and version of LCM. Exit status: 0 all that this machine can build decodes and encodes
every message alike; 1 something does not."""

import dataclasses
import pathlib
import subprocess
import sys
import sysconfig
import tempfile

import languages
import recording

TOP = recording.TOP

@dataclasses.dataclass
class Lcm:
    version: str
    generator: str
    jar: pathlib.Path
    c_flags: list
    c_libraries: list
    environment: dict


def lcm_versions():
    """Debian's, where there is one, and the one of this Python's environment."""
    found = []
    if pathlib.Path("/usr/bin/lcm-gen").exists():
        found.append(Lcm("1.3.1", "/usr/bin/lcm-gen", pathlib.Path("/usr/share/java/lcm.jar"), [], ["-llcm"], {}))
    top = pathlib.Path(sysconfig.get_paths()["platlib"])
    libraries = top / "lib"
    found.append(
        Lcm("1.5.3", str(top / "bin/lcm-gen"), top / "share/java/lcm.jar", ["-I", str(top / "include")],
            ["-L", str(libraries), "-llcm", f"-Wl,-rpath,{libraries}"], {"LD_LIBRARY_PATH": str(libraries)})
    )  # fmt: skip
    for lcm in found:
        said = subprocess.run([lcm.generator, "--version"], capture_output=True, text=True, env=lcm.environment)
        assert lcm.version in said.stdout + said.stderr, f"{lcm.generator} is not {lcm.version}: {said.stdout}{said.stderr}"
    return found


def generate(lcm, options, folder):
    files = sorted((TOP / "lcmtypes").glob("*.lcm"))
    done = subprocess.run(
        [lcm.generator, *options, *map(str, files)], cwd=folder, capture_output=True, text=True, env=lcm.environment
    )
    assert done.returncode == 0, done.stdout + done.stderr


def record(programs, folder):
    """{channel: message}: of pegasus, commanded by the Python example and heard by the C++ one, and of test_axis, which
    has a torque sensor."""
    python, listener = folder / "python", folder / "listener"
    python.mkdir(), listener.mkdir()
    debian_or_ours = lcm_versions()[0]
    generate(debian_or_ours, languages.Python.options, python)
    generate(debian_or_ours, languages.Cpp.options, listener)
    source = recording.EXAMPLES / "listener.cpp"
    subprocess.run(["c++", "-std=c++17", "-Wall", "-Wextra", "-Wno-unused-parameter", "-I", str(listener), *debian_or_ours.c_flags, str(source),
                    *debian_or_ours.c_libraries, "-o", str(listener / "listener")], check=True)  # fmt: skip
    out = {}
    with recording.Robot(programs, "test_axis", folder / "test_axis") as axis:
        axis.ask("status")
    out.update(recording.events(axis.log))
    with recording.Robot(programs, "pegasus", folder / "pegasus") as robot:
        heard = folder / "heard.txt"
        with open(heard, "w", encoding="utf-8") as file:
            listening = subprocess.Popen([str(listener / "listener"), robot.lcm_url], stdout=file)
        try:
            refused = command(robot, python, "stand")
            assert refused.returncode == 1 and "not referenced" in refused.stderr, refused
            for word in ("home", "stand"):
                done = command(robot, python, word)
                assert done.returncode == 0 and done.stdout.startswith(f"{word} done"), done
            robot.wait_for(lambda: "stands" in heard.read_text(), "the listener to see it stand")
            assert robot.ask("fault", "fl_knee_motor", "current-offset", "--value", "0").returncode == 0
        finally:
            listening.terminate()
            listening.wait()
        assert "safety: operational" in heard.read_text(), heard.read_text()
    out.update(recording.events(robot.log))
    out.pop("LCM_SELF_TEST", None)  # LCM's own, no message
    return out


def command(robot, messages, word):
    return subprocess.run(
        [sys.executable, str(recording.EXAMPLES / "command_robot.py"), word],
        env={**robot.environment, "PYTHONPATH": str(messages)}, capture_output=True, text=True, timeout=60,
    )  # fmt: skip


def types_of(messages, folder):
    """{type: channel}, by the fingerprint that each message begins with."""
    python = folder / "python"
    sys.path.insert(0, str(python))
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
        messages = record(programs, folder)
        types = types_of(messages, folder)
        print(f"languages: {len(types)} types on {len(messages)} channels; the examples command and listen")
        for lcm in lcm_versions():
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
