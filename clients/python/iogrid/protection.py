"""What is around each message: SOME/IP and E2E Profile 4 (docs/spec.md, 3.1)."""

import struct

import numpy

MOST_BYTES = 1392  # of a message
VERSION = 5  # of the interface


class Unsound(ValueError):
    """Bytes to drop, and to count by this cause."""


def require(is_sound: bool, cause: str = "unsound") -> None:
    if not is_sound:
        raise Unsound(cause)


def _crc_table() -> numpy.ndarray:
    """[k, b]: what CRC-32/P4 (3.1) makes of byte b and k zeros behind it. The CRC of bytes is the sum of these."""
    table = numpy.arange(256, dtype=numpy.uint32)
    for _ in range(8):
        table = table >> 1 ^ (table & 1) * numpy.uint32(0xC8DF352F)
    rows = [table]
    while len(rows) < MOST_BYTES:
        rows.append(rows[-1] >> 8 ^ table[rows[-1] & 0xFF])
    return numpy.stack(rows)


_P4 = _crc_table()


def crc_p4(data: bytes, crc: int = 0) -> int:
    """CRC-32/P4 of 4 to MOST_BYTES bytes. `crc` is the CRC of the bytes before them."""
    state = numpy.frombuffer(data, numpy.uint8).copy()
    state[:4] ^= numpy.frombuffer((crc ^ 0xFFFFFFFF).to_bytes(4, "little"), numpy.uint8)
    return int(numpy.bitwise_xor.reduce(_P4[numpy.arange(len(state))[::-1], state])) ^ 0xFFFFFFFF


def content_of(message: bytes) -> tuple[bytes, int]:
    """What is behind the headers of SOME/IP and E2E Profile 4, and the counter (3.1)."""
    require(len(message) >= 28 and struct.unpack_from(">HH8xB", message) == (0x4F47, 0x8001, 1), "not ours")
    length, version, kind, code, length_again, counter, data_id, crc = struct.unpack_from(">4xI5xBBBHHII", message)
    require(version == VERSION, f"interface version {version}")
    require(length == length_again == len(message) - 8 <= MOST_BYTES - 8, "damaged")
    require((kind, code, data_id) == (2, 0, 0x494F4701), "damaged")
    require(crc == crc_p4(message[8:24] + message[28:]), "damaged")
    return message[28:], counter
