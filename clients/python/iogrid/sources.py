"""Where messages come from: a UDP port, or a capture."""

import collections
import contextlib
import socket
import struct
import time
from collections.abc import Iterator

from iogrid.frame import Frame
from iogrid.receiver import Receiver

SILENCE_S = 0.5  # a target that lives says something at least every 150 ms


def listen(port: int = 15000, address: str = "127.0.0.1", receiver: Receiver | None = None) -> Iterator[Frame | None]:
    """The frames that come to a UDP port of this PC, for ever; None for each SILENCE_S in which no message of use has
    come. OSError if the port cannot be had."""
    receiver = receiver or Receiver()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link:
        link.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)  # a frame comes at once
        link.bind((address, port))
        used, deadline = 0, time.monotonic() + SILENCE_S
        while True:
            link.settimeout(max(deadline - time.monotonic(), 0.001))
            with contextlib.suppress(TimeoutError):
                yield from receiver.take(link.recv(65536))
            if receiver.used != used:
                used, deadline = receiver.used, time.monotonic() + SILENCE_S
            elif time.monotonic() >= deadline:
                yield from receiver.finish()
                yield None
                deadline = time.monotonic() + SILENCE_S


def replay(path: str, port: int = 15000, receiver: Receiver | None = None) -> Iterator[Frame]:
    """The frames of a capture (pcap of Ethernet, Linux "any" or raw IP), as fast as they are asked for. ValueError if
    it is none; one that is cut short ends there, and Receiver.dropped says so."""
    receiver = receiver or Receiver()
    for datagram in _datagrams(path, port, receiver.dropped):
        yield from receiver.take(datagram)
    yield from receiver.finish()


def _datagrams(path: str, port: int, dropped: collections.Counter[str]) -> Iterator[bytes]:
    with open(path, "rb") as file:
        head = file.read(24)
        order = {b"\xd4\xc3\xb2\xa1": "<", b"\x4d\x3c\xb2\xa1": "<", b"\xa1\xb2\xc3\xd4": ">",
                 b"\xa1\xb2\x3c\x4d": ">"}.get(head[:4]) if len(head) == 24 else None
        link = struct.unpack(order + "20xI", head)[0] & 0xFFFF if order else None
        if link not in (1, 101, 113, 276):
            raise ValueError(f"{path}: no pcap of Ethernet, Linux cooked or raw IP; pcapng: editcap -F pcap")
        at = {1: 14, 101: 0, 113: 16, 276: 20}[link]  # of the IPv4 header
        while record := file.read(16):
            size = struct.unpack(order + "8xI4x", record)[0] if len(record) == 16 else 1 << 32
            packet = file.read(size) if size <= 262144 else b""
            if len(packet) < size:
                dropped["capture that is cut short"] += 1
                return
            ip, udp = packet[at:at + 20], at + 4 * (packet[at] & 15) if len(packet) > at + 20 else 0
            if len(packet) >= udp + 8 and len(ip) == 20 and ip[0] >> 4 == 4 and ip[9] == 17 and \
                    not (ip[6] & 0x3F or ip[7]) and packet[udp + 2:udp + 4] == struct.pack(">H", port):
                yield packet[udp + 8:udp + struct.unpack_from(">H", packet, udp + 4)[0]]
