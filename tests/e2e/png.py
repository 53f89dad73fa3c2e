"""Reads the pictures that a browser takes of itself: PNG of 8 bits a channel."""

import struct
import zlib


class Picture:
    """Its pixels, as (red, green, blue)."""

    def __init__(self, data: bytes):
        assert data[:8] == b"\x89PNG\r\n\x1a\n", "not a PNG"
        compressed = b""
        at = 8
        while at < len(data):
            size, kind = struct.unpack_from(">I4s", data, at)
            body = data[at + 8:at + 8 + size]
            if kind == b"IHDR":
                self.width, self.height, depth, colours, _, _, interlaced = \
                    struct.unpack(">IIBBBBB", body)
                assert (depth, interlaced) == (8, 0) and colours in (2, 6)
                self._channels = 3 if colours == 2 else 4
            elif kind == b"IDAT":
                compressed += body
            at += 12 + size
        self._rows = self._unfiltered(zlib.decompress(compressed))

    def _unfiltered(self, data: bytes) -> list[bytearray]:
        """Each row is written as differences from its neighbours, by one of five rules."""
        step, size = self._channels, self.width * self._channels
        rows = []
        above = bytearray(size)
        for number in range(self.height):
            start = number * (size + 1)
            rule, row = data[start], bytearray(data[start + 1:start + 1 + size])
            for i in range(size if rule else 0):
                left = row[i - step] if i >= step else 0
                corner = above[i - step] if i >= step else 0
                row[i] = row[i] + predicted(rule, left, above[i], corner) & 0xFF
            rows.append(row)
            above = row
        return rows

    def at(self, column: int, row: int) -> tuple[int, int, int]:
        start = column * self._channels
        red, green, blue = self._rows[row][start:start + 3]
        return red, green, blue


def predicted(rule: int, left: int, above: int, corner: int) -> int:
    if rule == 4:  # Paeth
        guess = left + above - corner
        return min((left, above, corner), key=lambda value: abs(guess - value))
    return (0, left, above, (left + above) // 2)[rule]
