"""What may come from a sensor's own address to its own port, and is not what the sensor measured.

Every attack returns (cause, frame): the frame, and the one counter of docs/spec.md (1.4 or 3.5)
that it must end in. None of them may change a grid.
"""

import random
import struct

import ethernet
from capture import Packet
from sabrelite import IP, scan, to_board

FORGER_MAC = ethernet.mac("02:69:6f:67:00:03")
# Packets that the firmware still remembers: 192 of each sensor, which sends six or seven a frame.
FRAMES_REMEMBERED = 7


def patched(data: bytes, at: int, form: str, *values: int) -> bytes:
    """`data` with these values packed over what was at `at`."""
    new = struct.pack(form, *values)
    return data[:at] + new + data[at + len(new):]


class HostileScans:
    def __init__(self, rng: random.Random):
        self._random = rng
        self._frames: list[list[Packet]] = [[]]  # fused already; the last one is still open
        self._attacks = [self.truncated, self.wrong_count, self.wrong_body_size,
                         self.trailing_bytes, self.wrong_magic, self.wrong_type, self.wrong_turn,
                         self.wrong_sector, self.wrong_layer, self.wrong_echo, self.outside_sector,
                         self.duplicate, self.damaged_scan, self.damaged_ip_header, self.fragment]

    def attacks(self) -> list:
        """Those that are possible by now: each begins with a good packet that was sent before."""
        if not self._good():
            return []
        return self._attacks + ([self.late] if len(self._frames) > 1 else [])

    def fused(self, packet: Packet) -> None:
        """The firmware has been sent this good packet."""
        self._frames[-1].append(packet)

    def next_frame(self) -> None:
        self._frames.append([])

    def _good(self) -> list[Packet]:
        return [packet for frame in self._frames[-FRAMES_REMEMBERED:] for packet in frame]

    def _packet(self) -> Packet:
        return self._random.choice(self._good())

    def _altered(self, cause: str, packet: Packet, payload: bytes) -> tuple[str, bytes]:
        return cause, scan(packet.source, packet.ports, payload)

    def truncated(self):
        packet = self._packet()
        size = self._random.randrange(len(packet.payload))
        return self._altered("wrong length", packet, packet.payload[:size])

    def wrong_count(self):
        packet = self._packet()
        count = struct.unpack_from("<H", packet.payload, 24 + 28)[0]
        other = self._random.choice([0, count - 1, count + 1, 6554, 0x7FFF, 0x8000, 0xFFFF])
        return self._altered("wrong length", packet, patched(packet.payload, 52, "<H", other))

    def wrong_body_size(self):
        packet = self._packet()
        size = self._random.choice([0, 43, 44, len(packet.payload), 0x7FFFFFFF, 0xFFFFFFFF])
        return self._altered("wrong length", packet, patched(packet.payload, 8, ">I", size))

    def trailing_bytes(self):
        packet = self._packet()
        more = self._random.randbytes(self._random.randrange(1, 1473 - len(packet.payload)))
        return self._altered("wrong length", packet, packet.payload + more)

    def wrong_magic(self):
        packet = self._packet()
        bit = 1 << self._random.randrange(32)
        return self._altered("wrong type", packet,
                             patched(packet.payload, 0, ">I", 0xAFFEC0C2 ^ bit))

    def wrong_type(self):
        packet = self._packet()
        kind = self._random.choice([0, 0x0222, 0x2204, 0x2205, 0x2221, 0x6400])
        return self._altered("wrong type", packet, patched(packet.payload, 14, ">H", kind))

    def wrong_turn(self):
        packet = self._packet()
        ticks = self._random.choice([0, 1, 11519, 11521, 0xFFFF])
        return self._altered("wrong angle", packet, patched(packet.payload, 46, "<H", ticks))

    def wrong_sector(self):
        packet = self._packet()
        at, angle = self._random.choice([(48, 5761), (48, 32767), (50, -5761), (50, -32768)])
        return self._altered("wrong angle", packet, patched(packet.payload, at, "<h", angle))

    def _with_wrong_point(self, offset: int, form: str, value: int):
        packet = self._packet()
        point = self._random.randrange((len(packet.payload) - 68) // 10)
        return self._altered("wrong point", packet,
                             patched(packet.payload, 68 + 10 * point + offset, form, value))

    def wrong_layer(self):
        return self._with_wrong_point(0, "B", self._random.randrange(4, 16))

    def wrong_echo(self):
        return self._with_wrong_point(0, "B", self._random.randrange(3, 16) << 4)

    def outside_sector(self):
        # A LUX sees 50 degrees (1600 ticks) to either side.
        angle = self._random.choice([-32768, -5761, -1700, 1700, 5761, 32767])
        return self._with_wrong_point(2, "<h", angle)

    def duplicate(self):
        packet = self._packet()
        return self._altered("duplicate", packet, packet.payload)

    def late(self):
        """Of a scan whose frame is closed, and unlike anything that was fused: another end time."""
        closed = self._frames[-FRAMES_REMEMBERED:-1]
        packet = self._random.choice([packet for frame in closed for packet in frame])
        end = self._random.randrange(1 << 64)
        return self._altered("late", packet, patched(packet.payload, 38, "<Q", end))

    def damaged_scan(self):
        """One bit of a good datagram is wrong, and its UDP checksum says so."""
        frame = bytearray(scan(self._packet().source, (12000, 12002), self._packet().payload))
        frame[self._random.randrange(42, len(frame))] ^= 1 << self._random.randrange(8)
        return "bad UDP checksum", bytes(frame)

    def damaged_ip_header(self):
        packet = self._packet()
        frame = bytearray(scan(packet.source, packet.ports, packet.payload))
        frame[self._random.choice([15, 18, 19, 22, 26, 29, 30])] ^= 1 << self._random.randrange(8)
        return "bad IP checksum", bytes(frame)

    def fragment(self):
        packet = self._packet()
        # Not the last, and no whole units: no datagram has such a piece.
        flags_and_offset = self._random.choice([0x2000, 0x2001, 0x20B9])
        datagram = ethernet.udp(packet.source, IP, *packet.ports, packet.payload)[20:]
        datagram = datagram[:len(datagram) // 8 * 8 - self._random.randrange(1, 8)]
        piece = ethernet.ipv4(packet.source, IP, ethernet.UDP, datagram, flags_and_offset)
        return "fragment", to_board(ethernet.TYPE_IPV4, piece, FORGER_MAC)
