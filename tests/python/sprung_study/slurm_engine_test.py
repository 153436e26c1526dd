"""What is handed to Slurm."""
import os
import unittest
from unittest import mock

from sprung_study import slurm_engine


class SlurmTest(unittest.TestCase):
    def test_chunks_grow_with_the_study_so_that_the_array_is_not_too_long(self):
        self.assertEqual(slurm_engine.chunk_size(1000, 50), 50)
        self.assertEqual(slurm_engine.chunk_size(1_000_000, 50), 1000)

    def test_only_chunks_with_a_run_to_do_are_asked_for(self):
        self.assertEqual(slurm_engine.array_of([1, 2, 50, 51, 200], 50), "0,1,3")

    def test_the_last_chunk_ends_with_the_study(self):
        with mock.patch.dict(os.environ, {"SPRUNG": "/opt/my sprung"}):
            text = slurm_engine.script("/s.yaml", "/out", 50, 120)
        self.assertIn("last=120", text)
        self.assertIn("exec '/opt/my sprung' study run", text)
        self.assertIn("--runs $first..$last", text)


if __name__ == "__main__":
    unittest.main()
