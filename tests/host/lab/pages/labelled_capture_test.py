"""What the scorers of a labelled capture say of a drive that is made here: a car at 5 m/s ahead of one that stands."""

import pathlib
import tempfile
import unittest

import numpy as np

import laboratory  # noqa: F401 ; it makes the others known
import evaluate
from labelled_capture import LabelledCapture
from recorded_drive_test import CAR
from trajectories import MovingObjects, Trajectory, followed, speed_band

STANDING, MOVING, FREE = 6 << 3, 4 << 3, 3 << 3
LEVEL = CAR.replace("pitch_deg = 10", "pitch_deg = 0")  # its unit is 1 m ahead of the origin and 1.75 m high


def trajectory(**changes):
    """10 turns of 0.1 s along x at 5 m/s, seen from its second turn on."""
    times = 0.1 * np.arange(10)
    return Trajectory(**{"thing": "1", "kind": "vehicle", "length_m": 4, "width_m": 2, "times": times, "x": 10 + 5 * times,
                         "y": np.zeros(10), "heading": np.zeros(10), "speeds_mps": np.full(10, 5.0),
                         "away_m": np.full(10, 20.0), "hits": np.array([19] + 9 * [20])} | changes)


class Velocity(unittest.TestCase):
    def objects(self, *rows):
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as out:
            out.write("time_us,id,x_mm,y_mm,vx_cm_s,vy_cm_s\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))
            out.flush()
            return MovingObjects(pathlib.Path(out.name), 100.0)

    def test_it_counts_from_the_first_turn_that_is_seen_to_the_first_object_in_the_box(self):
        its = followed(trajectory(), self.objects(
            (100_200_000, 7, 20_000, 0, 500, 0),       # elsewhere
            (100_400_000, 1, 12_000, 800, 500, 30),    # 0.3 m/s to the side
            (100_500_000, 1, 12_500, 0, 540, 30),      # 0.4 along, 0.3 across
            (100_500_000, 2, 14_000, 0, 900, 0)))      # the box's other end: the nearer one counts
        self.assertAlmostEqual(its.delay_s, 0.3)
        np.testing.assert_allclose(its.errors_mps, [0.3, 0.5], atol=1e-6)

    def test_without_an_object_it_is_never_published(self):
        its = followed(trajectory(), self.objects())
        self.assertEqual((its.delay_s, len(its.errors_mps)), (np.inf, 0))

    def test_what_is_far_or_slow_is_not_seen(self):
        self.assertIsNone(followed(trajectory(away_m=np.full(10, 40.0)), self.objects()))
        self.assertIsNone(followed(trajectory(speeds_mps=np.full(10, 1.0)), self.objects()))

    def test_bands_of_speed_have_their_upper_end(self):
        self.assertEqual([speed_band(value) for value in (0, 0.3, 0.31, 1, 3, 8, 8.1, np.nan)],
                         ["still", "still", "0.3 to 1 m/s", "0.3 to 1 m/s", "1 to 3 m/s", "3 to 8 m/s", "over 8 m/s",
                          "unknown"])


class Capture(unittest.TestCase):
    """Turns 8 to 19 but for 12, 0.1 s each. In each a hit on box 5, which moves, on box 6, which is parked, on a
    building, one that is too low, and two returns of the road: one beside box 6."""

    TURNS = [turn for turn in range(8, 20) if turn != 12]
    PLACES = {5: (20, 0, 1), 6: (10, 8, 1), 41: (5, -5, 1), 42: (8, -5, 0.2), 7: (15, 3, 0), 8: (10, 8.2, 0)}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "made.pcap").write_bytes(b"")
        (self.folder / "poses.csv").write_text("time_s,x_m,y_m,heading_deg\n" + "".join(
            f"{99 + i},0,0,0\n" for i in range(5)))
        boxes, returns = [], []
        for turn in self.TURNS:
            at_us = 100_000 * turn
            ahead = 0.5 * turn
            boxes += [f"{turn},5,Car,Moving,5.0,{20 + ahead},0,{-np.pi / 2},2,4", f"{turn},6,Car,Parked,0.0,10,8,0,2,4"]
            for name, (x, y, z) in self.PLACES.items():
                x += ahead if name == 5 else 0
                label = {5: 13, 6: 13, 42: 41, 8: 7}.get(name, name)
                returns.append((turn, at_us, (x - 1, y, z - 1.75), label, name if name in (5, 6) else 0, 1000 * z))
        (self.folder / "boxes.csv").write_text(
            "turn,box,kind,motion,speed_m_s,x_m,y_m,yaw_rad,width_m,length_m\n" + "\n".join(boxes) + "\n")
        turn, at_us, places, label, box, height = map(np.array, zip(*returns))
        np.savez(self.folder / "truth.npz", t0_s=100.0, turn=turn.astype("u1"), t_us=at_us, label=label.astype("u1"),
                 xyz=np.round(places / 0.002).astype("i2"), box=box.astype("u2"), height=height.astype("i2"))
        self.grids = self.folder / "grids"
        with open(self.grids, "wb") as out:
            for turn in range(22):
                cells = np.full((1024, 1024), FREE, np.uint8)
                cells[512, 512 + 200:] = MOVING
                cells[592, 612] = cells[462, 562] = STANDING
                out.write(np.array([100_000_000 + 100_000 * turn, 10, -16, -16, 0, 0], "<i8").tobytes() + cells.tobytes())

    def results(self):
        return LabelledCapture(self.folder, LEVEL).evaluate(LEVEL, evaluate.Frames(self.grids))

    def test_hits_are_of_their_kind_their_speed_and_their_range(self):
        """unknown, free, moving, standing, open"""
        found = {tuple(row[:3]): row[5:] for row in self.results().hits if row[4]}
        self.assertEqual(found, {("building", "", 0): [0, 0, 0, 11, 0], ("parked vehicle", "still", 0): [0, 0, 0, 11, 0],
                                 ("vehicle", "3 to 8 m/s", 0): [0, 0, 4, 0, 0], ("vehicle", "3 to 8 m/s", 25): [0, 0, 7, 0, 0],
                                 ("road", "", 0): [0, 11, 0, 0, 0]})

    def test_an_object_has_its_hits_and_apart_those_after_a_gap(self):
        self.assertEqual(self.results().things, [[5, "vehicle", 0, 0, 0, 4, 0, 0], [5, "vehicle", 1, 0, 0, 7, 0, 0]])

    def test_hits_on_vehicles_are_ground_where_the_same_beam_has_a_return_that_is(self):
        """In turn 9 box 5 is hit at (24.5, 0, 1) and box 6 at (10, 8, 1)."""
        lines = [(100_900_100, 24_510, 0, 1_000), (100_900_100, 10_000, 8_100, 1_000), (101_000_100, 10_000, 8_000, 1_000)]
        (self.folder / "ground").write_bytes(np.array(lines, "<i8").tobytes())
        self.assertEqual(LabelledCapture(self.folder, LEVEL).taken_for_ground(LEVEL, self.folder / "ground"), (22, 2))

    def test_the_trajectory_of_what_moves_is_where_its_returns_were_seen(self):
        its, = self.results().trajectories
        self.assertEqual((its.thing, its.length_m, its.width_m, list(its.hits)), ("5", 4, 2, 11 * [1]))
        np.testing.assert_allclose(its.times, 0.1 * np.array(self.TURNS))
        np.testing.assert_allclose(its.heading, 0, atol=1e-9)
        np.testing.assert_allclose(its.velocity(), [11 * [5.0], 11 * [0.0]], atol=1e-6)

    def test_a_folder_has_one_capture(self):
        (self.folder / "other.pcap.xz").write_bytes(b"")
        with self.assertRaisesRegex(ValueError, "2 captures; one is needed"):
            LabelledCapture(self.folder, LEVEL)


if __name__ == "__main__":
    unittest.main()
