#!/usr/bin/env python3
"""The check of modules of others, against a small folder: what was changed, is missing or unnamed is told."""

import pathlib
import sys
import tempfile
import unittest
from hashlib import sha256

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import third_party


def faults(files, sums):
    with tempfile.TemporaryDirectory() as folder:
        top = pathlib.Path(folder)
        for path, content in files.items():
            (top / path).parent.mkdir(parents=True, exist_ok=True)
            (top / path).write_text(content)
        lines = (f"{sha256(content.encode()).hexdigest()}  {path}\n" for path, content in sums.items())
        (top / "SHA256SUMS").write_text("".join(lines))
        return third_party.faults_of(top)


class ThirdParty(unittest.TestCase):
    def test_what_is_as_it_came_is_fine_and_licences_need_no_sum(self):
        self.assertEqual(faults({"x/a.js": "1", "x/LICENSE": "MIT", "README.md": ""}, {"x/a.js": "1"}), [])

    def test_what_was_changed_is_told(self):
        self.assertIn("differs", faults({"x/a.js": "2"}, {"x/a.js": "1"})[0])

    def test_what_is_missing_is_told(self):
        self.assertEqual(faults({}, {"x/a.js": "1"}), ["x/a.js is missing"])

    def test_what_nobody_names_is_told(self):
        self.assertEqual(faults({"x/b.js": "1"}, {}), ["x/b.js is not in SHA256SUMS"])


if __name__ == "__main__":
    unittest.main()
