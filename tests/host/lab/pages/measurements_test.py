"""What lab/run and lab/check share: the steps, and what lab/data was made from."""

import importlib.machinery
import importlib.util
import pathlib
import tempfile
import unittest
from unittest import mock

import laboratory
import a9_runs
import measurements
import sources


def script(name: str):
    """A program without .py as a module; its main() runs only as a program."""
    loader = importlib.machinery.SourceFileLoader(pathlib.Path(name).name, str(laboratory.ROOT / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


class Tree(unittest.TestCase):
    """A project of two rooms, of which one program needs one."""

    FILES = {
        "CMakeLists.txt": "all", "toolchain/install": "packages", "lab/data/t.csv": "1",
        "lab/x/x.cpp": '#include "a/a.hpp"\n', "lab/x/notes.md": "words",
        "lab/y/y.cpp": '#include "b/b.hpp"\n',
        "src/a/a.hpp": '#include "a/made.hpp"\n', "src/a/made.hpp.in": '#include "a/made_@BY@.hpp"\n',
        "src/a/made_neon.hpp": "", "src/a/implements_it.cpp": '#include "a/a.hpp"\n',
        "src/a/CMakeLists.txt": "room", "src/a/program.cpp": '#include "a/a.hpp"\nint main() {}\n',
        "src/a/other.cpp": "", "src/b/b.hpp": "", "tools/view/page.js": ""}
    STEPS = {"peers": ("lab/y",), "one/x": ("lab/x",), "two": ("lab/y",)}

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        for name, text in self.FILES.items():
            self.write(name, text)
        for where, values in ((sources, {"ROOT": self.root}),
                              (measurements, {"STEPS": self.STEPS, "DATA": self.root / "lab/data",
                                              "MADE_FROM": self.root / "lab/data/made_from"})):
            for name, value in values.items():
                patch = mock.patch.object(where, name, value)
                patch.start()
                self.addCleanup(patch.stop)
        self.addCleanup(self.forget)

    def forget(self):
        """What was read before."""
        sources._included.cache_clear()
        sources._includers.cache_clear()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        self.forget()


class Sources(Tree):
    def names(self, *starts):
        return {path.relative_to(self.root).as_posix() for path in sources.files_of(starts)}

    def test_what_is_included_counts_and_what_implements_it(self):
        self.assertEqual(self.names("lab/x"), {
            "CMakeLists.txt", "toolchain/install", "lab/x/x.cpp", "src/a/a.hpp", "src/a/made.hpp.in",
            "src/a/made_neon.hpp", "src/a/implements_it.cpp", "src/a/CMakeLists.txt"})

    def test_what_is_nowhere_is_no_silence(self):
        self.write("lab/x/x.cpp", '#include "a/gone.hpp"\n')
        with self.assertRaisesRegex(sources.Unknown, "lab/x/x.cpp includes a/gone.hpp"):
            self.names("lab/x")


class Stamp(Tree):
    def test_without_a_stamp_everything_has_to_be_measured(self):
        self.assertEqual(measurements.stale_steps(), ["one/x", "two"])

    def test_with_one_nothing_has_to_be(self):
        measurements.write_stamps(self.STEPS)
        self.assertEqual(measurements.stale_steps(), [])
        self.assertFalse(measurements.has_edited_tables())

    def test_a_source_makes_those_steps_stale_that_it_is_of(self):
        for name, text, stale in (("src/a/implements_it.cpp", '#include "a/a.hpp"\n// other\n', ["one/x"]),
                                  ("src/a/another.cpp", '#include "a/a.hpp"\n', ["one/x"]),
                                  ("src/b/b.hpp", "// other", ["two"]),
                                  ("src/a/CMakeLists.txt", "other", ["one/x"]),
                                  ("toolchain/install", "other", ["one/x", "two"]),
                                  ("lab/x/notes.md", "other", []), ("src/a/other.cpp", "other", []),
                                  ("src/a/program.cpp", "int main() {}", []),
                                  ("tools/view/page.js", "other", [])):
            measurements.write_stamps(self.STEPS)
            self.write(name, text)
            self.assertEqual(measurements.stale_steps(), stale, name)
        measurements.write_stamps(self.STEPS)
        (self.root / "src/a/another.cpp").unlink()
        self.forget()
        self.assertEqual(measurements.stale_steps(), ["one/x"])

    def test_a_table_that_was_edited_is_seen(self):
        measurements.write_stamps(self.STEPS)
        self.write("lab/data/t.csv", "typed")
        self.assertTrue(measurements.has_edited_tables())

    def test_one_step_alone_leaves_the_others_stale(self):
        measurements.write_stamps(["two"])
        self.assertEqual(measurements.stale_steps(), ["one/x"])

    def test_times_beside_other_libraries_are_never_measured_again_but_refused(self):
        measurements.write_stamps(["one/x", "two"])
        self.assertFalse(measurements.is_current("peers"))
        measurements.write_stamps(["peers"])
        self.assertTrue(measurements.is_current("peers"))
        self.write("src/b/b.hpp", "// other")
        self.assertFalse(measurements.is_current("peers"))
        self.assertEqual(measurements.stale_steps(), ["two"])

    def test_what_was_measured_of_one_part_of_the_target_leaves_the_others(self):
        head = ",".join(a9_runs.Row._fields)
        row = "{},,counted,points,{}".format
        self.write("lab/data/cortex_a9.csv", "\n".join(
            [head, row("frame_cost scene=city", 1), row("scaling sensors=1", 1), row("turning x", 1), ""]))
        self.write("found.csv", "\n".join([head, row("scaling sensors=2", 2), ""]))
        measurements.keep_other_parts(self.root / "found.csv", ["scaling"])
        self.assertEqual((self.root / "found.csv").read_text().splitlines(), [
            head, row("frame_cost scene=city", 1), row("scaling sensors=2", 2), row("turning x", 1)])


class Project(unittest.TestCase):
    """The steps as they are."""

    def names(self, step):
        return {path.relative_to(laboratory.ROOT).as_posix()
                for path in sources.files_of(measurements.STEPS[step])}

    def test_a_step_is_of_what_its_programs_are_made_of(self):
        for step, needed in (("peers", "src/grid/frame_fusion.cpp"),
                             ("experiments/recursive_sets", "src/index/recursive_set.hpp"),
                             ("experiments/map_quality", "src/map/raster.cpp"),
                             ("target/perception", "src/window/window_fusion.cpp"),
                             ("target/frames", "lab/a9_model/pipeline.cpp"),
                             ("target/frames", "src/grid/carve_run_neon.cpp"),
                             ("images", "board/imx6/core_start.S"), ("a9_model", "lab/a9_model/micro/core.cpp")):
            self.assertIn(needed, self.names(step), step)

    def test_no_step_is_of_the_view(self):
        for step in measurements.STEPS:
            self.assertFalse([name for name in self.names(step)
                              if name.startswith(("tools/view/", "lab/pages/"))], step)
        self.assertFalse([name for name in self.names("experiments/recursive_sets") if "map" in name and
                          name.startswith("lab/")])

    def test_run_and_build_know_the_same_pages(self):
        self.assertEqual(set(measurements.PAGES), set(script("lab/pages/build").PAGES))
        steps = {step for steps in measurements.PAGES.values() for step in steps}
        self.assertEqual(steps, set(measurements.STEPS))


class Check(unittest.TestCase):
    def setUp(self):
        self.check = script("lab/check")

    def fault(self, stage, variant, counter, found, stored):
        return self.check.fault_of(a9_runs.Row("run", stage, variant, counter, found), stored)

    def test_instructions_may_differ_by_2_percent(self):
        self.assertIsNone(self.fault("fuse", "counted", "instructions", "102", "100"))
        self.assertIn("grew", self.fault("fuse", "counted", "instructions", "103", "100"))
        self.assertIn("shrank", self.fault("fuse", "counted", "instructions_max", "97", "100"))

    def test_what_was_done_may_not_differ_at_all(self):
        self.assertIsNone(self.fault("", "counted", "points", "100", "100"))
        self.assertIn("may not differ", self.fault("", "counted", "points", "101", "100"))
        self.assertIn("may not differ", self.fault("", "counted", "run_hash", "abc", "abd"))

    def test_of_a_small_stage_only_the_instructions_are_compared(self):
        self.assertIsNone(self.fault("mark", "nominal", "cycles", "150", "100"))
        self.assertIn("grew", self.fault("mark", "nominal", "instructions", "150", "100"))
        self.assertIn("grew", self.fault("carve", "nominal", "cycles", "150", "100"))

    def test_what_is_not_stored_is_a_fault(self):
        self.assertIn("not stored", self.fault("", "counted", "points", "1", None))

    def test_lines_that_differ_are_shown(self):
        with laboratory.Tables(stored="a\n1\n", found="a\n2\n") as folder:
            self.assertEqual(self.check.differences(folder / "stored.csv", folder / "found.csv"),
                             ["line 2: stored '1', found '2'"])
            self.assertEqual(self.check.differences(folder / "stored.csv", folder / "stored.csv"),
                             [])
            self.assertEqual(self.check.differences(folder / "stored.csv", folder / "none.csv"),
                             ["nothing makes it"])


if __name__ == "__main__":
    unittest.main()
