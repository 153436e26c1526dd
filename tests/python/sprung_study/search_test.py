"""What a set of numbers costs, without Optuna."""
import unittest

from sprung_study import search

GOAL = {"name": "g", "want": "least", "over": "worst",
        "of": [{"row": "a", "weight": 2.0, "unreached": 50.0},
               {"row": "h", "weight": 1.0, "about": 10.0, "above": 1.0, "unreached": 9.0}]}


def row(a, h):
    return {"rows": [{"name": "a", "value": a}, {"name": "h", "value": h}]}


class SearchTest(unittest.TestCase):
    def test_cost_counts_weights_distances_and_what_was_not_reached(self):
        self.assertEqual(search.plant_cost(GOAL, row(3.0, 10.5)), 6.0)
        self.assertEqual(search.plant_cost(GOAL, row(3.0, 7.0)), 8.0)
        self.assertEqual(search.plant_cost(GOAL, row(None, None)), 59.0)
        self.assertEqual(search.plant_cost(GOAL, {"rows": []}), 59.0)

    def test_worst_is_the_most_of_what_is_to_be_least_and_the_reverse(self):
        rows = [row(1.0, 10.0), row(4.0, 10.0)]
        self.assertEqual(search.goal_value(GOAL, rows), 8.0)
        self.assertEqual(search.goal_value({**GOAL, "want": "most"}, rows), 2.0)
        self.assertEqual(search.goal_value({**GOAL, "over": "mean"}, rows), 5.0)

    def test_numbers_are_tried_in_four_digits_and_within_their_ranges(self):
        study = {"parameters": [{"path": "a", "from": 1.0, "to": 4000.0}, {"path": "b", "from": 0.123456, "to": 0.123457}]}
        self.assertEqual(search.as_tried(study, {"a": 1234.5678, "b": 0.1234565}), {"a": 1235.0, "b": 0.123457})


if __name__ == "__main__":
    unittest.main()
