"""The tiles of a grid, of the messages of a frame (docs/spec.md, 3.3 to 3.6)."""

import collections
import math
import struct
import typing

import numpy

from iogrid.protection import Unsound, crc_p4, require
from iogrid.tiles import CELLS, RunStarts, draw, read_tile, reference_of

MOST_TILES = 1024  # of a grid
INDEXES, CLASSES = 0, 2  # storages


class Geometry(typing.NamedTuple):
    """The geometry of a grid, which each of its messages states (3.3)."""

    columns: int  # cells along x
    rows: int
    cell_m: float
    x_m: float  # its lowest corner in the car's frame; 0 of a window, which says it itself
    y_m: float
    epsilon: float | None  # of the indexes; None of a window

    @classmethod
    def read(cls, body: bytes) -> "Geometry":
        log2, storage, columns, rows, cell_mm, epsilon_e5, x_mm, y_mm = struct.unpack_from(">BBHHHHii", body, 6)
        require(log2 == 5 and storage in (INDEXES, CLASSES) and columns % 32 == rows % 32 == 0 and
                0 < columns * rows <= MOST_TILES * CELLS and cell_mm > 0, "unknown grid")
        require(storage == CLASSES or 0 < epsilon_e5 < 50_000, "unknown grid")
        return cls(columns, rows, cell_mm / 1000, x_mm / 1000, y_mm / 1000,
                   epsilon_e5 / 100_000 if storage == INDEXES else None)

    @property
    def tiles(self) -> tuple[int, int]:
        """The number of tiles along y and x."""
        return self.rows // 32, self.columns // 32

    def index(self, x_m: float, y_m: float) -> tuple[int, int]:
        """Row and column of a place in the car's frame. They may be outside the grid."""
        return tuple(math.floor(place / self.cell_m) - round(corner / self.cell_m)
                     for place, corner in ((y_m, self.y_m), (x_m, self.x_m)))

    def has(self, row: int, column: int) -> bool:
        return 0 <= row < self.rows and 0 <= column < self.columns


NOTHING = Geometry(0, 0, 0.1, 0.0, 0.0, None)  # nothing has come of a grid that would say it


class References:
    """Of each tile of a grid the last one that was sent by itself, and the frame that it was of; -1: none."""

    def __init__(self):
        self.begin(NOTHING)

    def begin(self, geometry: Geometry) -> None:
        self.geometry, tiles = geometry, math.prod(geometry.tiles)
        self.frames, self.cells = numpy.full(tiles, -1, numpy.int64), numpy.zeros((tiles, CELLS), numpy.uint8)


class Grid:
    """What has come of one grid of a frame, by tile number (3.3)."""

    def __init__(self, is_of_classes: bool):
        self.is_of_classes, self.window = is_of_classes, b""  # the window's header, the same in all messages
        self.geometry: Geometry | None = None
        self.spoken_of, self.tiles, self.end = numpy.zeros(1, bool), [], None  # sent, lost, name
        byte = numpy.arange(256)
        self.is_cell = (byte == 0) | (byte >= 8) & (byte < 72) if is_of_classes else byte != 0x80

    def window_of(self, body: bytes, at: int) -> tuple[bytes, int]:
        """The window's header and where it ends; nothing for a grid without."""
        size = struct.unpack_from(">H46x", body, at)[0] if self.is_of_classes else 0
        window = body[at:at + min(size, 48)]
        require(not self.is_of_classes or size >= 48 and at + size <= len(body) and self.window in (b"", window),
                "malformed")
        return window, at + size

    def take_tiles(self, sequence: int, body: bytes) -> None:
        first, end, count = struct.unpack_from(">HHH", body)
        geometry = Geometry.read(body)
        require(self.geometry in (None, geometry), "malformed")
        spoken_of = self.spoken_of if self.geometry else numpy.zeros(math.prod(geometry.tiles), bool)
        window, at = self.window_of(body, 24)
        record, tiles, lowest = struct.Struct(">HBxH" if self.is_of_classes else ">HBH"), [], first
        while at < len(body):
            number, encoding, size = record.unpack_from(body, at)
            payload, at = body[at + record.size:at + record.size + size], at + record.size + size
            require(lowest <= number < end and at <= len(body) and size <= CELLS, "malformed")
            tiles.append((sequence, number, encoding, payload))
            lowest = number + 1
        require(first <= end <= len(spoken_of) and len(tiles) == count and not spoken_of[first:end].any(), "malformed")
        spoken_of[first:end], self.window, self.geometry, self.spoken_of = True, window, geometry, spoken_of
        self.tiles += tiles

    def take_end(self, body: bytes) -> None:
        window, at = self.window_of(body, 0)
        self.end, self.window = struct.unpack_from(">III", body, at), window

    @staticmethod
    def tail_of(body: bytes, sensors: int) -> tuple[int, int, float | None]:
        """The unwatched and blocked sectors and the chip's temperature, which follow counters and sensors (3.5)."""
        at = 32 + 4 * sum(body[28:32])
        require(at < len(body), "malformed")
        unwatched, blocked, tenths = struct.unpack_from(">QQh6x", body, at + 4 + sensors * body[at])
        return unwatched, blocked, None if tenths == -0x8000 else tenths / 10

    def decode(self, frame: int, own: References,
               dropped: collections.Counter[str]) -> tuple[numpy.ndarray, numpy.ndarray, bool]:
        """The cells [y, x], the tiles that were lost, likewise, and whether nothing was."""
        if self.geometry is None:  # no tile has come: it is that of the frame before
            self.geometry, self.spoken_of = own.geometry, numpy.zeros(len(own.frames), bool)
        if self.geometry != own.geometry:
            own.begin(self.geometry)
        count = len(own.frames)
        cells, is_lost = numpy.zeros((count, CELLS), numpy.uint8), ~self.spoken_of
        known: dict[int, bool] = {}  # tiles, and whether they stand by themselves
        drawn: dict[int, RunStarts] = {}
        for _, number, encoding, payload in sorted(self.tiles):
            try:
                of, payload = reference_of(encoding, payload, frame)
                require(of in (None, own.frames[number]), "without reference")
                tile = read_tile(encoding, payload)
            except Unsound as fault:
                dropped[f"tile: {fault}"] += 1
                is_lost[number] = True
                continue
            if isinstance(tile, bytes):
                cells[number] = numpy.frombuffer(tile, numpy.uint8)
            else:
                drawn[number] = tile
                if of is not None:
                    cells[number] = own.cells[number]
            known[number] = of is None
        if drawn:
            cells[list(drawn)] = draw(list(drawn.values()), cells[list(drawn)])
        for number in numpy.array(list(known), int)[~self.is_cell[cells[list(known)]].all(axis=1)]:
            dropped["tile: no such cell"] += 1
            is_lost[number] = True
        is_own = numpy.isin(numpy.arange(count), [number for number, is_alone in known.items() if is_alone]) & ~is_lost
        own.frames[is_own], own.cells[is_own] = frame, cells[is_own]
        cells[is_lost] = 0
        sent, lost, name = self.end or (0, 1, 0)
        is_whole = lost == 0 and sent == len(known) and is_lost.size > 0 and not bool(is_lost.any())
        if is_whole and name != self.name_of(cells):  # some cell is wrong, and nobody knows which
            dropped["grid of another name"] += 1
            own.frames[:], cells[:], is_lost[:], is_whole = -1, 0, True, False
        rows, columns = self.geometry.tiles
        cells = self._in_place(cells).reshape(rows, columns, 32, 32).swapaxes(1, 2).reshape(32 * rows, 32 * columns)
        return cells, self._in_place(is_lost), is_whole

    def _in_place(self, by_number: numpy.ndarray) -> numpy.ndarray:
        """[tile y, tile x, ...] of [tile number, ...]: a window's tile keeps its number while the window moves."""
        a, b = struct.unpack(">ii", self.window[4:12]) if self.window else (0, 0)
        return numpy.roll(by_number.reshape(*self.geometry.tiles, *by_number.shape[1:]), (-b, -a), (0, 1))

    def name_of(self, cells: numpy.ndarray) -> int:
        """3.6, and 3.10 for classes."""
        numbers = numpy.flatnonzero(cells.any(axis=1)).tolist()
        crc = crc_p4(self.window[4:12]) if self.is_of_classes else 0
        for number in numbers:
            y, x = divmod(number, self.geometry.tiles[1])
            place = struct.pack(">H", number) if self.is_of_classes else struct.pack(">HH", x, y)
            crc = crc_p4(place + cells[number].tobytes(), crc)
        return crc if numbers else 0
