"""The Python part of studies without any package: its logic, and the contract against a worker of lines."""
import json
import os
import pathlib
import stat
import tempfile
import unittest
from unittest import mock

from sprung_study import contract, growth, slurm_engine, tune


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


class SlurmTest(unittest.TestCase):
    def test_chunks_grow_with_the_study_so_that_the_array_is_not_too_long(self):
        self.assertEqual(slurm_engine.chunk_size(1000, 50), 50)
        self.assertEqual(slurm_engine.chunk_size(1_000_000, 50), 1000)

    def test_only_chunks_with_a_run_to_do_are_asked_for(self):
        self.assertEqual(slurm_engine.array_of([1, 2, 50, 51, 200], 50), "0,1,3")

    def test_the_last_chunk_ends_with_the_study(self):
        with FakeProgram():
            text = slurm_engine.script("/s.yaml", "/out", 50, 120)
        self.assertIn("last=120", text)
        self.assertIn("--runs $first..$last", text)


class GrowthTest(unittest.TestCase):
    def test_one_worker_does_all_after_another(self):
        self.assertAlmostEqual(growth.makespan([1.0] * 10, 1, 0.0, 0.0), 10.0)

    def test_many_workers_share_and_wait_for_the_driver(self):
        self.assertAlmostEqual(growth.makespan([1.0] * 10, 10, 0.0, 0.0), 1.0)
        self.assertAlmostEqual(growth.makespan([1.0] * 100, 100, 0.1, 0.0), 11.0)

    def test_workers_that_start_late_cost_their_start(self):
        self.assertAlmostEqual(growth.makespan([1.0] * 4, 2, 0.0, 5.0), 7.0)

    def test_the_driver_saturates_at_service_over_dispatch(self):
        few, many = growth.makespan([1.0] * 1000, 8, 0.1, 0.0), growth.makespan([1.0] * 1000, 64, 0.1, 0.0)
        self.assertGreater(few / many, 1.2)
        self.assertGreaterEqual(many, 100.0)


GOAL = {"name": "g", "want": "least", "over": "worst",
        "of": [{"row": "a", "weight": 2.0, "above": -1.7976931348623157e308, "unreached": 50.0},
               {"row": "h", "weight": 1.0, "about": 10.0, "above": 1.0, "unreached": 9.0}]}


def row(a, h):
    return {"rows": [{"name": "a", "value": a}, {"name": "h", "value": h}]}


class TuneTest(unittest.TestCase):
    def test_cost_counts_weights_distances_and_what_was_not_reached(self):
        self.assertEqual(tune.plant_cost(GOAL, row(3.0, 10.5)), 6.0)
        self.assertEqual(tune.plant_cost(GOAL, row(3.0, 7.0)), 8.0)
        self.assertEqual(tune.plant_cost(GOAL, row(None, None)), 59.0)
        self.assertEqual(tune.plant_cost(GOAL, {"rows": []}), 59.0)

    def test_worst_is_the_most_of_what_is_to_be_least_and_the_reverse(self):
        rows = [row(1.0, 10.0), row(4.0, 10.0)]
        self.assertEqual(tune.goal_value(GOAL, rows), 8.0)
        self.assertEqual(tune.goal_value({**GOAL, "want": "most"}, rows), 2.0)
        self.assertEqual(tune.goal_value({**GOAL, "over": "mean"}, rows), 5.0)

    def test_a_search_begins_with_the_robots_own_numbers_then_evenly(self):
        study = {"parameters": [{"path": "a", "from": 1.0, "to": 100.0, "present": 7.0, "logarithmic": True},
                                {"path": "b", "from": 0.0, "to": 1.0, "present": 0.25, "logarithmic": False}],
                 "tuning": {"seed": 0}}
        sets = tune.first_sets(study, 50)
        self.assertEqual(len(sets), 50)
        self.assertEqual(sets[0], {"a": 7.0, "b": 0.25})
        self.assertEqual(sets[1], {"a": 10.0, "b": 0.5})
        for low in (0.0, 0.25, 0.5, 0.75):
            self.assertGreaterEqual(sum(low <= one["b"] < low + 0.25 for one in sets[1:]), 10)
        study["tuning"]["seed"] = 1
        self.assertNotIn(tune.first_sets(study, 50)[1], sets)

    def test_own_numbers_beyond_the_range_are_asked_for_within_it_alone(self):
        study = {"parameters": [{"path": "a", "from": 1.0, "to": 2.0, "present": 7.0, "logarithmic": False}],
                 "tuning": {"seed": 0}}
        self.assertEqual(tune.first_sets(study, 3)[0], {})

    def test_numbers_have_four_digits_and_the_fragment_nests_them_with_units(self):
        self.assertEqual(tune.four_digits(1234.5678), 1235.0)
        study = {"parameters": [{"path": "presets.best.a.z", "unit": "N/m"}, {"path": "presets.best.b", "unit": ""}]}
        self.assertEqual(tune.fragment(study, {"presets.best.a.z": 3500.0, "presets.best.b": 0.5}),
                         "presets:\n  best:\n    a:\n      z: 3500 N/m\n    b: 0.5\n")

    def test_an_item_of_a_list_is_no_key_of_the_fragment(self):
        study = {"parameters": [{"path": "presets.best.lengths.4", "unit": "m"}]}
        self.assertEqual(tune.fragment(study, {"presets.best.lengths.4": 0.5}), "# presets.best.lengths.4: 0.5 m\n")


if __name__ == "__main__":
    unittest.main()
