"""Which suites there are, asked of ctest and of the test programs themselves: it does not matter whether a ctest entry is a case or a suite."""

import dataclasses
import fnmatch
import json
import pathlib
import re
import subprocess
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
# Whoever says one of these starts programs of the build, or a browser.
PROCESSES = re.compile(r"test::bin_dir\(\)|chromium --headless")
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
LEFT_OUT = {"vm"}  # labels: boots a machine of its own, whose clock does not go by ours


class NotBuilt(Exception):
    """What there is to run is not there yet."""


@dataclasses.dataclass(frozen=True)
class Suite:
    name: str  # PROGRAM/SUITE, or a ctest entry that is no GoogleTest
    command: tuple
    folder: str
    processes: bool
    realtime: bool
    program: str  # file whose change makes older rounds worthless
    skip_status: int = -1


def suites_of(build, only):
    """@param only regular expression of names."""
    found = []
    programs = {}
    for entry in _entries(build, only):
        labels = set(entry.get("labels", []))
        program = entry["command"][0]
        if pathlib.Path(program).parent == (build / "tests").resolve():
            programs.setdefault(program, []).append(entry)
        elif not labels & LEFT_OUT:
            found.append(_script(entry, labels))
    for program, entries in programs.items():
        found += _suites_of_program(build, program, entries)
    return sorted((s for s in found if re.search(only, s.name)), key=lambda suite: suite.name)


def _entries(build, only):
    text = subprocess.run(
        ["ctest", "--test-dir", str(build), "--show-only=json-v1"], check=True, capture_output=True, text=True
    ).stdout
    for test in json.loads(text)["tests"]:
        if "command" not in test:
            program = test["name"].removesuffix("_NOT_BUILT")
            if re.search(only, f"{program}/"):
                raise NotBuilt(f"{program} is not built: cmake --build --preset release")
            continue
        yield {
            "name": test["name"],
            "command": test["command"],
            **{p["name"].lower(): p["value"] for p in test.get("properties", [])},
        }


def _script(entry, labels):
    return Suite(
        name=entry["name"],
        command=tuple(entry["command"]),
        folder=entry.get("working_directory", "."),
        processes=True,
        realtime="realtime" in labels,
        program=entry["command"][0],
        skip_status=int(entry.get("skip_return_code", -1)),
    )


def _suites_of_program(build, program, entries):
    realtime_filters = [
        argument.partition("=")[2]
        for entry in entries
        if "realtime" in entry.get("labels", [])
        for argument in entry["command"]
        if argument.startswith("--gtest_filter=")
    ]
    folder = entries[0].get("working_directory", ".")
    suites = []
    for suite, (source, cases) in _listed(program).items():
        realtime = [case for case in cases if any(_matches(case, f) for f in realtime_filters)]
        rest = [case for case in cases if case not in realtime]
        for some, is_realtime in ((rest, False), (realtime, True)):
            if not some:
                continue
            chosen = f"{suite}.*" if len(some) == len(cases) else ":".join(some)
            name = f"{pathlib.Path(program).name}/{suite}" + ("@realtime" if is_realtime else "")
            suites.append(
                Suite(
                    name=name,
                    command=(program, f"--gtest_filter={chosen}"),
                    folder=folder,
                    processes=_starts_processes(_of_this_tree(source)),
                    realtime=is_realtime,
                    program=program,
                )
            )
    return suites


def _listed(program):
    """@return for each suite its source and its cases, SUITE.CASE."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "list.json"
        subprocess.run(
            [program, "--gtest_list_tests", f"--gtest_output=json:{path}"], check=True, capture_output=True
        )
        listed = json.loads(path.read_text())
    found = {}
    for suite in listed["testsuites"]:
        cases = [c for c in suite["testsuite"] if not c["name"].startswith("DISABLED_")]
        if cases and not suite["name"].startswith("DISABLED_"):
            found[suite["name"]] = (cases[0]["file"], [f"{suite['name']}.{c['name']}" for c in cases])
    return found


def _matches(case, gtest_filter):
    """As GoogleTest has it: patterns by `:`, then what is left out behind a `-`."""
    take, _, leave = gtest_filter.partition("-")
    return any(fnmatch.fnmatchcase(case, p) for p in (take or "*").split(":")) and not any(
        fnmatch.fnmatchcase(case, p) for p in leave.split(":") if p
    )


def _of_this_tree(source):
    """@param source as the compiler was called; ccache may have it from another clone."""
    path = TOP / "tests" / source.rpartition("/tests/")[2]
    if not path.is_file():
        raise NotBuilt(f"{source} is not in this tree: build it anew")
    return path


def _starts_processes(source, seen=None):
    """Whether this file, or a test's header that it includes (and what is behind that), starts any."""
    seen = set() if seen is None else seen
    path = source.resolve()
    if path in seen or not path.is_file():
        return False
    seen.add(path)
    text = path.read_text(encoding="utf-8")
    if PROCESSES.search(text):
        return True
    for included in INCLUDE.findall(text):
        header = (TOP / included if included.startswith("tests/") else path.parent / included).resolve()
        if not header.is_relative_to(TOP / "tests"):
            continue
        if any(_starts_processes(file, seen) for file in (header, header.with_suffix(".cpp"))):
            return True
    return False
