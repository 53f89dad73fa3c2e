"""A short drive: made by `iog simulate`, played frame by frame."""

import pathlib
import subprocess

import capture
import machine
from sabrelite import scan

POSE_PORT = 15010
SEED, SECONDS = 1, 1
IDLES = 80  # a frame is closed by time long before the machine has wanted to sleep so often


def frames(iog: str, folder: pathlib.Path) -> list[list[bytes]]:
    """What is on the wire in each frame: the packets of its four scans, and the poses that come before the last."""
    path = folder / "drive.pcap"
    subprocess.run([iog, "simulate", "--seed", str(SEED), "--seconds", str(SECONDS), "--moving", "--out", path],
                   check=True, stdout=subprocess.DEVNULL)
    return [[scan(packet.source, packet.ports, packet.payload) for packet in frame]
            for frame in by_scan(capture.read(str(path)))]


def by_scan(packets: list[capture.Packet]) -> list[list[capture.Packet]]:
    """What comes up to the last packet of each scan."""
    last = {packet.scan_number: at for at, packet in enumerate(packets) if packet.ports[1] != POSE_PORT}
    ends = [0, *(at + 1 for at in sorted(last.values()))]
    return [packets[begin:end] for begin, end in zip(ends, ends[1:])]


def play(board: machine.Machine, frame: list[bytes], patience_s: float) -> list[bytes]:
    """Until a frame with all of its sensors has come, or it should have: the messages meanwhile."""
    for each in frame:
        board.send(each)
    messages = []
    for _ in range(IDLES):
        board.to_idle(patience_s)
        while board.messages:
            messages.append(board.messages.popleft())
            if is_end_with_evidence(messages[-1]):
                return messages
    return messages


def is_end_with_evidence(message: bytes) -> bool:
    """docs/spec.md 3.3: the type, and the sensors with complete or partial scans."""
    return len(message) > 58 and message[28] == 2 and message[28 + 25:28 + 27] != b"\0\0"
