"""Streams for the tests of clients/, and what `iog` says of them. Environment: IOG is the program, STREAMS a folder.

The first is made by `iog` of a simulated drive; raw tiles, which it does not have, are made by tests/e2e/made_stream.py,
and so is an end that is too short. Tiles are counted by tests/e2e/grid_stream.py, the tests' own reader.
"""

import collections
import functools
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
IOG, FOLDER = os.environ["IOG"], pathlib.Path(os.environ["STREAMS"])
sys.path[:0] = [str(ROOT / "tests/e2e"), str(ROOT / "clients/python")]

import capture  # noqa: E402
import ethernet  # noqa: E402
import grid_stream  # noqa: E402
import made_classes  # noqa: E402
import made_stream  # noqa: E402
import numpy  # noqa: E402
import protected_message  # noqa: E402

FRAMES = 25  # of the drive
MAC, IP = bytes(6), bytes((127, 0, 0, 1))


def iog(*arguments) -> str:
    return subprocess.run([IOG, *map(str, arguments)], capture_output=True, text=True, check=True, timeout=120).stdout


@functools.cache
def drive() -> pathlib.Path:
    FOLDER.mkdir(parents=True, exist_ok=True)
    path = FOLDER / "drive.pcap"
    iog("simulate", "--moving", "--scene", "city", "--seconds", "1", "--seed", "3", "--out", path)
    return path


@functools.cache
def simulated() -> pathlib.Path:
    path = FOLDER / "stream.pcap"
    iog("fuse", "--pcap", drive(), "--stream", path, "--hashes", FOLDER / "hashes.txt",
        "--classes-hashes", FOLDER / "classes_hashes.txt")
    return path


def hashes(name: str) -> list[list[str]]:
    """Of each frame what `iog fuse` writes: `hashes` or `classes_hashes`."""
    simulated()
    return [line.split() for line in (FOLDER / f"{name}.txt").read_text().splitlines()[1:]]


@functools.cache
def raw() -> pathlib.Path:
    """Two frames, all of whose tiles are raw, with classes and without a place for them in the second."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    path, target = FOLDER / "raw.pcap", made_stream.Target(0)
    target.unwatched, target.blocked = 0x8000_0001_0F00_0003, 0x8000_0000_0300_0000
    target.temperature_dc = -55
    grid, window = made_stream.Grid(), made_classes.Window(1.0, 2.0, 0.125)
    for i in range(-127, 128):
        grid.set(512 + i, 500 + i % 7, i)
    window.fill(range(-40, 70), range(3, 90), made_classes.class_byte(made_classes.FREE, 5))
    messages = target.messages_of(grid, 7, window) + target.messages_of(grid, 9, made_classes.Window().without_pose())
    write(path, messages)
    return path


def with_a_short_end() -> list[bytes]:
    """A frame whose end lacks its last byte (3.5)."""
    *messages, end = made_stream.Target(0).messages_of(made_stream.Grid(), 1, made_classes.Window())
    return [*messages, protected_message.protect(end[28:-1], len(messages))]


def write(path: pathlib.Path, messages: list[bytes]) -> None:
    packets = [ethernet.udp(IP, IP, 15001, 15000, message) for message in messages]
    capture.write(path, [capture.Packet(i, ethernet.ethernet(MAC, MAC, 0x0800, packet))
                         for i, packet in enumerate(packets)])


@functools.cache
def messages_of(path: pathlib.Path) -> list[bytes]:
    return [packet.payload for packet in capture.read(path)]


def frame_of(message: bytes) -> int:
    return int.from_bytes(message[36:40], "big")


def tiles_of(message: bytes) -> list[tuple[tuple[bool, int], grid_stream.Tile]]:
    """Each with whether it is of classes, and its encoding."""
    body = message[76:]
    if message[28] != grid_stream.TILES:
        return []
    are_classes = grid_stream.is_of_classes(body)
    tiles = grid_stream.read_class_tiles(body)[1] if are_classes else grid_stream.read_tiles(body)
    return [((are_classes, tile.encoding), tile) for tile in tiles.tiles]


def by_tile(cells: numpy.ndarray) -> numpy.ndarray:
    """The same cells as [row of tiles, column, row of the tile, column]."""
    rows, columns = cells.shape
    return cells.reshape(rows // 32, 32, columns // 32, 32).swapaxes(1, 2)


def encodings_of(messages: list[bytes]) -> collections.Counter:
    """How many tiles there are by grid and encoding."""
    return collections.Counter(of for message in messages for of, _ in tiles_of(message))


def some_tiles() -> list[grid_stream.Tile]:
    """Of each grid and encoding up to 30."""
    kept: collections.defaultdict = collections.defaultdict(list)
    for path in (simulated(), raw()):
        for message in messages_of(path):
            for of, tile in tiles_of(message):
                kept[of].append(tile)
    return [tile for tiles in kept.values() for tile in tiles[:30]]


def as_pcapng(path: pathlib.Path) -> pathlib.Path:
    """The same packets, by Wireshark's program."""
    subprocess.run(["editcap", "-F", "pcapng", path, made := path.with_suffix(".pcapng")], check=True, timeout=120)
    return made


def zstd_of(data: bytes) -> bytes:
    return subprocess.run(["zstd", "-cq"], input=data, capture_output=True, check=True, timeout=120).stdout
