"""The counters of a frame's end by name, in the order of docs/spec.md 1.4 and 3.7."""

PACKET_DROPS = ("stranger", "wrong length", "wrong type", "wrong angle", "wrong point", "duplicate",
                "late", "over budget", "other unit", "not taken", "frozen", "too soon")
NET_DROPS = ("short", "not for us (MAC)", "VLAN tagged", "neither IPv4 nor ARP", "bad IP header",
             "bad IP checksum", "fragment", "not for us (IP)", "bad source", "neither UDP nor ICMP",
             "bad UDP length", "bad UDP checksum", "bad ICMP", "ping ignored", "other ICMP",
             "bad ARP", "ARP ignored", "address conflict", "reply without room")
LOOP_TIMES = ("fuse", "mark", "publish", "perceive", "frame", "late", *(f"core {core}" for core in range(4)))
TIME_COUNTERS = ("worst us", "sum us high", "sum us low", *(f"below {256 << octave} us" for octave in range(9)),
                 "longer")
LINK_COUNTERS = ("frames received", "datagrams delivered", "ARP answered", "ARP learned",
                 "pings answered", "messages sent", "ARP requested", *NET_DROPS,
                 "peer unresolved", "ring full", "misuse",
                 "port received", "receive errors", "oversized", "port sent", "port refused",
                 "fragments joined", "fragments duplicate", "fragments overlapping", "fragments bad",
                 "fragments refused", "datagrams joined", "datagrams expired", "datagrams displaced",
                 "cores at work", "items for lost cores",
                 *(f"items of core {core}" for core in range(4)), "port without room",
                 "port restarts", "received lost by restarts", "unsent lost by restarts",
                 "starts since power-up", "end of the run before", "detail of that end",
                 *(f"{row} {what}" for row in LOOP_TIMES for what in TIME_COUNTERS))
# Of a target that offers its service.
DISCOVERY_COUNTERS = ("SD received", "SD malformed", "SD spoofed", "SD unanswered", "SD offers", "SD found",
                      "SD subscriptions acknowledged", "SD subscriptions refused",
                      "SD subscriptions unconfirmed", "SD subscriptions stopped",
                      "SD subscriptions expired", "SD subscribers rebooted", "SD copied", "SD not copied")
# Of a target that wants its commands signed; those of service discovery come before them.
COMMAND_COUNTERS = (*(f"{kind} {what}" for kind in ("poses", "maps")
                      for what in ("authentic", "unsigned", "replayed", "forged", "last counter")),
                    "commands MAC high", "commands MAC low")
# What the header of a message counts as dropped, besides PACKET_DROPS: damaged datagrams.
DAMAGED = ("short", "bad IP header", "bad IP checksum", "fragment", "bad source", "bad UDP length",
           "bad UDP checksum", "receive errors", "oversized", "datagrams expired", "datagrams displaced",
           "port without room", "received lost by restarts")
