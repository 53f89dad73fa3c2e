"""UDP ports of this PC, side by side, as `iog replay --port-base` sends to them."""

import socket


def bound(count: int, buffer_bytes: int | None = None) -> tuple[int, list[socket.socket]]:
    """The first of so many, and a socket at each. buffer_bytes: what may wait in one of them."""
    for base in range(41_000, 60_000, count):
        sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(count)]
        try:
            for i, each in enumerate(sockets):
                if buffer_bytes is not None:
                    each.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer_bytes)
                each.bind(("127.0.0.1", base + i))
            return base, sockets
        except OSError:
            for each in sockets:
                each.close()
    raise AssertionError("no free ports")
