"""What lab/data/cortex_a9.csv says of the Cortex-A9 hangs together: stages add up, variants are in
order, the model is near what QEMU counts, and nothing is below what the memory asks for."""

import unittest

import laboratory  # noqa: F401 ; it makes the others known
import worst_frames
from cortex_a9 import FUSED, PUBLISH, STAGES, VARIANTS, CortexA9, frame_run
from tables import Data
from target_frames import SCENES, WHOLE, floor, target_frame

DATA = Data()
A9 = CortexA9(DATA)
RUNS = [frame_run(scene, sensors) for scene in SCENES for sensors in (2, 3, 4)]
WORST = [run.removeprefix("floor ") for run in A9.runs("floor", "nominal") if "worst=" in run]
WALKS = A9.runs("traversal_cost")


class TargetDataTest(unittest.TestCase):
    def assert_in_order(self, cost):
        cycles = cost.cycles
        self.assertLess(cycles.optimistic, cycles.nominal)
        self.assertLess(cycles.nominal, cycles.pessimistic)

    def test_a_frame_costs_what_its_stages_cost(self):
        for run in RUNS:
            counted = [A9.value(run, "instructions", stage)
                       for stage in ("receive", "fuse", "mark", "publish")]
            self.assertEqual(A9.value(run, "instructions", WHOLE), sum(counted), run)
            for variant in VARIANTS:
                self.assertAlmostEqual(getattr(A9.cost(run, WHOLE).cycles, variant),
                                       getattr(A9.cost(run, *STAGES).cycles, variant), delta=1)

    def test_the_variants_are_in_order(self):
        for run in RUNS:
            for stages in (FUSED, PUBLISH, [WHOLE]):
                self.assert_in_order(A9.cost(run, *stages))

    def test_the_core_dispatches_two_instructions_a_cycle_at_most(self):
        for run in RUNS:
            for stage in STAGES:
                cost = A9.cost(run, stage)
                self.assertGreaterEqual(cost.cycles.optimistic, cost.instructions / 2, run)

    def test_the_modelled_instructions_are_of_those_that_qemu_counts(self):
        """A mean over some frames lies between the cheapest and the dearest of all. Reading the
        counter is in one of the two counts only, one in a hundred; and the model leaves out the
        library's 64-bit division, which is Thumb code: four more in a hundred where many lines are
        cut off at the grid's edge (docs/a9_model.md)."""
        for run in RUNS:
            for stage, stages in ((WHOLE, [WHOLE]), ("fuse", ("decode", "beams", "carve"))):
                modelled = A9.cost(run, *stages).instructions
                self.assertGreaterEqual(modelled,
                                        0.95 * A9.value(run, "instructions_min", stage), run)
                self.assertLessEqual(modelled,
                                     1.01 * A9.value(run, "instructions_max", stage), run)

    def test_the_floor_is_below_every_frame(self):
        """Two of its fill buffers bring a line from L2 at best every seven cycles."""
        for scene in SCENES:
            memory, frame = floor(A9, f"scene={scene}"), target_frame(A9, frame_run(scene))
            self.assertGreater(memory.lines, 0)
            self.assertGreater(memory.fuse, 7 * memory.lines)
            self.assertLess(memory.fused, frame.fused.cycles.optimistic)
            self.assertLess(memory.whole, frame.whole.cycles.optimistic)
        self.assertGreater(len(WORST), 0)
        for worst in WORST:
            fused = A9.cost(frame_run(worst=worst.removeprefix("worst=")), *FUSED)
            self.assertLess(floor(A9, worst).fused, fused.cycles.nominal, worst)

    def test_the_synthetic_load_grows(self):
        before = 0
        for sensors in range(1, 9):
            run = (f"scaling cells_per_side=1024 cell_mm=100 sensors={sensors} azimuths=201 "
                   "range_cm=2500")
            self.assertEqual(A9.value(run, "points", variant="nominal"), sensors * 201 * 4)
            whole = A9.cost(run, WHOLE).cycles.nominal
            self.assertGreater(whole, before)
            self.assertLess(A9.cost(run, *FUSED).cycles.nominal, whole)
            before = whole

    def test_a_walk_costs_the_instructions_that_qemu_counts(self):
        """But for the counter's own call and the walk's, 25 at most."""
        self.assertGreater(len(WALKS), 0)
        for run in WALKS:
            cost = A9.cost(run)
            self.assertAlmostEqual(cost.instructions, A9.value(run, "instructions"), delta=25)
            self.assert_in_order(cost)
            self.assertGreaterEqual(cost.cycles.optimistic, cost.instructions / 2, run)
            self.assertLessEqual(cost.l1d_refills, A9.value(run, "cells"), run)

    def test_the_resolution_does_not_change_what_a_cell_costs(self):
        per_cell = [A9.value(run, "instructions") / A9.value(run, "cells")
                    for run in WALKS if "walk=discrete " in run]
        self.assertEqual(len(per_cell), 4)
        self.assertLess(max(per_cell) - min(per_cell), 0.001)

    def test_the_printed_fusion_saw_the_same_points(self):
        ours = frame_run("ring_road")
        for run in A9.runs("printed_cost"):
            for counter in ("frames", "points"):
                self.assertEqual(A9.value(run, counter), A9.value(ours, counter), run)

    def test_the_map_s_layer_is_modelled_on_the_drive_that_was_counted(self):
        """The model leaves out the 64-bit division of the rasters."""
        runs = A9.runs("map_cost")
        self.assertGreater(len(runs), 0)
        for run in runs:
            counted = A9.value(run, "instructions", "layer")
            for variant in ("nominal", "pessimistic"):
                self.assertEqual(A9.value(run, "tiles", variant=variant), A9.value(run, "tiles"))
                modelled = A9.value(run, "instructions", "layer", variant)
                self.assertLessEqual(modelled, counted, run)
                self.assertGreater(modelled, 0.9 * counted, run)
            self.assertLess(A9.value(run, "cycles", "layer", "nominal"),
                            A9.value(run, "cycles", "layer", "pessimistic"), run)

    def test_the_bound_is_not_far_from_a_frame_without_shared_lines(self):
        """One far above what can happen would say nothing. It counts with a walk for each beam: a
        frame whose beams share no line comes near to it, for its number of points."""
        kinds = [worst_frames.kind_of(A9, row) for row in DATA["worst_frames"].itertuples()]
        bound = worst_frames.bound_of(kinds, next(DATA["frame_limits"].itertuples()))
        apart = next(kind for kind in kinds if kind.name == "random_azimuths")
        self.assertGreater(bound.of_its_points(apart), 0.75)


if __name__ == "__main__":
    unittest.main()
