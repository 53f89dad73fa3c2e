"""UDP datagrams out of a capture file: pcap or pcapng, as it is or packed by gzip or zstd."""

import collections
import contextlib
import gzip
import struct
import subprocess
import zlib
from collections.abc import Iterator
from typing import BinaryIO

PCAP_ORDERS = {b"\xd4\xc3\xb2\xa1": "<", b"\x4d\x3c\xb2\xa1": "<", b"\xa1\xb2\xc3\xd4": ">", b"\xa1\xb2\x3c\x4d": ">"}
PCAPNG, PCAPNG_ORDERS = b"\n\r\r\n", {b"\x4d\x3c\x2b\x1a": "<", b"\x1a\x2b\x3c\x4d": ">"}
GZIP, ZSTD = b"\x1f\x8b", b"\x28\xb5\x2f\xfd"
# By link type the bytes of its header and where its EtherType is: Ethernet, both of Linux "any", loopbacks, raw IP. As
# tools/formats/capture/link_layer.cpp; tests/host/clients/captures_test.py compares them.
LINKS = {1: (14, 12), 113: (16, 14), 276: (20, 0), **dict.fromkeys((0, 108), (4, None)),
         **dict.fromkeys((12, 14, 101, 228), (0, None))}
IPV4, VLAN_TAGS = b"\x08\x00", (b"\x81\x00", b"\x88\xa8", b"\x91\x00")
INTERFACE, OLD_PACKET, SIMPLE_PACKET, PACKET = 1, 2, 3, 6  # blocks of pcapng
LONGEST_PACKET, LONGEST_BLOCK = 1 << 18, 1 << 24  # bytes


class _BreaksOff(Exception):
    """The file ends in the middle, or goes on with what is none."""


def datagrams(path: str, port: int, dropped: collections.Counter[str]) -> Iterator[bytes]:
    """What went to a UDP port, in the order of the file. ValueError if it is no capture."""
    with open(path, "rb") as plain:
        magic = plain.read(4)
        plain.seek(0)
        try:
            with _unpacked(path, plain, magic) as file:
                for link, packet, size in _packets(path, file):
                    if link not in LINKS:
                        dropped["packet of a link type that is not read"] += 1
                    elif len(packet) < size:
                        dropped["packet that the capture cuts short"] += 1
                    elif (payload := _payload(link, packet, port)) is not None:
                        yield payload
        except (_BreaksOff, EOFError, gzip.BadGzipFile, zlib.error):
            dropped["capture that is cut short"] += 1


@contextlib.contextmanager
def _unpacked(path: str, plain: BinaryIO, magic: bytes) -> Iterator[BinaryIO]:
    """The bytes before they were packed. Python 3.11 has no zstd: the program does it, with 128 MiB at most."""
    if magic != ZSTD:
        yield gzip.GzipFile(fileobj=plain) if magic[:2] == GZIP else plain
        return
    try:
        with open(path, "rb") as packed:
            zstd = subprocess.Popen(["zstd", "-dcq", "--memory=128MB"], stdin=packed, stdout=subprocess.PIPE,
                                    stderr=subprocess.DEVNULL)
    except FileNotFoundError:
        raise ValueError(f"{path}: packed by zstd; the program zstd, which unpacks it, is not installed") from None
    try:
        yield zstd.stdout
        if zstd.wait() != 0:
            raise _BreaksOff
    except ValueError:  # of nothing, if it is damaged at its beginning
        if not zstd.stdout.read(1) and zstd.wait() != 0:
            raise _BreaksOff from None
        raise
    finally:
        zstd.kill()
        zstd.stdout.close()
        zstd.wait()


def _packets(path: str, file: BinaryIO) -> Iterator[tuple[int | None, bytes, int]]:
    """Link types, packets as captured, and their original lengths."""
    magic = file.read(4)
    if order := PCAP_ORDERS.get(magic):
        yield from _pcap(path, file, order)
    elif magic == PCAPNG:
        yield from _pcapng(file)
    else:
        raise ValueError(f"{path}: no pcap or pcapng")


def _exactly(file: BinaryIO, count: int) -> bytes:
    data = file.read(count)
    if len(data) < count:
        raise _BreaksOff
    return data


def _pcap(path: str, file: BinaryIO, order: str) -> Iterator[tuple[int, bytes, int]]:
    link = struct.unpack(order + "16xI", _exactly(file, 20))[0] & 0xFFFF
    if link not in LINKS:
        raise ValueError(f"{path}: no pcap of Ethernet, Linux cooked, a loopback or raw IP")
    while head := file.read(16):
        kept, size = struct.unpack(order + "8xII", head) if len(head) == 16 else (LONGEST_PACKET + 1, 0)
        if kept > LONGEST_PACKET:
            raise _BreaksOff
        yield link, _exactly(file, kept), size


def _pcapng(file: BinaryIO) -> Iterator[tuple[int | None, bytes, int]]:
    kind, order, links = PCAPNG, "<", []
    while kind:
        if len(kind) < 4:
            raise _BreaksOff
        head = _exactly(file, 8 if kind == PCAPNG else 4)
        if kind == PCAPNG:  # a section begins, in an order of its own
            order, links = PCAPNG_ORDERS.get(head[4:]), []
        size = struct.unpack_from(order + "I", head)[0] if order else 0
        if size % 4 or not 12 <= size <= LONGEST_BLOCK:
            raise _BreaksOff
        body = _exactly(file, size - 4 - len(head))[:-4]  # behind it the size again
        number = struct.unpack(order + "I", kind)[0]
        if number == INTERFACE and len(body) >= 8:
            links.append(struct.unpack_from(order + "H2xI", body))
        elif number in (PACKET, OLD_PACKET) and len(body) >= 20:
            interface, kept, size = struct.unpack_from(order + ("I8xII" if number == PACKET else "H10xII"), body)
            yield links[interface][0] if interface < len(links) else None, body[20:20 + kept], size
        elif number == SIMPLE_PACKET and links and len(body) >= 4:
            size = struct.unpack_from(order + "I", body)[0]
            yield links[0][0], body[4:4 + min(size, links[0][1] or size)], size
        kind = file.read(4)


def _ipv4(link: int, frame: bytes) -> bytes:
    """The IPv4 packet behind the link's header and any VLAN tags; b"" if it is another protocol."""
    at, type_at = LINKS[link]
    if type_at is not None:
        kind = frame[type_at:type_at + 2]
        while kind in VLAN_TAGS:
            at, kind = at + 4, frame[at + 2:at + 4]
        if kind != IPV4:
            return b""
    return frame[at:]


def _payload(link: int, frame: bytes, port: int) -> bytes | None:
    """Of an unfragmented UDP datagram over IPv4 to that port; a message of the stream is never longer."""
    ip = _ipv4(link, frame)
    udp = 4 * (ip[0] & 15) if len(ip) > 20 else 20
    if len(ip) < udp + 8 or ip[0] >> 4 != 4 or ip[9] != 17 or ip[6] & 0x3F or ip[7]:
        return None
    to, size = struct.unpack_from(">HH", ip, udp + 2)
    return ip[udp + 8:udp + size] if to == port else None
