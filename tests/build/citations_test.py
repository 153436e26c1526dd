#!/usr/bin/env python3
"""The citation check against small trees: each dangling citation must fail, in each kind of file."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import citations

SOURCES = """# Sources
### A5. Its equations
| S0 (7) | spring |
### C2. A plant
| D7 | teeth |
| goal 4 | a fit |
## E. Errata
| E6 | inertia |
| E8 | reported torques |
## Physics
1. Friction sticks.
2. Another.
3. A contact.
## CANopen
| 2 | CiA 402 |
| 2.1 | control word |
| 2.2 | status word |
| 2.3 | modes |
## LCM
| L7 | count |
| L13b | tail |
## Design
| 8 | faults |
"""


def wrong(name, text):
    """What the check says of a tree of docs/sources.md and one file."""
    with tempfile.TemporaryDirectory() as folder:
        top = pathlib.Path(folder)
        for path, content in {"docs/sources.md": SOURCES, name: text}.items():
            (top / path).parent.mkdir(parents=True, exist_ok=True)
            (top / path).write_text(content, encoding="utf-8")
        return citations.check(top)[0]


def labels(name, text):
    return [label for label, line in citations.cited_in(name, text)[0]]


class Dangling(unittest.TestCase):
    def test_fails_in_each_kind_of_file(self):
        for name in ("a.h", "a.cpp", "a.js"):
            self.assertEqual(len(wrong(name, "int x;  // facts C3\n")), 1, name)
        for name in ("a.py", "a.sh", "a.yaml", "a.csv", "a.txt", "a.cmake", "a.md"):
            self.assertEqual(len(wrong(name, "# facts C3\n")), 1, name)
        self.assertEqual(len(wrong("a.xml", "<!-- facts C3 -->")), 1)
        self.assertEqual(len(wrong("a.lcm", "double x;  // facts C3\n")), 1)
        self.assertEqual(len(wrong("a.eds", "; [2.9] a word\n")), 1)
        self.assertEqual(len(wrong("run", "#!/bin/bash\n# facts C3\n")), 1)

    def test_each_form(self):
        dangling = """facts C3 | Facts papers C3 | errata E7 | Errata E6, E7 | facts E6 and E7 |
            facts L8 | facts canopen 2.4 | facts canopen section 3 | facts canopen 2.1-2.4 | facts physics 4 |
            facts physics 2-4 | design section 9 | S0 (8) | S1 (7) | S0 eq. 8 | facts goal 5 | [E7] |
            [D7, D8] | (E7) | as E7 says | C3's mass | [P] 4 | the papers' equation (8)""".split("|") + ["facts\n/// C3"]
        for text in dangling:
            self.assertEqual(len(wrong("a.h", f"/// {text.strip()}: why\n")), 1, text)

    def test_what_cannot_be_read_fails(self):
        for text in ("the facts say so", "facts/papers", "see physics.md", "facts 2.5", "errata of it"):
            self.assertTrue(wrong("a.h", f"/// {text}.\n"), text)

    def test_a_whole_section_is_no_row_of_its_part(self):
        self.assertEqual(wrong("a.h", "/// facts canopen 2\n"), [])
        self.assertEqual(len(wrong("a.h", "/// facts canopen 2.6\n")), 1)

    def test_a_header_of_the_cores_names_the_page(self):
        self.assertEqual(len(wrong("model/a.h", "/// facts C2\n")), 1)
        self.assertEqual(wrong("model/a.h", "/// docs/sources.md, facts C2\n"), [])

    def test_the_page_itself(self):
        self.assertEqual(len(wrong("docs/sources.md", SOURCES + "as E7 says, errata of it\n")), 1)

    def test_file_and_line_are_named(self):
        self.assertTrue(wrong("a.h", "int x;\n\n/// facts C3\n")[0].startswith("a.h:3 "))


class Good(unittest.TestCase):
    def test_passes(self):
        good = """facts C2, D7 | facts papers D7 and C2 | errata E6, E8 | facts canopen 2.1-2.3 |
            S0 (7) | facts canopen 2.1, canopen 2.3 | facts physics 1, 3 | facts physics 3: 0.1 is soft |
            facts C2, 29.7 Nm | design section 8 | facts L13b: the end | facts goal 4 | facts A5 |
            facts canopen 2.2, 4 bits"""
        for text in good.split("|"):
            self.assertEqual(wrong("a.h", f"/// {text}\n"), [], text)

    def test_code_is_no_citation(self):
        code = "InterfaceFacts facts;\nuse(facts, 1);\nint at = 1'000;  // it's facts C2\n"
        self.assertEqual(wrong("a.cpp", code), [])
        self.assertEqual(labels("a.cpp", code), [("papers", "C2")])

    def test_strings_are_read(self):
        code = 'const char* a = "S1 as facts papers "\n    "C2 reads it";\n'
        self.assertEqual(labels("a.cpp", code), [("papers", "C2")])

    def test_ranges_are_read_as_a_whole(self):
        cited = labels("a.h", "// facts canopen 2.1 to 2.3\n")
        self.assertEqual([label for book, label in cited], ["2.1", "2.2", "2.3"])
        cited = labels("a.h", "// by S0 (10) to (12) with errata E1\n")
        self.assertEqual([label for book, label in cited], ["10", "11", "12", "E1"])


if __name__ == "__main__":
    unittest.main()
