"""QEMU's debugger stub, by the remote serial protocol of GDB: as much of it as a test of faults needs.

While it is connected the machine stands still; leaving the `with` lets it go on.
"""

import functools
import os
import pathlib
import socket
import subprocess
import time

PATIENCE_S = 300  # a campaign of low priority may wait long on a busy PC


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
        self.is_at_watch = False

    def begin(self) -> None:
        self.ask("?")
        self.ask("qXfer:features:read:target.xml:0,ffb")  # who has not asked may set no register

    def close(self) -> None:
        self._socket.close()

    def __enter__(self) -> "Debugger":
        self.begin()
        return self

    def __exit__(self, *_) -> None:
        assert self.ask("D") == "OK", "it does not let the machine go on"
        self.close()

    def has_answer(self) -> bool:
        """One that has been received already."""
        return b"#" in self._bytes[self._bytes.find(b"$") + 1:] if b"$" in self._bytes else False

    def fileno(self) -> int:
        return self._socket.fileno()

    def ask(self, command: str) -> str:
        """Sends a packet and waits for the answer to it."""
        self._send(command)
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

    def write_device(self, address: int, value: int, count: int = 4) -> None:
        """A register of a device, of so many bytes, past what the firmware's MMU allows."""
        assert self.ask("Qqemu.PhyMemMode:1") == "OK"
        self.write(address, value.to_bytes(count, "little"))
        assert self.ask("Qqemu.PhyMemMode:0") == "OK"

    def read_device(self, address: int) -> int:
        assert self.ask("Qqemu.PhyMemMode:1") == "OK"
        value = int.from_bytes(self.read(address, 4), "little")
        assert self.ask("Qqemu.PhyMemMode:0") == "OK"
        return value

    def command(self, line: str) -> None:
        """One of QEMU's own, which has nothing to say."""
        answer = self.ask(f"qRcmd,{line.encode('ascii').hex()}")
        assert answer == "OK", bytes.fromhex(answer[1:]).decode() if answer.startswith("O") else answer

    def break_at(self, address: int) -> None:
        assert self.ask(f"Z0,{address:x},4") == "OK", f"no breakpoint at {address:#x}"

    def forget_break(self, address: int) -> None:
        assert self.ask(f"z0,{address:x},4") == "OK", f"no breakpoint at {address:#x}"

    def watch(self, address: int) -> None:
        """The machine is stopped before this byte is written, again and again until it is passed: see is_at_watch."""
        assert self.ask(f"Z2,{address:x},1") == "OK", f"{address:#x} cannot be watched"

    def forget_watch(self, address: int) -> None:
        assert self.ask(f"z2,{address:x},1") == "OK", f"{address:#x} is not watched"

    def go_on(self) -> None:
        """Who stands at a breakpoint has to leave it first: see step()."""
        self._send("c")

    def step(self, core: int) -> None:
        """One instruction of one core, while the others stand still."""
        self._send(f"vCont;s:{core + 1:x}")
        self.stopped_core()

    def interrupt(self) -> None:
        """The machine is stopped soon."""
        self._socket.sendall(b"\3")

    def stopped_core(self) -> int | None:
        """Waits until the machine stops; None: QEMU has ended."""
        try:
            packet = self._packet()
        except (AssertionError, ConnectionError):
            return None
        self.is_at_watch = "watch:" in packet
        return None if packet[0] in "WX" else int(packet[packet.index("thread:") + 7:].split(";")[0].split(".")[-1], 16) - 1

    def choose(self, core: int) -> None:
        """Whose registers are meant from now on; QEMU calls cores threads and counts them from 1."""
        assert self.ask(f"Hg{core + 1:x}") == "OK", f"no core {core}"

    def register(self, number: int) -> int:
        return int.from_bytes(bytes.fromhex(self.ask(f"p{number:x}")), "little")

    def flip_register(self, number: int, bit: int) -> None:
        """Of any size: bit 0 is the lowest."""
        value = bytearray(bytes.fromhex(self.ask(f"p{number:x}")))
        value[bit // 8] ^= 1 << bit % 8
        assert self.ask(f"P{number:x}={value.hex()}") == "OK", f"register {number} is not taken"

    def set_register(self, number: int, value: int) -> None:
        size = len(self.ask(f"p{number:x}")) // 2
        assert self.ask(f"P{number:x}={value.to_bytes(size, 'little').hex()}") == "OK", f"register {number} is not taken"

    def _send(self, command: str) -> None:
        body = command.encode("ascii")
        self._socket.sendall(b"$" + body + b"#" + f"{sum(body) & 0xFF:02x}".encode("ascii"))
        # Once it is acknowledged, whatever comes is an answer.
        while b"+" not in self._bytes:
            self._receive()
        self._bytes = self._bytes.replace(b"+", b"", 1)

    def _packet(self) -> str:
        while True:
            begin = self._bytes.find(b"$")
            end = self._bytes.find(b"#", begin)
            if 0 <= begin < end and len(self._bytes) >= end + 3:
                body, self._bytes = self._bytes[begin + 1:end], self._bytes[end + 3:]
                self._socket.sendall(b"+")
                return body.decode("ascii")
            self._receive()

    def _receive(self) -> None:
        more = self._socket.recv(4096)
        assert more, "QEMU has hung up"
        self._bytes += more


@functools.cache
def symbols_of(image: str) -> dict[str, int]:
    """Addresses by the names that C++ gives them."""
    table = subprocess.run(["nm", "-C", image], check=True, text=True, stdout=subprocess.PIPE).stdout
    return {name: int(address, 16) for address, _, name in
            (line.split(maxsplit=2) for line in table.splitlines() if line[0] != " ")}
