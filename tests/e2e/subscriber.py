"""Hosts that find and subscribe to a service, by scapy's SOME/IP-SD layer, on the wire of a firmware.

scapy is Debian's, and an implementation of its own: it makes what is sent, and reads what is answered.
"""

import collections
import dataclasses
import pathlib
import queue
import struct
import time

import ethernet
from sabrelite import GRID_SOURCE_PORT, IP, MAC, Sabrelite, to_board
from scapy.contrib.automotive.someip import (SD, SOMEIP, SDEntry_EventGroup, SDEntry_Service,
                                             SDOption_IP4_EndPoint)

SD_PORT = 30490
GROUP = ethernet.ip("224.244.224.245")
GROUP_MAC = ethernet.mac("01:00:5e:74:e0:f5")
FIND, OFFER, SUBSCRIBE, ACKNOWLEDGE = 0, 1, 6, 7
REBOOT, UNICAST = 0x80, 0x40
UDP = 0x11
EVENTS_PORT = 30500  # of a subscriber
COUNTER = 5  # of its subscriptions


@dataclasses.dataclass(frozen=True)
class Said:
    """A message of the firmware: entries as (type, service, instance, major, ttl, minor or event group)."""

    session: int
    reboot: bool
    unicast: bool
    entries: list[tuple]
    endpoints: list[tuple]


def read(payload: bytes) -> Said:
    message = SOMEIP(payload)
    assert (message.srv_id, message.sub_id, message.event_id) == (0xFFFF, 1, 0x100), payload.hex()
    assert (message.msg_type, message.retcode, message.proto_ver, message.iface_ver) == (2, 0, 1, 1)
    assert message.len == len(payload) - 8
    discovery = message[SD]
    entries = []
    for entry in discovery.entry_array:
        if entry.type == OFFER:
            assert (entry.index_1, entry.index_2, entry.n_opt_1, entry.n_opt_2) == (0, 0, 1, 0)
            entries.append(("offer", entry.srv_id, entry.inst_id, entry.major_ver, entry.ttl, entry.minor_ver))
        else:
            assert entry.type == ACKNOWLEDGE and entry.cnt == COUNTER and not entry.n_opt_1, entry
            entries.append(("ack", entry.srv_id, entry.inst_id, entry.major_ver, entry.ttl, entry.eventgroup_id))
    endpoints = [(option.addr, option.l4_proto, option.port) for option in discovery.option_array]
    return Said(message.session_id, bool(discovery.flags & REBOOT), bool(discovery.flags & UNICAST), entries,
                endpoints)


def message_of(session: int, entry, options: tuple = ()) -> bytes:
    discovery = SD(flags=REBOOT | UNICAST)
    discovery.set_entryArray([entry])
    discovery.set_optionArray(list(options))
    head = SOMEIP(srv_id=0xFFFF, sub_id=1, event_id=0x100, session_id=session, msg_type=2, retcode=0)
    return bytes(head / discovery)


class OfferingBoard(Sabrelite):
    """The firmware on a wire with its peer, and with hosts that come and go."""

    def __init__(self, image: str, folder: pathlib.Path, record_to: pathlib.Path):
        self.hosts: dict[bytes, "Subscriber"] = {}  # by Ethernet address
        self.offers: list[tuple[float, Said]] = []  # to the group, and when
        self.answers = 0
        # The newest of the peer's messages, to compare others with.
        self.of_peer: collections.deque[bytes] = collections.deque(maxlen=4000)
        super().__init__(image, folder, record_to)

    def host(self, address: str, mac: str, answers_arp: bool = True) -> "Subscriber":
        return self.hosts.setdefault(ethernet.mac(mac), Subscriber(self, address, mac, answers_arp))

    def _sort(self, frame: bytes) -> None:
        destination, kind = frame[:6], struct.unpack_from(">H", frame, 12)[0]
        if kind == ethernet.TYPE_ARP and destination == ethernet.BROADCAST:
            asked = [host for host in self.hosts.values() if host.ip == frame[38:42]]
            for host in asked:
                host.answer_arp()
            if asked:
                return
        if kind == ethernet.TYPE_IPV4 and destination == GROUP_MAC:
            self.offers.append((time.monotonic(), read(self._datagram(frame, GROUP, (SD_PORT, SD_PORT)))))
        elif kind == ethernet.TYPE_IPV4 and destination in self.hosts:
            self.hosts[destination].take(frame)
        else:
            super()._sort(frame)
            if kind == ethernet.TYPE_IPV4 and frame[23] == ethernet.UDP:
                self.of_peer.append(frame[42:14 + struct.unpack_from(">H", frame, 16)[0]])

    @staticmethod
    def _datagram(frame: bytes, to: bytes, ports: tuple[int, int]) -> bytes:
        """The payload of a datagram of the firmware that goes there, and is sound."""
        packet = frame[14:14 + struct.unpack_from(">H", frame, 16)[0]]
        assert frame[6:12] == MAC and packet[12:20] == IP + to, "in another's name, or to another"
        assert ethernet.checksum(packet[:20]) == 0 and ethernet.udp_checksum(IP, to, packet[20:]) == 0
        assert struct.unpack_from(">HH", packet, 20) == ports, "another port"
        return packet[28:]

    datagram = _datagram


class Subscriber:
    """A host; what it is answered waits in next_answer(), the stream that it gets in `stream`."""

    def __init__(self, board: OfferingBoard, address: str, mac: str, answers_arp: bool = True):
        self.address, self.ip, self.mac = address, ethernet.ip(address), ethernet.mac(mac)
        self.session = 0
        self.stream: collections.deque[bytes] = collections.deque(maxlen=4000)
        self._answers: queue.Queue[Said] = queue.Queue()
        self._board = board
        self._answers_arp = answers_arp

    def find(self, service: int, to_group: bool) -> None:
        self._say(SDEntry_Service(type=FIND, srv_id=service, inst_id=0xFFFF, major_ver=0xFF, ttl=3,
                                  minor_ver=0xFFFFFFFF), to_group=to_group)

    def subscribe(self, service: int, instance: int, major: int, group: int, ttl_s: int,
                  endpoint: str | None = None) -> None:
        """ttl_s 0: no longer. endpoint: where to, if not here."""
        option = SDOption_IP4_EndPoint(addr=endpoint or self.address, l4_proto=UDP, port=EVENTS_PORT)
        self._say(SDEntry_EventGroup(type=SUBSCRIBE, index_1=0, n_opt_1=1, srv_id=service, inst_id=instance,
                                     major_ver=major, ttl=ttl_s, cnt=COUNTER, eventgroup_id=group), (option,))

    def next_answer(self) -> Said | None:
        try:
            return self._answers.get_nowait()
        except queue.Empty:
            return None

    def send(self, payload: bytes, to_group: bool = False) -> None:
        to_ip, to_mac = (GROUP, GROUP_MAC) if to_group else (IP, MAC)
        packet = ethernet.udp(self.ip, to_ip, SD_PORT, SD_PORT, payload)
        self._board.send(ethernet.padded(ethernet.ethernet(to_mac, self.mac, ethernet.TYPE_IPV4, packet)))

    def _say(self, entry, options: tuple = (), to_group: bool = False) -> None:
        self.session += 1
        self.send(message_of(self.session, entry, options), to_group)

    def answer_arp(self) -> None:
        if self._answers_arp:
            reply = ethernet.arp(ethernet.ARP_REPLY, self.mac, self.ip, MAC, IP)
            self._board.send(to_board(ethernet.TYPE_ARP, reply, self.mac))

    def take(self, frame: bytes) -> None:
        if struct.unpack_from(">H", frame, 36)[0] == SD_PORT:
            self._board.answers += 1
            self._answers.put(read(self._board.datagram(frame, self.ip, (SD_PORT, SD_PORT))))
        else:
            self.stream.append(self._board.datagram(frame, self.ip, (GRID_SOURCE_PORT, EVENTS_PORT)))
