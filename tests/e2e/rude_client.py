"""A WebSocket client that sends whatever it likes: the bytes of RFC 6455, right or wrong."""

import base64
import json
import os
import socket
import struct

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
PATIENCE_S = 20


def handshake(address: tuple[str, int], **changed: str | None) -> bytes:
    """The request, with other values for some headers, or without them; underscores are hyphens."""
    headers = {"Host": f"{address[0]}:{address[1]}", "Upgrade": "websocket", "Connection": "Upgrade",
               "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(), "Sec-WebSocket-Version": "13",
               "Sec-WebSocket-Protocol": "foxglove.websocket.v1"}
    for name, value in changed.items():
        headers[name.replace("_", "-")] = value
    lines = [f"{name}: {value}" for name, value in headers.items() if value is not None]
    return "\r\n".join(["GET / HTTP/1.1", *lines, "", ""]).encode()


def frame(kind: int, payload: bytes, is_last: bool = True, is_masked: bool = True, length: int | None = None,
          reserved: int = 0) -> bytes:
    """length: what the frame says of itself, if that is not true."""
    size = len(payload) if length is None else length
    head = bytes((kind | is_last << 7 | reserved << 4,))
    mask_bit = is_masked << 7
    if size < 126:
        head += bytes((mask_bit | size,))
    elif size < 1 << 16:
        head += struct.pack(">BH", mask_bit | 126, size)
    else:
        head += struct.pack(">BQ", mask_bit | 127, size)
    if not is_masked:
        return head + payload
    mask = os.urandom(4)
    return head + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(payload))


class RudeClient:
    def __init__(self, address: tuple[str, int], request: bytes | None = None):
        self._socket = socket.create_connection(address, timeout=PATIENCE_S)
        self._rest = b""
        self.send(request or handshake(address))
        head = self._until(b"\r\n\r\n").decode()
        self.status = int(head.split()[1]) if head else 0
        self.headers = dict(line.lower().split(": ", 1) for line in head.split("\r\n")[1:] if line)

    def __enter__(self) -> "RudeClient":
        return self

    def __exit__(self, *_) -> None:
        self._socket.close()

    def send(self, data: bytes) -> None:
        self._socket.sendall(data)

    def try_to_send(self, data: bytes, seconds: float) -> bool:
        """False if that does not go within the time, or if the connection has ended."""
        self._socket.settimeout(seconds)
        try:
            self._socket.sendall(data)
            return True
        except OSError:
            return False
        finally:
            self._socket.settimeout(PATIENCE_S)

    def ask(self, request: dict | str) -> None:
        self.send(frame(TEXT, (request if isinstance(request, str) else json.dumps(request)).encode()))

    def _read(self, size: int) -> bytes:
        while len(self._rest) < size:
            more = self._socket.recv(65536)
            if not more:
                return b""
            self._rest += more
        data, self._rest = self._rest[:size], self._rest[size:]
        return data

    def _until(self, end: bytes) -> bytes:
        while end not in self._rest:
            more = self._socket.recv(65536)
            if not more:
                return b""
            self._rest += more
        data, _, self._rest = self._rest.partition(end)
        return data

    def next(self) -> tuple[int, bytes] | None:
        """Kind and payload of the next frame; nothing if the connection has ended."""
        try:
            head = self._read(2)
            if not head:
                return None
            size = head[1] & 0x7F
            if size >= 126:
                size = int.from_bytes(self._read(2 if size == 126 else 8), "big")
            return head[0] & 0x0F, self._read(size)
        except ConnectionError:
            return None

    def next_json(self, operation: str) -> dict:
        """The next text of that operation."""
        while found := self.next():
            kind, payload = found
            if kind == TEXT and (message := json.loads(payload))["op"] == operation:
                return message
        raise AssertionError(f"the connection has ended before a {operation}")

    def end(self) -> int | None:
        """Reads to the end; the code of the close frame, if there is one."""
        code = None
        while found := self.next():
            if found[0] == CLOSE:
                code = struct.unpack(">H", found[1][:2])[0]
        return code
