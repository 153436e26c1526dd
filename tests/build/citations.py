#!/usr/bin/env python3
"""Every source that a comment, a string or a document cites stands in docs/sources.md, whose head says how
labels look. usage: citations.py SOURCE_DIR

Whatever says "facts" or "errata" and is not followed by a label fails, and so does the name of a page that is
not in the repository: a citation that this file cannot read would be one that nobody checks.
"""

import pathlib
import re
import subprocess
import sys

# Different labels cited today; lower it where the last citation of one went with what it described.
LEAST = 102
SUFFIXES = set(".h .cpp .py .sh .md .yaml .xml .cmake .txt .lcm .eds .csv .js .css .html .in".split())
ROOMS = {"model", "estimator", "controller"}  # a header that holds an equation says once where sources stand
SOURCES = "docs/sources.md"  # its own labels must stand there too; what else it says of errata is no citation
OWN = {"tests/build/citations.py", "tests/build/citations_test.py", "tests/build/docs_names_test.py"}
CPP_TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"\((.*?)\)"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'',
    re.DOTALL,
)
LEADER = re.compile(r"^([ \t]*)(///?<?|\*|#|;|<!--)", re.MULTILINE)

# What opens a citation, and which labels may follow it there.
OPENS = re.compile(
    r"(?<![\w-])((?:facts|errata|erratum|design sections?)\b|\[P\]|papers' equations?(?= \(?\d)"
    r"|S[01](?:'s)?(?= (?:(?:eq\.|equations?) \(?\d|\(\d)))",
    re.IGNORECASE,
)
NOT_HERE = re.compile(
    r"\b(?:facts/\w+|(?:papers|physics|canopen|lcm|plant|ground|drives|hazards|peers|vm|design|house)\.md)\b"
)
BOOK = re.compile(r"\s*(papers|canopen|physics|goal)\s+(?:sections?\s+)?", re.I)
PAPER_LABEL = re.compile(r"\s*([A-E]\d{1,2}|L\d+b?)\b")
NUMBER = re.compile(r"\s*(\d+)\b(?!\.\d)")
DOTTED = re.compile(r"\s*(\d\.\d)\b")
EQUATION = re.compile(r"\s*(?:eq\.|equations?)?\s*\(?(\d+)\)?")
EQUATION_NEXT = re.compile(r"\s*\((\d+)\)")
NEXT = re.compile(r"\s*(,|and\b|or\b|to\b|-)")
ENDS = re.compile(r"\s*(?:\Z|[).;:\],]|-\d|and\b|to\b)")
SHORT = re.compile(
    r"\[[A-E]\d{1,2}(?:\s*,\s*[A-E]\d{1,2})*\](?!\()|\([B-E]\d{1,2}(?=[),:;])|\b(?:E\d{1,2}|[A-D][1-9]\d?)\b"
)
SHORT_CANOPEN = {".eds": re.compile(r"\[(\d(?:\.\d)?)\]"), ".yaml": re.compile(r"\[(\d\.\d)\]")}
HEADINGS = {"canopen": "CANopen", "physics": "Physics", "design": "Design"}


def files(top):
    """Those that are kept; where this is no clone, all but what was built."""
    listed = subprocess.run(
        ["git", "-C", str(top), "ls-files", "-z"], check=False, capture_output=True, text=True
    )
    if listed.returncode == 0 and (top / ".git").exists():
        return [name for name in listed.stdout.split("\0") if name]
    found = (path.relative_to(top) for path in top.rglob("*") if path.is_file())
    return [str(path) for path in found if path.parts[0] not in {"build", "logs", ".git"}]


def blank(text):
    return re.sub(r"[^\s]", " ", text)


def words_of_cpp(text):
    """Comments and strings where they stand; code becomes a mark that no citation goes across."""
    kept, at = [], 0
    for token in CPP_TOKEN.finditer(text):
        kept.append(re.sub(r"\S", "\1", text[at : token.start()]))
        kept.append(token.group(0).replace('"', " "))
        at = token.end()
    kept.append(re.sub(r"\S", "\1", text[at:]))
    return "".join(kept)


def words(name, text):
    """What may cite: all of a file, of C++ comments and strings. Lines stay where they are."""
    if name.endswith((".h", ".cpp", ".js", ".css")):
        text = words_of_cpp(text)
    return LEADER.sub(lambda found: found.group(1) + blank(found.group(2)), text)


def label_at(book, text, at, first):
    """@return (label, where it ends), or nothing where none begins. @param first of a citation."""
    if book == "papers":
        found = PAPER_LABEL.match(text, at)
    elif book == "canopen":
        found = DOTTED.match(text, at) or NUMBER.match(text, at)
    elif book in ("S0", "S1"):
        found = (EQUATION if first else EQUATION_NEXT).match(text, at)
    else:
        found = NUMBER.match(text, at)
    return (found.group(1), found.end()) if found else None


def between(first, last):
    """Labels after `first` up to `last`: of 2.1 to 2.3, C1 to C3 or 1 to 4."""
    stem, low = re.fullmatch(r"(.*?)(\d+)", first).groups()
    high = re.fullmatch(r".*?(\d+)", last).group(1)
    return [f"{stem}{number}" for number in range(int(low) + 1, int(high) + 1)]


def book_of(opening):
    opening = opening.lower()
    if opening.startswith("design"):
        return "design"
    if opening == "[p]":
        return "physics"
    if opening.startswith(("s0", "s1", "papers'")):
        return "S1" if opening.startswith("s1") else "S0"
    return "papers"


def labels_after(opening, text, at):
    """@return the (book, label) after what opens a citation, none where none is readable; and their end."""
    book, found, joint, end = book_of(opening), [], ",", at
    while True:
        named = BOOK.match(text, at)
        if named and opening.lower() == "facts":
            book, at = named.group(1).lower(), named.end()
        here = label_at(book, text, at, not found)
        bare = here and here[0].isdigit() and found and book not in ("S0", "S1")
        if not here or (bare and not named and not ENDS.match(text, here[1])):
            return found, end
        if joint in ("to", "-") and found:
            found += [(book, label) for label in between(found[-1][1], here[0])]
        else:
            found.append((book, here[0]))
        end = here[1]
        more = NEXT.match(text, end)
        if not more:
            return found, end
        joint, at = more.group(1), more.end()


def at_lines(found, text):
    """Offsets in the text -> lines, in their order."""
    return [(what, text.count("\n", 0, at) + 1) for what, at in sorted(found, key=lambda it: it[1])]


def cited_in(name, text):
    """@return ((book, label), line) of each citation, and (what cannot be read, line)."""
    text, found, unclear = words(name, text), [], []
    for opening in reversed(list(OPENS.finditer(text))):
        labels, end = labels_after(opening.group(1), text, opening.end())
        found += [(label, opening.start()) for label in labels]
        if not labels:
            about = " ".join(text[opening.start() : opening.end() + 30].split())
            unclear.append((f'"{about}" is no citation that can be followed', opening.start()))
        text = text[: opening.start()] + blank(text[opening.start() : end]) + text[end:]
    for page in NOT_HERE.finditer(text):
        why = f"{page.group(0)} is not in the repository: cite docs/sources.md"
        unclear.append((why, page.start()))
    for short in SHORT.finditer(text):
        for label in re.findall(r"[A-E]\d+", short.group(0)):
            found.append((("papers", label), short.start()))
    canopen = SHORT_CANOPEN.get(pathlib.Path(name).suffix)
    if canopen:
        found += [(("canopen", short.group(1)), short.start()) for short in canopen.finditer(text)]
    return at_lines(found, text), at_lines(unclear, text)


def below(heading, text):
    """What stands below a heading of the second level; all of it for none."""
    found = re.search(rf"^## {re.escape(heading)}.*?(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    return found.group(0) if heading and found else "" if heading else text


def stands(book, label, sources):
    """Whether docs/sources.md has it, as a row or a heading."""
    if book == "physics":
        pattern = rf"^{re.escape(label)}\. "
    elif book in ("S0", "S1"):
        pattern = rf"^\| {book} \({label}\) \|"
    elif book == "goal":
        pattern = rf"^\| goal {label} \|"
    else:
        pattern = rf"^(?:### {re.escape(label)}\.|\| {re.escape(label)} \|)"
    return re.search(pattern, below(HEADINGS.get(book, ""), sources), re.MULTILINE) is not None


def check(top):
    """@return what is wrong, and the labels cited with the number of places."""
    sources = (top / SOURCES).read_text(encoding="utf-8")
    wrong, labels = [], {}
    for name in files(top):
        path = top / name
        if name in OWN or not path.is_file() or path.suffix not in SUFFIXES | {""}:
            continue
        text = path.read_text(encoding="utf-8", errors="replace")
        if not path.suffix and not text.startswith("#!"):
            continue
        found, unclear = cited_in(name, text)
        if found and name.endswith(".h") and name.split("/")[0] in ROOMS and "docs/sources.md" not in text:
            wrong.append(f"{name} cites, and does not say that its sources stand in docs/sources.md")
        wrong += [f"{name}:{line}: {what}" for what, line in unclear if name != SOURCES]
        for (book, label), line in found:
            if name != SOURCES:
                labels[book, label] = labels.get((book, label), 0) + 1
            if not stands(book, label, sources):
                shown = label if book == "papers" else f"{book} {label}"
                wrong.append(f"{name}:{line} cites {shown}: docs/sources.md has no such source")
    return wrong, labels


def main():
    top = pathlib.Path(sys.argv[1])
    wrong, labels = check(top)
    print(*wrong, sep="\n", end="\n" if wrong else "")
    print(f"{len(labels)} sources cited in {sum(labels.values())} places{', all there' if not wrong else ''}")
    if len(labels) < LEAST:
        print(f"that is less than {LEAST}: does citations.py still see all? If so, lower LEAST there")
    return 1 if wrong or len(labels) < LEAST else 0


if __name__ == "__main__":
    sys.exit(main())
