"""Classes of a window that are made by hand, as docs/spec.md sections 3.9 and 3.10 say."""

import struct

import grid_stream
import object_parts
import protected_message

TILE = 32
TILES_ACROSS = 32
CLASS_END = 3
HAS_CLASSES = 0x04
FREE, MOVING, STANDING, OCCUPIED = 3, 4, 6, 8
LATE, LOST, IMPRECISE, JUMP, RESTART, CONTRADICTED, DRIFTING = 0x01, 0x02, 0x04, 0x08, 0x10, 0x40, 0x80
CAUSES = (0, LATE, IMPRECISE, LOST, JUMP, RESTART, CONTRADICTED, DRIFTING)  # in the order of section 5.5
FATES = 16


def class_byte(number: int, sureness: int = 7) -> int:
    return number * 8 + sureness


def map_part(cause: int = 0, attribution: str | None = "me", waiting: int = 0, missing: int = 0,
             crc: int = 0x1a2b3c4d, place: tuple[int, int, float] | None = None) -> bytes:
    """What a target says of its map (docs/spec.md 3.10). attribution None: no block is in use; missing:
    chunks of another one; place: of the local frame in the map's plane, mm and turns."""
    words = (attribution or "").encode()
    counts = bytes(4 * (9 + 12))
    x_mm, y_mm, turns = place or (0, 0, 0)
    flags = int(attribution is not None) | (2 if place else 0)
    head = struct.pack(">HBBHHHBBIQQiiIHH", 72 + len(counts) + len(words), cause, 9, 500, 0, waiting, flags,
                       int(attribution is not None), crc, 1, 1, x_mm, y_mm, round(turns * 2**32) % 2**32,
                       50, 50)
    delivery = struct.pack(">4B4IB3x", int(missing > 0), 0, 9, 12, 0, 0x5e6f7081, 1280 * 10, 10 - missing,
                           len(words))
    return head + delivery + counts + words


class Window:
    """Class bytes by cell of the local frame, where the car is in it, and what kept it from being
    placed. Angles are in turns, counter-clockwise from x."""

    def __init__(self, x_m: float = 0, y_m: float = 0, turns: float = 0, corner=(-16, -16),
                 sides=(TILES_ACROSS, TILES_ACROSS)):
        self.pose = (x_m, y_m, turns)
        self.corner, self.sides = corner, sides  # in tiles
        self.sigma_mm, self.sigma_10_urad = 20, 100
        self.slices = 6
        self.causes = 0
        self.not_placed = 0  # packets
        self.stamp_us = 100_000_000
        # By bit: slices since start, how often it began, and when it did last.
        self.history: dict[int, tuple[int, int, int]] = {}
        self.map = map_part(cause=1, attribution=None, crc=0)  # what it says of its map
        self.tiles: dict[tuple[int, int], bytearray] = {}
        self.objects: list[object_parts.Object] | None = None  # by id; None: the target looks for none
        self.objects_left = (0, 0)  # tracks and hits without room

    def fill(self, xs: range, ys: range, byte: int) -> None:
        for y in ys:
            for column in range(xs.start // TILE, -(-xs.stop // TILE)):  # of tiles
                first, last = max(xs.start, column * TILE), min(xs.stop, (column + 1) * TILE)
                tile = self.tiles.setdefault((column, y // TILE), bytearray(TILE * TILE))
                at = y % TILE * TILE + first % TILE
                tile[at:at + last - first] = bytes((byte,)) * (last - first)

    def without_pose(self) -> "Window":
        """The same, where the pose at the end is not known."""
        self.pose = (0, 0, 0)
        self.sigma_mm, self.sigma_10_urad = 65535, 65535
        return self

    def without_place(self, cause: int, since_us: int, times: int = 1) -> "Window":
        """The same, where nothing was placed because of that."""
        self.slices, self.not_placed, self.causes = 0, 20, cause
        self.history[cause] = (self.stamp_us // 1000, times, since_us)
        return self

    @property
    def objects_us(self) -> int:
        """The middle of the last slice; 0 without a place."""
        return self.stamp_us - 4_000 if self.slices > 0 else 0

    @property
    def header(self) -> bytes:
        x_m, y_m, turns = self.pose
        return struct.pack(">HHiiiiIHHBBHQQ", 48, self.causes, *self.corner, round(x_m * 1000),
                           round(y_m * 1000), round(turns * 2**32) % 2**32, self.sigma_mm, self.sigma_10_urad,
                           self.slices, 8, 0, self.stamp_us - 40_000, self.stamp_us)

    @property
    def by_slot(self) -> list[tuple[int, bytes]]:
        """The tiles in which a cell has a class, in the order of their numbers."""
        columns, rows = self.sides
        return sorted((b % rows * columns + a % columns, bytes(cells)) for (a, b), cells in self.tiles.items()
                      if any(cells) and 0 <= a - self.corner[0] < columns and 0 <= b - self.corner[1] < rows)

    @property
    def crc(self) -> int:
        crc = protected_message.crc32_p4(struct.pack(">ii", *self.corner))
        for number, cells in self.by_slot:
            crc = protected_message.crc32_p4(struct.pack(">H", number) + cells, crc)
        return crc if self.by_slot else 0

    def bodies(self, age: int = 0) -> list[tuple[int, bytes]]:
        """Message types and what is behind their headers, one tile in each message."""
        bodies = []
        known, count = self.by_slot, self.sides[0] * self.sides[1]
        first = 0
        for i, (number, cells) in enumerate(known):
            end = known[i + 1][0] if i + 1 < len(known) else count
            record = struct.pack(">HBBH", number, 0, age, TILE * TILE) + cells
            bodies.append((grid_stream.TILES, self._tiles(first, end, 1) + record))
            first = end
        if not known:
            bodies.append((grid_stream.TILES, self._tiles(0, count, 0)))
        return [*bodies, (CLASS_END, self._end(len(known)))]

    def _tiles(self, first: int, end: int, count: int) -> bytes:
        columns, rows = self.sides
        return struct.pack(">HHHBBHHHHii", first, end, count, 5, 2, TILE * columns, TILE * rows, 100, 0, 0,
                           0) + self.header

    def _end(self, tiles: int) -> bytes:
        placed = 0 if self.slices == 0 else 20
        counts = struct.pack(">III II I III", tiles, 0, self.crc, placed, self.not_placed, 0, 1000, 0,
                             0)
        shape = struct.pack(">5B3x", FATES, len(CAUSES), 16, 0, 24)
        causes = b"".join(struct.pack(">IIQ", *self.history.get(cause, (0, 0, 0)))
                          for cause in CAUSES)
        return self.header + counts + shape + struct.pack(f">{FATES}I", 400, *[0] * 15) + causes + self.map
