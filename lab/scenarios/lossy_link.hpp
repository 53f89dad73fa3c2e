// A link that loses, doubles, damages and delays messages, always in the same way for one seed, a
// target that starts over, and what a receiver behind them shows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "tools/frames/grid_frame.hpp"
#include "tools/simulate/random.hpp"

namespace iog::lab {

using Message = std::vector<std::byte>;

// In percent of the messages.
struct Harm {
  const char* name;
  unsigned drop = 0;
  unsigned duplicate = 0;  // comes once more, up to 60 messages later
  unsigned corrupt = 0;    // one to four bytes are others
  unsigned reorder = 0;    // up to 20 messages late
  unsigned delay = 0;      // up to 300 messages late
  unsigned repeat = 0;     // comes once more, up to 4000 messages later: perhaps in another run
};

// What the receiver is tried with: docs/results/stream.md shows what is left, the tests that no
// cell is wrong.
inline constexpr std::array kHarms{
    Harm{.name = "none"},
    Harm{.name = "1 % lost", .drop = 1},
    Harm{.name = "10 % lost", .drop = 10},
    Harm{.name = "30 % lost", .drop = 30},
    Harm{.name = "30 % twice", .duplicate = 30},
    Harm{.name = "30 % damaged", .corrupt = 30},
    Harm{.name = "30 % out of order", .reorder = 30},
    Harm{.name = "30 % up to 300 messages late", .delay = 30},
    Harm{.name = "10 % of each of the five",
         .drop = 10,
         .duplicate = 10,
         .corrupt = 10,
         .reorder = 10,
         .delay = 10},
    Harm{.name = "30 % of each of the five",
         .drop = 30,
         .duplicate = 30,
         .corrupt = 30,
         .reorder = 30,
         .delay = 30},
};

// A stream as it was sent, and the frames in it. Frames are counted through all runs.
struct SentStream {
  using Name = std::pair<std::uint32_t, std::uint32_t>;  // run number and frame number

  std::vector<Message> messages;
  std::vector<std::uint32_t> frame_of;  // of each message
  std::vector<tools::GridFrame> frames;
  std::map<Name, std::uint32_t> by_name;
};

// Of a stream from its first message on, over a link that does no harm.
[[nodiscard]] SentStream sent_stream(const std::vector<Message>& messages);

// Of several runs of a target, one after the other, each with another run number. Each but the last
// ends in the middle of its last frame.
[[nodiscard]] SentStream sent_stream_of_runs(const std::vector<std::vector<Message>>& runs);

// What comes out at the other end if the link does harm to the frames before `quiet_from`.
[[nodiscard]] std::vector<Message> carry(const SentStream& sent, const Harm& harm,
                                         std::uint32_t quiet_from, std::uint64_t seed);

struct LinkTrial {
  // While the link does harm.
  std::uint64_t frames = 0;        // sent
  std::uint64_t whole_frames = 0;  // that arrived so, with the CRC that the target gave
  std::uint64_t tiles = 0;         // shown: 1024 for each frame that was handed over
  std::uint64_t fresh_tiles = 0;  // of these, those of that frame; the others are known to be stale
  // All the time.
  std::uint64_t wrong_tiles = 0;       // shown as those of a frame and not equal to it
  std::uint64_t old_frames = 0;        // shown after one that was sent later
  std::uint32_t incomplete_after = 0;  // frames from `quiet_from` on until all are whole
  std::uint64_t corrupt_found = 0;     // messages
  std::uint64_t restarts = 0;
  std::uint64_t malformed = 0;
};

[[nodiscard]] LinkTrial try_link(const SentStream& sent, const Harm& harm, std::uint32_t quiet_from,
                                 std::uint64_t seed);

}  // namespace iog::lab
