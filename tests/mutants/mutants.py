"""What tests/mutants/list says, and the sources with a switch for each mutant in them.

  file drivers/bridge/command_gate.cpp   whose mutants follow
  campaign message field                 classes of faults that could tell, on single_leg; `any`
  campaign message field on pegasus      where it does not tell, on pegasus too
  campaign none: WHY                     none can
  NAME: what it switches off
  - what stands in the file; «this part» of it alone is replaced, where it is marked
  + what the mutant has instead; nothing: the statement is left out
  alive: why no unit test can tell
  unseen: why the campaign does not tell

Lines of one kind that follow one another are one text, and white space is any white space. A text that ends in ; or }
is statements, any other an expression. One may lie within another. A `campaign` is that of all that follow it.
"""

import dataclasses
import pathlib
import re
import zlib

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
INCLUDE = '#include "tests/mutants/switch.h"\n'
SWITCH = """#pragma once
/// Made by tests/mutants/run: whether this mutant is the one that is switched on.
#include <cstdlib>

inline bool sprung_mutant(long number) noexcept {
  static const long on = [] {
    const char* text = std::getenv("SPRUNG_MUTANT");
    return text != nullptr ? std::atol(text) : -1L;
  }();
  return number == on;
}
"""
FIELDS = {"- ": "before", "+ ": "after", "alive: ": "alive", "unseen: ": "unseen"}


@dataclasses.dataclass
class Mutant:
    name: str
    what: str
    file: str
    campaign: list
    before: str = ""
    after: str = ""
    alive: str = ""
    unseen: str = ""
    robots: tuple = ()

    @property
    def number(self):
        return zlib.crc32(self.name.encode()) & 0x7FFFFFFF


class WrongList(Exception):
    pass


def parsed(text):
    """The mutants of one file of the list."""
    found, file, campaign, unseen, robots = [], None, [], "", ()
    for number, line in enumerate(text.splitlines(), 1):
        line = line + " " if line in ("+", "-") else line
        field = next((name for mark, name in FIELDS.items() if line.startswith(mark)), None)
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("file "):
            file, campaign, unseen, robots = line[5:].strip(), ["any"], "", ("single_leg",)
        elif line.startswith("campaign none: "):
            campaign, unseen, robots = [], line[15:].strip(), ()
        elif line.startswith("campaign "):
            classes, _, second = line[9:].partition(" on ")
            campaign, unseen, robots = classes.split(), "", ("single_leg", *second.split())
        elif field:
            mutant = found[-1]
            setattr(mutant, field, (getattr(mutant, field) + "\n" + line.split(" ", 1)[1].strip()).strip())
        elif re.match(r"\w+: ", line) and file:
            name, what = line.split(": ", 1)
            found.append(Mutant(name, what, file, campaign, unseen=unseen, robots=robots))
        else:
            raise WrongList(f"line {number} is nothing that the list knows: {line}")
    return found


def listed(folder=HERE / "list"):
    found = [mutant for path in sorted(folder.glob("*.txt")) for mutant in parsed(path.read_text("utf-8"))]
    for key in ("name", "number"):
        values = [getattr(mutant, key) for mutant in found]
        twice = sorted({mutant.name for mutant in found if values.count(getattr(mutant, key)) > 1})
        if twice:
            raise WrongList(f"two mutants have one {key}: {', '.join(twice)}")
    return found


def spaced(text):
    return r"\s+".join(re.escape(word) for word in text.split())


def place(mutant, source):
    """@return (begin, end) of what it replaces. @throws WrongList unless that stands there once."""
    marked = re.fullmatch(r"(.*)«(.*)»(.*)", mutant.before, re.DOTALL)
    parts = marked.groups() if marked else ("", mutant.before, "")
    pattern = r"\s*".join(f"({spaced(part)})" for part in parts)
    found = list(re.finditer(pattern, source)) if mutant.before else []
    if len(found) != 1:
        raise WrongList(f"{mutant.file}: {mutant.name}: found {len(found)} times, expected once: {mutant.before}")
    return found[0].span(2)


def switched(mutant, original):
    on = f"sprung_mutant({mutant.number})"
    if original.rstrip()[-1] in ";}":
        return f"{{ if ({on}) {{ {mutant.after} }} else {{ {original} }} }}"
    return f"({on} ? ({mutant.after}) : ({original}))"


def with_switches(source, mutants):
    """@throws WrongList where two overlap and neither lies within the other."""
    widest_last = sorted(mutants, key=lambda m: (lambda p: (p[1] - p[0], m.name))(place(m, source)))
    done = []  # (begin, end, text) that stand for themselves
    for mutant in widest_last:
        begin, end = place(mutant, source)
        inner = [one for one in done if begin <= one[0] and one[1] <= end]
        outer = [one for one in done if one not in inner]
        if any(one[0] < end and begin < one[1] for one in outer):
            raise WrongList(f"{mutant.file}: {mutant.name} overlaps another")
        text = pieced(source, begin, end, inner)
        done = [*outer, (begin, end, switched(mutant, text))]
    body = pieced(source, 0, len(source), done)
    once = "#pragma once\n"
    return body.replace(once, once + INCLUDE, 1) if once in body else INCLUDE + body


def pieced(source, begin, end, replaced):
    out = []
    for first, last, text in sorted(replaced):
        out += [source[begin:first], text]
        begin = last
    return "".join(out) + source[begin:end]
