"""The page of a recorded drive says what its tables say, whatever settings and things they have; and the
measurement is done only when it is asked for."""

import contextlib
import io
import sys
import unittest
from unittest import mock

import laboratory
import measurements
from measurements_test import script
from tables import Data

HITS = ("drive,setting,kind,speed,range_from_m,range_to_m,named_by_neighbour,unknown_hits,free_hits,moving_hits,"
        "standing_hits,open_hits\n")
AREAS = "drive,setting,within_m,free_m2,moving_m2,standing_m2,open_m2\n"
RUNS = ("drive,setting,measured_at,metres,pitch_deg,mount_z_m,band_low_m,band_high_m,turns,frames,packets_placed,"
        "packets_not_placed,points_used,slices_placed\n")
THINGS = ("drive,setting,thing,kind,after_gap,unknown_hits,free_hits,moving_hits,standing_hits,open_hits,from_m,to_m,"
          "from_mps,to_mps\n")
GROUND = "drive,setting,kind,hits,ground_hits\npandaset_002,both,vehicle,1000,4\n"
VELOCITIES = "drive,setting,thing,kind,delay_s,frames,median_error_mps\n"


def tables(hits, settings, drive="street", things=(), velocities=()):
    return laboratory.Tables(
        recorded_hits=HITS + "".join(f"{drive},{row}" for row in hits),
        recorded_areas=AREAS + "".join(f"{drive},{name},40,{free},1,2,3\n" for name, free in settings.items()),
        recorded_runs=RUNS + "".join(f"{drive},{name},abc,107,0.81,1.75,0.3,2.2,108,278,38441,238,3833209,1653\n"
                                     for name in settings),
        recorded_ground=GROUND,
        recorded_things=THINGS + "".join(f"{drive},{row}" for row in things),
        recorded_velocities=VELOCITIES + "".join(f"{drive},{row}" for row in velocities))


class Page(unittest.TestCase):
    def page(self, hits, settings, *more):
        """Its goals, and the cells of its tables."""
        with tables(hits, settings, *more) as folder:
            page = script("lab/pages/build").Page("results/recorded", Data(folder))
            rows = [[cell.strip() for cell in line.strip("|").split("|")]
                    for line in page.text.splitlines() if line.startswith("|")]
            return page.goals, rows

    def test_shares_are_of_the_hits_of_a_setting(self):
        goals, rows = self.page(["flat,parked car,still,0,25,1,0,0,38,50,12\n", "flat,parked car,still,0,25,0,5,5,28,50,12\n",
                                 "moved,parked car,still,0,25,1,0,0,1,999,0\n", "moved,parked car,still,0,25,0,0,10,1,989,0\n"],
                                {"flat": 2664, "moved": 2621})
        self.assertEqual([row[2:] for row in rows if row[:2] == ["parked car", "0 to 25 m"]], [
            ["100 → 1,000", "38.00 → 0.10", "50.00 → 99.90", "0.00", "5.00 → 1.00"]])
        found = {goal.what.removeprefix("street: "): (goal.found, goal.is_met) for goal in goals}
        self.assertEqual(found, {
            "parked cars below 25 m: called moving": ("0.10 %", True),
            "labelled and upright objects, with a neighbour's class: called free": ("0.00 %", True),
            "labelled and upright objects: called free": ("1.00 %", True), "free area within 40 m": ("2,621 m²", False)})

    def test_a_goal_is_missed_on_its_own_side(self):
        row = "flat,{},over 8 m/s,0,25,1,0,0,{},{},0\n".format
        for kind, moving, met in (("parked car", 2, True), ("parked car", 3, False), ("cyclist", 970, True),
                                  ("cyclist", 969, False), ("moving car", 990, True), ("moving car", 989, False)):
            goals, _ = self.page([row(kind, moving, 1000 - moving)], {"flat": 2664})
            self.assertEqual(goals[0].is_met, met, (kind, moving))

    def test_a_mount_that_is_wrong_has_a_column_beside_that_which_is_right(self):
        name = "both, pitch 1° less"
        row = '"{}",parked car,still,0,25,1,0,0,{},{},0\n'.format
        _, rows = self.page([row(name, 4, 996), row("both", 1, 999)], {f'"{name}"': 2664, "both": 2664})
        self.assertIn(["goal", "asked", "both", name], rows)
        self.assertIn(["parked cars below 25 m: called moving", "≤ 0.2 %", "0.10 %", "**0.40 %**"], rows)

    def test_of_things_that_the_drive_has_not_nothing_is_said(self):
        goals, rows = self.page(["flat,road ahead,,0,20,1,0,10,0,0,0\n"], {"flat": 2664})
        self.assertEqual([row[0] for row in rows if row[1:2] == ["0 to 20 m"]], ["road ahead"])
        self.assertEqual(len(goals), 2)  # and the area

    def test_an_object_that_moves_has_a_row_and_the_time_after_gaps_counts_only_where_it_is_said(self):
        goals, rows = self.page(
            [], {"both": 1, '"both, followed"': 1}, "pandaset_002",
            ['"both, followed",43,vehicle,0,0,0,90,1,9,10.3,21.2,2.2,7.8\n',
             '"both, followed",43,vehicle,1,0,0,10,80,10,10.3,21.2,2.2,7.8\n',
             '"both, followed",45,vehicle,0,0,0,0,0,5,32.0,47.7,3.5,7.0\n',
             '"both, followed",12,vehicle,0,0,0,6,2,2,5,6,1,2\n'],
            ['"both, followed",43,vehicle,0.50,160,0.31\n', '"both, followed",45,vehicle,inf,0,nan\n'])
        self.assertIn(["43", "vehicle", "10.3 to 21.2", "2.2 to 7.8", "200", "50.00", "40.50", "0.00", "0.50",
                       "0.31"], rows)
        self.assertIn(["45", "vehicle", "32.0 to 47.7", "3.5 to 7.0", "5", "0.00", "0.00", "0.00", "never",
                       "–"], rows)
        found = [(goal.found, goal.is_met) for goal in goals]
        self.assertEqual(found, [("90.00 %", True), ("1.00 %", True), ("60.00 %", False), ("20.00 %", False),
                                 ("0.31 m/s", True), ("0.50 s", True), ("0.40 %", False)])


class Run(unittest.TestCase):
    def said(self, *words):
        """What lab/run says, and its status; nothing is measured."""
        program = script("lab/run")
        out, error = io.StringIO(), io.StringIO()
        with mock.patch.object(sys, "argv", ["lab/run", *words]), contextlib.redirect_stdout(out), \
                contextlib.redirect_stderr(error), mock.patch.object(measurements, "run"), \
                mock.patch.object(measurements, "measure", side_effect=AssertionError):
            try:
                program.main()
                status = 0
            except SystemExit as end:
                status = end.code
        return out.getvalue() + error.getvalue(), status

    def test_without_its_drive_it_is_not_measured_and_says_why(self):
        for words in (["recorded"], ["recorded", "folder"]):
            said, status = self.said(*words)
            self.assertEqual(status, 2)
            self.assertIn("recorded is not measured: its drives are not part of this project", said)
        said, status = self.said("recorded", str(laboratory.ROOT), "no_car.toml")
        self.assertEqual(status, 2)
        self.assertIn("cannot read no_car.toml", said)

    def test_its_page_alone_stays_and_says_why(self):
        said, status = self.said("results/recorded")
        self.assertEqual(status, 0)
        self.assertIn("docs/results/recorded.md stays, not measured", said)


if __name__ == "__main__":
    unittest.main()
