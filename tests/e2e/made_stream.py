"""A target that is made by hand: whatever grid is wanted, sent as docs/spec.md section 3 says."""

import itertools
import socket
import struct

import grid_stream
import made_classes
import object_parts
import protected_message
import vehicle_id

SIDE = 1024
TILE = 32
FRAME_US = 40_000


class Grid:
    """Occupancy indexes by cell; what is not set is unknown."""

    def __init__(self, columns: int = SIDE, rows: int = SIDE, cell_mm: int = 100,
                 corner_mm: tuple[int, int] = (-51200, -51200), epsilon_e5: int = 5000):
        self.tiles: dict[int, bytearray] = {}
        self.geometry = (5, 0, columns, rows, cell_mm, epsilon_e5, *corner_mm)
        self.across, self.tile_count = columns // TILE, columns // TILE * (rows // TILE)

    def set(self, x: int, y: int, index: int) -> None:
        tile = self.tiles.setdefault(y // TILE * self.across + x // TILE, bytearray(TILE * TILE))
        tile[y % TILE * TILE + x % TILE] = index & 0xFF

    def fill(self, xs: range, ys: range, index: int) -> None:
        for y in ys:
            for x in xs:
                self.set(x, y, index)

    @property
    def crc(self) -> int:
        crc = 0
        for number, cells in sorted(self.tiles.items()):
            if any(cells):
                place = struct.pack(">HH", number % self.across, number // self.across)
                crc = protected_message.crc32_p4(place + cells, crc)
        return crc


class Target:
    """Sends frames to a UDP port of this PC. A new one counts everything from 0, as after a reset,
    and is another run."""

    _runs = itertools.count(1)

    def __init__(self, port: int, vehicle: int = vehicle_id.REFERENCE_CAR):
        self.run = next(self._runs)
        self._to = ("127.0.0.1", port)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._vehicle = vehicle
        self.messages = 0
        self.frames = 0
        self.complete = 0b1111  # sensors, a bit each
        self.points_other = 0  # scan points that were not used
        self.unwatched = self.blocked = 0  # sectors around the car, a bit each
        self.frame_us = FRAME_US
        self.temperature_dc = -0x8000  # of the chip, 1/10 degree Celsius: not known

    def messages_of(self, grid: Grid, points_used: int = 0,
                    window: made_classes.Window | None = None) -> list[bytes]:
        """The next frame's."""
        known = sorted(number for number, cells in grid.tiles.items() if any(cells))
        bodies = []
        first = 0
        for i, number in enumerate(known):
            end = known[i + 1] if i + 1 < len(known) else grid.tile_count
            record = struct.pack(">HBH", number, 0, TILE * TILE) + grid.tiles[number]
            bodies.append((grid_stream.TILES, self._tiles_header(grid, first, end, 1) + record))
            first = end
        if not known:
            bodies.append((grid_stream.TILES, self._tiles_header(grid, 0, grid.tile_count, 0)))
        bodies += window.bodies() if window else []
        if window and window.objects is not None:
            bodies += [(grid_stream.OBJECTS, body) for body in object_parts.bodies(
                window.objects, window.objects_us, *window.objects_left)]
        bodies.append((grid_stream.FRAME_END, self._end(len(known), grid.crc, points_used)))
        flags = made_classes.HAS_CLASSES if window else 0
        if window and window.objects is not None:
            flags |= grid_stream.HAS_OBJECTS
        messages = []
        for kind, body in bodies:
            content = self._header(kind, flags, points_used) + body
            messages.append(protected_message.protect(content, self.messages))
            self.messages += 1
        self.frames += 1
        return messages

    def send(self, grid: Grid, points_used: int = 0,
             window: made_classes.Window | None = None) -> None:
        for message in self.messages_of(grid, points_used, window):
            self.send_bytes(message)

    def send_bytes(self, datagram: bytes) -> None:
        self._socket.sendto(datagram, self._to)

    @property
    def _closed_us(self) -> int:
        return (self.frames + 1) * self.frame_us

    def _header(self, kind: int, flags: int, points_used: int) -> bytes:
        return struct.pack(">BBHIIQIBBBBIIIII", kind, flags, grid_stream.HEADER_BYTES, self.messages,
                           self.frames, self._closed_us, self._vehicle, 4, self.complete, 0, 0,
                           points_used, self.points_other, 4, 0, self.run)

    @staticmethod
    def _tiles_header(grid: Grid, first: int, end: int, count: int) -> bytes:
        return struct.pack(">HHHBBHHHHii", first, end, count, *grid.geometry)

    def _end(self, tiles: int, crc: int, points_used: int) -> bytes:
        stages, fates, causes = (4, 13, 12)
        head = struct.pack(">IIIIQIBBBB", tiles, 0, crc, 2048, self._closed_us - self.frame_us,
                           1_000_000, stages, fates, causes, 0)
        counts = struct.pack(">4I13I12I", 3000, 40, 1500, 0, points_used, *([0] * 24))
        sensor = struct.pack(">BxHHxxII", grid_stream.COMPLETE, 0, 1, points_used // 4, self.frames)
        return head + counts + b"\x10\0\0\0" + sensor * 4 + struct.pack(
            ">QQhxx4x", self.unwatched, self.blocked, self.temperature_dc)
