"""Do `iog` and clients/python read the same of a capture, however its packets were recorded?

The same frames in each link type, byte order and unit of time, by the formats' descriptions: tcpdump.org/linktypes,
draft-ietf-opsawg-pcap and -pcapng, IEEE 802.1Q and 802.1ad; where tcpdump puts the tags of cooked packets, libpcap
says (pcap-linux.c, set_vlan_offset); what a packet on its way out holds in place of checksums, Linux (udp4_hwcsum).
"""

import gzip
import struct
import unittest

import streams
from stream_test import replayed

ETHERNET, PPP, WIFI = 1, 9, 105
TAGS = {"8100": "81000005", "88a8": "88a8000781000005", "9100": "9100000781000005", "three": "910000079100000881000005"}


def cooked(kind: bytes, packet: bytes) -> bytes:
    return bytes(14) + kind + packet


def cooked_2(kind: bytes, packet: bytes) -> bytes:
    return kind + bytes(18) + packet


def links(frame: bytes) -> dict[str, tuple[int, bytes]]:
    """The packet in each link type."""
    mac, packet = frame[:12], frame[14:]
    made = {"SLL": (113, cooked(b"\x08\x00", packet)), "SLL2": (276, cooked_2(b"\x08\x00", packet)),
            "raw": (101, packet), "raw of old": (12, packet), "IPV4": (228, packet),
            "NULL": (0, b"\2\0\0\0" + packet), "NULL, big": (0, b"\0\0\0\2" + packet), "LOOP": (108, b"\0\0\0\2" + packet)}
    for name, tag in TAGS.items():
        tag = bytes.fromhex(tag)
        made[f"Ethernet {name}"] = ETHERNET, mac + tag + b"\x08\x00" + packet
        made[f"SLL {name}"] = 113, cooked(tag[:2], tag[2:] + b"\x08\x00" + packet)
        made[f"SLL2 {name}"] = 276, cooked_2(tag[:2], tag[2:] + b"\x08\x00" + packet)
    return made


def folded(data: bytes) -> int:
    total = sum(struct.unpack(f">{len(data) // 2}H", data))
    while total >> 16:
        total = (total >> 16) + (total & 0xFFFF)
    return total


def outgoing(frame: bytes, ip_checksum: bool, ip_length: bool) -> bytes:
    """As the sending host's capture has it: the rest is left to the card."""
    packet = bytearray(frame[14:])
    length = packet[24:26]
    packet[26:28] = struct.pack(">H", folded(packet[12:20] + b"\0\x11" + length))
    packet[2:4] = packet[2:4] if ip_length else bytes(2)
    packet[10:12] = bytes(2)
    if ip_checksum:
        packet[10:12] = struct.pack(">H", 0xFFFF ^ folded(packet[:20]))
    return frame[:14] + packet


def pcap(packets, link: int, order: str = "<", nano: bool = False, kept: int = 1 << 16) -> bytes:
    data = struct.pack(order + "IHHiIII", 0xA1B23C4D if nano else 0xA1B2C3D4, 2, 4, 0, 0, 1 << 16, link)
    for time_us, frame in packets:
        seconds, fraction = divmod(time_us, 1_000_000)
        data += struct.pack(order + "IIII", seconds, fraction * (1000 if nano else 1), min(kept, len(frame)), len(frame))
        data += frame[:kept]
    return data


class Section:
    """Of a pcapng."""

    def __init__(self, order: str):
        self.order, self.data = order, b""
        self.block(0x0A0D0D0A, struct.pack(order + "IHHq", 0x1A2B3C4D, 1, 0, -1))

    def block(self, kind: int, body: bytes) -> None:
        size = 12 + len(body) + -len(body) % 4
        self.data += struct.pack(self.order + "II", kind, size) + body + bytes(-len(body) % 4) + struct.pack(self.order + "I", size)

    def interface(self, link: int, kept: int = 0, unit: int | None = None, begin_s: int = 0) -> None:
        options = b"" if unit is None else struct.pack(self.order + "HHB3xHHqHH", 9, 1, unit, 14, 8, begin_s, 0, 0)
        self.block(1, struct.pack(self.order + "HHI", link, 0, kept) + options)

    def packet(self, interface: int, units: int, frame: bytes, kept: int = 1 << 16, is_old: bool = False) -> None:
        head = struct.pack(self.order + ("HH" if is_old else "I"), *((interface, 0) if is_old else (interface,)))
        head += struct.pack(self.order + "IIII", units >> 32, units & 0xFFFFFFFF, min(kept, len(frame)), len(frame))
        self.block(2 if is_old else 6, head + frame[:kept])


def many_interfaces(packets) -> bytes:
    """Each of another link type, length that packets are cut to and unit of time; two sections of other orders."""
    data, half = b"", len(packets) // 2
    for order, part in ((">", packets[:half]), ("<", packets[half:])):
        section = Section(order)
        section.interface(ETHERNET)
        section.interface(WIFI, 512)
        section.interface(113, 2000, 9)
        section.interface(276, 3000, 0x94, -1000)  # 2^-20 s
        section.interface(101, 4000, 3)
        for i, (time_us, frame) in enumerate(part):
            cooked_frames = links(frame)
            if time_us % 1000 == 0:
                section.packet(4, time_us // 1000, frame[14:])
            elif i % 3 == 0:
                section.packet(0, time_us, frame, is_old=i % 2 == 0)
            elif i % 3 == 1:
                section.packet(2, time_us * 1000, cooked_frames["SLL 8100"][1])
            else:
                units = -(-((time_us + 10**9) << 20) // 10**6)
                section.packet(3, units, cooked_frames["SLL2 9100"][1])
        data += section.data
    return data


class Captures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        plain = streams.FOLDER / "short.pcap"
        packets = streams.capture.read(streams.simulated())
        streams.capture.write(plain, [packet for packet in packets if streams.frame_of(packet.payload) < 3])
        cls.packets = [(packet.time_us, packet.frame) for packet in streams.capture.read(plain)]
        cls.path = streams.FOLDER / "some.file"
        cls.right = [(frame.number, frame.is_whole) for frame in replayed(plain)[0]]
        cls.said = streams.iog("info", plain)

    def check_same(self, data: bytes, name: str) -> None:
        self.path.write_bytes(data)
        with self.subTest(name):
            frames, receiver = replayed(self.path)
            self.assertEqual([(frame.number, frame.is_whole) for frame in frames], self.right)
            self.assertEqual(+receiver.dropped, {})
            self.assertEqual(streams.iog("info", self.path), self.said)

    def test_link_types_and_tags(self):
        for name in links(self.packets[0][1]):
            made = [(time_us, *links(frame)[name]) for time_us, frame in self.packets]
            self.check_same(pcap([(time_us, frame) for time_us, _, frame in made], made[0][1]), name)

    def test_byte_orders_and_units_of_time(self):
        for order in "<>":
            for nano in (False, True):
                self.check_same(pcap(self.packets, ETHERNET, order, nano), f"{order} {nano}")

    def test_interfaces_of_other_kinds(self):
        data = many_interfaces(self.packets)
        self.check_same(data, "as it is")
        self.check_same(gzip.compress(data), "gzip")
        self.check_same(streams.zstd_of(data), "zstd")

    def test_recorded_on_the_sending_host(self):
        for ip_checksum, ip_length in ((True, True), (True, False), (False, True), (False, False)):
            made = [(time_us, outgoing(frame, ip_checksum, ip_length)) for time_us, frame in self.packets]
            self.check_same(pcap(made, ETHERNET), f"{ip_checksum} {ip_length}")
            tagged = [(time_us, links(frame)["Ethernet 88a8"][1]) for time_us, frame in made]
            self.check_same(pcap(tagged, ETHERNET), f"tagged {ip_checksum} {ip_length}")

    def test_what_is_not_read_is_told(self):
        """Of two interfaces the one that is not read, packets that are cut short, another version of IP, an interface
        that is none."""
        section = Section("<")
        section.interface(ETHERNET)
        section.interface(PPP)
        for time_us, frame in self.packets:
            section.packet(0, time_us, frame)
            section.packet(1, time_us, b"\xff\x03\x00\x21" + frame[14:])
        for _, frame in self.packets[:5]:
            section.packet(0, time_us, frame, kept=60)
        section.packet(0, time_us, frame[:12] + b"\x86\xdd\x60" + bytes(60))
        section.packet(7, time_us, frame)
        self.path.write_bytes(section.data)
        frames, receiver = replayed(self.path)
        self.assertEqual([(frame.number, frame.is_whole) for frame in frames], self.right)
        self.assertEqual(receiver.dropped, {"packet that the capture cuts short": 5,
                                            "packet of a link type that is not read": len(self.packets) + 1})
        count = len(self.packets)
        skipped = (f"{count + 7} packets skipped: 1 not UDP over IPv4, "
                   "5 cut short by the capture (record whole packets: `tcpdump -s 0`), "
                   f"{count} of link type PPP, which is not read, 1 of an interface that the file does not describe\n")
        said = streams.iog("info", self.path)
        self.assertIn(skipped, said)
        self.assertEqual(said.replace(skipped, ""), self.said)


if __name__ == "__main__":
    unittest.main()
