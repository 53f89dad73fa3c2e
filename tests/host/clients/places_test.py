"""Does a place in the car's frame find its cell, and do the examples of docs/clients.md say what is there?"""

import contextlib
import io
import math
import random
import socket
import unittest
from unittest import mock

import streams
from code_blocks import code_blocks
from made_classes import FREE, LOST, MOVING, OCCUPIED, class_byte
from stream_test import received

import grid_stream
import iogrid
import made_classes
import made_stream
import numpy
from object_parts import MOVES, Object


def frame_with(window: made_classes.Window, grid: made_stream.Grid | None = None) -> iogrid.Frame:
    frame, = received(made_stream.Target(0).messages_of(grid or made_stream.Grid(), 1, window))[0]
    return frame


class Watched(unittest.TestCase):
    def frame_of(self, unwatched: int) -> iogrid.Frame:
        target = made_stream.Target(0)
        target.unwatched = unwatched
        frame, = received(target.messages_of(made_stream.Grid(), 1))[0]
        return frame

    def test_the_sector_ahead(self):
        """64 sectors of 0.098 rad, counter-clockwise: 62 and 63 are to the right of straight ahead, 0 and 1 to the left."""
        self.assertTrue(self.frame_of(0).is_watched(-0.19, 0.19))
        for sector in (62, 63, 0, 1):
            self.assertFalse(self.frame_of(1 << sector).is_watched(-0.19, 0.19), sector)
        self.assertTrue(self.frame_of(2 ** 62 - 4).is_watched(-0.19, 0.19))  # all but these

    def test_all_around_and_across_behind(self):
        self.assertTrue(self.frame_of(0).is_watched(-math.pi, math.pi))
        self.assertFalse(self.frame_of(1 << 32).is_watched(-math.pi, math.pi))
        self.assertFalse(self.frame_of(1 << 31).is_watched(3.1, 3.2))
        self.assertTrue(self.frame_of(1 << 31).is_watched(3.15, 3.2))

    def test_covered(self):
        target = made_stream.Target(0)
        target.unwatched, target.blocked = 0b11 << 62 | 0b11, 0b1
        frame, = received(target.messages_of(made_stream.Grid(), 1))[0]
        self.assertFalse(frame.is_watched(-0.19, 0.19))
        self.assertTrue(frame.is_blocked(-0.19, 0.19))
        self.assertFalse(frame.is_blocked(-0.19, -0.01))

    def test_without_its_end_nothing_is_watched(self):
        (frame,), receiver = received(streams.with_a_short_end())
        self.assertEqual((frame.is_whole, receiver.dropped), (False, {"malformed": 1}))
        self.assertEqual((frame.unwatched, frame.blocked, frame.temperature_c), (None, None, None))
        self.assertFalse(frame.is_watched(0, 0.1))

    def test_how_warm_the_chip_is(self):
        target = made_stream.Target(0)
        for tenths, degrees in ((853, 85.3), (-55, -5.5), (-0x8000, None)):
            target.temperature_dc = tenths
            frame, = received(target.messages_of(made_stream.Grid(), 1))[0]
            self.assertEqual(frame.temperature_c, degrees)
            self.assertTrue(frame.is_watched(0, 1))

    def test_no_sector(self):
        for begin, end in ((0.2, 0.1), (0, 7), (math.nan, 0)):
            with self.assertRaises(ValueError):
                self.frame_of(0).is_watched(begin, end)


class Places(unittest.TestCase):
    def test_a_cell_of_the_occupancy_grid(self):
        grid = made_stream.Grid()
        grid.set(512 + 30, 512 - 21, 7)  # its corner of lowest x and y is at (3.0, -2.1) m
        frame = frame_with(made_classes.Window(), grid)
        places = ((3.01, -2.09), (3.09, -2.01), (3.11, -2.05), (3.05, -1.99))
        self.assertEqual([frame.index_at(*place) for place in places], [7, 7, 0, 0])
        self.assertEqual([frame.index_at(*place) for place in ((51.3, 0), (0, -51.3), (1e9, 0))], [0, 0, 0])

    def test_a_grid_says_where_it_is_and_its_epsilon(self):
        """A rectangle 25.6 x 16 m ahead of the car, of cells of 5 cm."""
        grid = made_stream.Grid(512, 320, 50, (0, -8000), 10_000)
        grid.set(511, 3, 2)  # its corner of lowest x and y is at (25.55, -7.85) m
        frame = frame_with(made_classes.Window(), grid)
        self.assertTrue(frame.is_whole)
        self.assertEqual((frame.indexes.shape, frame.indexes_lost.shape), ((320, 512), (10, 16)))
        places = ((25.57, -7.83), (25.61, -7.83), (25.54, -7.83), (-0.01, 0), (1, 8.01))
        self.assertEqual([frame.index_at(*place) for place in places], [2, 0, 0, 0, 0])
        self.assertEqual(frame.geometry.epsilon, 0.1)
        self.assertAlmostEqual(iogrid.probability(2, frame.geometry.epsilon), 36 / 52)  # 1 / (1 + (4/6)^2)

    def test_a_long_grid(self):
        """204.8 x 51.2 m, most of it ahead of the car."""
        grid = made_stream.Grid(2048, 512, 100, (-4800, -25600))
        grid.set(2040, 500, 3)  # its corner of lowest x and y is at (199.2, 24.4) m
        frame = frame_with(made_classes.Window(), grid)
        self.assertTrue(frame.is_whole)
        self.assertEqual((frame.indexes.shape, frame.indexes_lost.shape), ((512, 2048), (16, 64)))
        self.assertEqual([frame.index_at(x, 24.45) for x in (199.25, 199.35)], [3, 0])

    def test_probability_is_that_of_the_recursive_set(self):
        """The table of docs/model.md, section 2."""
        table = {-14: 0.057, -7: 0.197, 0: 0.5, 1: 0.55, 2: 0.599}
        for value, (index, expected) in zip(iogrid.probability(numpy.array([*table], numpy.int8), 0.05), table.items()):
            self.assertAlmostEqual(value, expected, delta=0.0005, msg=index)
        self.assertAlmostEqual(iogrid.probability(numpy.int8([-127]), 0.05)[0], 8.5e-12, delta=1e-13)

    def test_a_probability_is_of_the_cars_own_epsilon(self):
        """By hand: (49/51)^10 = 0.6703, (9/11)^10 = 0.1344."""
        indexes = numpy.array([[10, 0], [-10, 127]], numpy.int8)
        self.assertTrue(numpy.allclose(iogrid.probability(indexes, 0.01), [[0.5987, 0.5], [0.4013, 0.9938]], atol=1e-4))
        self.assertAlmostEqual(iogrid.probability(indexes, epsilon=0.05)[0, 0], 0.8815, places=4)
        self.assertRaises(TypeError, iogrid.probability, indexes)
        for no_epsilon in (0, 0.5, -0.1, math.nan):
            self.assertRaises(ValueError, iogrid.probability, indexes, no_epsilon)

    def test_a_class_where_the_car_has_turned(self):
        """The car is at (10, 20) m of the local frame and looks along its y: 5 m before it is (10, 25)."""
        window = made_classes.Window(10.0, 20.0, 0.25)
        window.fill(range(98, 102), range(248, 252), class_byte(OCCUPIED))
        frame = frame_with(window)
        self.assertEqual(frame.class_at(5.0, 0.0), iogrid.Class.OCCUPIED)
        self.assertEqual(frame.class_at(5.3, 0.0), iogrid.Class.UNKNOWN)
        self.assertEqual(frame.class_at(0.0, 5.0), iogrid.Class.UNKNOWN)
        self.assertEqual((frame.window.pose.x_m, frame.window.pose.y_m), (10, 20))
        self.assertAlmostEqual(frame.window.pose.heading_rad, math.pi / 2)
        places = frame.places(iogrid.Class.OCCUPIED)
        numpy.testing.assert_allclose(sorted(map(tuple, places.round(6))), [
            (x, y) for x in (4.85, 4.95, 5.05, 5.15) for y in (-0.15, -0.05, 0.05, 0.15)], atol=1e-6)
        row, column = frame.cell_at(5.0, 0.01)
        self.assertEqual((row, column), (250 + 16 * 32, 99 + 16 * 32))

    def test_a_window_that_is_a_rectangle(self):
        """9 by 7 tiles; the cell 5 m before the car is in tile (3, 7), whose number is 7 % 7 * 9 + 3 % 9."""
        window = made_classes.Window(10.0, 20.0, 0.25, corner=(-2, 3), sides=(9, 7))
        window.fill(range(98, 102), range(248, 252), class_byte(OCCUPIED))
        self.assertEqual([number for number, _ in window.by_slot], [3])
        frame = frame_with(window)
        self.assertEqual(frame.classes.shape, (7 * 32, 9 * 32))
        self.assertEqual(frame.class_at(5.0, 0.0), iogrid.Class.OCCUPIED)
        self.assertEqual(frame.class_at(5.3, 0.0), iogrid.Class.UNKNOWN)
        self.assertEqual(frame.cell_at(5.0, 0.01), (250 - 3 * 32, 99 + 2 * 32))
        self.assertIsNone(frame.cell_at(12.1, 0))  # y is 32 m, the window ends at 10 tiles of 3.2 m
        self.assertIsNotNone(frame.cell_at(11.9, 0))

    def test_nothing_is_free_without_a_place(self):
        window = made_classes.Window().without_pose().without_place(LOST, 7)
        window.fill(range(-400, 400), range(-400, 400), class_byte(FREE))
        frame = frame_with(window)
        self.assertIsNone(frame.window.pose)
        self.assertIn(iogrid.Cause.LOST, frame.window.causes)
        self.assertIsNone(frame.cell_at(0, 0))
        self.assertFalse(frame.is_free((1, 2), (-1, 1)))
        self.assertEqual(len(frame.places(iogrid.Class.FREE)), 0)
        self.assertEqual(iogrid.Class(frame.classes[512, 512]), iogrid.Class.FREE)

    def test_a_rectangle_is_free_if_all_that_it_touches_is(self):
        """Against points of it every 2 cm; and whatever is not free is at most a cell's diagonal away."""
        rng, answers = random.Random(5), []
        for _ in range(12):
            window = made_classes.Window(rng.uniform(-3, 3), rng.uniform(-3, 3), rng.random())
            window.fill(range(-250, 250), range(-250, 250), class_byte(FREE))
            for _ in range(150):
                window.fill(*((range(at, at + 1)) for at in (rng.randrange(-250, 250), rng.randrange(-250, 250))),
                            rng.choice((0, class_byte(OCCUPIED), class_byte(MOVING))))
            frame = frame_with(window)
            for _ in range(30):
                x, y = rng.uniform(-12, 12), rng.uniform(-12, 12)
                x_m, y_m = (x, x + rng.uniform(0, 4)), (y, y + rng.uniform(0, 2))
                is_free = frame.is_free(x_m, y_m)
                answers.append(is_free)
                self.assertLessEqual(is_free, self.are_points_free(frame, x_m, y_m, 0))
                self.assertGreaterEqual(is_free, self.are_points_free(frame, x_m, y_m, 0.142))
        self.assertTrue(30 < sum(answers) < len(answers) - 30, sum(answers))

    @staticmethod
    def are_points_free(frame: iogrid.Frame, x_m, y_m, more_m: float) -> bool:
        steps = [numpy.append(numpy.arange(low - more_m, high + more_m, 0.02), high + more_m)
                 for low, high in (x_m, y_m)]
        x, y = numpy.meshgrid(*steps)
        column, row = (numpy.floor(each).astype(int) for each in frame.window.to_cells(x, y))
        return bool(numpy.isin(frame.classes[row, column], iogrid.FREE_CLASSES).all())

    def test_what_is_outside_or_lost_is_not_free(self):
        window = made_classes.Window()
        window.fill(range(-512, 512), range(-64, 64), class_byte(FREE))
        messages = made_stream.Target(0).messages_of(made_stream.Grid(), 1, window)
        whole, = received(messages)[0]
        self.assertTrue(whole.is_free((0, 51), (-6, 6)))
        self.assertFalse(whole.is_free((0, 51.3), (-1, 1)))
        self.assertFalse(whole.is_free((0, math.inf), (-1, 1)))
        with self.assertRaises(ValueError):
            whole.is_free((3, 1), (-1, 1))
        with self.assertRaises(ValueError):
            whole.is_free((math.nan, 1), (-1, 1))
        a_tile = next(i for i, message in enumerate(messages) if message[28] == 1 and message[83] == 2)
        part, = received(messages[:a_tile] + messages[a_tile + 1:])[0]
        self.assertEqual(part.classes_lost.sum(), 1)
        self.assertFalse(part.is_free((-51, 51), (-6, 6)))


class Examples(unittest.TestCase):
    EXAMPLES = code_blocks((streams.ROOT / "docs/clients.md").read_text(), "python")

    def said(self, example: str, frames: list) -> list[str]:
        said = io.StringIO()
        with mock.patch.object(iogrid, "listen", lambda port=15000: iter(frames)), contextlib.redirect_stdout(said):
            exec(example, {})  # noqa: S102
        return said.getvalue().splitlines()

    def test_there_are_two_of_some_ten_lines(self):
        lines = [[line for line in example.splitlines() if line and not line.startswith("import")]
                 for example in self.EXAMPLES]
        self.assertEqual([len(each) <= 10 for each in lines], [True, True], lines)

    def test_is_this_strip_free(self):
        window = made_classes.Window()
        window.fill(range(0, 200), range(-30, 30), class_byte(FREE))
        free = frame_with(window)
        window.fill(range(80, 82), range(-1, 2), class_byte(OCCUPIED))
        self.assertEqual(self.said(self.EXAMPLES[0], [free, None, frame_with(window)]),
                         ["0 free", "the target is silent", "0 not known to be free: OCCUPIED"])

    def test_what_comes_towards_me(self):
        """The car drives with 10 m/s along y of the local frame. 30 m before it something comes with 5 m/s; another goes
        as fast as the car, a third is not believed to move, a fourth is behind and faster. In the third frame the car's
        place jumps, in the fourth a message of objects is lost."""
        target, frames = made_stream.Target(0), []
        for number in range(4):
            window = made_classes.Window(10.0, 20.0 + 0.4 * number, 0.25)
            window.stamp_us += 40_000 * number
            window.causes = made_classes.JUMP if number == 2 else 0
            window.objects = [Object(each, MOVES, x_mm=10_000, y_mm=y_mm, vy_cm_s=vy, sigma_v_along=30, sigma_v_across=20)
                              for each, y_mm, vy in ((3, 50_420, -500), (4, 60_400, 1000), (9, 5_340, 1500))]
            window.objects.insert(2, Object(8, x_mm=10_000, y_mm=70_000))
            frames.append(target.messages_of(made_stream.Grid(), 1, window))
        frames[3] = [message for message in frames[3] if message[28] != grid_stream.OBJECTS]
        frames, _ = received([message for messages in frames for message in messages])
        self.assertEqual(self.said(self.EXAMPLES[1], [frames[0], None, *frames[1:]]), [
            "not known", "not known", "3: 30.0 m away, 15.0 m/s towards me, give or take 0.6",
            "9: 15.0 m away, 5.0 m/s towards me, give or take 0.6", "not known", "not known"])
        self.assertEqual([frame.velocity for frame in frames], [None, (0, 10), None, (0, 10)])
        self.assertIsNone(frames[1].closing(frames[1].objects[2]))
        x, y = frames[1].window.from_local(frames[1].objects[0].x_m, frames[1].objects[0].y_m)
        self.assertAlmostEqual(x, 30.02)
        self.assertAlmostEqual(y, 0.0)


class Live(unittest.TestCase):
    def test_frames_and_silence(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        receiver = iogrid.Receiver()
        live = iogrid.listen(port, receiver=receiver)
        self.assertIsNone(next(live))
        messages = streams.messages_of(streams.raw())
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            for message in [b"garbage", *messages[:-1]]:
                sender.sendto(message, ("127.0.0.1", port))
            self.assertTrue(next(live).is_whole)
            part = next(live)  # after half a second, without its end
            self.assertFalse(part.is_whole)
            self.assertIsNone(next(live))
        self.assertEqual((receiver.dropped, receiver.used), ({"not ours": 1}, len(messages) - 1))
        live.close()


if __name__ == "__main__":
    unittest.main()
