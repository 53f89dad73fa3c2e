"""Does clients/python make the grids that `iog` makes of the same bytes, whatever the network did to these?"""

import contextlib
import functools
import gzip
import io
import os
import pathlib
import random
import re
import struct
import unittest
import unittest.mock
import zlib

import streams
from code_blocks import code_blocks

import iogrid
import numpy
import protected_message


def name_of(indexes: numpy.ndarray) -> int:
    """As a user names a grid: by the snippet of docs/spec.md, 3.6."""
    names = {"struct": struct, "cells": memoryview(indexes.tobytes())}
    exec(snippet_of_names(), names)  # noqa: S102
    return names["crc"]


@functools.cache
def snippet_of_names():
    blocks = code_blocks((streams.ROOT / "docs/spec.md").read_text(), "python")
    snippet, = (block for block in blocks if "sys.argv" in block)
    lines = [line for line in snippet.splitlines() if not line.startswith(("import", "cells =", "print"))]
    return compile("\n".join(lines), "docs/spec.md", "exec")


def name_of_classes(frame: iogrid.Frame) -> int:
    """Likewise, by the words of 3.10."""
    a, b = frame.window.corner
    crc, is_anything = protected_message.crc32_p4(struct.pack(">ii", a, b)), False
    cells = frame.classes << 3 | frame.sureness
    for number in range(1024):
        x, y = (number % 32 - a) % 32 * 32, (number // 32 - b) % 32 * 32
        tile = cells[y:y + 32, x:x + 32]
        if tile.any():
            crc, is_anything = protected_message.crc32_p4(struct.pack(">H", number) + tile.tobytes(), crc), True
    return crc if is_anything else 0


def replayed(path: pathlib.Path) -> tuple[list[iogrid.Frame], iogrid.Receiver]:
    receiver = iogrid.Receiver()
    return list(iogrid.replay(str(path), receiver=receiver)), receiver


def printed_by_the_readme(*frames: iogrid.Frame | None) -> str:
    """By the line that README.md has for Python, of what `listen` hands out."""
    line = re.search(r"^- Python: `([^`]+)`", (streams.ROOT / "README.md").read_text(), re.M).group(1)
    with unittest.mock.patch("iogrid.listen", return_value=frames), \
            contextlib.redirect_stdout(io.StringIO()) as said:
        exec(line, {"iogrid": iogrid})  # noqa: S102
    return said.getvalue()


def received(messages) -> tuple[list[iogrid.Frame], iogrid.Receiver]:
    receiver = iogrid.Receiver()
    frames = [frame for message in messages for frame in receiver.take(message)]
    return frames + receiver.finish(), receiver


def pcapng_of(frames: list[bytes]) -> bytes:
    """Big endian: a simple packet first, and half of the others in a second section, as raw IP."""
    def block(kind: int, body: bytes) -> bytes:
        size = 12 + len(body) + -len(body) % 4
        return struct.pack(">II", kind, size) + body + bytes(-len(body) % 4) + struct.pack(">I", size)

    section, half = block(0x0A0D0D0A, struct.pack(">IHHq", 0x1A2B3C4D, 1, 0, -1)), len(frames) // 2
    enhanced = [block(6, struct.pack(">IIIII", 0, 0, i, len(each), len(each)) + each)
                for i, each in enumerate(frames[1:half] + [frame[14:] for frame in frames[half:]])]
    ethernet, raw = (block(1, struct.pack(">HHI", link, 0, 0)) for link in (1, 101))
    simple = block(3, struct.pack(">I", len(frames[0])) + frames[0])
    return b"".join((section, ethernet, simple, *enhanced[:half - 1], section, block(5, bytes(12)), raw, *enhanced[half - 1:]))


class Stream(unittest.TestCase):
    def check_names(self, path: pathlib.Path, frames: list[iogrid.Frame]) -> None:
        """The run hashes that `iog info` finds, of the arrays."""
        said = streams.iog("info", path)
        names = b"".join(struct.pack(">I", name_of(frame.indexes)) for frame in frames)
        self.assertIn(f"{zlib.crc32(names):08x}", re.search(r"^run hash +(\w+)$", said, re.M)[1])
        names = b"".join(struct.pack(">I", name_of_classes(frame)) for frame in frames)
        self.assertIn(f"{zlib.crc32(names):08x}", re.search(r"^class run hash +(\w+)$", said, re.M)[1])

    def check_same(self, frame: iogrid.Frame, right: iogrid.Frame) -> None:
        """What is not lost is right, what is lost is unknown, and the frame says whether something is."""
        self.assertEqual((frame.number, frame.run, frame.vehicle), (right.number, right.run, right.vehicle))
        is_whole = True
        for is_lost, grids in ((frame.indexes_lost, ((frame.indexes, right.indexes),)),
                               (frame.classes_lost, ((frame.classes, right.classes),
                                                     (frame.sureness, right.sureness)))):
            is_whole = is_whole and not is_lost.any()
            for cells, right_cells in grids:
                expected = right_cells.copy()
                streams.by_tile(expected)[is_lost] = 0
                self.assertTrue(numpy.array_equal(cells, expected))
        self.assertFalse(frame.is_whole and not is_whole)

    def test_each_encoding_is_among_the_bytes(self):
        """Else the tests below would say less than they seem to."""
        counts = streams.encodings_of([message for path in (streams.simulated(), streams.raw())
                                       for message in streams.messages_of(path)])
        expected = [(are_classes, n) for are_classes in (False, True) for n in (0, 4, 5)]
        self.assertEqual(sorted(counts), sorted(expected), counts)

    def test_grids_are_those_of_iog(self):
        frames, receiver = replayed(streams.simulated())
        self.assertEqual((len(frames), receiver.lost, +receiver.dropped), (streams.FRAMES, 0, {}))
        self.assertEqual(receiver.used, len(streams.messages_of(streams.simulated())))
        rows = zip(frames, streams.hashes("hashes"), streams.hashes("classes_hashes"), strict=True)
        for frame, row, class_row in rows:
            self.assertTrue(frame.is_whole)
            self.assertEqual(f"{frame.number} {frame.complete:x} {frame.partial:x} {frame.points_used}",
                             " ".join([*row[:3], row[4]]))
            self.assertEqual(f"{name_of(frame.indexes):08x}", row[-1])
            _, stamp, slices, _, _, causes, a, b, _, name, *_ = class_row
            window = frame.window
            self.assertEqual((window.end_us, window.slices, window.causes, window.corner),
                             (int(stamp), int(slices), int(causes, 16), (int(a), int(b))))
            self.assertEqual(f"{name_of_classes(frame):08x}", name)
            self.assertEqual((frame.indexes.dtype, frame.indexes.shape), (numpy.int8, (1024, 1024)))

    def test_cells_are_those_of_iog(self):
        frames, _ = replayed(streams.simulated())
        for number in (0, 13, 24):
            raw = streams.FOLDER / "grid.raw"
            streams.iog("fuse", "--pcap", streams.drive(), "--frame", number, "--out-raw", raw)
            expected = numpy.fromfile(raw, numpy.int8).reshape(1024, 1024)
            numpy.testing.assert_array_equal(frames[number].indexes, expected)
            self.assertGreater(numpy.count_nonzero(expected), 10000)

    def test_raw_tiles(self):
        frames, receiver = replayed(streams.raw())
        self.assertEqual([frame.is_whole for frame in frames], [True, True])
        self.assertEqual((receiver.lost, +receiver.dropped), (0, {}))
        self.check_names(streams.raw(), frames)

    def test_the_line_of_the_readme_goes_on_in_silence(self):
        frames, _ = replayed(streams.simulated())
        frame = next(frame for frame in frames if frame.window and frame.window.pose)
        self.assertEqual(printed_by_the_readme(None, frame, None),
                         f"None\n{frame.is_free((3, 13), (-1, 1))}\nNone\n")

    def test_order_does_not_show(self):
        """Each message comes twice, and both times in the time of two frames, at random."""
        messages, rng = streams.messages_of(streams.simulated())[:500], random.Random(33)
        frames, _ = received(messages)
        came, receiver = received(sorted(2 * messages, key=lambda each: streams.frame_of(each) + 2 * rng.random()))
        self.assertEqual([frame.number for frame in came], list(range(came[-1].number + 1)))
        self.assertGreater(len(came), 5)
        for frame, right in zip(came, frames):
            self.check_same(frame, right)
        self.assertTrue(all(frame.is_whole for frame in came[:-1]))
        self.assertEqual(receiver.lost, 0)
        self.assertEqual(receiver.used + receiver.dropped.total(), 2 * len(messages))

    def test_each_message_can_be_lost(self):
        for path in (streams.simulated(), streams.raw()):
            messages = [message for message in streams.messages_of(path) if streams.frame_of(message) < 2]
            whole, _ = received(messages)
            for i, message in enumerate(messages):
                frames, receiver = received(messages[:i] + messages[i + 1:])
                self.assertEqual([frame.number for frame in frames], [0, 1])
                self.assertFalse(frames[streams.frame_of(message)].is_whole, f"message {i} of {path}")
                self.assertEqual(receiver.lost, int(0 < i < len(messages) - 1))
                for frame, right in zip(frames, whole):
                    self.check_same(frame, right)

    def test_a_receiver_is_complete_again_in_the_eighth_whole_frame(self):
        """3.4. Until then what refers to a lost tile is lost."""
        messages, (right, _) = streams.messages_of(streams.simulated()), replayed(streams.simulated())
        frames, receiver = received(message for message in messages if streams.frame_of(message) != 0)
        self.assertFalse(frames[0].is_whole)
        self.assertGreater(receiver.dropped["tile: without reference"], 0)
        for frame, other in zip(frames, right[1:], strict=True):
            self.check_same(frame, other)
        self.assertTrue(all(frame.is_whole for frame in frames[7:]))

    def test_captures_of_every_kind_have_the_same_frames(self):
        """pcapng is by Wireshark's editcap; by hand in the other byte order, with a simple packet and a second section
        whose interface 0 is another (draft-ietf-opsawg-pcapng, 4)."""
        plain, made, packed = streams.simulated(), streams.FOLDER / "made.pcapng", streams.FOLDER / "packed.gz"
        right = [(frame.number, frame.is_whole) for frame in replayed(plain)[0]]
        made.write_bytes(pcapng_of([packet.frame for packet in streams.capture.read(plain)]))
        ng = streams.as_pcapng(plain)
        packed.write_bytes(gzip.compress(ng.read_bytes()))
        of_zstd = streams.FOLDER / "packed.zst"
        of_zstd.write_bytes(streams.zstd_of(ng.read_bytes()))
        for path in (ng, made, packed, of_zstd):
            frames, receiver = replayed(path)
            self.assertEqual([(frame.number, frame.is_whole) for frame in frames], right, path)
            self.assertEqual(receiver.dropped, {}, path)
        of_zstd.write_bytes(of_zstd.read_bytes()[:-5])
        frames, receiver = replayed(of_zstd)
        whole = [(frame.number, frame.is_whole) for frame in frames[:-1]]
        self.assertGreater(len(whole), 5)
        self.assertEqual(whole, right[:len(whole)])
        self.assertEqual(receiver.dropped, {"capture that is cut short": 1})
        with unittest.mock.patch.dict(os.environ, PATH=str(streams.FOLDER)):
            self.assertRaisesRegex(ValueError, "zstd, which unpacks it, is not installed", replayed, of_zstd)

    def test_another_run_takes_over_with_its_third_message(self):
        """3.2."""
        messages, other = streams.messages_of(streams.simulated()), streams.FOLDER / "other_run.pcap"
        streams.iog("fuse", "--pcap", streams.drive(), "--stream", other, "--run-number", 9)
        old = [message for message in messages if streams.frame_of(message) < 2]
        new = [message for message in streams.messages_of(other) if streams.frame_of(message) < 1]
        frames, receiver = received([*old[:-1], *new[:2], old[-1], *new, *old])
        self.assertEqual([(frame.run, frame.number, frame.is_whole) for frame in frames],
                         [(1, 0, True), (1, 1, True), (9, 0, True)])
        self.assertEqual(receiver.dropped["run that is over"], len(old))

    def test_protection_is_checked(self):
        """3.1 and 3.2: the CRC, the data id, the lengths, and a counter that is the low half of the sequence number."""
        message = streams.messages_of(streams.simulated())[0]
        wrong = {
            "damaged": [message[:at] + bytes((message[at] ^ 1,)) + message[at + 1:] for at in (5, 17, 18, 23, 24, 500)],
            "malformed": [protected_message.protect(message[28:], 1)],
        }
        for cause, datagrams in wrong.items():
            receiver = iogrid.Receiver()
            self.assertEqual([receiver.take(datagram) for datagram in datagrams], [[]] * len(datagrams))
            self.assertEqual((receiver.used, receiver.dropped), (0, {cause: len(datagrams)}))
        other_id = protected_message.protect(message[28:], 0, protected_message.Channel(0x8001, 0x494F4702))
        receiver.take(other_id)
        self.assertEqual(receiver.dropped["damaged"], 1)

    def test_no_tile_is_spoken_of_twice(self):
        """3.3: a message that does is malformed, whatever its sequence number."""
        first = streams.messages_of(streams.simulated())[0]
        again = protected_message.protect(first[28:32] + struct.pack(">I", 1000) + first[36:], 1000)
        receiver = iogrid.Receiver()
        self.assertEqual((receiver.take(first), receiver.take(again)), ([], []))
        self.assertEqual((receiver.used, receiver.dropped), (1, {"malformed": 1}))

    def test_messages_of_a_frame_agree_on_the_window(self):
        """3.9: one that contradicts those before it is malformed, and what it has said is lost."""
        messages = [message for message in streams.messages_of(streams.raw()) if streams.frame_of(message) == 0]
        at = max(i for i, message in enumerate(messages) if message[28] == 1 and message[83] == 2)
        moved = messages[at][28:112] + struct.pack(">i", 1001) + messages[at][116:]
        messages[at] = protected_message.protect(moved, at)
        frames, receiver = received(messages)
        self.assertEqual(([frame.is_whole for frame in frames], receiver.dropped), ([False], {"malformed": 1}))
        self.assertEqual(frames[0].window.pose.x_m, 1.0)

    def test_another_version_is_named(self):
        receiver, message = iogrid.Receiver(), streams.messages_of(streams.raw())[0]
        for version in (4, 6):
            self.assertEqual(receiver.take(protected_message.of_version(message, version)), [])
        self.assertEqual(receiver.dropped, {"interface version 4": 1, "interface version 6": 1})


if __name__ == "__main__":
    unittest.main()
