"""Does clients/c make the grids of clients/python, and bear any bytes? By gcc, and by clang with sanitizers."""

import functools
import math
import random
import struct
import subprocess
import unittest
import zlib

import streams
from code_blocks import code_blocks
from hostile_test import SEED, mutant
from stream_test import received

import grid_stream
import iogrid
import made_classes
import made_stream
import protected_message
from object_parts import MOVES, Object

HEADERS, READER = streams.ROOT / "clients/c", streams.ROOT / "tests/host/clients/reader.c"
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-Wconversion")
MAIN = """
int main(void) {
  static unsigned char bytes[65536];
  unsigned char head[2];
  iogrid_init(&receiver);
  while (fread(head, 1, 2, stdin) == 2) {
    const size_t count = (size_t)head[0] << 8 | head[1];
    if (fread(bytes, 1, count, stdin) != count) return 1;
    const uint32_t frame = receiver.next;
    on_datagram(bytes, count);
    if (receiver.next != frame && receiver.is_whole) print_what_comes(&receiver);
  }
}
"""
SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-g")


@functools.cache
def program(compiler: str, *options: str):
    streams.FOLDER.mkdir(parents=True, exist_ok=True)
    path = streams.FOLDER / f"reader_{compiler}"
    compile_to(path, compiler, READER, *options)
    return path


def compile_to(path, compiler: str, source, *options: str, headers=HEADERS) -> None:
    subprocess.run([compiler, *STRICT, "-O2", *options, "-I", headers, source, "-lm", "-o", path], check=True)


def said_by(path, messages: list[bytes]) -> list[str]:
    data = b"".join(struct.pack(">H", len(message)) + message for message in messages)
    return subprocess.run([path], input=data, capture_output=True, check=True, timeout=300).stdout.decode().splitlines()


def objects_of(frame: iogrid.Frame) -> str:
    if frame.objects is None:
        return f"-1 {zlib.crc32(b''):08x}"
    text = ""
    for each in frame.objects:
        sigmas = [65535 if sigma == math.inf else round(sigma * 100) for sigma in each.sigma_v_m_s]
        fields = [each.time_us, each.id, each.state, round(each.existence * 255), each.age_frames,
                  *(round(place * 1000) for place in (each.x_m, each.y_m)),
                  *(round(side * 100) for side in (each.length_m, each.width_m)),
                  -1 if each.heading_rad is None else round(each.heading_rad / math.tau * 65536),
                  each.is_hit, each.is_end_hidden, round(each.vx_m_s * 100), round(each.vy_m_s * 100), *sigmas,
                  *(round(sigma * 1000) for sigma in each.sigma_m), round(each.since_hit_s * 1000),
                  65535 if each.since_stopped_s is None else round(each.since_stopped_s * 100)]
        later = each.at(each.time_us + 512345)
        fields += [later is not None, *(round(value * 1000) for value in later or (0, 0, 0))]
        text += " ".join(f"{field:d}" for field in fields) + "\n"
    return f"{len(frame.objects)} {zlib.crc32(text.encode()):08x}"


def line_of(frame: iogrid.Frame) -> str:
    """What reader.c prints, by the Python reader."""
    window, moving = frame.window, frame.places(iogrid.Class.MOVING)
    is_free = 0
    for i in range(200):
        x, y = -20 + i * 0.2137, -5 + i % 7 * 1.377
        is_free += frame.is_free((x, x + i % 5 * 0.613), (y, y + i % 3 * 0.797)) << i % 16
    is_watched = sum(frame.is_watched(-3.3 + i * 0.213, -3.3 + i * 0.213 + i % 4 * 0.31) << i for i in range(32))
    is_blocked = sum(frame.is_blocked(-3.3 + i * 0.213, -3.3 + i * 0.213 + i % 4 * 0.31) << i for i in range(32))
    pose = window and window.pose
    return (f"{frame.number} run {frame.run} whole {frame.is_whole:d} lost {frame.indexes_lost.sum()} "
            f"{frame.classes_lost.sum()} cells {zlib.crc32(frame.indexes.tobytes()):08x} "
            f"{zlib.crc32((frame.classes << 3 | frame.sureness).tobytes()):08x} "
            f"p(3) {iogrid.probability(3, frame.geometry.epsilon) if frame.geometry.epsilon else 0:.6f} "
            f"objects {objects_of(frame)} unwatched {frame.unwatched is not None:d} {frame.unwatched or 0:016x} "
            f"watched {is_watched:08x} blocked {frame.blocked or 0:016x} {is_blocked:08x} "
            f"chip {-32768 if frame.temperature_c is None else round(frame.temperature_c * 10)} causes {window.causes if window else 0:x} "
            f"pose {pose is not None:d} {pose.x_m if pose else 0:.3f} {pose.y_m if pose else 0:.3f} "
            f"{pose.heading_rad if pose else 0:.6f} end {window.end_us if window else 0} moving {len(moving)} "
            f"{(moving @ (1, 2)).sum():.3f} free {is_free} at {frame.class_at(5.03, 0.71)} "
            "car {:d} {:.3f} {:.3f}".format(frame.velocity is not None, *(frame.velocity or (0, 0))))


class Header(unittest.TestCase):
    def compare(self, messages: list[bytes], path=None) -> None:
        frames, receiver = received(messages)
        dropped = sum(count for cause, count in receiver.dropped.items() if not cause.startswith(("tile", "grid")))
        expected = [*map(line_of, frames), f"used {receiver.used} dropped {dropped}"]
        self.assertEqual(said_by(path or program("gcc"), messages), expected)

    def test_same_as_the_python_reader(self):
        for path in (streams.raw(), streams.simulated()):
            self.compare(streams.messages_of(path))
        self.compare(streams.with_a_short_end())

    def test_a_rectangle_ahead_of_smaller_cells(self):
        """And a change of geometry in a run, to which no tile of the other refers."""
        target, messages = made_stream.Target(0), []
        for grid in (made_stream.Grid(512, 320, 50, (0, -8000), 10_000), made_stream.Grid(), made_stream.Grid(32, 64, 500),
                     made_stream.Grid(2048, 512, 100, (-4800, -25600)), made_stream.Grid(512, 2048)):
            for i in range(32):
                grid.set(i, 2 * i % 60, i - 16)
            messages += target.messages_of(grid, 1, made_classes.Window())
        self.compare(messages)
        self.compare(messages[1:])

    def test_a_window_that_is_a_rectangle(self):
        """It moves, so that numbers become those of other tiles."""
        target, messages = made_stream.Target(0), []
        for step in range(4):
            window = made_classes.Window(10.0 + 3 * step, 20.0, 0.25, corner=(-2 + step, 3 - step), sides=(9, 7))
            window.fill(range(90, 200), range(150, 252), made_classes.class_byte(made_classes.FREE, step))
            window.fill(range(-10, 20), range(100, 120), made_classes.class_byte(made_classes.MOVING, 2))
            messages += target.messages_of(made_stream.Grid(), 1, window)
        self.compare(messages)
        self.compare(messages[1:], program("clang", *SANITIZERS))

    def test_a_grid_larger_than_any_is_dropped(self):
        """Though the message says nothing of its tiles. Nobody reads behind the memory."""
        target, messages = made_stream.Target(0), []
        for sides in ((1024, 1024), (65504, 65504), (32, 0), (1024, 1024)):
            grid = made_stream.Grid(*sides)
            if sides == (1024, 1024):
                grid.set(512, 512, 7)
            else:
                grid.tile_count = 0
            messages += target.messages_of(grid, 1, made_classes.Window())
        self.compare(messages, program("clang", *SANITIZERS))

    def test_another_version_is_dropped(self):
        message = streams.messages_of(streams.raw())[0]
        others = [protected_message.of_version(message, version) for version in (4, 6)]
        self.assertEqual(said_by(program("gcc"), others), ["used 0 dropped 2"])

    def test_order_within_a_frame_and_losses(self):
        messages, rng = streams.messages_of(streams.simulated())[:420], random.Random(SEED)
        messages = messages[:next(i for i, each in enumerate(messages) if streams.frame_of(each) == 6)]
        shuffled = sorted(messages, key=lambda message: streams.frame_of(message) + 0.9 * rng.random())
        self.compare(shuffled)
        for _ in range(4):
            self.compare([message for message in shuffled if rng.random() < 0.98])

    def test_examples_of_the_document(self):
        """A wall of moving cells 9.9 m before the car, then 12.9 m: the strip to 13 m is free in neither. What comes is
        where the wall is; the car's velocity is unknown in the first frame, the objects in the third, and in the last
        what moves only goes away."""
        strip, comes = code_blocks((streams.ROOT / "docs/clients.md").read_text(), "c")
        source, path = streams.FOLDER / "examples.c", streams.FOLDER / "examples"
        source.write_text(strip + comes + MAIN)
        compile_to(path, "gcc", source)
        target, messages = made_stream.Target(0), []
        for number, front in enumerate((99, 129, 140, 150)):
            window = made_classes.Window()
            window.stamp_us += 40_000 * number
            window.fill(range(0, 200), range(-30, 30), made_classes.class_byte(made_classes.FREE))
            window.fill(range(front, front + 3), range(-9, 9), made_classes.class_byte(made_classes.MOVING))
            window.objects = [Object(5, state=MOVES, x_mm=100 * front, vx_cm_s=-300 if front < 150 else 400,
                                     vy_cm_s=100, sigma_v_along=20, sigma_v_across=20), Object(6)]
            made = target.messages_of(made_stream.Grid(), 1, window)
            messages += [each for each in made if front != 140 or each[28] != grid_stream.OBJECTS]
        self.assertEqual(said_by(path, messages), [
            "0 not known to be free", "not known", "1 not known to be free", "5: 12.9 m away, 3.0 m/s towards me",
            "2 free", "3 free"])

    def test_as_another_language(self):
        """The header is C++, too."""
        source = streams.FOLDER / "header.cpp"
        source.write_text('#include "iogrid.h"\nstatic iogrid_receiver r;\nint main() { iogrid_init(&r); }\n')
        options = [option for option in STRICT if option != "-std=c99"]
        subprocess.run(["g++", "-std=c++20", *options, "-I", HEADERS, source, "-lm", "-o", streams.FOLDER / "header"], check=True)

    def test_another_run(self):
        """The two messages with which another run begins are lost to this reader, which keeps none."""
        messages, other = streams.messages_of(streams.simulated()), streams.FOLDER / "other_run.pcap"
        streams.iog("fuse", "--pcap", streams.drive(), "--stream", other, "--run-number", 9)
        new = [message for message in streams.messages_of(other) if streams.frame_of(message) < 9]
        old = [message for message in messages if streams.frame_of(message) < 2]
        said = said_by(program("gcc"), [*old[:-1], *new[:2], old[-1], *new, *old])
        self.assertEqual([line.split(" lost")[0] for line in said[:3]],
                         ["0 run 1 whole 1", "1 run 1 whole 1", "0 run 9 whole 0"])
        self.assertEqual(said[-2].split(" lost")[0], "8 run 9 whole 1")

    def test_hostile_bytes_under_sanitizers(self):
        """What claims to be whole is a frame that was sent. tests/fuzz/client_reader.cpp goes on from here."""
        rng, reader = random.Random(SEED), program("clang", *SANITIZERS)
        self.compare(streams.with_a_short_end(), reader)
        mutants = whole = 0
        for path in (streams.simulated(), streams.raw()):
            messages = [message for message in streams.messages_of(path) if streams.frame_of(message) < 2]
            right = {line_of(frame).split(" causes")[0] for frame in received(messages)[0]}
            for rate in 3 * [0.01] + 12 * [0.9]:
                sent = [mutant(message, rng) if rng.random() < rate else message for message in messages]
                mutants += sum(a is not b for a, b in zip(sent, messages))
                came = {line.split(" causes")[0] for line in said_by(reader, sent) if " whole 1 " in line}
                self.assertLessEqual(came, right)
                whole += len(came)
        self.assertGreater(mutants, 1000)
        self.assertGreater(whole, 5)


if __name__ == "__main__":
    unittest.main()
