"""What a network carries besides scans: strangers' datagrams, pings, ARP, broken frames, noise.

Every attack returns (cause, frame): the frame, and the one counter of docs/spec.md (1.4 or 3.5)
that it must end in. Two causes are answers: a ping of the peer, and a question for our address.
"""

import collections
import random
import struct

import ethernet
import sabrelite
from capture import SENSOR_PORTS
from ethernet import ARP_REPLY, ARP_REQUEST, TYPE_ARP, TYPE_IPV4, ip
from hostile_scans import patched
from sabrelite import IP, MAC, PEER_IP, PEER_MAC, to_board

STRANGER_MAC = ethernet.mac("02:66:6f:6f:00:01")
OTHER_MAC = ethernet.mac("02:69:6f:67:00:02")
SENSOR_IPS = tuple(ip(f"10.0.2.{last}") for last in (101, 102, 103, 104))
STRANGERS = tuple(ip(text) for text in ("10.0.2.77", "10.0.2.1", "192.168.1.5", "8.8.8.8"))
# No single host can be the source of these.
IMPOSSIBLE = tuple(ip(text) for text in ("0.0.0.0", "127.0.0.1", "224.0.0.1", "255.255.255.255",
                                         "10.0.2.255", "10.0.2.15"))
MAX_FRAME = 1514


class HostileFrames:
    def __init__(self, rng: random.Random, board: str = "imx6"):
        self.asked: collections.Counter[tuple[bytes, bytes]] = collections.Counter()
        self.pings: list[bytes] = []
        self._random = rng
        self._small = [self.stranger, self.stolen_port, self.wrong_port, self.broadcast_stranger,
                       self.udp_length, self.ip_header, self.impossible_source, self.foreign_ip,
                       self.tcp, self.bad_icmp, self.other_icmp, self.stranger_ping,
                       self.broadcast_ping, self.peer_ping, self.vlan, self.foreign_mac,
                       self.other_type, self.noise, self.noise_for_us,
                       self.bad_arp, self.arp_of_others, self.arp_from_outside, self.stolen_address,
                       self.arp_question]
        self._is_gem = board == "zcu102"
        if not self._is_gem:  # QEMU's GEM pads a runt with bytes of an older frame
            self._small.append(self.runt)

    def attacks(self) -> list:
        return [*self._small, self.oversized]

    def small_attacks(self) -> list:
        """Those of at most 314 bytes, which fit a flood."""
        return self._small

    # IPv4 that nobody has asked for.

    def _datagram(self, source: bytes, port: int, destination: bytes = IP) -> bytes:
        payload = self._random.randbytes(self._random.randrange(64))
        return ethernet.udp(source, destination, 12000, port, payload)

    def _ip_frame(self, packet: bytes) -> bytes:
        return to_board(TYPE_IPV4, packet, self._random.choice([STRANGER_MAC, OTHER_MAC, PEER_MAC]))

    def stranger(self):
        source = self._random.choice(STRANGERS)
        return "stranger", self._ip_frame(self._datagram(source, self._random.choice(SENSOR_PORTS)))

    def stolen_port(self):
        """One sensor sends to the port of another."""
        owner, thief = self._random.sample(range(4), 2)
        return "stranger", self._ip_frame(self._datagram(SENSOR_IPS[thief], SENSOR_PORTS[owner]))

    def wrong_port(self):
        port = self._random.choice([0, 53, 2368, 12001, 12006, 15000, 15001, 65535])
        return "stranger", self._ip_frame(self._datagram(self._random.choice(SENSOR_IPS), port))

    def broadcast_stranger(self):
        to = self._random.choice([ip("255.255.255.255"), ip("10.0.2.255")])
        packet = self._datagram(STRANGERS[0], SENSOR_PORTS[0], to)
        return "stranger", ethernet.padded(ethernet.ethernet(ethernet.BROADCAST, STRANGER_MAC,
                                                             TYPE_IPV4, packet))

    def udp_length(self):
        body = self._datagram(SENSOR_IPS[0], 12002)[20:]
        wrong = [patched(body, 4, ">H", length) for length in (0, 7, len(body) + 1)]
        packet = ethernet.ipv4(SENSOR_IPS[0], IP, ethernet.UDP,
                               self._random.choice([*wrong, body[:7], b""]))
        return "bad UDP length", self._ip_frame(packet)

    def ip_header(self):
        packet = self._datagram(SENSOR_IPS[0], 12002)
        at, form, value = self._random.choice([(0, "B", 0x65), (0, "B", 0x44), (2, ">H", 19),
                                               (2, ">H", 0xFFFF)])
        return "bad IP header", self._ip_frame(patched(packet, at, form, value))

    def impossible_source(self):
        return "bad source", self._ip_frame(self._datagram(self._random.choice(IMPOSSIBLE), 12002))

    def foreign_ip(self):
        to = self._random.choice([ip("10.0.2.16"), ip("10.0.3.15"), ip("224.0.0.1"), PEER_IP])
        return "not for us (IP)", self._ip_frame(self._datagram(SENSOR_IPS[0], 12002, to))

    def tcp(self):
        protocol = self._random.choice([0, 2, 6, 41, 50, 132, 255])
        body = self._random.randbytes(40)
        return ("neither UDP nor ICMP",
                self._ip_frame(ethernet.ipv4(SENSOR_IPS[0], IP, protocol, body)))

    def bad_icmp(self):
        message = ethernet.icmp(PEER_IP, IP, ethernet.ECHO_REQUEST, b"\0\1\0\1 wrong")[20:]
        wrong = self._random.choice([message[:7], patched(message, 2, ">H", 0xBEEF), b""])
        return "bad ICMP", self._ip_frame(ethernet.ipv4(PEER_IP, IP, ethernet.ICMP, wrong))

    def other_icmp(self):
        kind = self._random.choice([0, 3, 5, 11, 13])
        return "other ICMP", self._ip_frame(ethernet.icmp(PEER_IP, IP, kind, bytes(32)))

    def stranger_ping(self):
        return "ping ignored", sabrelite.ping(self._random.choice(STRANGERS + SENSOR_IPS), b"me?")

    def broadcast_ping(self):
        message = ethernet.icmp(PEER_IP, ip("10.0.2.255"), ethernet.ECHO_REQUEST, b"\0\1\0\1all?")
        return "ping ignored", self._ip_frame(message)

    def peer_ping(self):
        data = self._random.randbytes(self._random.randrange(200))
        self.pings.append(b"\0\7\0\1" + data)
        return "pings answered", sabrelite.ping(PEER_IP, data)

    # Below IPv4.

    def vlan(self):
        tag = struct.pack(">HH", self._random.randrange(1 << 16), TYPE_IPV4)
        return "VLAN tagged", to_board(self._random.choice([0x8100, 0x88A8]),
                                       tag + self._datagram(SENSOR_IPS[0], 12002), OTHER_MAC)

    def foreign_mac(self):
        to = self._random.choice([OTHER_MAC, ethernet.mac("01:00:5e:00:00:01"), PEER_MAC, bytes(6)])
        return "not for us (MAC)", ethernet.padded(
            ethernet.ethernet(to, STRANGER_MAC, TYPE_IPV4, self._datagram(SENSOR_IPS[0], 12002)))

    def other_type(self):
        kind = self._random.choice([0x0000, 0x0026, 0x05DC, 0x0801, 0x86DD, 0x88CC, 0xFFFF])
        return "neither IPv4 nor ARP", to_board(kind, self._random.randbytes(50), STRANGER_MAC)

    def noise(self):
        """Bytes without a meaning; that they name our address does not happen."""
        return "not for us (MAC)", self._random.randbytes(self._random.randrange(14, 300))

    def noise_for_us(self):
        """The lengths of an IPv4 packet, and noise for the rest."""
        size = self._random.randrange(20, 300)
        packet = struct.pack(">BBH", 0x45, 0, size) + self._random.randbytes(size - 4)
        if ethernet.checksum(packet[:20]) == 0:
            packet = patched(packet, 10, ">H", struct.unpack_from(">H", packet, 10)[0] ^ 1)
        return "bad IP checksum", self._ip_frame(packet)

    def runt(self):
        return "receive errors", (MAC + STRANGER_MAC)[:self._random.randrange(1, 13)]

    def oversized(self):
        """Longer than a frame, from 2029 bytes on also longer than a buffer of the receive ring.

        2029 to 2031 bytes are left out: QEMU 7.2 itself crashes on a single one of them, where
        one to three bytes of the FCS are left for the second buffer.
        """
        size = self._random.choice([MAX_FRAME + 1, 1600, 2027, 2028, 2032, 2048, 3000, 4000])
        # QEMU's GEM lets four bytes more pass, and the driver takes these frames for damaged ones.
        cause = "receive errors" if self._is_gem and size == MAX_FRAME + 1 else "oversized"
        return cause, to_board(TYPE_IPV4, self._random.randbytes(size - 14), OTHER_MAC)

    # ARP: only a question for the firmware's own address deserves an answer.

    def _arp_frame(self, packet: bytes, source_mac: bytes = STRANGER_MAC) -> bytes:
        to = self._random.choice([MAC, ethernet.BROADCAST])
        return ethernet.padded(ethernet.ethernet(to, source_mac, TYPE_ARP, packet))

    def bad_arp(self):
        good = ethernet.arp(ARP_REQUEST, STRANGER_MAC, STRANGERS[0], bytes(6), IP)
        at, form, value = self._random.choice([(0, ">H", 6), (2, ">H", 0x86DD), (4, "B", 8),
                                               (5, "B", 16), (6, ">H", 0), (6, ">H", 3)])
        return "bad ARP", self._arp_frame(patched(good, at, form, value))

    def arp_of_others(self):
        operation = self._random.choice([ARP_REQUEST, ARP_REPLY])
        return "ARP ignored", self._arp_frame(ethernet.arp(operation, STRANGER_MAC, STRANGERS[0],
                                                           bytes(6), ip("10.0.2.99")))

    def arp_from_outside(self):
        """Questions that cannot be answered: the asker is no host of this subnet, or no station."""
        sender_mac, sender = self._random.choice([
            (STRANGER_MAC, ip("192.168.1.5")), (STRANGER_MAC, ip("10.0.2.255")),
            (STRANGER_MAC, ip("10.0.2.0")), (ethernet.BROADCAST, STRANGERS[0]),
            (ethernet.mac("01:00:5e:00:00:01"), PEER_IP), (bytes(6), PEER_IP), (MAC, STRANGERS[0])])
        return "ARP ignored", self._arp_frame(ethernet.arp(ARP_REQUEST, sender_mac, sender,
                                                           bytes(6), IP))

    def stolen_address(self):
        operation = self._random.choice([ARP_REQUEST, ARP_REPLY])
        target = self._random.choice([IP, PEER_IP])
        return "address conflict", self._arp_frame(ethernet.arp(operation, STRANGER_MAC, IP,
                                                                bytes(6), target))

    def arp_question(self):
        """Every host of the subnet may ask, and a station that has no address yet."""
        number = self._random.randrange(4)
        sender_mac, sender = self._random.choice([
            (b"\x02\0" + SENSOR_IPS[number], SENSOR_IPS[number]), (STRANGER_MAC, STRANGERS[0]),
            (STRANGER_MAC, bytes(4)), (PEER_MAC, PEER_IP)])
        self.asked[(sender_mac, sender)] += 1
        return "ARP answered", self._arp_frame(ethernet.arp(ARP_REQUEST, sender_mac, sender,
                                                            bytes(6), IP), sender_mac)
