"""What lab/run and lab/check share: the steps, the commits at which they were measured, and what changed since."""

import importlib.machinery
import importlib.util
import pathlib
import tempfile
import unittest
from unittest import mock

import laboratory
import a9_runs
import measurements
import since


def script(name: str):
    """A program without .py as a module; its main() runs only as a program."""
    loader = importlib.machinery.SourceFileLoader(pathlib.Path(name).name, str(laboratory.ROOT / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


class Stamp(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        patch = mock.patch.multiple(measurements, DATA=self.root, MADE_FROM=self.root / "made_from",
                                    STEPS=("one/x", "two"), commit=lambda: "abc")
        patch.start()
        self.addCleanup(patch.stop)

    def test_a_step_keeps_its_commit_until_it_is_measured_again(self):
        measurements.MADE_FROM.write_text("gone 123\none/x 123\ntwo 123\n")
        measurements.write_stamps(["two"], "abc")
        self.assertEqual(measurements.stamps(), {"one/x": "123", "two": "abc"})

    def test_the_commit_is_that_of_before_the_tables_change(self):
        kind = measurements.Kind("", lambda folder, _parts, _recordings: (folder / "two.csv").write_text("a\n"))
        with mock.patch.multiple(measurements, KINDS={"two": kind}, WORK=self.root / "work",
                                 commit=lambda: "changed" if (self.root / "two.csv").exists() else "clean"):
            measurements.measure("two", [""])
        self.assertTrue((self.root / "two.csv").exists())
        self.assertEqual(measurements.stamps(), {"two": "clean"})

    def test_what_was_measured_of_one_part_of_the_target_leaves_the_others(self):
        head = ",".join(a9_runs.Row._fields)
        row = "{},,counted,points,{}".format
        (self.root / "cortex_a9.csv").write_text("\n".join(
            [head, row("frame_cost scene=city", 1), row("scaling sensors=1", 1), row("turning x", 1), ""]))
        (self.root / "found.csv").write_text("\n".join([head, row("scaling sensors=2", 2), ""]))
        measurements.keep_other_parts(self.root / "found.csv", ["scaling"])
        self.assertEqual((self.root / "found.csv").read_text().splitlines(), [
            head, row("frame_cost scene=city", 1), row("scaling sensors=2", 2), row("turning x", 1)])

    def test_drives_that_were_not_measured_keep_their_rows(self):
        (self.root / "found").mkdir()
        (self.root / "recorded_x.csv").write_text("drive,hits\na,1\nb,2\nc,3\n")
        (self.root / "found/recorded_x.csv").write_text("drive,hits\nb,4\nb,5\n")
        measurements.keep_other_drives(self.root / "found/recorded_x.csv")
        self.assertEqual((self.root / "found/recorded_x.csv").read_text(), "drive,hits\na,1\nb,4\nb,5\nc,3\n")


class Project(unittest.TestCase):
    """The steps as they are."""

    def test_run_and_build_know_the_same_pages(self):
        self.assertEqual(set(measurements.PAGES), set(script("lab/pages/build").PAGES))
        steps = {step for steps in measurements.PAGES.values() for step in steps}
        self.assertEqual(steps, set(measurements.STEPS))

    def test_each_step_was_measured_at_a_commit_by_a_program_that_is_there(self):
        self.assertEqual(set(measurements.stamps()), set(measurements.STEPS))
        for step in set(measurements.STEPS) - set(measurements.DECIDED):
            self.assertTrue((laboratory.ROOT / measurements.program_of(step)).exists(), step)


class Since(unittest.TestCase):
    """What three frames cost now: a change of 2 % is named, a smaller one is not."""

    RUNS = [frame.run for frame in since.FRAMES]

    def setUp(self):
        for name, value in (("measured", lambda: dict.fromkeys(self.RUNS, 1000)), ("TABLE", pathlib.Path("none"))):
            patch = mock.patch.object(since, name, value)
            patch.start()
            self.addCleanup(patch.stop)

    def far_off(self, now):
        return since.far_off(dict.fromkeys(self.RUNS, 1000) | {self.RUNS[0]: now})

    def test_two_percent_are_not_named_and_more_is(self):
        self.assertEqual(self.far_off(1020) + self.far_off(980), [])
        self.assertRegex(self.far_off(1021)[0], r"ring road.* takes 1,021 instructions, \+2\.1%.*pages say \+0\.0%")
        self.assertRegex(self.far_off(979)[0], r"-2\.1%")

    def test_what_the_pages_say_already_is_not_named(self):
        with laboratory.Tables(since=f"run,commit,instructions\n{self.RUNS[0]},abc,1100\n") as folder, \
                mock.patch.multiple(since, TABLE=folder / "since.csv", DATA=folder):
            self.assertEqual(self.far_off(1110), [])
            self.assertRegex(self.far_off(1000)[0], r"\+0\.0%.*pages say \+10\.0%")
            self.assertRegex(since.sentence(), r"^At commit abc, instruction counts differ .* by \+10\.0% \(ring road, .*\)\.$")

    def test_nothing_counted_since_says_nothing(self):
        self.assertEqual(since.sentence(), "")


if __name__ == "__main__":
    unittest.main()
