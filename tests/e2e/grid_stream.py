"""The firmware's messages, read as docs/spec.md section 3 says, and put together to frames."""

import dataclasses
import struct
import zlib

import protected_message
import tile_coding

TILES, FRAME_END = 1, 2
CLOSED_BY_TIME = 0x01
BAYES = 0x02
HEADER_BYTES = 44
TILES_ACROSS = 32
TILE_COUNT = TILES_ACROSS * TILES_ACROSS
OLDEST_REFERENCE = 7  # frames
NEVER_SEEN, SILENT, PARTIAL, COMPLETE = range(4)
NEVER = 0xFFFF  # the age of a sensor that was never seen

PACKET_DROPS = ("stranger", "wrong length", "wrong type", "wrong angle", "wrong point", "duplicate",
                "late", "over budget")
NET_DROPS = ("short", "not for us (MAC)", "VLAN tagged", "neither IPv4 nor ARP", "bad IP header",
             "bad IP checksum", "fragment", "not for us (IP)", "bad source", "neither UDP nor ICMP",
             "bad UDP length", "bad UDP checksum", "bad ICMP", "ping ignored", "other ICMP",
             "bad ARP", "ARP ignored", "address conflict", "reply without room")
LINK_COUNTERS = ("frames received", "datagrams delivered", "ARP answered", "ARP learned",
                 "pings answered", "messages sent", "ARP requested", *NET_DROPS,
                 "peer unresolved", "ring full", "misuse",
                 "port received", "receive errors", "oversized", "port sent", "port refused")
# What the header of a message counts as dropped, besides PACKET_DROPS: damaged datagrams.
DAMAGED = ("short", "bad IP header", "bad IP checksum", "fragment", "bad source", "bad UDP length",
           "bad UDP checksum", "receive errors", "oversized")


@dataclasses.dataclass(frozen=True)
class Sensor:
    state: int
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


@dataclasses.dataclass(frozen=True)
class Tile:
    number: int
    encoding: int
    payload: bytes

    @property
    def reference(self) -> int | None:
        return tile_coding.reference_of(self.encoding, self.payload)


@dataclasses.dataclass(frozen=True)
class Tiles:
    """What a message of tiles says: of tiles `first` to `end` - 1 these, of the others that nothing
    is known."""

    first: int
    end: int
    tiles: list[Tile]


@dataclasses.dataclass(frozen=True)
class FrameEnd:
    tiles_sent: int
    tiles_lost: int
    crc: int
    opened_us: int
    fates: tuple[int, ...]
    counters: dict[str, int]
    sensors: list[Sensor]


@dataclasses.dataclass(frozen=True)
class Frame:
    """One frame as it arrived. `crc` is what the target says, `crc_of_tiles` what its tiles say."""

    number: int
    closed_us: int
    opened_us: int
    complete: int
    partial: int
    flags: int
    points_used: int
    packets_fused: int
    packets_dropped: int
    tiles_sent: int
    tiles_lost: int
    tiles_received: int
    encodings: tuple[int, ...]  # how many tiles came in each encoding
    crc: int
    crc_of_tiles: int
    counters: dict[str, int]
    sensors: list[Sensor]

    @property
    def has_evidence(self) -> bool:
        return (self.complete | self.partial) != 0

    @property
    def is_closed_by_time(self) -> bool:
        return self.flags & CLOSED_BY_TIME != 0

    def record(self, number: int) -> str:
        """The line that `iog fuse --hashes` writes for this frame."""
        return (f"{number} {self.complete:x} {self.partial:x} {self.points_used} "
                f"{self.tiles_received} {self.crc_of_tiles:08x}")


def read_header(content: bytes) -> Header:
    kind, flags, size, sequence, frame, closed_us, vehicle, sensors, complete, partial, zero, used, \
        other, fused, dropped = struct.unpack_from(">BBHIIQIBBBBIIII", content)
    assert size == HEADER_BYTES and flags <= CLOSED_BY_TIME | BAYES and zero == 0
    assert vehicle == zlib.crc32(b"reference_car") and sensors == 4
    return Header(kind, flags, sequence, frame, closed_us, complete, partial, used, other, fused,
                  dropped)


def level_of(body: bytes) -> int:
    """Of the grid that the tiles are of: 0 cells, above it the coarse grids of the serial link."""
    return (struct.unpack_from(">H", body, 12)[0] // 100).bit_length() - 1


def read_tiles(body: bytes, level: int = 0) -> Tiles:
    side = 1024 >> level
    first, end, count, side_log2, storage, width, height, cell_mm, zero, x_mm, y_mm = \
        struct.unpack_from(">HHHBBHHHHii", body)
    assert (side_log2, storage, zero) == (5, int(level > 0), 0)
    assert (width, height, cell_mm, x_mm, y_mm) == (side, side, 100 << level, -51200, -51200)
    assert first < end <= TILE_COUNT >> 2 * level, f"tiles {first} to {end - 1}"
    tiles = []
    at = 24
    for _ in range(count):
        number, encoding, size = struct.unpack_from(">HBH", body, at)
        tiles.append(Tile(number, encoding, body[at + 5:at + 5 + size]))
        at += 5 + size
    assert at == len(body), f"{len(body) - at} bytes behind the last tile"
    numbers = [tile.number for tile in tiles]
    assert numbers == sorted(set(numbers)), "tiles out of order"
    assert all(first <= number < end for number in numbers), "a tile of which nothing was said"
    return Tiles(first, end, tiles)


def read_frame_end(body: bytes) -> FrameEnd:
    sent, lost, crc, _, opened_us, _ = struct.unpack_from(">IIIIQI", body)
    stages, fates, causes, links = struct.unpack_from(">BBBB", body, 28)
    assert (stages, fates) == (3, 8)
    assert causes == len(PACKET_DROPS) and links in (0, len(LINK_COUNTERS)), "another spec.md"
    counts = struct.unpack_from(f">{stages + fates + causes + links}I", body, 32)
    at = 32 + 4 * len(counts)
    assert body[at:at + 4] == b"\x10\0\0\0", "a sensor record is 16 bytes"
    assert len(body) == at + 4 + 4 * 16
    sensors = [Sensor(*struct.unpack_from(">BxHHxxII", body, at + 4 + 16 * i)) for i in range(4)]
    return FrameEnd(sent, lost, crc, opened_us, counts[stages:stages + fates],
                    dict(zip(PACKET_DROPS + LINK_COUNTERS, counts[stages + fates:])), sensors)


class Assembler:
    """Takes every message in the order of arrival; a gap or a wrong byte is an AssertionError."""

    def __init__(self):
        self.messages = 0
        self._own: dict[int, tuple[int, bytes]] = {}  # of each tile the last one sent by itself
        self._begin_frame()

    def _begin_frame(self) -> None:
        self._header: Header | None = None
        self._spoken_of = 0
        self._crc = 0
        self._encodings = [0, 0, 0, 0]

    def take(self, message: bytes) -> Frame | None:
        """The frame that this message ends, if it does."""
        content = protected_message.content(message, self.messages)
        header, body = read_header(content), content[HEADER_BYTES:]
        assert header.sequence == self.messages, f"{header.sequence} where {self.messages} was due"
        self.messages += 1
        common = dataclasses.replace(header, kind=0, sequence=0)
        assert self._header in (None, common), "two messages of a frame disagree on it"
        self._header = common
        if header.kind == TILES:
            self._take_tiles(header.frame, read_tiles(body))
            return None
        assert header.kind == FRAME_END, f"message type {header.kind}"
        frame = self._frame(header, read_frame_end(body))
        self._begin_frame()
        return frame

    def _take_tiles(self, frame: int, message: Tiles) -> None:
        assert message.first == self._spoken_of, f"{message.first} instead of {self._spoken_of}"
        self._spoken_of = message.end
        for tile in message.tiles:
            cells = self._cells_of(frame, tile)
            assert any(cells), "a tile in which nothing is known"
            self._encodings[tile.encoding] += 1
            place = struct.pack(">HH", tile.number % TILES_ACROSS, tile.number // TILES_ACROSS)
            self._crc = zlib.crc32(place + cells, self._crc)

    def _cells_of(self, frame: int, tile: Tile) -> bytes:
        if tile.reference is None:
            cells = tile_coding.decode(tile.encoding, tile.payload, None)
            self._own[tile.number] = (frame, cells)
            return cells
        own_frame, own_cells = self._own[tile.number]
        assert tile.reference == own_frame, "not the last one that was sent by itself"
        assert frame - own_frame <= OLDEST_REFERENCE, f"frame {frame} refers to {own_frame}"
        return tile_coding.decode(tile.encoding, tile.payload, own_cells)

    def _frame(self, header: Header, end: FrameEnd) -> Frame:
        assert self._spoken_of == TILE_COUNT, f"tile {self._spoken_of} has not been spoken of"
        assert header.points_used == end.fates[0]
        assert header.points_other == sum(end.fates[1:])
        return Frame(header.frame, header.closed_us, end.opened_us, header.complete, header.partial,
                     header.flags, header.points_used, header.packets_fused, header.packets_dropped,
                     end.tiles_sent, end.tiles_lost, sum(self._encodings), tuple(self._encodings),
                     end.crc, self._crc, end.counters, end.sensors)
