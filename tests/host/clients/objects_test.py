"""Do both readers of clients/ say of objects what docs/spec.md 3.12 says, all of a frame's or none?"""

import dataclasses
import math
import random
import struct
import unittest

import c_test
import streams
from hostile_test import SEED, mutated
from object_parts import END_HIDDEN, HAS_HEADING, MOVES, NOT_HIT, STANDS, STOPPED, YOUNG, Object
from stream_test import received

import grid_stream
import iogrid
import made_classes
import made_stream
import protected_message

BODY, RECORD = 76, 100  # of a message
COMES = Object(7, MOVES, 212, 30, -12_345, 6_789, 420, 180, 0xC000, HAS_HEADING | END_HIDDEN, -1234, 56, 40, 30, 120, 80)


def messages_of(*lists: list[Object] | None) -> list[bytes]:
    """A frame each, without a cell that is known."""
    target, messages = made_stream.Target(0), []
    for number, objects in enumerate(lists):
        window = made_classes.Window()
        window.stamp_us += 40_000 * number
        window.objects = objects
        messages += target.messages_of(made_stream.Grid(), 1, window)
    return messages


def is_of_objects(message: bytes) -> bool:
    return message[28] == grid_stream.OBJECTS


def many(count: int) -> list[Object]:
    return [dataclasses.replace(COMES, id=3 * i + 1, x_mm=100 * i) if i % 3 == 0 else Object(3 * i + 1, 1 + i % 2)
            for i in range(count)]


def with_bytes(message: bytes, at: int, data: bytes) -> bytes:
    """The same with other bytes of its body, from a sender that means well."""
    return with_body(message, message[BODY:at] + data + message[at + len(data):])


def with_body(message: bytes, body: bytes) -> bytes:
    return protected_message.protect(message[28:BODY] + body, struct.unpack_from(">I", message, 32)[0])


class Objects(unittest.TestCase):
    def compare(self, messages: list[bytes]) -> list[iogrid.Frame]:
        """The frames, of which both readers say the same."""
        frames, receiver = received(messages)
        dropped = sum(count for cause, count in receiver.dropped.items() if not cause.startswith(("tile", "grid")))
        said = c_test.said_by(c_test.program("gcc"), messages)
        self.assertEqual(said, [*map(c_test.line_of, frames), f"used {receiver.used} dropped {dropped}"])
        return frames

    def test_each_field(self):
        stopped = Object(8, STOPPED, 0, 65535, 5, -6, 10, 20, 0, NOT_HIT, sigma_v_along=1, sigma_v_across=2,
                         since_hit_ms=80, since_stopped=123)
        frame, = self.compare(messages_of([COMES, stopped, Object(9, YOUNG), Object(10, STANDS)]))
        self.assertTrue(frame.is_whole)
        comes, has_stopped, young, stands = frame.objects
        self.assertEqual((comes.id, comes.state, comes.age_frames, comes.time_us), (7, iogrid.State.MOVES, 30, 99_996_000))
        self.assertEqual((comes.x_m, comes.y_m, comes.length_m, comes.width_m), (-12.345, 6.789, 4.2, 1.8))
        self.assertEqual((comes.heading_rad, comes.is_hit, comes.is_end_hidden), (1.5 * math.pi, True, True))
        self.assertEqual((comes.vx_m_s, comes.vy_m_s, comes.sigma_v_m_s, comes.sigma_m),
                         (-12.34, 0.56, (0.4, 0.3), (0.12, 0.08)))
        self.assertAlmostEqual(comes.existence, 10 / 12, delta=0.005)
        self.assertEqual((comes.since_hit_s, comes.since_stopped_s), (0, None))
        self.assertEqual((has_stopped.heading_rad, has_stopped.is_hit, has_stopped.is_end_hidden), (None, False, False))
        self.assertEqual((has_stopped.since_hit_s, has_stopped.since_stopped_s), (0.08, 1.23))
        self.assertEqual([each.is_believed for each in frame.objects], [True, True, False, False])
        self.assertEqual([each.sigma_v_m_s for each in (young, stands)], 2 * [(math.inf, math.inf)])

    def test_where_it_is_later(self):
        """Half a mm up, as both round; the deviation is not less than it may be."""
        frame, = received(messages_of([COMES, Object(9)]))[0]
        comes, young = frame.objects
        self.assertEqual(comes.at(comes.time_us), (-12.345, 6.789, 0.12))
        self.assertEqual(comes.at(comes.time_us + 500_000), (-18.515, 7.069, 0.32))
        self.assertEqual(comes.at(comes.time_us - 100_000), (-11.111, 6.733, 0.16))
        self.assertEqual(comes.at(comes.time_us + 1), (-12.345, 6.789, 0.121))
        self.assertIsNone(comes.at(comes.time_us + 10_000_001))
        self.assertIsNone(young.at(young.time_us))

    def test_nothing_is_not_the_same_as_not_known(self):
        frames = self.compare(messages_of([], None, [COMES]))
        self.assertEqual([each.objects if not each.objects else len(each.objects) for each in frames], [[], None, 1])
        window = made_classes.Window().without_place(made_classes.LOST, 7)
        window.objects = []
        frame, = self.compare(made_stream.Target(0).messages_of(made_stream.Grid(), 1, window))
        self.assertIsNone(frame.objects)
        self.assertTrue(frame.is_whole)

    def test_lists_in_parts_and_in_any_order(self):
        for count in (32, 33, 256):
            messages = messages_of(many(count), many(count))
            rng = random.Random(SEED)
            for _ in range(3):
                frames = self.compare(messages)
                self.assertEqual([[each.id for each in frame.objects] for frame in frames],
                                 2 * [[each.id for each in many(count)]])
                self.assertTrue(all(frame.is_whole for frame in frames))
                messages.sort(key=lambda message: streams.frame_of(message) + 0.9 * rng.random())

    def test_of_a_lost_part_nothing_is_said(self):
        messages = messages_of(many(70), many(70))
        for lost, message in enumerate(messages):
            if is_of_objects(message):
                frames = self.compare(messages[:lost] + messages[lost + 1:])
                self.assertEqual([frame.objects is None for frame in frames],
                                 [streams.frame_of(message) == number for number in (0, 1)])
                self.assertEqual([frame.is_whole for frame in frames], [frame.objects is not None for frame in frames])

    def test_forged_parts_are_malformed(self):
        """Each by itself or beside the others; the rest of the frame is as it was."""
        messages = messages_of(many(70))
        places = [at for at, message in enumerate(messages) if is_of_objects(message)]
        forged = {
            "header": (0, BODY, b"\0\x14"), "size": (0, BODY + 2, b"\0\x27"), "more": (1, BODY + 4, b"\0\x47"),
            "number": (2, BODY + 6, b"\1"), "beyond": (2, BODY + 6, b"\3"), "parts": (1, BODY + 7, b"\x09"),
            "no parts": (1, BODY + 7, b"\0"), "time": (1, BODY + 15, b"\0"), "no time": (0, BODY + 8, bytes(8)),
            "refused": (2, BODY + 17, b"\1"), "no id": (0, RECORD, bytes(4)), "same id": (0, RECORD + 43, b"\1"),
            "id of another part": (1, RECORD + 3, b"\2"), "state": (0, RECORD + 4, b"\5"),
            "speed of something young": (0, RECORD + 4, b"\1"), "half a deviation": (0, RECORD + 28, b"\xff\xff"),
            "speed of what stands": (0, RECORD + 40 + 24, b"\0\1"),
        }
        for name, (part, at, data) in forged.items():
            with self.subTest(name):
                sent = list(messages)
                sent[places[part]] = with_bytes(sent[places[part]], at, data)
                self.assertNotEqual(sent, messages)
                _, receiver = received(sent)
                self.assertGreaterEqual(receiver.dropped["malformed"], 1)
                frame, = self.compare(sent)
                self.assertIsNone(frame.objects)
        without_flag = [protected_message.protect(message[28:29] + b"\x04" + message[30:], at)
                        for at, message in enumerate(messages)]
        frame, = self.compare(without_flag)
        self.assertIsNone(frame.objects)
        self.assertEqual(received(without_flag)[1].dropped["malformed"], 3)

    def test_what_a_later_version_says_is_skipped(self):
        """A longer header, longer objects, and so fewer of them in a message."""
        objects = [COMES, Object(8), Object(9, STANDS)]
        messages = messages_of(objects)
        at = next(i for i, message in enumerate(messages) if is_of_objects(message))
        body = messages[at][BODY:]
        head, records = body[:24], [body[24 + 40 * i:64 + 40 * i] for i in range(3)]
        longer = struct.pack(">HH", 27, 41) + head[4:] + b"\xee" * 3 + b"".join(record + b"\xee" for record in records)
        messages[at] = protected_message.protect(messages[at][28:BODY] + longer, at)
        frame, = self.compare(messages)
        self.assertEqual([each.id for each in frame.objects], [7, 8, 9])
        self.assertEqual(frame.objects, received(messages_of(objects))[0][0].objects)

    def test_both_readers_say_the_same_of_mutants(self):
        """And of nothing that does not move there is a speed."""
        rng, known = random.Random(SEED), 0
        messages = messages_of(many(40), [COMES], many(33))
        for _ in range(20):
            sent = [with_body(message, mutated(message[BODY:], rng)[:1292])
                    if is_of_objects(message) and rng.random() < 0.4 else message for message in messages]
            for frame in self.compare(sent):
                known += frame.objects is not None
                for each in frame.objects or ():
                    self.assertTrue(each.state == iogrid.State.MOVES or each.vx_m_s == each.vy_m_s == 0)
        self.assertTrue(10 < known < 57, known)


if __name__ == "__main__":
    unittest.main()
