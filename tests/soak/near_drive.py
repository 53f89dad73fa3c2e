"""A minute of a drive whose scanners see little, so that an emulated board takes it faster than in real time."""

import dataclasses
import pathlib
import random
import struct
import subprocess

import capture
import drive
import protected_message
from hostile_scans import patched

FRAMES_PER_S = 25
POINTS_AT, POINT_BYTES, COUNT_AT, BODY_BYTES_AT, HEADER_BYTES = 68, 10, 52, 8, 24  # docs/spec.md 1.1
SCAN_TIMES_AT = 30  # begin and end of the scan, NTP
POSE_CLOCK_AT = 40  # docs/spec.md 5.1
NEAR_CM, EVERY = 1200, 2
QUIET_S = 4  # at the end, from a restart of the poses' sender on
# Of the poses, and how long: each once in a minute, at a second of its own.
POSE_FAULTS = {"poses stop": ("--pose-gap", ":0.6"), "poses are lost": ("--pose-gap", ":1.6"),
               "poses are stuck": ("--pose-freeze", ":1.5"), "poses jump": ("--pose-jump", ":3"),
               "poses start anew": ("--pose-restart", "")}
LONGEST_FAULT = 4 * FRAMES_PER_S  # of them, and till what a jump has left is forgotten


@dataclasses.dataclass(frozen=True)
class Drive:
    frames: list[list[capture.Packet]]
    pose_faults: dict[str, int]  # and the frames in which they begin

    @property
    def quiet_from(self) -> int:
        """The first frame in which nothing happens any more."""
        return len(self.frames) - QUIET_S * FRAMES_PER_S

    def poses_fail(self, begin: int, end: int) -> bool:
        """Whether a fault of the poses is not over within these frames, or begins there."""
        return any(at < end and at + LONGEST_FAULT >= begin for at in [*self.pose_faults.values(), self.quiet_from])


def simulated(iog: str, folder: pathlib.Path, rng: random.Random, seconds: int, later_s: int) -> Drive:
    """One that begins so many seconds later than others by the clock of its poses and scanners."""
    path = folder / "drive.pcap"
    restart_s = seconds - QUIET_S
    every = max(1, restart_s // (len(POSE_FAULTS) + 1))
    faults = rng.sample(sorted(POSE_FAULTS), len(POSE_FAULTS))[:restart_s // every - 1]
    options = ["--pose-restart", str(restart_s)]
    times_s = {fault: number * every for number, fault in enumerate(faults, 1)}
    for fault, at_s in times_s.items():
        option, how = POSE_FAULTS[fault]
        options += [option, f"{at_s}{how}"]
    subprocess.run([iog, "simulate", "--seed", str(rng.randrange(1, 1 << 31)), "--seconds", str(seconds), "--moving",
                    *options, "--out", path], check=True, stdout=subprocess.DEVNULL)
    packets = [later(near(packet), later_s) for packet in capture.read(str(path))]
    frames = drive.by_scan(packets)
    return Drive(frames, {fault: at_s * len(frames) // seconds for fault, at_s in times_s.items()})


def city_map(iog: str, folder: pathlib.Path) -> bytes:
    """Of many chunks. No pose says where on it the car is, so it names nothing."""
    osm, block = folder / "city.osm", folder / "city.iogmap"
    subprocess.run([iog, "simulate", "--moving", "--seconds", "1", "--osm", osm], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([iog, "map", osm, "--out", block], check=True, stdout=subprocess.DEVNULL)
    return block.read_bytes()


def near(packet: capture.Packet) -> capture.Packet:
    """Of a scan's points every second, if it is near."""
    if packet.ports[1] == drive.POSE_PORT:
        return packet
    payload = packet.payload
    points = [payload[at:at + POINT_BYTES] for at in range(POINTS_AT, len(payload), EVERY * POINT_BYTES)]
    points = [point for point in points if struct.unpack_from("<H", point, 4)[0] < NEAR_CM]
    kept = patched(payload[:POINTS_AT], COUNT_AT, "<H", len(points)) + b"".join(points)
    return with_payload(packet, patched(kept, BODY_BYTES_AT, ">I", len(kept) - HEADER_BYTES))


def later(packet: capture.Packet, seconds: int) -> capture.Packet:
    if seconds == 0:
        return packet
    payload = packet.payload
    if packet.ports[1] == drive.POSE_PORT:
        clock_us, = struct.unpack_from(">Q", payload, POSE_CLOCK_AT)
        return with_payload(packet, protected_message.of_version(
            patched(payload, POSE_CLOCK_AT, ">Q", clock_us + seconds * 1_000_000), 1))
    begin, end = struct.unpack_from("<QQ", payload, SCAN_TIMES_AT)
    return with_payload(packet, patched(payload, SCAN_TIMES_AT, "<QQ", begin + (seconds << 32), end + (seconds << 32)))


def with_payload(packet: capture.Packet, payload: bytes) -> capture.Packet:
    """Without checksums: a capture's datagram."""
    udp = packet.frame[34:38] + struct.pack(">HH", 8 + len(payload), 0)
    ip = patched(packet.frame[14:34], 2, ">H", 28 + len(payload))
    return dataclasses.replace(packet, frame=packet.frame[:14] + ip + udp + payload)
