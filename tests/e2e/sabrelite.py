"""The firmware of a board in QEMU, on a wire of which this program is the only other end.

The wire is a pair of Unix datagram sockets, one Ethernet frame a datagram. Its senders block, so
nothing is lost outside the firmware and every frame that was sent can be found in its counters.
"""

import collections
import hashlib
import os
import pathlib
import queue
import socket
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Callable

import ethernet
import grid_stream

MAC = ethernet.mac("02:69:6f:67:00:01")  # vehicles/reference_car.toml, by default
IP = ethernet.ip("10.0.2.15")
PEER_MAC = ethernet.mac("02:00:00:00:00:02")
PEER_IP = ethernet.ip("10.0.2.2")
ROOT = pathlib.Path(__file__).resolve().parents[2]
ENOUGH = 90  # as qemu/verdict has it
GRID_PORT = 15000
GRID_SOURCE_PORT = 15001
SIGNATURE = b"OG\x80\x05"  # how a message begins that signs those before it (docs/spec.md 9.2)

MARK = b"a mark in the stream"
PATIENCE_S = 10  # a loaded PC may take long for what should take milliseconds


ATTEMPTS = 5
FIRST_SESSION = b"\0\1"  # of SOME/IP, in a run's first message
NOT_JUDGED = 77  # to CTest a skipped test
SABRELITE = ("qemu-system-arm", "-M", "sabrelite", "-m", "256M")
VERDICT = f"cd {ROOT}; set -euo pipefail; source qemu/verdict; "


class HostStalled(Exception):
    """The PC took so long over a frame that the firmware rightly closed it by time."""


def with_patience(attempt: Callable[[], object]) -> object:
    """A frame lasts 40 ms of real time; a busy PC gets another chance from the beginning. What has failed while a machine
    got less of a processor than qemu/run wants for its verdict is not judged."""
    stalls = []
    while len(stalls) < ATTEMPTS:
        Emulator.share = 100
        try:
            return attempt()
        except (AssertionError, HostStalled) as fault:
            is_starved = Emulator.share < ENOUGH
            if not is_starved and not isinstance(fault, HostStalled):
                raise
            words = f"not judged: this PC gave QEMU {Emulator.share} % of a processor; " if is_starved else ""
            stalls.append(f"{words}{fault}")
            print(f"attempt {len(stalls)} of {ATTEMPTS}: {stalls[-1]}; is this PC busy?")
    if is_starved:
        sys.exit(NOT_JUDGED)
    raise AssertionError(f"in {ATTEMPTS} attempts what a busy PC explains, or a wrong rhythm: {'; '.join(stalls)}")


class Emulator:
    """QEMU with a board, and how much of a processor it gets: `share` is the least percentage, of all of an attempt."""
    share = 100

    def __init__(self, folder: pathlib.Path, *options: str, machine: tuple[str, ...] = SABRELITE):
        self._times = folder.resolve() / "processor.txt"
        with open(folder / "qemu.txt", "wb") as log:
            self.process = subprocess.Popen([*machine, "-display", "none", "-monitor", "none", *options],
                                            env=os.environ | {"QEMU_AUDIO_DRV": "none"},  # a ZCU102 has a sound card
                                            stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)
        self._watch = subprocess.Popen(
            ["bash", "-c", VERDICT + f"out='{self._times.parent}' qemu_pid={self.process.pid}; watch_qemu"])

    def end(self) -> None:
        self._watch.kill()
        self._watch.wait()
        share = subprocess.check_output(["bash", "-c", VERDICT + f"share_of_qemu '{self._times}'"], text=True)
        Emulator.share = min(Emulator.share, int(share))
        self.process.terminate()
        self.process.wait()


class Sabrelite:
    """A machine for one `with`. A thread plays the peer: it answers ARP and sorts what arrives.

    What was received, by kind; anything that the firmware has no business to send is in `strays`.
    `signatures` are of a car with a key: each with the names of the messages since the one before.
    Messages of the grid are kept as they are until a frame is asked for: to read them takes time,
    which the thread would take from whoever is sending a frame.
    """
    MACHINE = SABRELITE
    CARDS = ("-net", "nic,netdev=wire,model=imx.enet")
    CONSOLE = 1  # of its serial ports; the other one is the line

    def __init__(self, image: str, folder: pathlib.Path, record_to: pathlib.Path | None = None,
                 line: str = "null", options: tuple[str, ...] = ()):
        """line: what QEMU makes of UART1; options: further ones of QEMU."""
        self.frames_received = 0
        self.arp_requests = 0
        self.arp_replies: collections.Counter[tuple[bytes, bytes]] = collections.Counter()
        self.echo_replies: list[bytes] = []
        self.marks = 0  # of frame_from_now() that have come back
        self.strays: list[str] = []
        self.signatures: list[tuple[bytes, list[bytes]]] = []
        self._unsigned: list[bytes] = []
        self._messages: queue.Queue[bytes] = queue.Queue()
        self._assembler = grid_stream.Assembler()
        self._awaits_a_new_run = False
        self._console = folder / "console.txt"
        self._console.unlink(missing_ok=True)
        # A path in the address of a socket has 107 bytes at most; relative ones are short.
        self._here = os.path.relpath(folder / "peer.socket")
        self._there = os.path.relpath(folder / "board.socket")
        for path in (self._here, self._there):
            pathlib.Path(path).unlink(missing_ok=True)
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.bind(self._here)
        self._socket.settimeout(PATIENCE_S)
        self._is_over = False
        self._thread = threading.Thread(target=self._play_peer)
        recorder = [] if record_to is None else \
            ["-object", f"filter-dump,id=recorder,netdev=wire,file={record_to}"]
        ports = [line]
        ports.insert(self.CONSOLE, f"file:{self._console}")
        self._qemu = Emulator(
            folder, "-serial", ports[0], "-serial", ports[1], "-kernel", image,
            "-netdev", f"dgram,id=wire,local.type=unix,local.path={self._there},"
                       f"remote.type=unix,remote.path={self._here}",
            *self.CARDS, *recorder, *options, machine=self.MACHINE)
        self._thread.start()

    def __enter__(self) -> "Sabrelite":
        return self

    def __exit__(self, *_) -> None:
        self._qemu.end()
        self._is_over = True
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as waker:
            waker.sendto(b"", self._here)
        self._thread.join()
        self._socket.close()

    def console(self) -> str:
        return self._console.read_text(encoding="ascii") if self._console.exists() else ""

    def send(self, frame: bytes) -> None:
        """Waits while the firmware's receive ring and the wire are full."""
        try:
            self._socket.sendto(frame, self._there)
        except OSError as error:
            status = self._qemu.process.poll()
            raise AssertionError(f"QEMU takes no frame ({error}); its status is {status}")

    def next_frame(self) -> grid_stream.Frame:
        """The next frame, with evidence or without."""
        while True:
            try:
                message = self._messages.get(timeout=PATIENCE_S)
            except queue.Empty:
                stray = f"; it sent {self.strays[0]}" if self.strays else ""
                raise AssertionError(f"the firmware fell silent{stray}; it said:\n{self.console()}")
            if self._awaits_a_new_run and message[10:12] == FIRST_SESSION:
                self._assembler = grid_stream.Assembler()
                self._awaits_a_new_run = False
            if self._awaits_a_new_run and not self._continues(message):
                raise HostStalled("the first frame of the new run was over before this PC answered ARP")
            if self._assembler.messages == 0 and message[10:12] != FIRST_SESSION:
                raise HostStalled("the first frame was over before this PC answered ARP")
            if frame := self._assembler.take(message):
                return frame

    def expect_a_new_run(self) -> None:
        """The firmware starts anew, once; until it does, what it sends is of the run before."""
        self._awaits_a_new_run = True

    def _continues(self, message: bytes) -> bool:
        """Whether it is the next of the run before."""
        return struct.unpack_from(">H", message, 10)[0] == self._assembler.messages % 0xFFFF + 1

    def next_message(self) -> bytes:
        """The next message as it came, of a firmware that sends no grid."""
        try:
            return self._messages.get(timeout=PATIENCE_S)
        except queue.Empty:
            raise AssertionError(f"the firmware fell silent; it said:\n{self.console()}")

    def next_grid(self) -> grid_stream.Frame:
        """The next frame in which a sensor took part."""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            frame = self.next_frame()
            if frame.has_evidence:
                return frame
        raise AssertionError("no frame with evidence came")

    def frame_from_now(self) -> grid_stream.Frame:
        """A frame that was closed after the firmware had seen everything sent before this call."""
        marks = self.marks
        self.send(ping(PEER_IP, MARK))
        deadline = time.monotonic() + PATIENCE_S
        while self.marks == marks:
            assert time.monotonic() < deadline, "the firmware does not answer its peer's ping"
            time.sleep(0.001)
        while not self._messages.empty():
            self._assembler.take(self._messages.get())
        return self.next_frame()

    def assert_alive(self) -> None:
        """Neither a last word nor a reset."""
        console = self.console()
        assert "LAST WORD" not in console, console
        assert console.count("iogrid ") == 1 and "boot 1: cold start" in console, console
        assert self._qemu.process.poll() is None, "QEMU ended"

    def _play_peer(self) -> None:
        while not self._is_over:
            try:
                frame = self._socket.recv(65536)
            except TimeoutError:
                continue
            if not frame:
                return
            self.frames_received += 1
            try:
                self._sort(frame)
            except (AssertionError, struct.error) as error:
                self.strays.append(f"{error}: {frame[:64].hex()}")

    def _sort(self, frame: bytes) -> None:
        destination, source, kind = frame[:6], frame[6:12], struct.unpack_from(">H", frame, 12)[0]
        assert source == MAC, "a frame in another's name"
        if kind == ethernet.TYPE_ARP:
            self._sort_arp(destination, frame[14:42])
            return
        assert (kind, destination) == (ethernet.TYPE_IPV4, PEER_MAC), "a frame to a stranger"
        packet = frame[14:14 + struct.unpack_from(">H", frame, 16)[0]]
        assert ethernet.checksum(packet[:20]) == 0, "a wrong IP checksum"
        assert (packet[12:16], packet[16:20]) == (IP, PEER_IP), "a packet to a stranger"
        if packet[9] == ethernet.ICMP:
            assert packet[20] == ethernet.ECHO_REPLY and ethernet.checksum(packet[20:]) == 0
            if packet[24:].endswith(MARK):
                self.marks += 1
            else:
                self.echo_replies.append(packet[24:])
            return
        ports = struct.unpack_from(">HH", packet, 20)
        assert packet[9] == ethernet.UDP and ports == (GRID_SOURCE_PORT, GRID_PORT), "another port"
        assert ethernet.udp_checksum(IP, PEER_IP, packet[20:]) == 0, "a wrong UDP checksum"
        message = packet[28:]
        if message[:4] == SIGNATURE:
            self.signatures.append((message, self._unsigned))
            self._unsigned = []
            return
        self._unsigned.append(hashlib.sha256(message).digest()[:16])
        self._messages.put(message)

    def _sort_arp(self, destination: bytes, packet: bytes) -> None:
        operation = struct.unpack_from(">H", packet, 6)[0]
        assert (packet[8:14], packet[14:18]) == (MAC, IP), "ARP in another's name"
        if operation == ethernet.ARP_REPLY:
            assert destination == packet[18:24], "a reply to another than the asker"
            self.arp_replies[(packet[18:24], packet[24:28])] += 1
            return
        assert (destination, packet[24:28]) == (ethernet.BROADCAST, PEER_IP), "ARP for a stranger"
        self.arp_requests += 1
        self.send(to_board(ethernet.TYPE_ARP, ethernet.arp(ethernet.ARP_REPLY, PEER_MAC, PEER_IP,
                                                           MAC, IP), PEER_MAC))


class Zcu102(Sabrelite):
    """The same firmware on the second board. The connector is that of its last Ethernet controller."""
    MACHINE = ("qemu-system-aarch64", "-M", "xlnx-zcu102,virtualization=on", "-m", "512M")
    CARDS = ("-net", "nic", "-net", "nic", "-net", "nic", "-net", "nic,netdev=wire")
    CONSOLE = 0


BOARDS = {"imx6": Sabrelite, "zcu102": Zcu102}


def image_of(board: str) -> str:
    """Of its reference car, as the board's preset builds it."""
    return str(ROOT / f"build/{board}/board/{board}/iogrid-reference_car.elf")


def to_board(kind: int, payload: bytes, source_mac: bytes) -> bytes:
    return ethernet.padded(ethernet.ethernet(MAC, source_mac, kind, payload))


def ping(source: bytes, data: bytes) -> bytes:
    """An echo request to the firmware, identifier 7, sequence number 1."""
    message = ethernet.icmp(source, IP, ethernet.ECHO_REQUEST, b"\0\7\0\1" + data)
    return to_board(ethernet.TYPE_IPV4, message, PEER_MAC)


def scan(source: bytes, ports: tuple[int, int], payload: bytes) -> bytes:
    """A datagram of a scanner to the firmware."""
    datagram = ethernet.udp(source, IP, *ports, payload)
    return to_board(ethernet.TYPE_IPV4, datagram, b"\x02\0" + source)
