#!/usr/bin/env python3
# Modules of others are in the repository byte for byte: each SHA256SUMS names every file beside it, and
# every file has the sum that it says.
# usage: third_party.py SOURCE_FOLDER   exit status 1: a file differs, is missing, or is not named
import hashlib
import pathlib
import sys


def faults_of(folder):
    named = {}
    for line in (folder / "SHA256SUMS").read_text().splitlines():
        digest, name = line.split(maxsplit=1)
        named[name.lstrip("*")] = digest
    own = {"README.md", "SHA256SUMS"}
    there = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()} - own
    licences = {name for name in there if pathlib.PurePath(name).name.startswith("LICENSE")}
    faults = [f"{name} is not in SHA256SUMS" for name in sorted(there - licences - named.keys())]
    faults += [f"{name} is missing" for name in sorted(named.keys() - there)]
    for name in sorted(named.keys() & there):
        if hashlib.sha256((folder / name).read_bytes()).hexdigest() != named[name]:
            faults.append(f"{name} is not the file that its maker ships: its sum differs")
    return faults


def main(source):
    folders = sorted(path.parent for path in pathlib.Path(source, "tools").rglob("third_party/SHA256SUMS"))
    if not folders:
        sys.exit("third_party.py: there is no third_party/SHA256SUMS; was it moved?")
    faults = [f"{folder}: {fault}" for folder in folders for fault in faults_of(folder)]
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
