"""What docs/evidential.md shows of Kurdej's thesis: its printed digits, against lab/data in the
reading that each of them is of, and the numbers that the page must not lose."""

import unittest

import laboratory
import discounting
from claims import Verdict
from measurements_test import script
from tables import Data, ratio, select

DATA = Data()
TABLES = discounting.Tables(DATA)
SCENES = ("city", "street")
WORDS = ["unknown", "drivable", "non_drivable", "mapped", "moving", "stopped", "unmapped", "free", "standing", "open"]


class PrintedTables(unittest.TestCase):
    def test_table_61_is_what_is_meant(self):
        self.assertLess(TABLES.largest_difference_to_table_61(), 1e-15)

    def test_table_62_has_two_slips(self):
        self.assertEqual(TABLES.off_by(6.2, "meant"), 2)

    def test_table_63_has_kappa_for_alpha_to_its_digits(self):
        self.assertEqual(TABLES.off_by(6.3, "kappa for alpha"), 0)
        self.assertGreater(TABLES.off_by(6.3, "meant"), 8)

    def test_table_64_has_kappa_of_four_digits(self):
        """With what is left rounded so, its digits come out; unrounded within 3e-5."""
        kappa = [round(2 ** (-4 / half_life), 4) for half_life in (5, 4, 15)]
        left = {"1": 0.3 * (1 - kappa[0]), "3": 0.2 * (1 - kappa[2]),
                "12": 0.2 * (1 - kappa[0]) * (1 - kappa[1])}
        for name, mass in left.items():
            self.assertAlmostEqual(mass, float(discounting.PRINTED[6.4][name][2]), delta=1e-9)
        self.assertLess(TABLES.largest_off(6.4, "kappa for alpha"), 3e-5)

    def test_mercier_s_column_is_right(self):
        self.assertTrue(TABLES.contextual_is_printed())

    def test_the_schemes_are_in_order(self):
        self.assertTrue(TABLES.is_ordered())

    def test_masses_of_the_printed_equations_are_lost(self):
        self.assertAlmostEqual(TABLES.total(6.1, "conservative", "printed equations"), 0.8025,
                               delta=1e-12)


class Claims(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.verdicts = {(claim.place, claim.what): claim.verdict for claim in script("lab/pages/build").Page("evidential").claims}

    def test_section_54_comes_out(self):
        for gain in (0.05, 0.15):
            self.assertIs(self.verdicts["section 5.4, figure 5.6", f"stopped overtakes moving, δ = {gain}"], Verdict.EQUALS)
        self.assertIs(self.verdicts["table 7.1", "rates of {D,N,M} and {I,S,U}"], Verdict.DEPARTS)

    def test_the_map_may_come_late(self):
        self.assertIs(self.verdicts["section 5.1", "masses of free, occupied and moving"], Verdict.EQUALS)
        order = DATA["evidential_map_order"]
        proven = select(order, context=["none", "road", "intermediate"], ageing=["classical", "conservative", "optimistic"])
        not_kept = [f"sets_not_kept_by_{operation}" for operation in ("scan", "specialisation", "ageing")]
        self.assertEqual(proven[not_kept].to_numpy().sum(), 0)
        self.assertTrue((select(order, context="building")["difference"] > 1e-12).all())
        self.assertEqual({name: ratio(DATA["evidential_ghost_drive"], "free", "points", map=name)
                          for name in ("every scan", "decision", "our decision")},
                         {"every scan": 0, "decision": 0, "our decision": 1})

    def test_only_the_thesis_s_rule_finds_what_moves(self):
        for scene in SCENES:
            def called_moving(rule, echoes=DATA[f"evidential_{scene}_echoes"]):
                return ratio(echoes, ["moving"], WORDS, grid=rule, on=["moving car", "moving person"])
            for rule in ("conjunctive", "Dempster", "Yager", "disjunctive"):
                self.assertEqual(called_moving(rule), 0)
            self.assertGreater(called_moving("the thesis's"), 0.4)

    def test_all_grids_have_the_same_echoes(self):
        for scene in SCENES:
            echoes = DATA[f"evidential_{scene}_echoes"]
            sums = echoes.groupby(["on", "grid"])[WORDS].sum().sum(axis=1)
            self.assertTrue((sums.groupby("on").nunique() == 1).all())

    def test_the_time_beside_ours_is_of_whole_frames(self):
        self.assertIs(self.verdicts["section 8.1", "a scan of 25,600 cells"], Verdict.BEATS)


class Page(unittest.TestCase):
    def test_has_its_numbers(self):
        text = (laboratory.ROOT / "docs/evidential.md").read_text()
        for number in ("0.281", "0.01875", "0.12771", "0.17230", "0.7650", "0.8025", "0.9959", "0.4176", "0.0277"):
            self.assertIn(number, text)


if __name__ == "__main__":
    unittest.main()
