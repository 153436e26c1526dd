#!/usr/bin/env python3
"""README.md and docs name what is there: every link, every path, every file. docs/where.md answers its
questions in two links, docs/measured.md says of each figure how and when, and each page says first who should
read it. usage: docs_names.py SOURCE_DIR
"""

import glob
import pathlib
import re
import sys

import citations

LEAST_QUESTIONS = 10
TOP_FOLDERS = (
    "lcmtypes|signals|model|robots|runtime|drivers|estimator|controller|planner|simulation|tools|cmake|tests"
    "|docs|python|examples"
)
LINK = re.compile(r"\]\(([^)\s]+)\)")
PATH = re.compile(rf"(?<![\w./$-])((?:{TOP_FOLDERS})/[\w./{{}},*+-]*)")
FILE = re.compile(r"(?<![\w./*{{}}$-])([a-z][a-z0-9_]+\.(?:h|cpp|py|sh|cmake))\b")
CODE = re.compile(r"```.*?```", re.DOTALL)
ROW = re.compile(r"^\| (.+?) \| \[.*?\]\((.+?)\) \| `(.+?)` \| (.+?) \|$", re.MULTILINE)
MEASURED = re.compile(r"\b[0-9a-f]{7,40}, \d{4}-\d\d-\d\d\b")
# Files that a text makes up to show how one adds them.
EXAMPLES = {"acme_profile.h", "acme_profile.cpp", "acme_device.h", "acme_device.cpp"}


def pages(top):
    found = [name for name in citations.files(top) if name.endswith(".md")]
    return [name for name in found if name in ("README.md", "lcmtypes/README.md") or name.startswith("docs/")]


def slug(heading):
    """As the web pages of a repository make an anchor of a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def sections(text):
    """Anchor of each heading -> what stands below it, down to the next of its level."""
    found = {}
    plain = CODE.sub(lambda code: re.sub(r"[^\n]", " ", code.group(0)), text)
    for heading in re.finditer(r"^(#+) (.+)$", plain, re.MULTILINE):
        end = re.search(rf"^#{{1,{len(heading.group(1))}}} ", plain[heading.end() :], re.MULTILINE)
        found[slug(heading.group(2))] = text[heading.start() : heading.end() + end.start() if end else None]
    return found


def alternatives(path):
    """a/{b,c}.h -> a/b.h and a/c.h."""
    braces = re.search(r"\{([^{}]*)\}", path)
    if not braces:
        return [path]
    made = [path[: braces.start()] + word + path[braces.end() :] for word in braces.group(1).split(",")]
    return [each for one in made for each in alternatives(one)]


def is_there(top, path):
    """A path, or without its ending a header; a word in capitals stands for any name."""
    if not path.endswith("README.md"):
        path = re.sub(r"\b[A-Z]{3,}(?=[._/]|$)", "*", path)
    return bool(glob.glob(str(top / path)) or glob.glob(str(top / (path.rstrip("/") + ".h"))))


def wrong_links(top, name, text):
    for target in LINK.findall(CODE.sub("", text)):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (top / name).parent / path if path else top / name
        if not file.exists():
            yield f"{name} links to {target}: no such file"
        elif anchor and anchor not in sections(file.read_text(encoding="utf-8")):
            yield f"{name} links to {target}: no such heading"


def wrong_names(top, name, text):
    known = {pathlib.Path(file).name for file in citations.files(top)} | EXAMPLES
    for found in PATH.findall(text):
        path = found.rstrip(".,-")
        if path.count("{") == path.count("}"):
            for one in alternatives(path):
                if not is_there(top, one):
                    yield f"{name} names {one}: no such path"
    for file in FILE.findall(text):
        if file not in known:
            yield f"{name} names {file}: no such file"


def name_of(book, label):
    """As docs/where.md writes a label."""
    return f"{book} ({label})" if book in ("S0", "S1") else f"physics {label}" if book == "physics" else label


def wrong_answers(top):
    """Each question: its file holds what is said and cites the label, which stands where the link leads."""
    text = (top / "docs/where.md").read_text(encoding="utf-8")
    sources = sections((top / "docs/sources.md").read_text(encoding="utf-8"))
    questions = ROW.findall(text)
    for question, target, there, links in questions:
        file = (top / "docs" / target).resolve()
        if not file.is_file():
            yield f"{question}: {target} is no file"
            continue
        content = file.read_text(encoding="utf-8")
        if there not in content:
            yield f"{question}: `{there}` does not stand in {target}"
        cited = {name_of(*label) for label, _ in citations.cited_in(target, content)[0]}
        for label, anchor in re.findall(r"\[([^\]]+)\]\(sources\.md#([^)]+)\)", links):
            if label not in cited:
                yield f"{question}: {target} does not cite {label}"
            defined = label.removeprefix("physics ")
            word = re.escape(defined)
            pattern = rf"^(?:### {word}\.|\| {word} \||{word}\. )"
            if not re.search(pattern, sources.get(anchor, ""), re.MULTILINE):
                yield f"{question}: {label} stands not below docs/sources.md#{anchor}"
        if not re.search(r"\]\(sources\.md#", links):
            yield f"{question}: no source"
    if len(questions) < LEAST_QUESTIONS:
        yield f"docs/where.md has {len(questions)} questions, wanted {LEAST_QUESTIONS}"


def wrong_measurements(top):
    """Each table of docs/measured.md, or each of its rows, has a command, a version and a day."""
    text = (top / "docs/measured.md").read_text(encoding="utf-8")
    for table in re.finditer(r"^(.*)\n\n((?:\|.*\n)+)", text, re.MULTILINE):
        above, rows = table.group(1), table.group(2).splitlines()
        for row in [] if MEASURED.search(above) and "`" in above else rows[2:]:
            if not (MEASURED.search(row) and "`" in row):
                yield f"docs/measured.md: no command, version and day: {row[:60]}"


def check(top):
    wrong = []
    for name in pages(top):
        text = (top / name).read_text(encoding="utf-8")
        if name.startswith("docs/") and not re.match(r"# .+\n\nFor whoever ", text):
            wrong.append(f"{name} does not begin with who should read it: For whoever ...")
        wrong += [*wrong_links(top, name, text), *wrong_names(top, name, text)]
    return wrong + list(wrong_answers(top)) + list(wrong_measurements(top))


def main():
    top = pathlib.Path(sys.argv[1]).resolve()
    wrong = check(top)
    print(*wrong, sep="\n", end="\n" if wrong else "")
    if not wrong:
        print(f"{len(pages(top))} pages name what is there")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
