"""The firmware on an emulated board that stands still whenever nobody has anything for it.

QEMU's clock counts instructions, and it jumps where no core has anything to do, so nothing that happens depends on how
busy this PC is. The debugger stub stops the machine before it sleeps: then all that was sent to it is taken, and what it
had to say is here.
"""

import collections
import pathlib
import select
import socket
import struct
import subprocess
import time

import debugger
import ethernet
import sabrelite

CORES = 4
# A tick of a timer that the firmware does not know ends the turn of a core: else one would do all the work before the
# next is run (docs/injected_faults.md).
TURN_US = 50
EPIT2, EPIT_HZ = 0x020D_4000, 66_000_000
EPIT_ON, EPIT_OFF = 1 << 24 | 1 << 17 | 1 << 3 | 1 << 1 | 1, 0
PC = 15


class Ended(Exception):
    """QEMU has ended: the board was reset."""


class Hung(Exception):
    """The machine neither sleeps nor ends."""


class Machine:
    """One board for one `with`. Messages of the grid wait in `messages`."""

    def __init__(self, image: str, folder: pathlib.Path):
        self.messages: collections.deque[bytes] = collections.deque()
        self.strays = 0  # frames that it should not send
        self.arp_replies = 0  # that it was sent
        self.idle = debugger.symbols_of(image)["iog::imx6::Board::idle()"]
        self._console = folder / "console.txt"
        self._console.unlink(missing_ok=True)
        self._wire, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_STREAM)
        for end in (self._wire, theirs):
            end.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 1 << 20)
        self._received = b""
        stub = debugger.Stub(folder)
        with open(folder / "qemu.txt", "wb") as log:
            self._qemu = subprocess.Popen(
                ["qemu-system-arm", "-M", "sabrelite", "-m", "256M", "-smp", str(CORES), "-S", "-no-reboot",
                 "-icount", "shift=1,sleep=off", "-display", "none", "-monitor", "none", "-serial", "null",
                 "-serial", f"file:{self._console}", "-kernel", image,
                 "-netdev", f"socket,id=wire,fd={theirs.fileno()}", "-net", "nic,netdev=wire,model=imx.enet",
                 *stub.options],
                stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, pass_fds=(theirs.fileno(),))
        theirs.close()
        self.stub = debugger.Debugger(stub)

    def __enter__(self) -> "Machine":
        self.stub.begin()
        self.stub.break_at(self.idle)
        return self

    def __exit__(self, *_) -> None:
        self._qemu.kill()
        self._qemu.wait()
        self.stub.close()
        self._wire.close()

    def console(self) -> str:
        return self._console.read_text(encoding="ascii", errors="replace") if self._console.exists() else ""

    def take_turns(self, turn_us: int) -> None:
        """How long a core runs before the next does; 0: until it sleeps."""
        count = turn_us * EPIT_HZ // 1_000_000
        for offset, value in ((0, EPIT_OFF), (8, count - 1), (0, EPIT_ON)) if turn_us else ((0, EPIT_OFF),):
            self.stub.write_device(EPIT2 + offset, value)

    def send(self, frame: bytes) -> None:
        """It takes it when it goes on."""
        self._wire.sendall(struct.pack(">I", len(frame)) + frame)

    def to_idle(self, patience_s: float) -> None:
        """Until it wants to sleep the next time."""
        self.leave_break(self.idle)
        self.go_on(patience_s)

    def leave_break(self, address: int) -> None:
        """Who stands at a breakpoint would stop there again."""
        for core in range(CORES):
            self.stub.choose(core)
            if self.stub.register(PC) == address:
                self.stub.step(core)

    def go_on(self, patience_s: float) -> int:
        """Until it is stopped before it sleeps, or elsewhere: which core is."""
        self.stub.go_on()
        return self.wait_for_stop(patience_s)

    def wait_for_stop(self, patience_s: float) -> int:
        """Whether it comes to that is asked by this PC's time, the only thing that is."""
        deadline = time.monotonic() + patience_s
        while True:
            ready = self._ready(deadline)
            if self._wire in ready:
                self._listen()
            if self.stub in ready:
                core = self.stub.stopped_core()
                self._listen()
                if core is None:
                    raise Ended
                return core

    def pc(self, core: int) -> int:
        self.stub.choose(core)
        return self.stub.register(PC)

    def _ready(self, deadline: float) -> list:
        """Who has something to say."""
        if self.stub.has_answer():
            return [self.stub]
        ready = select.select([self._wire, self.stub], [], [], max(0, deadline - time.monotonic()))[0]
        if not ready:
            raise Hung
        return ready

    def run_free(self, until, patience_s: float) -> None:
        """Without a stop, until until() says so of the messages that have come."""
        self.take_turns(0)
        self.leave_break(self.idle)
        self.stub.forget_break(self.idle)
        self.stub.go_on()
        deadline = time.monotonic() + patience_s
        while not until():
            ready = self._ready(deadline)
            self._listen()
            if self.stub in ready and self.stub.stopped_core() is None:
                raise Ended

    def status(self) -> int:
        """Of QEMU, which has ended."""
        return self._qemu.wait(10)

    def _listen(self) -> None:
        while select.select([self._wire], [], [], 0)[0]:
            more = self._wire.recv(1 << 18)
            if not more:
                return
            self._received += more
        while len(self._received) >= 4:
            end = 4 + struct.unpack_from(">I", self._received)[0]
            if len(self._received) < end:
                break
            self._sort(self._received[4:end])
            self._received = self._received[end:]

    def _sort(self, frame: bytes) -> None:
        kind = frame[12:14]
        if kind == struct.pack(">H", ethernet.TYPE_ARP):
            if frame[20:22] == b"\0\1" and frame[38:42] == sabrelite.PEER_IP:
                reply = ethernet.arp(ethernet.ARP_REPLY, sabrelite.PEER_MAC, sabrelite.PEER_IP, sabrelite.MAC, sabrelite.IP)
                self.send(sabrelite.to_board(ethernet.TYPE_ARP, reply, sabrelite.PEER_MAC))
                self.arp_replies += 1
            return
        packet = frame[14:14 + struct.unpack_from(">H", frame, 16)[0]]
        # What a receiver's network would not hand on is no message.
        if frame[:6] == sabrelite.PEER_MAC and packet[9:10] == bytes([ethernet.UDP]) and \
                packet[16:20] == sabrelite.PEER_IP and ethernet.checksum(packet[:20]) == 0 and \
                packet[22:24] == struct.pack(">H", sabrelite.GRID_PORT) and \
                ethernet.udp_checksum(packet[12:16], packet[16:20], packet[20:]) == 0:
            self.messages.append(packet[28:])
        else:
            self.strays += 1
