"""Messages as they travel, read as docs/spec.md section 3.1 says: SOME/IP and E2E Profile 4."""

import dataclasses
import struct

SERVICE = 0x4F47
INTERFACE_VERSION = 5
NOTIFICATION = 2
PROTECTION_BYTES = 28
MAX_MESSAGE_BYTES = 1392


@dataclasses.dataclass(frozen=True)
class Channel:
    event: int
    data_id: int


OVER_UDP = Channel(0x8001, 0x494F4701)
OVER_UART = Channel(0x8002, 0x494F4702)


def _table(reflected_polynomial: int) -> list[int]:
    table = []
    for byte in range(256):
        for _ in range(8):
            byte = byte >> 1 ^ (reflected_polynomial if byte & 1 else 0)
        table.append(byte)
    return table


_P4 = _table(int(f"{0xF4ACFB13:032b}"[::-1], 2))


def crc32_p4(data: bytes, crc: int = 0) -> int:
    """Crc_CalculateCRC32P4 of AUTOSAR's CRC library: reflected, begun and ended by inversion. crc: of what came before."""
    crc ^= 0xFFFFFFFF
    for byte in data:
        crc = crc >> 8 ^ _P4[(crc ^ byte) & 0xFF]
    return crc ^ 0xFFFFFFFF


assert crc32_p4(b"123456789") == 0x1697D06A, "the check value that AUTOSAR publishes"


def protected_part(message: bytes) -> bytes:
    """What the CRC is of."""
    return message[8:24] + message[28:]


def content(message: bytes, number: int, channel: Channel = OVER_UDP) -> bytes:
    """What stands behind both headers. `number` messages came before; wrong bytes are an error."""
    assert PROTECTION_BYTES <= len(message) <= MAX_MESSAGE_BYTES, f"{len(message)} bytes"
    service, event, length, client, session, protocol, interface, kind, code = \
        struct.unpack_from(">HHIHHBBBB", message)
    assert (service, event, client) == (SERVICE, channel.event, 0), "another event"
    assert (protocol, interface, kind, code) == (1, INTERFACE_VERSION, NOTIFICATION, 0)
    assert session == number % 0xFFFF + 1, f"session {session} of message {number}"
    e2e_length, counter, data_id, crc = struct.unpack_from(">HHII", message, 16)
    assert length == e2e_length == len(message) - 8, (length, e2e_length, len(message))
    assert counter == number & 0xFFFF, f"counter {counter} where {number & 0xFFFF} was due"
    assert data_id == channel.data_id, f"data id {data_id:x}"
    assert crc == crc32_p4(protected_part(message)), "a wrong CRC"
    return message[PROTECTION_BYTES:]


def protect(content_bytes: bytes, number: int, channel: Channel = OVER_UDP) -> bytes:
    """The message of which content() gives this."""
    length = PROTECTION_BYTES + len(content_bytes) - 8
    head = struct.pack(">HHIHHBBBBHHI", SERVICE, channel.event, length, 0, number % 0xFFFF + 1, 1,
                       INTERFACE_VERSION, NOTIFICATION, 0, length, number & 0xFFFF,
                       channel.data_id)
    crc = crc32_p4(protected_part(head + bytes(4) + content_bytes))
    return head + struct.pack(">I", crc) + content_bytes


def of_version(message: bytes, interface_version: int) -> bytes:
    """The same message of another interface version: maps and poses have their own. Also sealed anew if it was changed."""
    changed = message[:13] + bytes([interface_version]) + message[14:24] + bytes(4) + message[28:]
    return changed[:24] + struct.pack(">I", crc32_p4(protected_part(changed))) + changed[28:]
