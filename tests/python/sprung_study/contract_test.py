"""The contract from Python, against a worker of lines."""
import json
import os
import pathlib
import stat
import tempfile
import unittest
from unittest import mock

from sprung_study import contract


class FakeProgram:
    """`sprung study worker` as a script: answers, waits for ever at run 2, dies at run 3."""

    SCRIPT = """#!/bin/sh
while read -r line; do
  case $line in *'"run": 2'*|*'"run":2'*) exec sleep 600 ;; *'"run": 3'*|*'"run":3'*) kill -9 $$ ;; esac
  echo '{"run":1,"row":{}}'
done
"""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        path = pathlib.Path(self.folder.name) / "sprung"
        path.write_text(self.SCRIPT)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        self.patch = mock.patch.dict(os.environ, {"SPRUNG": str(path)})
        self.patch.start()
        return self

    def __exit__(self, *_):
        self.patch.stop()
        self.folder.cleanup()


class WorkerTest(unittest.TestCase):
    def test_answers_and_is_kept(self):
        with FakeProgram():
            worker = contract.Worker(60.0)
            self.assertEqual(worker.ask('{"run":1}'), '{"run":1,"row":{}}')
            first = worker._process.pid
            worker.ask('{"run":1}')
            self.assertEqual(worker._process.pid, first)
            worker.close()

    def test_a_run_that_hangs_is_an_answer_without_a_row_and_the_next_goes_on(self):
        with FakeProgram():
            worker = contract.Worker(0.3)
            answer = json.loads(worker.ask('{"run":2}'))
            self.assertEqual(answer["run"], 2)
            self.assertIn("longer than 0.3 s", answer["error"])
            worker.timeout_s = 60.0
            self.assertEqual(worker.ask('{"run":1}'), '{"run":1,"row":{}}')
            worker.close()

    def test_a_worker_that_dies_is_an_error_for_the_engine_to_retry(self):
        with FakeProgram():
            worker = contract.Worker(60.0)
            with self.assertRaisesRegex(RuntimeError, "in the middle of run 3"):
                worker.ask('{"run":3}')
            self.assertEqual(worker.ask('{"run":1}'), '{"run":1,"row":{}}')
            worker.close()

    def test_a_run_that_ends_every_worker_is_an_error_after_ten_tries(self):
        with FakeProgram():
            worker = contract.Worker(60.0)
            answer = json.loads(worker.answer('{"run":3}'))
            self.assertEqual(answer["run"], 3)
            self.assertIn("10 times", answer["error"])
            self.assertEqual(worker.answer('{"run":1}'), '{"run":1,"row":{}}')
            worker.close()

    def test_a_program_that_there_is_not_is_said(self):
        with mock.patch.dict(os.environ, {"SPRUNG": "", "PATH": ""}), mock.patch("pathlib.Path.exists", lambda _: False):
            with self.assertRaisesRegex(RuntimeError, "SPRUNG="):
                contract.program()


if __name__ == "__main__":
    unittest.main()
