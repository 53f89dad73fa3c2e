"""The runs on the emulated Cortex-A9: lines that images print into rows, and which runs there are."""

import csv
import pathlib
import re
import unittest
from unittest import mock

import laboratory
import a9_cores
import a9_map
import a9_moved
import a9_perception
import a9_runs
import a9_scaling
import a9_sensitivity
import a9_turning


class Rows(unittest.TestCase):
    def test_a_line_says_its_run_by_its_naming_pairs(self):
        self.assertEqual(a9_runs.run_of("traversal_cost walk=discrete r=20 beams=181 cells=7"),
                         "traversal_cost walk=discrete r=20")
        self.assertEqual(a9_runs.run_of("many_core approach=cbc cell_mm=100 cells=7"),
                         "many_core approach=cbc cell_mm=100")

    def test_what_is_of_a_stage_is_told_from_what_is_of_the_run(self):
        rows = a9_runs.counted_rows(
            "frame_cost sensors=4 frames=2 fuse_sum=10 fuse_mean=5 fuse_max=7 stack_bytes=9", "run")
        self.assertEqual([tuple(row) for row in rows],
                         [("run", "", "counted", "frames", "2"),
                          ("run", "fuse", "counted", "instructions", "10"),
                          ("run", "fuse", "counted", "instructions_max", "7"),
                          ("run", "", "counted", "stack_bytes", "9")])

    def test_the_whole_is_the_sum_of_its_stages(self):
        stages = {name: dict.fromkeys(a9_runs.COUNTERS, number)
                  for name, number in (("carve", 3), ("mark", 4))}
        whole = a9_runs.with_whole(stages, "frame")["frame"]
        self.assertEqual(set(whole.values()), {7})


class DividedRounds(unittest.TestCase):
    # Rounds of two, one and one items, and the end of a frame, as the image and the model print them.
    # Two functions have one name.
    PRINTED = ["perception_cost rounds=2,1,1,0"] + [
        f"modelled variant=nominal round={number} of={name} cycles={cycles} l2_misses=0 "
        f"ddr_reads={reads} ddr_writes=1"
        for number, costs in enumerate([(3, 2, 0, 0), (0, 0, 40, 0), (0, 0, 60, 0), (7, 0, 0, 0),
                                        (0, 0, 0, 30), (4, 0, 0, 0), (9, 0, 0, 0), (2, 0, 0, 0)])
        for name, cycles, reads in zip(("other", "other", "fuse", "encode", "benchmark"),
                                       (*costs, 1000), (1, 0, 2, 0, 500))]

    def test_items_are_dealt_to_whoever_is_idle_first(self):
        items = [a9_cores.Item(cycles, 0) for cycles in (4, 1, 1, 1, 1, 9)]
        self.assertEqual(a9_cores.dealt(items, 2), [13, 4])
        self.assertEqual(a9_cores.dealt(items, 1), [17])

    def test_rounds_are_told_from_what_core_0_does_alone(self):
        rounds = a9_cores.rounds_of(self.PRINTED)
        self.assertEqual([(each.frame, each.stage, [item.cycles for item in each.items])
                          for each in rounds],
                         [(0, "alone", [5]), (0, "fuse", [40, 60]), (0, "alone", [7]),
                          (0, "encode", [30]), (0, "alone", [4]), (0, "window", [9]),
                          (0, "alone", [2])])
        self.assertEqual(rounds[0].items[0].ddr_lines, (1 + 1) + (0 + 1) + (2 + 1) + (0 + 1))

    def test_no_round_is_shorter_than_its_lines_take(self):
        rows = {row.stage: row for row in
                a9_cores.divided("city", "nominal", 2, a9_cores.rounds_of(self.PRINTED), 10)}
        self.assertEqual(rows["fuse"].longest_cycles, 60)
        self.assertEqual(rows["fuse"].bounded_cycles, 2 * 7 * 10)
        self.assertEqual(rows["alone"].busy_cycles, 5 + 7 + 4 + 2)
        self.assertEqual((rows["encode"].rounds, rows["encode"].items), (1, 1))


def nothing_modelled(_place, _variant, stages, image, *arguments):
    """In place of the model: the pairs that an image prints, and no cost at all."""
    pairs = dict.fromkeys(("lines", "leaves", "bytes"), "0")
    if image.name == "scaling":
        grid = re.search(r"grid_(\d+)_(\d+)", str(image))
        naming = (*(grid.groups() if grid else ("1024", "100")), *map(str, arguments[:3]))
        pairs = dict(zip(a9_runs.NAMING["scaling"], naming))
        pairs.update(dict.fromkeys(("frames", "points", "points_used", "messages"), "0"))
    return pairs, {name: dict.fromkeys(a9_runs.COUNTERS, 0) for name in stages}


class Runs(unittest.TestCase):
    def test_what_is_modelled_is_what_the_table_holds(self):
        """So that nobody learns after minutes that lab/target/measure_a9 writes something else."""
        with open(laboratory.ROOT / "lab/data/cortex_a9.csv", newline="") as table:
            stored = [tuple(row[:4]) for row in list(csv.reader(table))[1:]]
        worst = dict.fromkeys(run.split()[1].removeprefix("worst=")
                              for run, *_ in stored if " worst=" in run)
        place = a9_runs.Place(*map(pathlib.Path, ("iog", "images", "model", "work")))
        nothing = " ".join(f"{counter}=0" for counter in a9_runs.COUNTERS)
        with mock.patch.object(a9_runs, "modelled", nothing_modelled), \
                mock.patch.object(a9_runs, "printed_by_model",
                                  lambda *_: [f"modelled region={number} {nothing}"
                                              for number, _ in enumerate(a9_runs.WALKS, 1)]):
            rows = a9_runs.results_of({"modelled": [
                *a9_runs.modelled_runs(place, {"city": "city.pcap", "ring_road": "ring_road.pcap"},
                                       list(worst)),
                *a9_scaling.runs(place)]})["modelled"]
        with mock.patch.object(a9_runs, "printed_by_model",
                               lambda *_: ["object_cost frames=0", "modelled of=objects cycles=0"]):
            for variant in a9_perception.VARIANTS:
                for kind in a9_perception.FORGED:
                    rows += a9_perception.objects_modelled(place, kind, variant)
        with mock.patch.object(a9_runs, "printed_by_model",
                               lambda *_: ["perception_cost groups_fused_after=0"]):
            for variant in a9_perception.VARIANTS:
                for drive in ("city", "ring_road"):
                    rows += a9_perception.modelled(place, drive, variant, "drive.pcap")
        with mock.patch.object(a9_runs, "printed_by_model",
                               lambda *_: ["map_cost tiles=0", "modelled of=layer cycles=0"]):
            for variant in a9_map.VARIANTS:
                for name in a9_map.BEGINS:
                    rows += a9_map.modelled(place, name, variant)
        with mock.patch.object(a9_runs, "modelled", nothing_modelled), \
                mock.patch.object(a9_runs, "printed_by_model",
                                  lambda *_: [f"modelled region={region} {nothing}"
                                              for region in a9_turning.REGIONS]):
            rows += a9_runs.results_of({"turning": a9_turning.modelled_runs(
                place, dict.fromkeys(a9_turning.VEHICLES, "drive.pcap"))})["turning"]
        with mock.patch.object(a9_runs, "printed_by_model", lambda *_: ["perception_cost points_after=0"]):
            rows += a9_runs.results_of({"moved": a9_moved.modelled_runs(
                place, dict.fromkeys(a9_moved.VEHICLES, "drive.pcap"))})["moved"]
        constants = "\n".join(["constant,nominal,pessimistic",
                               *(f"{name},1,1" for name in ("ddr_line", *a9_sensitivity.CONSTANTS))])
        no_rounds = ["perception_cost rounds=0",
                     "round=0 of=other " + " ".join(f"{counter}=0" for counter in a9_cores.COUNTERS)]
        scenes = dict.fromkeys(("city", "ring_road"), "drive.pcap")
        with mock.patch.object(a9_runs, "modelled", nothing_modelled), \
                mock.patch.object(a9_runs, "printed_by_model", lambda *_: no_rounds), \
                mock.patch.object(a9_runs, "output_of", lambda *_: constants):
            rows += a9_runs.results_of({"sensitivity": a9_sensitivity.runs(
                place, scenes, {**scenes, a9_moved.TRACKED: "drive.pcap"},
                dict.fromkeys(a9_sensitivity.POINTS, "drive.pcap"))})["sensitivity"]
        self.assertEqual([tuple(row[:4]) for row in rows],
                         [key for key in stored if key[2] != "counted"])


if __name__ == "__main__":
    unittest.main()
