"""Claims, and the tables that they are made of."""

import unittest

import laboratory  # noqa: F401 ; it makes lab/pages known
from claims import Claim, Goal, Verdict, counts, goal_table
from tables import Data, one, select


class Claims(unittest.TestCase):
    def test_every_verdict_but_equal_needs_a_reason(self):
        Claim("table 1", "cells", "1", "1", Verdict.EQUALS)
        for verdict in (Verdict.BEATS, Verdict.FALLS_SHORT, Verdict.DEPARTS):
            with self.assertRaises(AssertionError):
                Claim("table 1", "cells", "1", "2", verdict)
            Claim("table 1", "cells", "1", "2", verdict, "see below")

    def test_only_what_differs_is_bold(self):
        self.assertEqual(Claim("t", "w", "1", "1", Verdict.EQUALS).word, "equal")
        self.assertEqual(Claim("t", "w", "1", "2", Verdict.BEATS, "why").word, "**better**")
        self.assertEqual(Goal("g", "2", "2", True).word, "met")
        self.assertEqual(Goal("g", "2", "1", False).word, "**missed**")

    def test_a_table_of_goals_has_no_column_that_is_empty(self):
        goals = [Goal("g", "2", "2", True)]
        self.assertNotIn("reason", goal_table(goals))
        self.assertIn("reason", goal_table([*goals, Goal("h", "2", "1", False, "why")]))

    def test_all_verdicts_are_counted(self):
        claims = [Claim("t", "w", "1", "1", Verdict.EQUALS),
                  Claim("t", "w", "1", "2", Verdict.BEATS, "why")]
        self.assertEqual(counts(claims), 'Of the 2 claims, 1 is marked "equal", 1 "better", 0 "short of it" and 0 "departs".')


class Tables(unittest.TestCase):
    def test_a_value_is_found_by_the_others_of_its_row(self):
        with laboratory.Tables(walks="walk,r,cells\na,1,10\na,2,20\nb,1,30\n") as folder:
            table = Data(folder)["walks"]
            self.assertEqual(one(table, "cells", walk="a", r=2), 20)
            self.assertEqual(len(select(table, walk="a")), 2)
            with self.assertRaises(AssertionError):
                one(table, "cells", walk="a")
            with self.assertRaises(AssertionError):
                one(table, "cells", walk="c")

    def test_a_double_is_read_as_it_was_written(self):
        with laboratory.Tables(p="p\n0.1\n8.553601571093055e-12\n") as folder:
            self.assertEqual(list(Data(folder)["p"]["p"]), [0.1, 8.553601571093055e-12])


if __name__ == "__main__":
    unittest.main()
