"""What a target says of its map, read as docs/spec.md 3.10 says."""

import dataclasses
import struct


@dataclasses.dataclass(frozen=True)
class MapState:
    cause: int
    blur_cells: int
    tiles_drawn: int
    tiles_outside: int
    tiles_waiting: int
    flags: int
    source: int
    crc: int
    origin: int
    pose_origin: int
    x_mm: int
    y_mm: int
    heading: int
    sigma_mm: int
    sigma_10_urad: int
    delivery: int
    refusal: int
    refused: int
    incoming_crc: int
    incoming_bytes: int
    chunks_there: int
    times: tuple[int, ...]  # how often each cause began
    chunks: tuple[int, ...]  # by fate
    attribution: str


def read(part: bytes) -> MapState:
    size, cause, blur, drawn, outside, waiting, flags, source, *transform, delivery, refusal, causes, fates, \
        refused, crc, incoming, there, attribution, zeros = \
        struct.unpack_from(">HBBHHHBBIQQiiIHH4B4IB3s", part)
    assert size == len(part) and (causes, fates, zeros) == (9, 12, b"\0\0\0")
    counts = struct.unpack_from(f">{causes + fates}I", part, 72)
    words = part[72 + 4 * (causes + fates):]
    assert len(words) == attribution
    return MapState(cause, blur, drawn, outside, waiting, flags, source, *transform, delivery, refusal,
                    refused, crc, incoming, there, counts[:causes], counts[causes:], words.decode())
