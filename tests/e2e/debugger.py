"""QEMU's debugger stub, by the remote serial protocol of GDB: as much of it as a test of faults needs.

While it is connected the machine stands still; leaving the `with` lets it go on.
"""

import os
import pathlib
import socket
import struct
import subprocess
import time

PATIENCE_S = 10


class Stub:
    """Where a machine waits for a debugger: `options` are QEMU's."""

    def __init__(self, folder: pathlib.Path):
        self.path = os.path.relpath(folder / "debugger.socket")  # 107 bytes at most
        pathlib.Path(self.path).unlink(missing_ok=True)
        self.options = ("-chardev", f"socket,id=debugger,path={self.path},server=on,wait=off",
                        "-gdb", "chardev:debugger")


class Debugger:
    def __init__(self, stub: Stub):
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self._socket.settimeout(PATIENCE_S)
        deadline = time.monotonic() + PATIENCE_S
        while True:
            try:
                self._socket.connect(stub.path)
                break
            except (FileNotFoundError, ConnectionRefusedError):
                assert time.monotonic() < deadline, "QEMU offers no debugger"
                time.sleep(0.02)
        self._bytes = b""

    def __enter__(self) -> "Debugger":
        self.ask("?")
        self.ask("qXfer:features:read:target.xml:0,ffb")  # who has not asked may set no register
        return self

    def __exit__(self, *_) -> None:
        assert self.ask("D") == "OK", "it does not let the machine go on"
        self._socket.close()

    def ask(self, command: str) -> str:
        """Sends a packet and waits for the answer to it."""
        body = command.encode("ascii")
        self._socket.sendall(b"$" + body + b"#" + f"{sum(body) & 0xFF:02x}".encode("ascii"))
        while True:
            packet = self._packet()
            if not packet.startswith("T") or command == "?":
                return packet

    def read(self, address: int, count: int) -> bytes:
        return bytes.fromhex(self.ask(f"m{address:x},{count:x}"))

    def write(self, address: int, data: bytes) -> None:
        assert self.ask(f"M{address:x},{len(data):x}:{data.hex()}") == "OK", f"{address:#x} takes no byte"

    def flip(self, address: int, bit: int = 0) -> None:
        self.write(address, bytes([self.read(address, 1)[0] ^ 1 << bit]))

    def choose(self, core: int) -> None:
        """Whose registers are meant from now on; QEMU calls cores threads and counts them from 1."""
        assert self.ask(f"Hg{core + 1:x}") == "OK", f"no core {core}"

    def register(self, number: int) -> int:
        return struct.unpack("<I", bytes.fromhex(self.ask(f"p{number:x}")))[0]

    def set_register(self, number: int, value: int) -> None:
        assert self.ask(f"P{number:x}={struct.pack('<I', value).hex()}") == "OK", f"register {number} is not taken"

    def _packet(self) -> str:
        while True:
            begin = self._bytes.find(b"$")
            end = self._bytes.find(b"#", begin)
            if 0 <= begin < end and len(self._bytes) >= end + 3:
                body, self._bytes = self._bytes[begin + 1:end], self._bytes[end + 3:]
                self._socket.sendall(b"+")
                return body.decode("ascii")
            more = self._socket.recv(4096)
            assert more, "QEMU has hung up"
            self._bytes += more


def symbols_of(image: str) -> dict[str, int]:
    """Addresses by the names that C++ gives them."""
    table = subprocess.run(["arm-none-eabi-nm", "-C", image], check=True, text=True, stdout=subprocess.PIPE).stdout
    return {line[19 - 8:]: int(line[:8], 16) for line in table.splitlines() if line[0] != " "}
