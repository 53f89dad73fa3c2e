"""Does clients/python bear any bytes: no exception, no wrong grid, and each datagram counted?"""

import gzip
import itertools
import random
import struct
import unittest

import streams
from stream_test import received

import iogrid
import numpy
import protected_message
import tile_coding
from iogrid import tiles
from iogrid.protection import Unsound

MUTATIONS = 10_000  # of a tile; each is read in a fraction of a millisecond
MESSAGES = 4_000  # mutants, a dozen in each frame
SEED = 7


def mutated(data: bytes, rng: random.Random) -> bytes:
    """Bytes changed, set to an extreme, cut off, left out or put in."""
    changed = bytearray(data)
    for _ in range(rng.choice((1, 1, 1, 2, 5))):
        at = rng.randrange(len(changed) + 1)
        match rng.randrange(8):
            case 0 | 1 | 2 | 3:
                changed[at:at + 1] = bytes((rng.randrange(256),))
            case 4:
                changed[at:at + 1] = bytes((rng.choice((0, 1, 0x7F, 0x80, 0xFF)),))
            case 5:
                del changed[at:]
            case 6:
                del changed[at:at + rng.randrange(8)]
            case 7:
                changed[at:at] = rng.randbytes(rng.randrange(8))
    return bytes(changed)


def mutant(message: bytes, rng: random.Random) -> bytes:
    """Of three two have a right CRC and the counter of their sequence number, so that every byte is looked at."""
    if rng.randrange(3) == 0:
        return mutated(message, rng)
    content = mutated(message[28:], rng)[:1364]
    sequence = int.from_bytes(content[4:8], "big")
    return protected_message.of_version(protected_message.protect(content, sequence), message[13])


class Hostile(unittest.TestCase):
    def check_frame(self, frame: iogrid.Frame) -> None:
        if frame.indexes is not None:
            self.assertGreater(frame.indexes.min(initial=0), -128)
            self.assertFalse(streams.by_tile(frame.indexes)[frame.indexes_lost].any())
        if frame.classes is not None:
            self.assertLessEqual(frame.classes.max(initial=0), 8)
            self.assertFalse(streams.by_tile(frame.classes)[frame.classes_lost].any())
        self.assertIsInstance(frame.is_free((1, 5), (-1, 1)), bool)

    def test_mutated_messages(self):
        """What claims to be whole is a frame that was sent."""
        rng, mutants, whole, lost = random.Random(SEED), 0, 0, 0
        sources = [[message for message in streams.messages_of(path) if streams.frame_of(message) < 2]
                   for path in (streams.simulated(), streams.raw())]
        right = [{frame.number: frame for frame in received(messages)[0]} for messages in sources]
        for messages, frames_sent in itertools.cycle(zip(sources, right)):
            if mutants >= MESSAGES:
                break
            sent = [mutant(message, rng) if rng.random() < 0.7 else message for message in messages]
            mutants += sum(a is not b for a, b in zip(sent, messages))
            frames, receiver = received(sent)
            of_tiles = sum(count for cause, count in receiver.dropped.items() if cause.startswith(("tile", "grid")))
            self.assertGreaterEqual(receiver.used + receiver.dropped.total() - of_tiles, len(sent) - 1)
            for frame in frames:
                self.check_frame(frame)
                whole, lost = whole + frame.is_whole, lost + (not frame.is_whole)
                if frame.is_whole:
                    self.assertTrue(numpy.array_equal(frame.indexes, frames_sent[frame.number].indexes))
                    self.assertTrue(numpy.array_equal(frame.classes, frames_sent[frame.number].classes))
        self.assertGreater(lost, 100)

    def test_lightly_mutated_streams(self):
        """One mutant in a frame: the other one of two is whole, unless it refers to that."""
        rng = random.Random(SEED)
        messages = [message for message in streams.messages_of(streams.raw())]
        right = received(messages)[0]
        for _ in range(100):
            place = rng.randrange(len(messages))
            sent = [*messages[:place], mutant(messages[place], rng), *messages[place + 1:]]
            for frame in received(sent)[0]:
                self.check_frame(frame)
                if frame.is_whole:
                    self.assertTrue(numpy.array_equal(frame.indexes, right[frame.number].indexes))
                    self.assertTrue(numpy.array_equal(frame.classes, right[frame.number].classes))

    def test_random_bytes(self):
        """Each is dropped and counted, also behind a sound beginning."""
        rng, receiver = random.Random(SEED), iogrid.Receiver()
        head = streams.messages_of(streams.simulated())[0]
        for number in range(MUTATIONS):
            size = rng.choice((0, 1, 27, 28, 75, 76, 1392, 1393, rng.randrange(3000)))
            self.assertEqual(receiver.take(head[:rng.choice((0, 4, 14, 16))] + rng.randbytes(size)), [])
            self.assertEqual((receiver.used, receiver.dropped.total()), (0, number + 1))

    def test_tiles_are_read_as_by_another_reader(self):
        """tests/e2e/tile_coding.py shares nothing with this one. Mutants of payloads of all encodings."""
        rng, both, neither = random.Random(SEED), 0, 0
        three_values = bytes((0, 1, 250)[i % 3] for i in range(256))
        payloads = [(tile.encoding, tile.payload) for tile in streams.some_tiles()]
        self.assertEqual({encoding for encoding, _ in payloads}, {0, 4, 5})
        for _ in range(MUTATIONS):
            encoding, payload = rng.choice(payloads)
            payload = mutated(payload, rng)[:1024]
            reference = rng.randbytes(1024).translate(three_values)
            ours, others = self.ours(encoding, payload, reference), self.others(encoding, payload, reference)
            if others is not None or not has_value_twice(encoding, payload):
                self.assertEqual(ours, others, (encoding, payload.hex()))
            both, neither = both + (ours is not None), neither + (ours is None)
        self.assertGreater(min(both, neither), MUTATIONS // 20)

    @staticmethod
    def ours(encoding: int, payload: bytes, reference: bytes) -> bytes | None:
        try:
            of, behind = tiles.reference_of(encoding, payload, 9)
            cells = numpy.frombuffer(bytes(1024) if of is None else reference, numpy.uint8)
            tile = tiles.read_tile(encoding, behind)
            if isinstance(tile, tiles.RunStarts):
                tile = tiles.draw([tile], cells[None, :]).tobytes()
        except Unsound:
            return None
        return tile if 0x80 not in tile else None  # Grid looks for bytes that are no index

    @staticmethod
    def others(encoding: int, payload: bytes, reference: bytes) -> bytes | None:
        try:
            of = tile_coding.reference_of(encoding, payload, 9)
            return tile_coding.decode(encoding, payload, None if of is None else reference)
        except (AssertionError, IndexError, ValueError, struct.error, StopIteration):
            return None

    def test_mutated_captures(self):
        rng, path = random.Random(SEED), streams.FOLDER / "mutated.pcap"
        plain = streams.raw().read_bytes()
        of_zstd = streams.zstd_of(plain)
        for whole in (plain, streams.as_pcapng(streams.raw()).read_bytes(), gzip.compress(plain), of_zstd):
            faults = cuts = 0
            for _ in range(100):
                path.write_bytes(mutated(whole[:60] if rng.random() < 0.3 else whole, rng))
                receiver = iogrid.Receiver()
                try:
                    for frame in iogrid.replay(str(path), receiver=receiver):
                        self.check_frame(frame)
                except ValueError as fault:
                    self.assertIn("no pcap", str(fault))
                    faults += 1
                cuts += receiver.dropped["capture that is cut short"]
            self.assertGreater(faults, 0)
            self.assertGreater(cuts, 0)
            path.write_bytes(whole[:-5])
            receiver = iogrid.Receiver()
            frames = [frame.is_whole for frame in iogrid.replay(str(path), receiver=receiver)]
            # zstd packs 128 KiB at a time, which is all of this capture, and of a broken piece nothing comes.
            self.assertEqual(frames[:1], [] if whole is of_zstd else [True])
            self.assertEqual(receiver.dropped, {"capture that is cut short": 1})


def has_value_twice(encoding: int, payload: bytes) -> bool:
    """That other reader refuses, and 3.4 says nothing of it."""
    at = int(encoding == tiles.RUN_STARTS_SINCE)
    values = payload[at + 1:at + 1 + payload[at]] if len(payload) > at else b""
    return len(set(values)) < len(values)


if __name__ == "__main__":
    unittest.main()
