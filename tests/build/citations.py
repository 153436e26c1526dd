#!/usr/bin/env python3
"""Every source that a comment or a document cites by its label stands in docs/sources.md. usage: citations.py SOURCE_DIR"""

import pathlib
import re
import subprocess
import sys

TOP = pathlib.Path(sys.argv[1])
# What a label looks like where it is cited, and below which heading of docs/sources.md it stands as what.
ROW = r"^\| {label} \|"
KINDS = [
    (r"\bfacts (?:papers )?([A-D]\d)\b", "", r"^(?:### |\| ){label}\b"),
    (r"\b(?:errata|facts|facts papers) (E\d+)\b", "E. Errata", ROW),
    (r"\bfacts (L\d+)", "LCM", ROW),
    (r"\bfacts physics (\d+)", "Physics", r"^{label}\. "),
    (r"\bfacts canopen (?:section )?(\d)", "CANopen", ROW),
    (r"\bdesign section (\d+)", "Design", ROW),
]


def files():
    """Those that are kept; where this is no clone, all but what was built."""
    listed = subprocess.run(
        ["git", "-C", str(TOP), "ls-files", "-z"], check=False, capture_output=True, text=True
    )
    if listed.returncode == 0:
        return listed.stdout.split("\0")
    found = (path.relative_to(TOP) for path in TOP.rglob("*"))
    return [str(path) for path in found if path.parts[0] not in {"build", "logs", ".git"}]


def cited():
    """@return (label, heading, pattern of its definition) -> a place that cites it."""
    found = {}
    for name in files():
        path = TOP / name
        if path.suffix not in {".h", ".cpp", ".py", ".md", ".yaml", ".xml", ".cmake", ".txt", ".lcm", ".eds"}:
            continue
        text = path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
        text = re.sub(r"\n\s*(?:///?<?|#|;)\s*", " ", text)  # a citation may be broken over two lines
        for pattern, heading, definition in KINDS:
            for label in re.findall(pattern, text):
                found.setdefault((label, heading, definition.format(label=label)), name)
    return found


def below(heading, text):
    """What stands below a heading of the second level; all of it for none."""
    found = re.search(rf"^## {re.escape(heading)}.*?(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    return found.group(0) if heading and found else "" if heading else text


def main():
    sources = (TOP / "docs/sources.md").read_text(encoding="utf-8")
    places = cited()
    missing = [
        f"{name} cites {label}: docs/sources.md has no such source"
        for (label, heading, definition), name in places.items()
        if not re.search(definition, below(heading, sources), re.MULTILINE)
    ]
    print("\n".join(missing) if missing else f"{len(places)} sources cited, all there")
    return 1 if missing or len(places) < 30 else 0


if __name__ == "__main__":
    sys.exit(main())
