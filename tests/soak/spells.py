"""What happens to the packets of some frames in a row: what is sent then, and what must be counted."""

import collections
import random
import struct
from collections.abc import Iterable

import capture
import ethernet
import protected_message
from capture import Packet
from drive import POSE_PORT
from hostile_frames import HostileFrames
from hostile_scans import patched
from near_drive import SCAN_TIMES_AT, Drive, with_payload
from sabrelite import scan

CUT = "link is down"
KINDS = (CUT, "packets are lost", "packets come twice", "packets are reordered", "packets are damaged",
         "flood of strangers", "scanner is silent", "scanner loses packets", "scanner is late", "scanner's clock stands still",
         "poses are imprecise", "chunks of a map are lost", "another map")
SHARE = 0.1  # of packets that are lost, doubled or damaged
# Frames before a frame's packets: together they fit the ring of 256. What waits before it is thrown away by QEMU when the
# machine stops.
FLOOD = 200
FLOODED = 3  # frames of a spell, at most
AHEAD = 25  # frames behind a cut of the link
POSE_SIGMA_AT, IMPRECISE = 60, (400, 500)  # mm, 10 urad (docs/spec.md 5.1)


class Wire:
    """What goes onto the wire, and what the target must say of it."""

    def __init__(self, send, rng: random.Random):
        self._send = send
        self.hostile = HostileFrames(rng)
        self.counts: collections.Counter[str] = collections.Counter()
        self.poses = self.chunks = 0

    def good(self, packet: Packet) -> None:
        self._send(frame_of(packet))
        self.counts["datagrams delivered"] += 1
        self.counts["frames received"] += 1
        self.poses += packet.ports[1] == POSE_PORT

    def chunk(self, source: bytes, port: int, message: bytes) -> None:
        self._send(scan(source, (40_000, port), message))
        self.counts["datagrams delivered"] += 1
        self.counts["frames received"] += 1
        self.chunks += 1

    def counted(self, cause: str, frame: bytes, delivered: bool = False) -> None:
        """What must be dropped, by its cause."""
        self._send(frame)
        self.counts[cause] += 1
        self.counts["datagrams delivered"] += delivered
        self.counts["frames received"] += cause not in ("receive errors", "oversized")

    def lost(self, packet: Packet) -> None:
        """While the link is down nobody counts it."""
        self._send(frame_of(packet))

    def flood(self, rng: random.Random) -> None:
        for attack in rng.choices(self.hostile.small_attacks(), k=FLOOD):
            cause, frame = attack()
            self.counted(cause, frame, delivered=cause == "stranger")


def frame_of(packet: Packet) -> bytes:
    return scan(packet.source, packet.ports, packet.payload)


def is_pose(packet: Packet) -> bool:
    return packet.ports[1] == POSE_PORT


class Spell:
    """From one frame to another. `taken` are the packets of which frames are made."""

    def __init__(self, kind: str, begin: int, end: int, rng: random.Random):
        self.kind, self.begin, self.end = kind, begin, end
        self._random = rng
        self._port = rng.choice(capture.SENSOR_PORTS)
        self._times: bytes | None = None
        self._held: list[Packet] = []

    def play(self, packets: list[Packet], wire: Wire) -> list[Packet]:
        """Sends one frame's; returns those that must be taken."""
        taken = []
        for packet in self._held:
            wire.counted("late", frame_of(packet), delivered=True)
        self._held.clear()
        if self.kind == "flood of strangers":
            wire.flood(self._random)
        for packet in self._changed(packets):
            fate = self._fate(packet, packets)
            if fate == "good":
                wire.good(packet)
                taken.append(packet)
            elif fate == "twice":
                wire.good(packet)
                wire.counted("duplicate", frame_of(packet), delivered=True)
                taken.append(packet)
            elif fate == "damaged":
                wire.counted("bad UDP checksum", damaged(frame_of(packet), self._random))
            elif fate == "held":
                self._held.append(packet)
            elif fate == "unseen":
                wire.lost(packet)
        return taken

    def finish(self, wire: Wire) -> None:
        """Before the first frame behind it."""
        for packet in self._held:
            wire.counted("late", frame_of(packet), delivered=True)
        self._held.clear()

    def _changed(self, packets: list[Packet]) -> Iterable[Packet]:
        if self.kind == "packets are reordered":
            scans = [packet for packet in packets if not is_pose(packet)]
            self._random.shuffle(scans)
            return [packet if is_pose(packet) else scans.pop() for packet in packets]
        if self.kind == "poses are imprecise":
            return [imprecise(packet) if is_pose(packet) else packet for packet in packets]
        if self.kind == "scanner's clock stands still":
            return [self._with_old_times(packet) if packet.ports[1] == self._port else packet for packet in packets]
        return packets

    def _fate(self, packet: Packet, packets: list[Packet]) -> str:
        if self.kind == CUT:
            return "unseen"
        if is_pose(packet):
            return "good"
        is_hit = self._random.random() < SHARE
        if is_hit and self.kind in ("packets are lost", "packets come twice", "packets are damaged"):
            return {"packets are lost": "gone", "packets come twice": "twice"}.get(self.kind, "damaged")
        if packet.ports[1] != self._port:
            return "good"
        if self.kind == "scanner is silent":
            return "gone"
        mine = [each for each in packets if each.ports[1] == self._port]
        if packet is mine[-1] and len(mine) > 1 and self.kind in ("scanner loses packets", "scanner is late"):
            return "gone" if self.kind == "scanner loses packets" else "held"
        return "good"

    def _with_old_times(self, packet: Packet) -> Packet:
        self._times = self._times or packet.payload[SCAN_TIMES_AT:SCAN_TIMES_AT + 16]
        return with_payload(packet, packet.payload[:SCAN_TIMES_AT] + self._times + packet.payload[SCAN_TIMES_AT + 16:])


def imprecise(packet: Packet) -> Packet:
    changed = patched(packet.payload, POSE_SIGMA_AT, ">HH", *IMPRECISE)
    return with_payload(packet, protected_message.of_version(changed, 1))


def damaged(frame: bytes, rng: random.Random) -> bytes:
    """A bit of its datagram's content, of which the UDP checksum says that it is wrong."""
    changed = bytearray(frame)
    end = 34 + struct.unpack_from(">H", frame, 38)[0]
    changed[rng.randrange(42, end)] ^= 1 << rng.randrange(8)
    assert ethernet.checksum(bytes(changed[14:34])) == 0
    return bytes(changed)


def plan(rng: random.Random, first: int, its_drive: Drive) -> list[Spell]:
    """Each kind as often as any other, with quiet frames between them.

    While the link is down the window's time goes on by the target's clock, and for a second after it is ahead of the poses'. If
    these failed then, it would take up there (docs/spec.md 5.3), and periods would begin at times that no capture tells.
    """
    spells: list[Spell] = []
    kinds: list[str] = []
    at = first
    while True:
        kinds = kinds or rng.sample(KINDS, len(KINDS))
        kind = kinds.pop()
        frames = rng.randint(1, FLOODED) if kind == "flood of strangers" else rng.randint(3, 20)
        if at + frames > its_drive.quiet_from:
            return spells
        if kind == CUT and its_drive.poses_fail(at, at + frames + AHEAD):
            kinds.insert(0, kind)
        else:
            spells.append(Spell(kind, at, at + frames, rng))
            at += frames
        at += rng.randint(3, 10)
