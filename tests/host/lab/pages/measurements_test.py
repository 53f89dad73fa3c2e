"""What lab/run and lab/check share: the steps, and what lab/data was made from."""

import importlib.machinery
import importlib.util
import pathlib
import re
import tempfile
import unittest
from unittest import mock

import laboratory
import a9_runs
import measurements


def script(name: str):
    """A program without .py as a module; its main() runs only as a program."""
    loader = importlib.machinery.SourceFileLoader(pathlib.Path(name).name, str(laboratory.ROOT / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


class Stamp(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        root = pathlib.Path(self.folder.name)
        for name in ("src/a.cpp", "lab/data/t.csv", "lab/pages/build", "tools/view/page.js"):
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(name)
        patches = {"ROOT": root, "DATA": root / "lab/data",
                   "MADE_FROM": root / "lab/data/made_from"}
        for name, value in patches.items():
            patch = mock.patch.object(measurements, name, value)
            patch.start()
            self.addCleanup(patch.stop)
        self.root = root

    def stamp_all(self):
        for step in measurements.STEPS:
            measurements.write_stamp(step)

    def test_without_a_stamp_everything_has_to_be_checked(self):
        self.assertIn("other sources", measurements.what_changed())

    def test_with_one_nothing_has_to_be(self):
        self.stamp_all()
        self.assertEqual(measurements.what_changed(), "")

    def test_a_source_that_changes_or_comes_or_goes_is_seen(self):
        self.stamp_all()
        for name, text in (("src/a.cpp", "other"), ("src/b.cpp", "")):
            before = measurements.sources()
            (self.root / name).write_text(text)
            self.assertNotEqual(measurements.sources(), before)
            self.assertIn("experiments, target", measurements.what_changed())
        before = measurements.sources()
        (self.root / "src/b.cpp").unlink()
        self.assertNotEqual(measurements.sources(), before)

    def test_words_and_the_view_change_no_figure(self):
        self.stamp_all()
        for name in ("lab/pages/build", "tools/view/page.js", "src/README.md"):
            (self.root / name).write_text("other")
        self.assertEqual(measurements.what_changed(), "")

    def test_a_table_that_was_edited_is_seen(self):
        self.stamp_all()
        (self.root / "lab/data/t.csv").write_text("typed")
        self.assertIn("by hand", measurements.what_changed())

    def test_one_step_alone_leaves_the_others_stale(self):
        measurements.write_stamp("images")
        self.assertIn("(experiments, target, a9_model)", measurements.what_changed())


    def test_times_beside_other_libraries_are_of_what_they_time(self):
        """Another page, view or simulator command does not make them old; src/ does."""
        self.assertFalse(measurements.are_peers_current())
        self.stamp_all()
        for name in ("tools/view/page.js", "lab/pages/build", "src/README.md", "lab/target/run"):
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text("other")
            self.assertTrue(measurements.are_peers_current(), name)
        (self.root / "src/a.cpp").write_text("other")
        self.assertFalse(measurements.are_peers_current())
        measurements.write_stamp("experiments")
        self.assertFalse(measurements.are_peers_current())
        measurements.write_stamp("peers")
        self.assertTrue(measurements.are_peers_current())

    def test_old_times_leave_the_other_tables_current(self):
        self.stamp_all()
        stale = measurements.stamps() | {"peers": "0"}
        measurements.MADE_FROM.write_text("".join(f"{key} {stale[key]}\n" for key in stale))
        self.assertEqual(measurements.what_changed(), "")
        self.assertFalse(measurements.are_peers_current())


def room_of(name: str) -> pathlib.Path | None:
    """The file that an #include "name" of the peers program means, if it is one of ours."""
    found = [base / name for base in (laboratory.ROOT / "src", laboratory.ROOT)]
    return next((path for path in found if path.is_file()), None)


class Peers(unittest.TestCase):
    def test_all_that_is_timed_is_among_the_sources(self):
        """Whoever is included by what is timed, and the .cpp beside it, but for tools/: its part is
        to make the beams."""
        rooms = measurements.PEERS_SOURCES
        self.assertTrue({"tools/simulate", "tools/vehicles", "vehicles"} <= set(rooms))
        waiting, seen = sorted((laboratory.ROOT / "lab/peers").glob("*.cpp")), set()
        while waiting:
            path = waiting.pop()
            name = path.relative_to(laboratory.ROOT).as_posix()
            if path in seen or name.startswith("tools/"):
                continue
            seen.add(path)
            self.assertTrue(any(name.startswith(f"{room}/") for room in rooms), name)
            includes = re.findall(r'^#include "([^"]+)"', path.read_text(), re.M)
            waiting += [found for each in includes if (found := room_of(each))]
            waiting += [beside for beside in [path.with_suffix(".cpp")] if beside.is_file()]
        self.assertGreater(len(seen), 50)


class Programs(unittest.TestCase):
    def test_run_and_build_know_the_same_pages(self):
        self.assertEqual(set(measurements.PAGES), set(script("lab/pages/build").PAGES))


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
