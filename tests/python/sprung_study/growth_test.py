"""Arrivals that can be counted by hand."""
import pathlib
import tempfile
import unittest

from sprung_study import growth


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

    def test_a_line_that_was_cut_short_is_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "times.jsonl").write_text('{"run":1,"wall_s":0.5}\n{"run":2,"wa')
            self.assertEqual(growth.service_times(folder), [0.5])


if __name__ == "__main__":
    unittest.main()
