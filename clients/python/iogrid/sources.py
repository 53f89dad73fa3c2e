"""Where messages come from: a UDP port, or a capture."""

import contextlib
import socket
import time
from collections.abc import Iterator

from iogrid.captures import datagrams
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
    """The frames of a capture (pcap or pcapng of Ethernet, Linux "any", a loopback or raw IP, as it is, .gz or .zst), as fast as
    they are asked for. ValueError if it is none; one that is cut short or damaged ends there. Receiver.dropped says so, and
    what packets could not be read."""
    receiver = receiver or Receiver()
    for datagram in datagrams(path, port, receiver.dropped):
        yield from receiver.take(datagram)
    yield from receiver.finish()
