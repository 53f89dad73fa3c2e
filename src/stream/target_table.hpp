// The names of the target's counters and states, and their positions on the wire.
//
// The frame end has one list for each of the first three groups, and one list of link counters for
// the groups from kNet to kCommand (docs/spec.md 3.5 and 3.7). The frame end also contains the
// group kSensorState. The remaining groups are in the last class message of the frame (docs/spec.md
// 3.10). To add a counter, add its name here and to the struct that counts it. Insert a link
// counter before the spare words, and reduce the number of spare words accordingly. Positions are
// looked up by name (stream/target_state.hpp). The script tests/lint/target_state generates the
// table in docs/spec.md and the table of the Wireshark dissector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::stream {

// The comment above a group is used as its description in docs/spec.md.
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
  // Shared work. Core 0 runs the items of lost cores ([cores.md](cores.md)).
  kCore,
  // Frames dropped because the port was full, port restarts ([drivers.md](drivers.md)), and frames
  // lost in these restarts.
  kRestart,
  // Starts, including this one, and how the previous run ended (below).
  kRun,
  // Loop timing, 13 words per duration (below).
  kLoopTime,
  // Reserved for later counters. Receivers ignore these zeros.
  kLater,
  // Only with service discovery ([service_discovery.md](service_discovery.md)) or signed commands:
  // discovery datagrams, answers and subscriptions, and messages that were copied to the subscriber
  // or did not fit.
  kDiscovery,
  // Only with signed commands (section 9): messages per verdict, the counters of the last authentic
  // messages, and a two-word MAC over these ten fields.
  kCommand,
  // Messages since start.
  kPoseFate,
  // Slices since start.
  kSliceCause,
  // How often each cause has begun since start.
  kMapCause,
  // Chunks of maps since start.
  kChunkFate,
  // States of a sensor in a frame.
  kSensorState,
};

enum class Kind : std::uint8_t {
  kCount,     // increases, modulo 2^32
  kLoss,      // a kCount that adds to the dropped datagrams in the message header
  kState,     // a present or past state
  kDuration,  // 13 words of health::Durations
  kMac,       // two words
  kRoom,      // kSpareWords words that count nothing
};
inline constexpr std::size_t kSpareWords = 16;

// `names` contains the counter names, separated by ", ". `words` is a description for programs that
// do not show the group. `words` is empty if the names are sufficient.
struct Row {
  consteval Row(Group of, std::string_view all, Kind what = Kind::kCount,
                std::string_view said = {})
      : group(of), kind(what), names(all), words(said) {}

  Group group;
  Kind kind;
  std::string_view names;
  std::string_view words;
};

namespace table {
using enum Group;
using enum Kind;

inline constexpr Row kRows[] = {
    {kStage, "fuse, mark, publish, perceive"},
    {kFate, "used, no return, too near, too far"},
    {kFate, "height band", kCount, "outside the height band"},
    {kFate, "flagged, later echo, malformed, stale, not taken, ground, overhang, under the ground"},
    {kPacketDrop,
     "stranger, wrong length, wrong type, wrong angle, wrong point, duplicate, late, over budget, "
     "other unit, not taken, frozen, too soon"},
    {kNet,
     "frames received, datagrams delivered, ARP answered, ARP learned, pings answered, "
     "messages sent, ARP requested"},
    {kDrop, "short", kLoss},
    {kDrop, "not for us (MAC), VLAN tagged, neither IPv4 nor ARP"},
    {kDrop, "bad IP header, bad IP checksum, fragment", kLoss},
    {kDrop, "not for us (IP)"},
    {kDrop, "bad source", kLoss},
    {kDrop, "neither UDP nor ICMP"},
    {kDrop, "bad UDP length, bad UDP checksum", kLoss},
    {kDrop,
     "bad ICMP, ping ignored, other ICMP, bad ARP, ARP ignored, address conflict, "
     "reply without room"},
    {kRefusal, "peer unresolved, ring full, misuse"},
    {kPort, "port received"},
    {kPort, "receive errors, oversized", kLoss},
    {kPort, "port sent, port refused"},
    {kFragment,
     "fragments joined, fragments duplicate, fragments overlapping, fragments bad, "
     "fragments refused, datagrams joined"},
    {kFragment, "datagrams expired, datagrams displaced", kLoss},
    {kCore, "cores at work", kState},
    {kCore,
     "items for lost cores, items of core 0, items of core 1, items of core 2, items of core 3"},
    {kRestart, "port without room", kLoss},
    {kRestart, "port restarts"},
    {kRestart, "received lost by restarts", kLoss},
    {kRestart, "unsent lost by restarts"},
    {kRun, "starts since power-up"},
    {kRun, "end of the run before, detail of that end", kState},
    {kLoopTime, "fuse, mark, publish, perceive, frame, late, core 0, core 1, core 2, core 3",
     kDuration},
    {kLater, "spare", kRoom},
    {kDiscovery,
     "SD received, SD malformed, SD spoofed, SD unanswered, SD offers, SD found, "
     "SD subscriptions acknowledged, SD subscriptions refused, SD subscriptions unconfirmed, "
     "SD subscriptions stopped, SD subscriptions expired, SD subscribers rebooted, SD copied, "
     "SD not copied"},
    {kCommand, "poses authentic, poses unsigned, poses replayed, poses forged"},
    {kCommand, "poses last counter", kState},
    {kCommand, "maps authentic, maps unsigned, maps replayed, maps forged"},
    {kCommand, "maps last counter", kState},
    {kCommand, "commands MAC", kMac},
    {kPoseFate,
     "used, unconfirmed, stranger, too short, not ours, wrong version, damaged, wrong length, "
     "wrong flags, not zero, out of range, no sigma, too old, not newer, flood, of a past run"},
    {kSliceCause, "placed, late, imprecise, lost, jump, restart, contradicted, drifting"},
    {kMapCause,
     "in use, no map, no transform, other origin, imprecise, blurred, no place, outside, "
     "contradicted"},
    {kChunkFate, "taken, repeated, in use"},
    {kChunkFate, "of another map", kCount, "of another block"},
    {kChunkFate,
     "stranger, too short, not ours, wrong version, damaged, wrong length, not zero, out of range"},
    {kSensorState, "never seen, silent, partial, complete", kState},
};
}  // namespace table

}  // namespace iog::stream
