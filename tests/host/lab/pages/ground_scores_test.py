"""How a ground is scored on labelled clouds: by hand, on a street of a few points."""

import unittest

import numpy as np

import laboratory  # noqa: F401 ; it makes the others known
import ground_scores
from ground_scores import Scores, score

GROUND_Z = -1.73
ROAD, PAVEMENT, CAR, VEGETATION, UNLABELLED = 40, 48, 10, 70, 0


def cloud(*points):
    """(x, y, height over the ground, class, fate) of each."""
    x, y, height, labels, fates = zip(*points)
    return (np.column_stack([x, y, np.array(height) + GROUND_Z]).astype(float), np.array(labels),
            np.array([fate.encode() for fate in fates], "S1"))


class GroundScores(unittest.TestCase):
    def test_a_point_called_ground_is_right_by_its_class(self):
        its = score(*cloud((5, 0, 0, ROAD, "g"), (6, 0, 0, PAVEMENT, "g"), (7, 0, 0, ROAD, "g"),
                           (8, 0, 0, ROAD, "o"), (9, 0, 0.1, CAR, "g"), (9, 1, 1, CAR, "o")))
        self.assertEqual((its.right_ground, its.missed_ground, its.wrong_ground), (3, 1, 1))
        self.assertEqual((its.precision, its.recall, its.f1), (75, 75, 75))

    def test_vegetation_and_what_is_not_known_are_not_judged(self):
        its = score(*cloud((5, 0, 0, VEGETATION, "g"), (6, 0, 0, UNLABELLED, "g"), (7, 0, 0, ROAD, "."),
                           (8, 0, 0, ROAD, "-"), (9, 0, 0, ROAD, "g")))
        self.assertEqual((its.right_ground, its.missed_ground, its.wrong_ground), (1, 0, 0))
        self.assertEqual((its.points, its.not_sent), (5, 1))

    def test_what_is_marked_counts_by_its_height_over_the_ground_below(self):
        """On a road that rises by a tenth, which heights over the car's plane would get wrong."""
        road = [(x, 0, 0.1 * x, ROAD, "g") for x in range(4, 40)]
        def at(x, height, fate):
            return (x, 0, 0.1 * x + height, CAR, fate)
        its = score(*cloud(*road, at(10, 0.28, "o"), at(10, 0.4, "g"), at(20, 0.4, "o"), at(30, 1.0, "o"),
                           at(30, 2.3, "o"), at(30, 2.6, "h"), at(20, 2.6, "o")))
        self.assertEqual((its.things, its.marked_things), (3, 2))
        self.assertEqual((its.low_things, its.marked_low_things), (2, 1))
        self.assertEqual((its.high_things, its.marked_high_things), (2, 1))

    def test_the_ground_of_a_thing_may_be_three_metres_away(self):
        near = score(*cloud((10.1, 0.1, 0, ROAD, "g"), (13.1, 0.1, 1, CAR, "o")))
        far = score(*cloud((10.1, 0.1, 0, ROAD, "g"), (13.6, 0.1, 1, CAR, "o")))
        self.assertEqual((near.things, far.things), (1, 0))

    def test_the_nearest_ground_counts(self):
        its = score(*cloud((10.1, 0.1, 0, ROAD, "g"), (11.1, 0.1, -2, ROAD, "g"), (12.6, 0.1, 1, CAR, "o")))
        self.assertEqual((its.things, its.high_things), (0, 1))  # 3 m over the lower one

    def test_a_cell_is_false_if_only_ground_marks_it(self):
        its = score(*cloud((10.01, 0.01, 0, ROAD, "o"), (10.05, 0.05, 0, ROAD, "o"), (10.11, 0.01, 0, PAVEMENT, "o"),
                           (10.21, 0.01, 0, ROAD, "o"), (10.22, 0.02, 1, CAR, "o"), (60, 0, 0, ROAD, "o")))
        self.assertEqual((its.false_cells, its.false_road_cells), (2, 1))

    def test_scores_add_up(self):
        one = score(*cloud((5, 0, 0, ROAD, "g"), (9, 1, 1, CAR, "g")))
        both = one + one + Scores()
        self.assertEqual((both.scans, both.right_ground, both.wrong_ground, both.precision), (2, 2, 2, 50))

    def test_of_nothing_there_is_no_share(self):
        self.assertTrue(np.isnan(Scores().f1))

    def test_the_class_is_the_lower_half_of_a_label(self):
        self.assertEqual(list(ground_scores.labels_in(np.array([(7 << 16) + 252, 40], np.uint32))), [252, 40])


if __name__ == "__main__":
    unittest.main()
