"""How the hits of a recorded drive are found and told apart, on clouds and grids that are made here."""

import pathlib
import tempfile
import unittest

import numpy as np

import laboratory  # noqa: F401 ; it makes the others known
import car as cars
import evaluate
from drive import Drive, Thing

LASERS = "".join(f"{{ elevation_deg = {2 - 0.4 * i:.1f}, azimuth_deg = 0, height_m = 0.2, range_m = 0 }}, "
                 for i in range(64))
CAR = f"""name = "car"
z_min_m = 0.3
z_max_m = 2.2
footprint = {{ x_min_m = -1, x_max_m = 3, y_min_m = -1, y_max_m = 1 }}

[[sensors]]
type = "velodyne_hdl64e_s2"
mount = {{ x_m = 1, y_m = 0, z_m = 1.75, pitch_deg = 10 }}
lasers = [ {LASERS}]
"""


class CarFile(unittest.TestCase):
    def test_keys_take_the_place_of_others_or_come_first(self):
        changed = cars.with_keys(CAR + "[[sensors]]\nname = \"other\"\n", "new", {"z_max_m": "2.0", "grids": '"classes"'},
                                 {"ground": "{ low_m = 0.2 }", "type": '"velodyne_hdl64e_s3"'})
        self.assertEqual(changed.count("name = \"new\""), 1)
        self.assertEqual(changed.count("z_max_m = 2.0"), 1)
        self.assertTrue(changed.startswith('grids = "classes"\nname = "new"\n'))
        first = changed.split("[[sensors]]\n")[1]
        self.assertTrue(first.startswith("ground = { low_m = 0.2 }\n"))
        self.assertIn('type = "velodyne_hdl64e_s3"', first)
        self.assertIn('name = "other"', changed.split("[[sensors]]\n")[2])

    def test_a_mount_is_pitched_more_and_nothing_else_changes(self):
        pitched = cars.pitched(CAR, -0.5)
        self.assertEqual(cars.Car(pitched).pitch_deg, 9.5)
        np.testing.assert_array_equal(cars.Car(pitched).place, cars.Car(CAR).place)
        self.assertEqual([line for line in pitched.splitlines() if "mount" not in line],
                         [line for line in CAR.splitlines() if "mount" not in line])
        self.assertEqual(cars.pitched(CAR, 0), CAR)

    def test_a_positive_pitch_looks_down(self):
        """ISO 8855, as tools/car/description.hpp says."""
        ahead = cars.Car(CAR).in_vehicle(np.array([[10.0, 0, 0]]))[0]
        np.testing.assert_allclose(ahead, [1 + 10 * np.cos(np.radians(10)), 0, 1.75 - 10 * np.sin(np.radians(10))])

    def test_a_point_is_of_the_laser_whose_cone_is_nearest(self):
        car = cars.Hdl64e(CAR)
        for laser in (0, 31, 63):
            rise = np.tan(np.radians(2 - 0.4 * laser))
            point = np.array([[6.0, 8.0, 0.2 / np.cos(np.arctan(rise)) + 10 * rise + 0.01]])
            self.assertEqual(car.lasers_of(point)[0], laser)

    def test_a_car_without_the_unit_is_refused(self):
        with self.assertRaisesRegex(ValueError, "velodyne_hdl64e_s2"):
            cars.Hdl64e(CAR.replace("hdl64e_s2", "vlp16"))


class Clouds(unittest.TestCase):
    def test_the_road_is_found_beside_a_wall(self):
        random = np.random.default_rng(1)
        x, y = random.uniform(-18, 18, 20_000), random.uniform(-5, 5, 20_000)
        road = np.column_stack([x, y, 0.014 * x - 0.003 * y - 1.75 + random.normal(0, 0.02, len(x))])
        wall = np.column_stack([random.uniform(-10, 10, 5_000), np.full(5_000, 4.5), random.uniform(-1.5, 2, 5_000)])
        np.testing.assert_allclose(evaluate.road_of(np.vstack([road, wall])), [0.014, -0.003, -1.75], atol=0.004)

    def test_squares_have_their_lowest_and_highest(self):
        code = evaluate.squares(np.array([0.1, 0.4, -0.1, 0.2]), np.array([0.1, 0.2, 0.1, 0.49]), 2)
        found, count, low, top = evaluate.grouped(code, np.array([1.0, 5, 7, 3]))
        self.assertEqual(list(found), sorted(set(code)))
        self.assertEqual(sorted(zip(count, low, top)), [(1, 7, 7), (3, 1, 5)])

    def test_a_box_is_turned_as_its_label_says(self):
        thing = Thing("Car", 1.5, 2, 4, np.array([0]), np.zeros((1, 4)), None)
        place = np.array([10, 0, -1.7, np.pi / 2])
        points = np.array([[10, 1.9, -1], [11.9, 0, -1], [10, 0, 0.2], [10, 0, -2], [10, 2.05, -1]], float)
        self.assertEqual(list(thing.holds(points, place, 0)), [True, False, False, False, False])
        self.assertEqual(list(thing.holds(points, place, 0.1)), [True, False, False, False, True])


class Said(unittest.TestCase):
    """Two frames; a wall of standing cells in the first."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "grids"
        with open(self.path, "wb") as out:
            for frame, words in enumerate([(1_000_000, 8, -16, -16, 0, 0), (1_040_000, 8, -15, -16, 0, 0)]):
                cells = np.full((1024, 1024), 3 << 3, np.uint8)
                if frame == 0:
                    cells[512, 522] = 6 << 3 | 5
                    cells[700, 700] = 0
                out.write(np.array(words, "<i8").tobytes() + cells.tobytes())
        self.frames = evaluate.Frames(self.path)

    def test_a_cell_is_where_the_window_has_it(self):
        column, row, inside = self.frames.cells_of(1, np.array([1.0, -48.1]), np.array([0.0, 0.0]))
        self.assertEqual((column[0], row[0]), (490, 512))
        self.assertEqual(list(inside), [True, False])

    def test_a_hit_takes_the_name_of_an_occupied_neighbour_only_if_it_may(self):
        x, y = np.array([1.05, 1.15, 1.15, 1.35, 70]), np.full(5, 0.05)
        alone, named = evaluate.said_of(self.frames, np.zeros(5, int), x, y,
                                        np.array([True, True, False, True, True]))
        self.assertEqual(list(alone), [6, 3, 3, 3, 255])
        self.assertEqual(list(named), [6, 6, 3, 3, 255])

    def test_areas_are_square_metres_around_the_car(self):
        free, moving, standing, opened = evaluate.areas_of(self.frames, 0)
        self.assertAlmostEqual(free, np.pi * 40**2, delta=3)
        self.assertEqual((moving, standing, opened), (0, 0.01, 0))

    def test_a_file_that_breaks_off_is_refused(self):
        self.path.write_bytes(self.path.read_bytes()[:-1])
        with self.assertRaises(ValueError):
            evaluate.Frames(self.path)


class Recording(unittest.TestCase):
    """A car that drives 10 m/s east and turns by a degree every tenth of a second."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for part in ("oxts/data", "velodyne_points/data"):
            (self.folder / part).mkdir(parents=True)
        stamps = "".join(f"2011-09-26 13:02:2{5 + i // 10}.{i % 10}00000000\n" for i in range(20))
        for part in ("oxts", "velodyne_points"):
            (self.folder / part / "timestamps.txt").write_text(stamps)
        metres = np.cos(np.radians(49)) * radius_at(49)
        for i in range(20):
            words = ["49", f"{8 + np.degrees(i / metres):.12f}", "0", "0", "0", f"{np.radians(i):.9f}"]
            (self.folder / f"oxts/data/{i:010d}.txt").write_text(" ".join(words) + "\n")
            np.array([[5, 0, -1, 0.3], [0, 5, -1, 0.3], [-5, 0.001, -1, 0.3]], "<f4").tofile(
                self.folder / f"velodyne_points/data/{i:010d}.bin")

    def test_between_poses_it_moves_evenly(self):
        x, y, heading = Drive(self.folder, 0, 0).pose(np.array([0.55, 1.2]))
        np.testing.assert_allclose(x, [5.5, 12], atol=1e-3)
        np.testing.assert_allclose(y, 0, atol=1e-3)
        np.testing.assert_allclose(np.degrees(heading), [5.5, 12], atol=1e-6)

    def test_the_head_turns_clockwise_from_rear_to_rear(self):
        drive = Drive(self.folder, 0, 0)
        np.testing.assert_allclose(drive.seen_at(10, drive.cloud(10)), [1.0, 0.975, 0.95], atol=1e-4)
        self.assertAlmostEqual(float(drive.turns_at(np.array(1.025))), 10.25, places=4)

    def test_what_stands_still_is_seen_to(self):
        """10 m ahead of the unit, which is 1 m ahead of the car's origin, seen from the origin."""
        drive = Drive(self.folder, 1, 0)
        x, y = drive.unit_world(0, np.array([[10.0, 0, 0]]))
        np.testing.assert_allclose([x[0], y[0]], [11, 0], atol=1e-3)

    def test_a_cloud_without_a_time_is_told(self):
        (self.folder / "velodyne_points/data/0000000020.bin").write_bytes(b"")
        with self.assertRaisesRegex(ValueError, "21 clouds of 20 times"):
            Drive(self.folder, 0, 0)


def radius_at(latitude):
    """Across the meridian, WGS 84."""
    return 6_378_137 / np.sqrt(1 - 0.00669437999014 * np.sin(np.radians(latitude))**2)


if __name__ == "__main__":
    unittest.main()
