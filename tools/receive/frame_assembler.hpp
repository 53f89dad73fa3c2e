// Puts frames together from the messages of one target, whatever the network did to them. It knows
// no socket and no clock.
//
// A message whose CRC is right is used where it says itself: its frame, its number and the tiles
// that it speaks of decide. So a message that comes late or twice is used once and in its place, or
// not at all. What the E2E check says of the order is only counted, as the health of the channel.
//
// No message says to which run of a target it belongs. Numbers and times mostly tell. Where they do
// not, a frame may refer to tiles of another run. Then its CRC is not the one that the target has
// sent, and nothing of that frame is valid.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "protection/protected_message.hpp"
#include "protection/supervision.hpp"
#include "stream/channel.hpp"
#include "stream/references.hpp"
#include "stream/tiles.hpp"
#include "tools/receive/grid_frame.hpp"
#include "tools/receive/sequence_watch.hpp"

namespace iog::tools {

struct MessageCounts {
  // Every datagram is counted in one of these.
  std::uint64_t messages = 0;        // ours, whole and of use, each once
  std::uint64_t repeated = 0;        // dropped
  std::uint64_t too_late = 0;        // its frame was given up already, or of a run that is over
  std::uint64_t corrupt = 0;         // of ours, but length, data id or CRC is wrong
  std::uint64_t malformed = 0;       // whole, and yet numbers contradict each other
  std::uint64_t not_ours = 0;        // another protocol, service or event
  std::uint64_t other_version = 0;   // of ours
  std::uint64_t not_understood = 0;  // a type, a storage or a grid that is new to us

  std::uint64_t bytes = 0;            // in the messages
  std::uint64_t late = 0;             // of these, behind one that was sent after it, still in time
  std::uint64_t tiles = 0;            // that are known
  std::uint64_t tiles_malformed = 0;  // in a sound message
  std::uint64_t tiles_not_understood = 0;  // an encoding that is new to us
  std::uint64_t without_reference = 0;     // tiles against a frame of which we do not have them
  std::uint64_t restarts = 0;              // of the target

  [[nodiscard]] std::uint64_t datagrams() const {
    return messages + repeated + too_late + corrupt + malformed + not_ours + other_version +
           not_understood;
  }
};

class FrameAssembler {
 public:
  using FrameHandler = std::function<void(GridFrame&&)>;

  // on_frame is called for each frame, in order, complete or not.
  explicit FrameAssembler(FrameHandler on_frame);

  // Takes one datagram; it may hold any bytes.
  void take(std::span<const std::byte> datagram);

  // A running target reports even silence every two frame periods, which are 110 ms at most.
  static constexpr std::chrono::milliseconds kLongestSilence{500};
  // To be called when nothing has come for longer than that: the next message may be of another
  // run. Hands over the frames that still wait, and forgets what tiles refer to.
  void note_silence();

  // To be called when nothing more comes. Hands over the frames that still wait for messages.
  void finish();

  [[nodiscard]] const MessageCounts& counts() const { return counts_; }
  [[nodiscard]] std::uint64_t messages_lost() const { return sequences_.lost(); }
  // Frames of which no message came at all.
  [[nodiscard]] std::uint64_t frames_lost() const { return frames_lost_; }
  // The channel as AUTOSAR's state machine sees it.
  [[nodiscard]] protection::ChannelState channel() const { return supervisor_.state(); }

 private:
  // A frame that waits for messages is given up when this many newer ones have begun.
  static constexpr std::size_t kMaxWaiting = 3;
  // A target that starts over counts frames, messages and time from 0. A single message of the past
  // is an old one. So many of them in a row, from so many frames, are a new run. Those of one frame
  // would not do, because a network may repeat it in one burst.
  static constexpr std::size_t kMessagesOfRestart = 16;
  static constexpr std::size_t kFramesOfRestart = 3;
  // A frame has at most a message for each tile.
  static constexpr std::size_t kMaxBodies = geometry::kTileCount;

  // A frame as far as it has arrived. Its tiles are decoded when it is handed over. Frames are in
  // order by then, and so are the tiles that others refer to.
  struct WaitingFrame {
    GridFrame frame;
    TileSet spoken_of;  // by the bodies
    std::vector<std::vector<std::byte>> bodies;

    [[nodiscard]] bool is_complete() const { return frame.has_end && spoken_of.all(); }
  };

  struct PastFrame {
    std::uint64_t closed_us;
    std::optional<std::uint32_t> end_sequence;  // of its last message
  };

  // The counter under which a datagram is counted.
  using Fate = std::uint64_t MessageCounts::*;

  // A message that may belong to a new run, and how it was counted in case it does not.
  struct PastMessage {
    std::vector<std::byte> content;
    Fate fate;
  };

  void take_content(std::span<const std::byte> content, std::size_t datagram_bytes);
  [[nodiscard]] bool is_of_this_run(const stream::Header& header) const;
  [[nodiscard]] bool is_of_another_run(const stream::Header& header) const;
  void take_repeated(const stream::Header& header, std::span<const std::byte> content);
  void consider_restart(const stream::Header& header, std::span<const std::byte> content,
                        Fate fate);
  void forget_the_past();
  void start_over();
  [[nodiscard]] Fate take_body(const stream::Header& header, std::span<const std::byte> body);
  [[nodiscard]] Fate take_tiles(WaitingFrame& waiting, const stream::Header& header,
                                std::span<const std::byte> body);
  [[nodiscard]] std::optional<std::uint32_t> end_sequence_of(std::uint32_t frame_number) const;
  [[nodiscard]] bool follows_the_frame_before(const stream::Header& header) const;
  [[nodiscard]] Fate take_end(WaitingFrame& waiting, const stream::Header& header,
                              std::span<const std::byte> body);
  WaitingFrame& frame_of(const stream::Header& header);
  void decode_tiles(WaitingFrame& waiting);
  [[nodiscard]] bool decode_tile(const stream::TileRecord& record, GridFrame& frame);
  [[nodiscard]] std::optional<tile_coding::Reference> reference_of(
      std::size_t tile, std::uint32_t frame_number) const;
  void take_back_if_damaged(GridFrame& frame);
  void note_past(const GridFrame& frame);
  void hand_over_first();

  FrameHandler on_frame_;
  MessageCounts counts_;
  protection::Receiver receiver_{stream::kNetworkChannel};
  protection::Supervisor supervisor_;
  SequenceWatch sequences_;
  std::map<std::uint32_t, WaitingFrame> waiting_;  // by frame number
  std::unique_ptr<stream::References> references_;
  std::map<std::uint32_t, PastFrame> past_frames_;  // the last that were handed over, by number
  // By frame and sequence number.
  std::map<std::uint32_t, std::map<std::uint32_t, PastMessage>> of_the_past_;
  std::size_t past_messages_ = 0;
  bool has_handed_over_ = false;
  std::uint32_t next_frame_ = 0;  // the lowest number that has not been handed over
  std::uint64_t last_closed_us_ = 0;
  std::uint64_t evidence_frames_ = 0;
  std::uint64_t frames_lost_ = 0;
};

}  // namespace iog::tools
