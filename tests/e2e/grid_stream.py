"""The firmware's messages, read as docs/spec.md section 3 says, and put together to frames."""

import dataclasses
import struct
import zlib

CLOSED_BY_TIME = 0x01
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


class Assembler:
    """Takes every message in the order of arrival; a gap or a wrong byte is an AssertionError."""

    def __init__(self):
        self.messages = 0
        self._tiles = 0
        self._crc = 0
        self._last_place = (-1, -1)

    def take(self, message: bytes) -> Frame | None:
        """The frame that this message ends, if it does."""
        magic, version, kind, header_bytes, sequence = struct.unpack_from(">IBBHI", message)
        assert (magic, version, header_bytes) == (0x494F4752, 1, 48), "not a message of version 1"
        assert sequence == self.messages, f"message {sequence} where {self.messages} was due"
        self.messages += 1
        if kind == 1:
            self._take_tile(message)
            return None
        assert kind == 2, f"message type {kind}"
        frame = self._frame(message)
        self._tiles, self._crc, self._last_place = 0, 0, (-1, -1)
        return frame

    def _take_tile(self, message: bytes) -> None:
        x, y, side_log2, encoding, storage, zero, width, height, cell_mm, size, x_mm, y_mm = \
            struct.unpack_from(">HHBBBBHHHHii", message, 48)
        assert (side_log2, encoding, storage, zero, size) == (5, 0, 0, 0, 1024)
        assert (width, height, cell_mm, x_mm, y_mm) == (1024, 1024, 100, -51200, -51200)
        assert len(message) == 72 + 1024
        assert x < 32 and (y, x) > self._last_place and y < 32, "a tile out of order"
        assert any(message[72:]), "a tile in which nothing is known"
        self._last_place = (y, x)
        self._tiles += 1
        self._crc = zlib.crc32(struct.pack(">HH", x, y) + message[72:], self._crc)

    def _frame(self, message: bytes) -> Frame:
        (number, closed_us, vehicle, sensor_count, complete, partial, flags, used, _, fused,
         dropped) = struct.unpack_from(">IQIBBBBIIII", message, 12)
        assert vehicle == zlib.crc32(b"reference_car") and sensor_count == 4
        sent, lost, crc, _, opened_us, _ = struct.unpack_from(">IIIIQI", message, 48)
        stages, fates, causes, links = struct.unpack_from(">BBBB", message, 76)
        assert (stages, fates) == (3, 8)
        assert causes == len(PACKET_DROPS) and links == len(LINK_COUNTERS), "another spec.md"
        at = 80 + 4 * (stages + fates)
        counts = struct.unpack_from(f">{causes + links}I", message, at)
        at += 4 * len(counts)
        assert message[at:at + 4] == b"\x10\0\0\0", "a sensor record is 16 bytes"
        sensors = [Sensor(*struct.unpack_from(">BxHHxxII", message, at + 4 + 16 * i))
                   for i in range(sensor_count)]
        assert len(message) == at + 4 + 16 * sensor_count
        return Frame(number, closed_us, opened_us, complete, partial, flags, used, fused, dropped,
                     sent, lost, self._tiles, crc, self._crc,
                     dict(zip(PACKET_DROPS + LINK_COUNTERS, counts)), sensors)
