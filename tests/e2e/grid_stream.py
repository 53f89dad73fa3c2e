"""The firmware's messages, read as docs/spec.md section 3 says, and put together to frames."""

import dataclasses
import struct
from collections.abc import Iterator

import map_state
import object_parts
import protected_message
import reception_parts
import tile_coding
import vehicle_id
from target_state import COMMAND_COUNTERS, DISCOVERY_COUNTERS, LINK_COUNTERS, PACKET_DROPS

TILES, FRAME_END, CLASS_END, OBJECTS = 1, 2, 3, 5
CLOSED_BY_TIME, BAYES, HAS_CLASSES, HAS_NO_INDEXES, HAS_OBJECTS = 0x01, 0x02, 0x04, 0x08, 0x10
CLASSES = 2  # a storage
HEADER_BYTES = 48
TILES_BYTES = 24
WINDOW_BYTES = 48
TILES_ACROSS = 32
TILE_COUNT = TILES_ACROSS * TILES_ACROSS
OLDEST_REFERENCE = 7  # frames
FRAME_NUMBERS = tile_coding.FRAME_NUMBERS
NEVER_SEEN, SILENT, PARTIAL, COMPLETE = range(4)
NEVER = 0xFFFF  # the age of a sensor that was never seen


@dataclasses.dataclass(frozen=True)
class Sensor:
    state: int
    blocked: int  # 0 no, 1 in some sectors, 2 in all
    age: int
    packets: int
    points: int
    scan_number: int


@dataclasses.dataclass(frozen=True)
class Header:
    kind: int
    flags: int
    sequence: int
    frame: int
    closed_us: int
    complete: int
    partial: int
    points_used: int
    points_other: int
    packets_fused: int
    packets_dropped: int
    run: int


@dataclasses.dataclass(frozen=True)
class Tile:
    number: int
    encoding: int
    payload: bytes

    def reference(self, frame: int) -> int | None:
        """The frame that it refers to; `frame`: its own."""
        return tile_coding.reference_of(self.encoding, self.payload, frame)


@dataclasses.dataclass(frozen=True)
class Tiles:
    """What a message of tiles says: of tiles `first` to `end` - 1 these, of the others that nothing
    is known."""

    first: int
    end: int
    tiles: list[Tile]


@dataclasses.dataclass(frozen=True)
class Window:
    causes: int
    a: int
    b: int
    x_mm: int
    y_mm: int
    heading: int
    sigma_mm: int
    sigma_10_urad: int
    slices: int
    slice_ms: int
    begin_us: int
    end_us: int


@dataclasses.dataclass(frozen=True)
class ClassTile(Tile):
    age: int


@dataclasses.dataclass(frozen=True)
class ClassEnd:
    window: Window
    tiles_sent: int
    tiles_lost: int
    crc: int
    packets_placed: int
    packets_not_placed: int
    slices_over_budget: int
    groups: tuple[int, ...]  # fused, left, refreshed
    pose_fates: tuple[int, ...]
    causes: list[tuple[int, int, int]]  # slices, how often it began, when it did last
    slices: list[tuple[int, ...]]  # middle, x, y, heading, deviations
    map: map_state.MapState


@dataclasses.dataclass(frozen=True)
class FrameEnd:
    tiles_sent: int
    tiles_lost: int
    crc: int
    opened_us: int
    fates: tuple[int, ...]
    counters: dict[str, int]
    sensors: list[Sensor]
    unwatched: int  # bit i: no sensor watches sector i of 64
    blocked: int  # and some sensor is blocked there
    stack_bytes: int  # the deepest since start
    temperature_dc: int  # of the chip, 1/10 degree Celsius, -0x8000: not known


@dataclasses.dataclass(frozen=True)
class Frame(FrameEnd, Header):
    """One frame as it arrived. `crc` is what the target says, `crc_of_tiles` what its tiles say."""

    encodings: tuple[int, ...]  # how many tiles came in each encoding
    crc_of_tiles: int
    classes: ClassEnd | None  # what the target says of its classes
    class_crc_of_tiles: int
    objects: object_parts.List | None  # None: it looks for none

    @property
    def number(self) -> int:
        return self.frame

    @property
    def tiles_received(self) -> int:
        return sum(self.encodings)

    @property
    def has_evidence(self) -> bool:
        return (self.complete | self.partial) != 0

    @property
    def is_closed_by_time(self) -> bool:
        return self.flags & CLOSED_BY_TIME != 0

    def record(self, number: int) -> str:
        """The line that `iog fuse --hashes` writes for this frame."""
        packets = ",".join(str(sensor.packets) for sensor in self.sensors)
        return (f"{number} {self.complete:x} {self.partial:x} {packets} {self.points_used} "
                f"{self.tiles_received} {self.crc_of_tiles:08x}")


def read_header(content: bytes) -> Header:
    kind, flags, size, sequence, frame, closed_us, vehicle, sensors, complete, partial, zero, used, \
        other, fused, dropped, run = struct.unpack_from(">BBHIIQIBBBBIIIII", content)
    known = CLOSED_BY_TIME | BAYES | HAS_CLASSES | HAS_NO_INDEXES | HAS_OBJECTS | reception_parts.FLAG
    assert size == HEADER_BYTES and flags <= known and zero == 0
    assert vehicle == vehicle_id.REFERENCE_CAR and sensors == 4
    assert run != 0
    return Header(kind, flags, sequence, frame, closed_us, complete, partial, used, other, fused,
                  dropped, run)


def level_of(body: bytes) -> int:
    """Of the grid that the tiles are of: 0 cells, above it the coarse grids of the serial link."""
    return (struct.unpack_from(">H", body, 12)[0] // 100).bit_length() - 1


def is_of_classes(body: bytes) -> bool:
    """A body of tiles."""
    return body[7] == CLASSES


def read_window(data: bytes) -> Window:
    size, causes, a, b, x_mm, y_mm, heading, sigma, sigma_heading, slices, slice_ms, zero, begin_us, \
        end_us = struct.unpack_from(">HHiiiiIHHBBHQQ", data)
    assert size == WINDOW_BYTES and zero == 0 and causes < 0x100
    return Window(causes, a, b, x_mm, y_mm, heading, sigma, sigma_heading, slices, slice_ms, begin_us,
                  end_us)


def tiles_between(first: int, end: int, most: int, records: list[Tile]) -> Tiles:
    assert first < end <= most, f"tiles {first} to {end - 1}"
    numbers = [tile.number for tile in records]
    assert numbers == sorted(set(numbers)), "tiles out of order"
    assert all(first <= number < end for number in numbers), "a tile of which nothing was said"
    return Tiles(first, end, records)


def records_of(body: bytes, at: int, count: int, head: struct.Struct) -> Iterator[tuple[tuple[int, ...], bytes]]:
    """Of so many tiles what stands before each payload, and that; nothing is behind the last."""
    for _ in range(count):
        *fields, size = head.unpack_from(body, at)
        at += head.size + size
        yield fields, body[at - size:at]
    assert at == len(body), f"{len(body) - at} bytes behind the last tile"


def read_class_tiles(body: bytes) -> tuple[Window, Tiles]:
    first, end, count, *geometry = struct.unpack_from(">HHHBBHHHHii", body)
    assert geometry == [5, CLASSES, 1024, 1024, 100, 0, 0, 0]
    tiles = [ClassTile(number, encoding, payload, age) for (number, encoding, age), payload
             in records_of(body, TILES_BYTES + WINDOW_BYTES, count, struct.Struct(">HBBH"))]
    return read_window(body[TILES_BYTES:]), tiles_between(first, end, TILE_COUNT, tiles)


def read_class_end(body: bytes) -> ClassEnd:
    window = read_window(body)
    *counts, fates, causes, cause_bytes, slices, slice_bytes, zeros = \
        struct.unpack_from(">9I5B3s", body, WINDOW_BYTES)
    assert (fates, causes, cause_bytes, slice_bytes, zeros) == (16, 8, 16, 24, b"\0\0\0")
    assert slices == window.slices
    at = WINDOW_BYTES + 44
    pose_fates = struct.unpack_from(f">{fates}I", body, at)
    at += 4 * fates
    cause_records = list(struct.iter_unpack(">IIQ", body[at:at + 16 * causes]))
    at += 16 * causes
    end = at + 24 * slices
    assert len(body) >= end
    slice_records = list(struct.iter_unpack(">QiiIHH", body[at:end]))
    return ClassEnd(window, *counts[:6], tuple(counts[6:]), pose_fates, cause_records, slice_records,
                    map_state.read(body[end:]))


def read_tiles(body: bytes, level: int = 0) -> Tiles:
    side = 1024 >> level
    first, end, count, *geometry = struct.unpack_from(">HHHBBHHHHii", body)
    assert geometry == [5, int(level > 0), side, side, 100 << level, 5000, -51200, -51200]
    tiles = [Tile(number, encoding, payload) for (number, encoding), payload
             in records_of(body, TILES_BYTES, count, struct.Struct(">HBH"))]
    return tiles_between(first, end, TILE_COUNT >> 2 * level, tiles)


def read_frame_end(body: bytes) -> FrameEnd:
    sent, lost, crc, stack_bytes, opened_us, _ = struct.unpack_from(">IIIIQI", body)
    stages, fates, causes, links = struct.unpack_from(">BBBB", body, 28)
    assert (stages, fates, causes) == (4, 13, len(PACKET_DROPS))
    with_discovery = LINK_COUNTERS + DISCOVERY_COUNTERS
    all_links = with_discovery + COMMAND_COUNTERS
    assert links in (0, len(LINK_COUNTERS), len(with_discovery), len(all_links)), \
        "another spec.md"
    counts = struct.unpack_from(f">{stages + fates + causes + links}I", body, 32)
    at = 32 + 4 * len(counts)
    assert body[at:at + 4] == b"\x10\0\0\0", "a sensor record is 16 bytes"
    unwatched, blocked, temperature_dc, zeros = struct.unpack(">QQh6s", body[at + 4 + 4 * 16:])
    assert zeros == bytes(6)
    sensors = [Sensor(*struct.unpack_from(">BBHHxxII", body, at + 4 + 16 * i)) for i in range(4)]
    return FrameEnd(sent, lost, crc, opened_us, counts[stages:stages + fates],
                    dict(zip(PACKET_DROPS + all_links, counts[stages + fates:])), sensors, unwatched, blocked,
                    stack_bytes, temperature_dc)


class Assembler:
    """Takes every message in the order of arrival; a gap or a wrong byte is an AssertionError."""

    def __init__(self):
        self.messages = 0
        # Of each tile the last one sent by itself: of indexes, of classes.
        self._own: tuple[dict[int, tuple[int, bytes]], ...] = ({}, {})
        self._begin_frame()

    def _begin_frame(self) -> None:
        self._header: Header | None = None
        self._spoken_of = 0
        self._crc = 0
        self._encodings = [0] * 6
        self._window: Window | None = None
        self._classes_spoken_of = 0
        self._class_crc = 0
        self._class_tiles = 0
        self._class_end: ClassEnd | None = None
        self._objects: list[object_parts.Part] = []

    def begin_behind(self, sequence: int) -> None:
        """Messages were lost up to this one, the last of its frame."""
        self.messages = sequence + 1
        self._begin_frame()

    def take(self, message: bytes) -> Frame | None:
        """The frame that this message ends, if it does."""
        content = protected_message.content(message, self.messages)
        header, body = read_header(content), content[HEADER_BYTES:]
        assert header.sequence == self.messages, f"{header.sequence} where {self.messages} was due"
        self.messages += 1
        common = dataclasses.replace(header, kind=0, sequence=0)
        assert self._header in (None, common), "two messages of a frame disagree on it"
        self._header = common
        if header.kind == TILES and is_of_classes(body):
            self._take_classes(header.frame, *read_class_tiles(body))
            return None
        if header.kind == TILES:
            self._take_tiles(header.frame, read_tiles(body))
            return None
        if header.kind == CLASS_END:
            self._take_class_end(read_class_end(body))
            return None
        if header.kind == OBJECTS:
            assert self._class_end is not None
            self._objects.append(object_parts.read(body))
            return None
        assert header.kind == FRAME_END, f"message type {header.kind}"
        frame = self._frame(header, read_frame_end(body))
        self._begin_frame()
        return frame

    def _take_tiles(self, frame: int, message: Tiles) -> None:
        assert message.first == self._spoken_of, f"{message.first} instead of {self._spoken_of}"
        self._spoken_of = message.end
        for tile in message.tiles:
            cells = self._cells_of(frame, tile, self._own[0])
            assert any(cells), "a tile in which nothing is known"
            self._encodings[tile.encoding] += 1
            place = struct.pack(">HH", tile.number % TILES_ACROSS, tile.number // TILES_ACROSS)
            self._crc = protected_message.crc32_p4(place + cells, self._crc)

    def _take_classes(self, frame: int, window: Window, message: Tiles) -> None:
        assert self._window in (None, window), "two messages of a frame disagree on its window"
        if self._window is None:
            self._window = window
            self._class_crc = protected_message.crc32_p4(struct.pack(">ii", window.a, window.b))
        assert message.first == self._classes_spoken_of, "tiles of classes are out of order"
        self._classes_spoken_of = message.end
        for tile in message.tiles:
            cells = self._cells_of(frame, tile, self._own[1])
            assert any(cells) and all(cell == 0 or 8 <= cell < 72 for cell in cells), "no classes"
            self._class_tiles += 1
            self._class_crc = protected_message.crc32_p4(struct.pack(">H", tile.number) + cells, self._class_crc)

    def _take_class_end(self, end: ClassEnd) -> None:
        assert end.window == self._window and self._class_end is None
        assert self._classes_spoken_of == TILE_COUNT
        assert end.tiles_lost > 0 or end.tiles_sent == self._class_tiles
        self._class_end = end

    def _cells_of(self, frame: int, tile: Tile, own: dict[int, tuple[int, bytes]]) -> bytes:
        reference = tile.reference(frame)
        if reference is None:
            cells = tile_coding.decode(tile.encoding, tile.payload, None)
            own[tile.number] = (frame, cells)
            return cells
        own_frame, own_cells = own[tile.number]
        assert reference == own_frame, "not the last one that was sent by itself"
        assert (frame - own_frame) % FRAME_NUMBERS <= OLDEST_REFERENCE, f"frame {frame} refers to {own_frame}"
        return tile_coding.decode(tile.encoding, tile.payload, own_cells)

    def _frame(self, header: Header, end: FrameEnd) -> Frame:
        spoken_of = 0 if header.flags & HAS_NO_INDEXES else TILE_COUNT
        assert self._spoken_of == spoken_of, f"tile {self._spoken_of} has not been spoken of"
        assert (self._class_end is not None) == (header.flags & HAS_CLASSES != 0)
        assert bool(self._objects) == (header.flags & HAS_OBJECTS != 0)
        assert header.points_used == end.fates[0]
        assert header.points_other == sum(end.fates[1:])
        return Frame(**vars(header), **vars(end), encodings=tuple(self._encodings), crc_of_tiles=self._crc,
                     classes=self._class_end, class_crc_of_tiles=self._class_crc if self._class_tiles > 0 else 0,
                     objects=object_parts.joined(self._objects) if self._objects else None)
