"""The messages of what a target has received, read and written as docs/spec.md 3.13 says."""

import dataclasses
import struct

HEADER = struct.Struct(">HHHBBII")
RECORD = struct.Struct(">HBBII")
OF_A_PART = 100
KIND, FLAG = 6, 0x20


@dataclasses.dataclass(frozen=True)
class Reception:
    port: int
    left: int
    key: int
    before_close_us: int


@dataclasses.dataclass(frozen=True)
class Part:
    count: int  # in the frame
    number: int
    parts: int
    not_listed: int
    receptions: list[Reception]


def read(body: bytes) -> Part:
    header_bytes, record_bytes, count, number, parts, not_listed, zero = HEADER.unpack_from(body)
    assert (header_bytes, record_bytes, zero) == (HEADER.size, RECORD.size, 0)
    receptions = []
    for port, flags, zero, key, before_close_us in RECORD.iter_unpack(body[HEADER.size:]):
        assert flags <= 1 and zero == 0
        receptions.append(Reception(port, flags, key, before_close_us))
    assert parts == max(1, -(-count // OF_A_PART)) and number < parts
    assert len(receptions) == min(OF_A_PART, count - number * OF_A_PART)
    return Part(count, number, parts, not_listed, receptions)


def body(receptions: list[Reception], not_listed: int) -> bytes:
    """Of a list that fits into one part."""
    assert len(receptions) <= OF_A_PART
    return HEADER.pack(HEADER.size, RECORD.size, len(receptions), 0, 1, not_listed, 0) + b"".join(
        RECORD.pack(each.port, each.left, 0, each.key, each.before_close_us) for each in receptions)
