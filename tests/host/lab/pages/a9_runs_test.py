"""The runs on the emulated Cortex-A9: lines that images print into rows, and which runs there are."""

import csv
import pathlib
import re
import unittest
from unittest import mock

import laboratory
import a9_runs


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


def nothing_modelled(_place, _variant, functions, image, *arguments):
    """In place of the model: the pairs that an image prints, and no cost at all."""
    pairs = dict.fromkeys(("lines", "leaves", "bytes"), "0")
    if image.name == "scaling":
        grid = re.search(r"grid_(\d+)_(\d+)", str(image))
        naming = (*(grid.groups() if grid else ("1024", "100")), *map(str, arguments[:3]))
        pairs = dict(zip(a9_runs.NAMING["scaling"], naming))
        pairs.update(dict.fromkeys(("frames", "points", "points_used", "messages"), "0"))
    return pairs, {name: dict.fromkeys(a9_runs.COUNTERS, 0) for name in functions}


class Runs(unittest.TestCase):
    def test_what_is_modelled_is_what_the_table_holds(self):
        """So that nobody learns after minutes that lab/target/measure_a9 writes something else."""
        with open(laboratory.ROOT / "lab/data/cortex_a9.csv", newline="") as table:
            stored = [tuple(row[:4]) for row in list(csv.reader(table))[1:]]
        worst = dict.fromkeys(run.split()[1].removeprefix("worst=")
                              for run, *_ in stored if " worst=" in run)
        place = a9_runs.Place(*map(pathlib.Path, ("iog", "images", "model", "work")))
        with mock.patch.object(a9_runs, "modelled", nothing_modelled):
            rows = a9_runs.results_of(a9_runs.modelled_runs(
                place, {"city": "city.pcap", "ring_road": "ring_road.pcap"}, list(worst)))
        self.assertEqual([tuple(row[:4]) for row in rows],
                         [key for key in stored if key[2] != "counted"])


if __name__ == "__main__":
    unittest.main()
