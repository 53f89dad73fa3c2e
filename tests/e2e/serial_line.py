"""The serial link of the firmware, recorded and read as docs/spec.md 3.8 says."""

import dataclasses
import os
import pathlib
import socket
import threading
import time

import grid_stream
import protected_message
import tile_coding

PATIENCE_S = 10
UNKNOWN = bytes(tile_coding.CELLS)


@dataclasses.dataclass(frozen=True)
class Told:
    """What a message has said of one tile of the grid of that level."""

    frame: int
    level: int
    tile: int
    cells: bytes


class Recorder:
    """Takes down what comes out of UART1, for one `with`. QEMU waits for it before it starts."""

    def __init__(self, folder: pathlib.Path):
        self._path = os.path.relpath(folder / "line.socket")
        pathlib.Path(self._path).unlink(missing_ok=True)
        self.option = f"unix:{self._path},server=on,wait=on"
        self.bytes = bytearray()
        self._thread = threading.Thread(target=self._record)

    def __enter__(self) -> "Recorder":
        self._thread.start()
        return self

    def __exit__(self, *_) -> None:
        self._thread.join()

    def _record(self) -> None:
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as line:
            deadline = time.monotonic() + PATIENCE_S
            while line.connect_ex(self._path) != 0:
                if time.monotonic() > deadline:
                    return
                time.sleep(0.01)
            while chunk := line.recv(65536):
                self.bytes += chunk


def uncobs(frame: bytes) -> bytes:
    """The message of a COBS frame, without the zero behind it."""
    message = bytearray()
    at = 0
    while at < len(frame):
        code = frame[at]
        block = frame[at + 1:at + code]
        assert len(block) == code - 1, "a frame ends in the middle of a block"
        message += block
        at += code
        if code < 0xFF and at < len(frame):
            message.append(0)
    return bytes(message)


def read(line: bytes) -> list[Told]:
    """All that a line from its first byte on has told; the last message may be cut off."""
    told = []
    for number, frame in enumerate(line.split(b"\0")[:-1]):
        content = protected_message.content(uncobs(frame), number, protected_message.OVER_UART)
        header, body = grid_stream.read_header(content), content[grid_stream.HEADER_BYTES:]
        assert (header.kind, header.sequence) == (grid_stream.TILES, number)
        level = grid_stream.level_of(body)
        message = grid_stream.read_tiles(body, level)
        cells = {tile.number: tile_coding.decode(tile.encoding, tile.payload, None)
                 for tile in message.tiles}
        told += [Told(header.frame, level, tile, cells.get(tile, UNKNOWN))
                 for tile in range(message.first, message.end)]
    return told
