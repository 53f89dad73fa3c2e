"""What pages read of the table of the Cortex-A9, on one that can be reckoned in the head."""

import unittest

import laboratory
from claims import Verdict
from cortex_a9 import CortexA9, Modelled, frame_run
from tables import Data

RUN = "frame_cost scene=city sensors=4"
TABLE = f"""run,stage,variant,counter,value
{RUN},,counted,run_hash,00001234
{RUN},,counted,frames,4
{RUN},,counted,points,40
{RUN},,counted,points_used,20
{RUN},,counted,cells,400
{RUN},,counted,tiles,8
{RUN},receive,counted,instructions,4
{RUN},fuse,counted,instructions,80
{RUN},mark,counted,instructions,8
{RUN},publish,counted,instructions,40
{RUN},clear,counted,instructions,12
{RUN},frame,counted,instructions,132
{RUN},frame,counted,instructions_max,50
{RUN},,nominal,frames,2
{RUN},,optimistic,frames,2
{RUN},,pessimistic,frames,2
{RUN},beams,nominal,cycles,200
{RUN},beams,optimistic,cycles,100
{RUN},beams,pessimistic,cycles,400
{RUN},beams,nominal,instructions,100
{RUN},beams,nominal,l1d_refills,6
{RUN},beams,nominal,l2_misses,4
{RUN},beams,nominal,mispredicts,2
{RUN},carve,nominal,cycles,20
{RUN},carve,nominal,instructions,10
{RUN},carve,nominal,l1d_refills,2
{RUN},carve,nominal,l2_misses,0
{RUN},carve,nominal,mispredicts,0
"""


class Table(unittest.TestCase):
    def setUp(self):
        with laboratory.Tables(cortex_a9=TABLE) as folder:
            self.a9 = CortexA9(Data(folder))

    def test_a_word_keeps_its_digits(self):
        self.assertEqual(self.a9.word(RUN, "run_hash"), "00001234")

    def test_what_is_counted_is_a_sum_and_its_mean_is_of_a_frame(self):
        self.assertEqual(self.a9.value(RUN, "points"), 40)
        self.assertEqual(self.a9.mean(RUN, "points"), 10)
        self.assertEqual(self.a9.mean(RUN, "cycles", "beams", "pessimistic"), 200)

    def test_what_is_not_there_is_said(self):
        with self.assertRaisesRegex(AssertionError, "no .*nothing"):
            self.a9.value(RUN, "nothing")

    def test_runs_are_found_by_their_program(self):
        self.assertEqual(self.a9.runs("frame_cost"), [RUN])
        self.assertEqual(self.a9.runs("floor", "nominal"), [])
        self.assertTrue(self.a9.has(RUN, "optimistic"))
        self.assertFalse(self.a9.has("floor scene=city"))

    def test_a_mean_frame_has_its_stages(self):
        frame = self.a9.frame(RUN)
        self.assertEqual((frame.points, frame.points_used, frame.cells, frame.tiles), (10, 5, 100, 2))
        self.assertEqual((frame.receive, frame.fuse, frame.mark, frame.publish), (1, 20, 2, 10))
        self.assertEqual(frame.fused, 20 + 2 + 3)
        self.assertEqual((frame.whole, frame.largest), (33, 50))

    def test_a_stage_costs_a_mean_frame_by_each_variant(self):
        beams = self.a9.cost(RUN, "beams")
        self.assertEqual(beams.cycles, Modelled(100, 50, 200))
        self.assertEqual((beams.instructions, beams.l1d_refills, beams.l2_misses,
                          beams.mispredicts), (50, 3, 2, 1))

    def test_stages_add_up_and_one_variant_alone_stands_for_all(self):
        both = self.a9.cost(RUN, "beams", "carve")
        self.assertEqual(both.cycles, Modelled(110, 60, 210))
        self.assertEqual(both.instructions, 55)

    def test_instructions_take_what_they_take_in_their_stage(self):
        self.assertEqual(self.a9.cost(RUN, "beams").cycles_of(10), Modelled(20, 10, 40))


class Variants(unittest.TestCase):
    def test_a_core_at_1_ghz_does_in_a_second_what_takes_so_many_cycles(self):
        self.assertEqual(Modelled(1e7, 5e6, 2e7).hz, Modelled(100, 200, 50))
        self.assertEqual(Modelled(1e7, 5e6, 2e7).ms, Modelled(10, 5, 20))

    def test_nothing_above_the_nominal_variant_is_a_bound(self):
        self.assertEqual(Modelled(1000, 2000, 500).banded(0), "1,000 (500)")
        self.assertEqual(Modelled(12.44, 10.9, 16).banded(1), "12.4 (16.0)")

    def test_the_nominal_variant_decides_and_the_band_says_how_surely(self):
        rate = Modelled(100, 120, 80)
        self.assertEqual(rate.verdict(99), Verdict.BEATS)
        self.assertEqual(rate.verdict(101), Verdict.FALLS_SHORT)
        self.assertTrue(rate.has_in_band(99))
        self.assertFalse(rate.has_in_band(101))
        self.assertFalse(rate.has_in_band(79))


class Names(unittest.TestCase):
    def test_only_what_is_not_usual_is_named(self):
        self.assertEqual(frame_run("city"), RUN)
        self.assertEqual(frame_run("ring_road", 2, coding="shortest"),
                         "frame_cost scene=ring_road sensors=2 coding=shortest")
        self.assertEqual(frame_run(worst="flood", paths="forgotten"),
                         "frame_cost worst=flood sensors=4 paths=forgotten")

    def test_the_stored_table_has_the_runs_that_pages_name(self):
        a9 = CortexA9(Data())
        for run in (frame_run("city"), frame_run("ring_road", coding="shortest"),
                    frame_run(worst="flood")):
            self.assertTrue(a9.has(run), run)
            self.assertTrue(a9.has(run, "nominal"), run)


if __name__ == "__main__":
    unittest.main()
