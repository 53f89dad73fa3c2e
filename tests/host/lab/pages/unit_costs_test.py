"""What `iog budget` reckons with, on a table that can be reckoned in the head."""

import unittest

import laboratory
import unit_costs
from cortex_a9 import CortexA9
from tables import Data

SHORTEST = "frame_cost scene={} sensors=4 coding=shortest"
# Of two frames each: what is of a run, and cycles of its stages.
RUNS = {
    SHORTEST.format("city"): (dict(points=20, cells=200, tiles=4),
                              dict(receive=20, decode=40, beams=100, mark=40, carve=400, encode=60,
                                   send=20, clear=20)),
    SHORTEST.format("ring_road"): (dict(points=20, cells=600, tiles=12),
                                   dict(receive=20, decode=40, beams=300, mark=40, carve=2000,
                                        encode=400, send=40, clear=40)),
    "frame_cost worst=random_azimuths sensors=4": (
        dict(points=10, cells=10, tiles=1), dict(receive=10, decode=10, beams=20, mark=10, carve=50)),
    "frame_cost worst=short_beams sensors=4": (
        dict(points=100, cells=10, tiles=1), dict(receive=10, decode=20, beams=50, mark=10, carve=10)),
    "perception_cost drive=city": (dict(class_tiles=10), dict(frame=1000, beams=400, update=600)),
    "perception_cost drive=ring_road": (dict(class_tiles=10), dict(frame=900, beams=100)),
    # Three cycles an azimuth step and five a point; over the ground 100 a turn and 7 a point more.
    **{f"turning vehicle={vehicle}{kind}":
       (dict(points=2 * points, tiles=2 * tiles),
        dict.fromkeys(("carve", "frame"), 2 * (3 * unit_costs.AZIMUTH_STEPS + 100 * over_ground +
                                               (5 + 7 * over_ground) * points)))
       for vehicle, points, tiles in (("roof_vlp16", 10, 1), ("roof_hdl32e", 20, 2), ("roof_hdl64e", 30, 3))
       for kind, over_ground in (("_band", 0), ("", 1))},
    # 50 more a frame and three more a point where the unit says `moved`.
    **{f"moved_cost vehicle={vehicle} moved={moved}":
       (dict(points=2 * points), dict(frame=2 * (1000 + 9 * points + more * (50 + 3 * points))))
       for vehicle, points in (("roof_vlp16", 10), ("roof_hdl32e", 20), ("roof_hdl64e", 30))
       for moved, more in (("no", 0), ("yes", 1))},
}


def table() -> str:
    lines = ["run,stage,variant,counter,value"]
    for run, (units, stages) in RUNS.items():
        lines += [f"{run},,{variant},frames,2" for variant in ("counted", "nominal")]
        lines += [f"{run},,{variant},{unit},{value}" for variant in ("counted", "nominal")
                  for unit, value in units.items()]
        whole = {stage: 0 for stage in unit_costs.STAGES} | stages
        lines += [f"{run},{stage},nominal,cycles,{value}" for stage, value in whole.items()]
    return "\n".join(lines) + "\n"


class UnitCosts(unittest.TestCase):
    def setUp(self):
        with laboratory.Tables(cortex_a9=table()) as folder:
            self.numbers = {name: value for name, (_, value) in
                            unit_costs._numbers(CortexA9(Data(folder))).items()}

    def test_typical_is_the_mean_of_both_drives(self):
        self.assertEqual(self.numbers["kPointCycles"], (200 + 400) / 40)
        self.assertEqual(self.numbers["kCellCycles"], 2400 / 800)
        self.assertEqual(self.numbers["kTileCycles"], (100 + 480) / 16)
        self.assertEqual(self.numbers["kTypicalPoints"], 10)
        self.assertEqual(self.numbers["kTypicalCells"], 200)
        self.assertEqual(self.numbers["kTypicalTiles"], 4)

    def test_the_dearest_are_of_one_drive_or_of_worst_frames(self):
        self.assertEqual(self.numbers["kDearestTileCycles"], 480 / 12)
        self.assertEqual(self.numbers["kPointOnceCycles"], 10)
        self.assertEqual(self.numbers["kLaterEchoCycles"], 1)

    def test_classes_are_what_a_frame_takes_besides(self):
        self.assertEqual(self.numbers["kClassTileCycles"], (600 + 800) / 20)
        self.assertEqual(self.numbers["kDearestClassTileCycles"], 80)

    def test_units_that_turn_are_reckoned_by_steps_and_points(self):
        self.assertAlmostEqual(self.numbers["kTurnStepCycles"], 3)
        self.assertAlmostEqual(self.numbers["kTurnPointCycles"], 5)
        self.assertEqual(self.numbers["kTurnTiles"], 2)

    def test_following_the_ground_is_what_whole_frames_take_besides(self):
        self.assertAlmostEqual(self.numbers["kGroundTurnCycles"], 100)
        self.assertAlmostEqual(self.numbers["kGroundPointCycles"], 7)

    def test_opening_ground_only_from_below_is_what_frames_with_classes_take_besides(self):
        self.assertAlmostEqual(self.numbers["kMovedFrameCycles"], 50)
        self.assertAlmostEqual(self.numbers["kMovedPointCycles"], 3)

    def test_the_header_is_that_of_the_data(self):
        self.assertTrue(unit_costs.is_current(Data()))


if __name__ == "__main__":
    unittest.main()
