"""Maps on their way to the target, as docs/spec.md 7.1 has them."""

import struct
import zlib

import protected_message

PORT = 15011
CHANNEL = protected_message.Channel(0x8004, 0x494F4704)
CHUNK_BYTES = 1280
TAKEN, REPEATED, IN_USE, OTHER_BLOCK, STRANGER, DAMAGED = 0, 1, 2, 3, 4, 8  # fates


def crc_of(block: bytes) -> int:
    return struct.unpack_from(">I", block, 12)[0]


def contents_of(block: bytes) -> list[bytes]:
    """Of its chunks' messages."""
    pieces = [block[at:at + CHUNK_BYTES] for at in range(0, len(block), CHUNK_BYTES)]
    return [struct.pack(">BBHIIIHH", 1, 0, 20, crc_of(block), len(block), CHUNK_BYTES * i, len(piece), 0) + piece
            for i, piece in enumerate(pieces)]


def message(content: bytes, number: int) -> bytes:
    """The interface version is that of maps."""
    return protected_message.of_version(protected_message.protect(content, number, CHANNEL), 1)


def with_accuracy(block: bytes, accuracy_mm: int) -> bytes:
    """Another map: the same with another accuracy, and a CRC that is right."""
    changed = block[:52] + struct.pack(">I", accuracy_mm) + block[56:]
    return changed[:12] + struct.pack(">I", zlib.crc32(changed[:12] + changed[16:])) + changed[16:]
