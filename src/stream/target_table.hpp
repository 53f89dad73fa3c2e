// The table of the target's counters and states: how each is called, and where it is on the wire.
//
// A frame's end has a list of each of the first three groups, and then the link counters in one
// list: the groups from kNet to kCommand (docs/spec.md 3.5 and 3.7). The end of the classes has the
// others. A new counter is a row here and a name where it is counted: the loop finds its place by
// that name (stream/target_state.hpp), and tests/lint/target_state makes what others read of it.
#pragma once

#include <cstdint>
#include <string_view>

namespace iog::stream {

// Above each: what its counters are of, for docs/spec.md.
enum class Group : std::uint8_t {
  // Ticks of the stopwatch.
  kStage,
  // Scan points of this frame.
  kFate,
  // Datagrams dropped since start.
  kPacketDrop,
  // Network.
  kNet,
  // Frames dropped.
  kDrop,
  // Messages refused.
  kRefusal,
  // Port.
  kPort,
  // Fragments, and fragmented datagrams (1.5).
  kFragment,
  // Shared work; core 0 does the items for lost cores ([cores.md](cores.md)).
  kCore,
  // Frames for which the port had no room, restarts of the port ([drivers.md](drivers.md)), and
  // frames lost by them.
  kRestart,
  // Starts with this one, how the run before ended, and that end's number (table below).
  kRun,
  // The loop's times, 13 words each (below).
  kLoopTime,
  // Only if the target offers its service ([service_discovery.md](service_discovery.md)), or if
  // commands must be signed: datagrams of service discovery, those left unanswered in a flood,
  // offers, questions answered, subscriptions; messages copied to the subscriber, and not copied
  // for want of room.
  kDiscovery,
  // Only if commands must be signed (9): messages on the ports of poses and maps, the last
  // authentic counter of each, and two words that sign these ten.
  kCommand,
  // Messages since start.
  kPoseFate,
  // Slices since start.
  kSliceCause,
  // How often it began, since start.
  kMapCause,
  // Chunks of maps since start.
  kChunkFate,
  // Of a sensor in a frame.
  kSensorState,
};

enum class Kind : std::uint8_t {
  kCount,     // grows, modulo 2^32
  kLoss,      // likewise, of datagrams that a header counts among those that were dropped
  kState,     // how something is now, or was
  kDuration,  // 13 words of health::Durations
  kMac,       // two words
};

struct Row {
  Group group;
  std::string_view name;
  Kind kind = Kind::kCount;
  std::string_view words{};  // for who does not see what group it is of; empty: the name says it
};

namespace table {
using enum Group;
using enum Kind;

inline constexpr Row kRows[] = {
    {kStage, "fuse"},
    {kStage, "mark"},
    {kStage, "publish"},
    {kStage, "perceive"},

    {kFate, "used"},
    {kFate, "no return"},
    {kFate, "too near"},
    {kFate, "too far"},
    {kFate, "height band", kCount, "outside the height band"},
    {kFate, "flagged"},
    {kFate, "later echo"},
    {kFate, "malformed"},
    {kFate, "stale"},
    {kFate, "not taken"},
    {kFate, "ground"},
    {kFate, "overhang"},
    {kFate, "under the ground"},

    {kPacketDrop, "stranger"},
    {kPacketDrop, "wrong length"},
    {kPacketDrop, "wrong type"},
    {kPacketDrop, "wrong angle"},
    {kPacketDrop, "wrong point"},
    {kPacketDrop, "duplicate"},
    {kPacketDrop, "late"},
    {kPacketDrop, "over budget"},
    {kPacketDrop, "other unit"},
    {kPacketDrop, "not taken"},
    {kPacketDrop, "frozen"},
    {kPacketDrop, "too soon"},

    {kNet, "frames received"},
    {kNet, "datagrams delivered"},
    {kNet, "ARP answered"},
    {kNet, "ARP learned"},
    {kNet, "pings answered"},
    {kNet, "messages sent"},
    {kNet, "ARP requested"},

    {kDrop, "short", kLoss},
    {kDrop, "not for us (MAC)"},
    {kDrop, "VLAN tagged"},
    {kDrop, "neither IPv4 nor ARP"},
    {kDrop, "bad IP header", kLoss},
    {kDrop, "bad IP checksum", kLoss},
    {kDrop, "fragment", kLoss},
    {kDrop, "not for us (IP)"},
    {kDrop, "bad source", kLoss},
    {kDrop, "neither UDP nor ICMP"},
    {kDrop, "bad UDP length", kLoss},
    {kDrop, "bad UDP checksum", kLoss},
    {kDrop, "bad ICMP"},
    {kDrop, "ping ignored"},
    {kDrop, "other ICMP"},
    {kDrop, "bad ARP"},
    {kDrop, "ARP ignored"},
    {kDrop, "address conflict"},
    {kDrop, "reply without room"},

    {kRefusal, "peer unresolved"},
    {kRefusal, "ring full"},
    {kRefusal, "misuse"},

    {kPort, "port received"},
    {kPort, "receive errors", kLoss},
    {kPort, "oversized", kLoss},
    {kPort, "port sent"},
    {kPort, "port refused"},

    {kFragment, "fragments joined"},
    {kFragment, "fragments duplicate"},
    {kFragment, "fragments overlapping"},
    {kFragment, "fragments bad"},
    {kFragment, "fragments refused"},
    {kFragment, "datagrams joined"},
    {kFragment, "datagrams expired", kLoss},
    {kFragment, "datagrams displaced", kLoss},

    {kCore, "cores at work", kState},
    {kCore, "items for lost cores"},
    {kCore, "items of core 0"},
    {kCore, "items of core 1"},
    {kCore, "items of core 2"},
    {kCore, "items of core 3"},

    {kRestart, "port without room", kLoss},
    {kRestart, "port restarts"},
    {kRestart, "received lost by restarts", kLoss},
    {kRestart, "unsent lost by restarts"},

    {kRun, "starts since power-up"},
    {kRun, "end of the run before", kState},
    {kRun, "detail of that end", kState},

    {kLoopTime, "fuse", kDuration},
    {kLoopTime, "mark", kDuration},
    {kLoopTime, "publish", kDuration},
    {kLoopTime, "perceive", kDuration},
    {kLoopTime, "frame", kDuration},
    {kLoopTime, "late", kDuration},
    {kLoopTime, "core 0", kDuration},
    {kLoopTime, "core 1", kDuration},
    {kLoopTime, "core 2", kDuration},
    {kLoopTime, "core 3", kDuration},

    {kDiscovery, "SD received"},
    {kDiscovery, "SD malformed"},
    {kDiscovery, "SD spoofed"},
    {kDiscovery, "SD unanswered"},
    {kDiscovery, "SD offers"},
    {kDiscovery, "SD found"},
    {kDiscovery, "SD subscriptions acknowledged"},
    {kDiscovery, "SD subscriptions refused"},
    {kDiscovery, "SD subscriptions unconfirmed"},
    {kDiscovery, "SD subscriptions stopped"},
    {kDiscovery, "SD subscriptions expired"},
    {kDiscovery, "SD subscribers rebooted"},
    {kDiscovery, "SD copied"},
    {kDiscovery, "SD not copied"},

    {kCommand, "poses authentic"},
    {kCommand, "poses unsigned"},
    {kCommand, "poses replayed"},
    {kCommand, "poses forged"},
    {kCommand, "poses last counter", kState},
    {kCommand, "maps authentic"},
    {kCommand, "maps unsigned"},
    {kCommand, "maps replayed"},
    {kCommand, "maps forged"},
    {kCommand, "maps last counter", kState},
    {kCommand, "commands MAC", kMac},

    {kPoseFate, "used"},
    {kPoseFate, "unconfirmed"},
    {kPoseFate, "stranger"},
    {kPoseFate, "too short"},
    {kPoseFate, "not ours"},
    {kPoseFate, "wrong version"},
    {kPoseFate, "damaged"},
    {kPoseFate, "wrong length"},
    {kPoseFate, "wrong flags"},
    {kPoseFate, "not zero"},
    {kPoseFate, "out of range"},
    {kPoseFate, "no sigma"},
    {kPoseFate, "too old"},
    {kPoseFate, "not newer"},
    {kPoseFate, "flood"},
    {kPoseFate, "of a past run"},

    {kSliceCause, "placed"},
    {kSliceCause, "late"},
    {kSliceCause, "imprecise"},
    {kSliceCause, "lost"},
    {kSliceCause, "jump"},
    {kSliceCause, "restart"},
    {kSliceCause, "contradicted"},
    {kSliceCause, "drifting"},

    {kMapCause, "in use"},
    {kMapCause, "no map"},
    {kMapCause, "no transform"},
    {kMapCause, "other origin"},
    {kMapCause, "imprecise"},
    {kMapCause, "blurred"},
    {kMapCause, "no place"},
    {kMapCause, "outside"},
    {kMapCause, "contradicted"},

    {kChunkFate, "taken"},
    {kChunkFate, "repeated"},
    {kChunkFate, "in use"},
    {kChunkFate, "of another map", kCount, "of another block"},
    {kChunkFate, "stranger"},
    {kChunkFate, "too short"},
    {kChunkFate, "not ours"},
    {kChunkFate, "wrong version"},
    {kChunkFate, "damaged"},
    {kChunkFate, "wrong length"},
    {kChunkFate, "not zero"},
    {kChunkFate, "out of range"},

    {kSensorState, "never seen", kState},
    {kSensorState, "silent", kState},
    {kSensorState, "partial", kState},
    {kSensorState, "complete", kState},
};
}  // namespace table

}  // namespace iog::stream
