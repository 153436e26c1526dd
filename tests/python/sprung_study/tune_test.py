"""What is written of the best."""
import unittest

from sprung_study import tune


class FragmentTest(unittest.TestCase):
    def test_the_fragment_nests_numbers_with_their_units(self):
        study = {"parameters": [{"path": "presets.best.a.z", "unit": "N/m"},
                                {"path": "presets.best.b", "unit": ""}]}
        self.assertEqual(tune.fragment(study, {"presets.best.a.z": 3500.0, "presets.best.b": 0.5}),
                         "presets:\n  best:\n    a:\n      z: 3500 N/m\n    b: 0.5\n")

    def test_an_item_of_a_list_is_no_key_of_the_fragment(self):
        study = {"parameters": [{"path": "presets.best.lengths.4", "unit": "m"}]}
        self.assertEqual(tune.fragment(study, {"presets.best.lengths.4": 0.5}), "# presets.best.lengths.4: 0.5 m\n")


if __name__ == "__main__":
    unittest.main()
