#!/usr/bin/env python3
"""The check of what docs name, against small trees: each kind of name that leads nowhere must be found."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import docs_names

WHO = "# Page\n\nFor whoever reads.\n\n"
SOURCES = WHO + "## E. Errata\n| E6 | inertia |\n## Physics\n1. Friction.\n"
QUESTION = WHO + "| The law | [a.h](../model/a.h) | `f = 1` | [E6](sources.md#e-errata) |\n"
LAW = "// errata E6, docs/sources.md\nf = 1\n"


TABLE = WHO + "What.\n`sprung bench`, 1a2b3c4, 2026-11-22.\n\n| what | Nm |\n|---|---|\n| knee | 3 |\n"


def wrong(pages, questions=QUESTION, law=LAW, measured=TABLE):
    files = {"docs/sources.md": SOURCES, "docs/where.md": questions, "model/a.h": law}
    files |= {"docs/measured.md": measured, **pages}
    with tempfile.TemporaryDirectory() as folder:
        top = pathlib.Path(folder).resolve()
        for path, content in files.items():
            (top / path).parent.mkdir(parents=True, exist_ok=True)
            (top / path).write_text(content, encoding="utf-8")
        return docs_names.check(top)


class DocsNames(unittest.TestCase):
    def setUp(self):
        docs_names.LEAST_QUESTIONS = 1

    def test_what_is_there_passes(self):
        text = "[a](docs/sources.md#e-errata), `model/a.h`, model/{a,a}.h, model/a, a.h, `model/NAME.h`\n"
        self.assertEqual(wrong({"README.md": text}), [])

    def test_names_that_lead_nowhere(self):
        for text in ("[a](docs/b.md)", "[a](docs/sources.md#none)", "`model/b.h`", "model/{a,b}.h",
                     "see b_test.cpp", "`tools/none/`", "model/*.cpp"):
            self.assertTrue(wrong({"README.md": text + "\n"}), text)

    def test_questions(self):
        self.assertEqual(wrong({}), [])
        self.assertEqual(len(wrong({}, law="// errata E6, docs/sources.md\nf = 2\n")), 1)  # symbol gone
        self.assertEqual(len(wrong({}, law="// docs/sources.md\nf = 1\n")), 1)  # file cites nothing
        self.assertEqual(len(wrong({}, QUESTION.replace("#e-errata", "#physics"))), 1)  # label elsewhere
        self.assertTrue(wrong({}, QUESTION.replace("a.h)", "b.h)")))  # file gone
        self.assertEqual(len(wrong({}, WHO + "nothing\n")), 1)  # too few

    def test_a_page_says_who_should_read_it(self):
        self.assertEqual(len(wrong({"docs/a.md": "# A\n\nText.\n"})), 1)
        self.assertEqual(wrong({"docs/a.md": "# A\n\nFor whoever asks.\n"}), [])

    def test_measurements(self):
        self.assertEqual(len(wrong({}, measured=TABLE.replace(", 1a2b3c4", ""))), 1)
        self.assertEqual(len(wrong({}, measured=TABLE.replace(", 2026-11-22", ""))), 1)
        row = WHO + "Times.\n\n| what | version |\n|---|---|\n| `sprung bench` | 1a2b3c4, 2026-11-22 |\n"
        self.assertEqual(wrong({}, measured=row), [])
        self.assertEqual(len(wrong({}, measured=row + "| `sprung bench log` | 2026-11-22 |\n")), 1)


if __name__ == "__main__":
    unittest.main()
