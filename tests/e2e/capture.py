"""Captures: reading and writing pcap files, and what their scans are."""

import dataclasses
import struct

FILE_HEADER = struct.pack("<IHHIIII", 0xA1B2C3D4, 2, 4, 0, 0, 0xFFFF, 1)
SENSOR_PORTS = (12002, 12003, 12004, 12005)  # vehicles/reference_car.toml


@dataclasses.dataclass(frozen=True)
class Packet:
    """One captured frame: Ethernet, IPv4 without options, UDP, a scan message of an ibeo LUX."""

    time_us: int
    frame: bytes

    @property
    def source(self) -> bytes:
        return self.frame[26:30]

    @property
    def ports(self) -> tuple[int, int]:
        return struct.unpack_from(">HH", self.frame, 34)

    @property
    def sensor(self) -> int:
        return SENSOR_PORTS.index(self.ports[1])

    @property
    def payload(self) -> bytes:
        return self.frame[42:34 + struct.unpack_from(">H", self.frame, 38)[0]]

    @property
    def scan_number(self) -> int:
        return struct.unpack_from("<H", self.payload, 24)[0]


def read(path: str) -> list[Packet]:
    with open(path, "rb") as file:
        data = file.read()
    assert data[:4] == FILE_HEADER[:4], f"{path} is not a little-endian pcap file"
    packets = []
    at = len(FILE_HEADER)
    while at < len(data):
        seconds, micros, kept, _ = struct.unpack_from("<IIII", data, at)
        packets.append(Packet(seconds * 1_000_000 + micros, data[at + 16:at + 16 + kept]))
        at += 16 + kept
    return packets


def write(path: str, packets: list[Packet]) -> None:
    with open(path, "wb") as file:
        file.write(FILE_HEADER)
        for packet in packets:
            size = len(packet.frame)
            seconds, micros = divmod(packet.time_us, 1_000_000)
            file.write(struct.pack("<IIII", seconds, micros, size, size) + packet.frame)


def frames_of(packets: list[Packet]) -> list[list[Packet]]:
    """The packets by scan number, which all sensors of a simulated drive count alike."""
    frames: dict[int, list[Packet]] = {}
    for packet in packets:
        frames.setdefault(packet.scan_number, []).append(packet)
    return list(frames.values())
