"""The one test build with every mutant in it, and what it is made from."""

import hashlib
import os
import shutil
import subprocess

import mutants

FOLDER = mutants.TOP / "build/mutants"
SOURCE = FOLDER / "source"
BINARIES = SOURCE / "build/release"
PROGRAMS = "drivers_tests runtime_tests estimator_tests controller_tests planner_tests simulation_tests sprung".split()
NOT_BUILT = ("docs/", "tests/mutants/")


def names():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=mutants.TOP, check=True,
                            capture_output=True, text=True).stdout.split("\0")  # fmt: skip
    return sorted({name for name in listed if name and (mutants.TOP / name).is_file()})


def digest(names_of_files):
    """Of their names and contents."""
    sha = hashlib.sha256()
    for name in names_of_files:
        sha.update(name.encode() + b"\0" + (mutants.TOP / name).read_bytes() + b"\0")
    return sha.hexdigest()


def write(path, content):
    """Only where it differs, so that ninja sees what has changed."""
    if path.is_file() and path.read_bytes() == content:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def copy(listed):
    kept = set(names()) | {"tests/mutants/switch.h"}
    for path in SOURCE.rglob("*") if SOURCE.exists() else ():
        name = path.relative_to(SOURCE)
        if name.parts[0] != "build" and path.is_file() and str(name) not in kept:
            path.unlink()
    write(SOURCE / "tests/mutants/switch.h", mutants.SWITCH.encode())
    for name in names():
        content = (mutants.TOP / name).read_bytes()
        of_file = [mutant for mutant in listed if mutant.file == name]
        if of_file:
            content = mutants.with_switches(content.decode(), of_file).encode()
        write(SOURCE / name, content)
        shutil.copymode(mutants.TOP / name, SOURCE / name)


def build(jobs):
    subprocess.run(["cmake", "--preset", "release"], cwd=SOURCE, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "--preset", "release", "-j", str(jobs), "--target", *PROGRAMS],
                   cwd=SOURCE, check=True)  # fmt: skip


def key_of_all():
    return digest(name for name in names() if not name.startswith(NOT_BUILT))


def program(name):
    return BINARIES / ("bin" if name == "sprung" else "tests") / name


def environment(mutant):
    """@param mutant nothing: none is switched on."""
    own = dict(os.environ)
    own.pop("SPRUNG_MUTANT", None)
    if mutant:
        own["SPRUNG_MUTANT"] = str(mutant.number)
    return own


def scratch():
    """Where programs run, and may leave what they write."""
    folder = FOLDER / "scratch"
    folder.mkdir(parents=True, exist_ok=True)
    return folder
