"""Frames as bytes: Ethernet, ARP, IPv4, ICMP and UDP, well formed.

Addresses are bytes in the order of the wire.
"""

import struct

TYPE_IPV4 = 0x0800
TYPE_ARP = 0x0806
ICMP = 1
UDP = 17
ARP_REQUEST = 1
ARP_REPLY = 2
ECHO_REPLY = 0
ECHO_REQUEST = 8
BROADCAST = b"\xff" * 6
DONT_FRAGMENT = 0x4000


def mac(text: str) -> bytes:
    return bytes.fromhex(text.replace(":", ""))


def ip(text: str) -> bytes:
    return bytes(int(part) for part in text.split("."))


def checksum(data: bytes) -> int:
    """The Internet checksum of RFC 1071; 0 over data that holds its own correct checksum."""
    padded = data + bytes(len(data) % 2)
    total = sum(struct.unpack(f">{len(padded) // 2}H", padded))
    while total >> 16:
        total = (total & 0xFFFF) + (total >> 16)
    return total ^ 0xFFFF


def ethernet(destination: bytes, source: bytes, kind: int, payload: bytes) -> bytes:
    return destination + source + struct.pack(">H", kind) + payload


def ipv4(source: bytes, destination: bytes, protocol: int, payload: bytes,
         flags_and_offset: int = DONT_FRAGMENT) -> bytes:
    header = struct.pack(">BBHHHBBH", 0x45, 0, 20 + len(payload), 0, flags_and_offset, 64,
                         protocol, 0) + source + destination
    return header[:10] + struct.pack(">H", checksum(header)) + header[12:] + payload


def udp_checksum(source: bytes, destination: bytes, datagram: bytes) -> int:
    return checksum(source + destination + struct.pack(">HH", UDP, len(datagram)) + datagram)


def udp(source: bytes, destination: bytes, source_port: int, port: int, payload: bytes) -> bytes:
    """The IPv4 packet of one datagram."""
    datagram = struct.pack(">HHHH", source_port, port, 8 + len(payload), 0) + payload
    # A checksum of 0 would say that there is none.
    value = udp_checksum(source, destination, datagram) or 0xFFFF
    datagram = datagram[:6] + struct.pack(">H", value) + datagram[8:]
    return ipv4(source, destination, UDP, datagram)


def icmp(source: bytes, destination: bytes, kind: int, rest: bytes) -> bytes:
    """The IPv4 packet of one ICMP message; `rest` is what follows its checksum."""
    message = struct.pack(">BBH", kind, 0, 0) + rest
    message = message[:2] + struct.pack(">H", checksum(message)) + message[4:]
    return ipv4(source, destination, ICMP, message)


def arp(operation: int, sender_mac: bytes, sender_ip: bytes, target_mac: bytes,
        target_ip: bytes) -> bytes:
    return (struct.pack(">HHBBH", 1, TYPE_IPV4, 6, 4, operation) + sender_mac + sender_ip +
            target_mac + target_ip)


def padded(frame: bytes) -> bytes:
    """As a controller sends it: at least 60 bytes."""
    return frame + bytes(max(0, 60 - len(frame)))
