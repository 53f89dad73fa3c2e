// Puts frames together from the messages of one target, whatever the network did to their order.
// It knows no socket and no clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>

#include "tools/assembly/grid_frame.hpp"
#include "tools/assembly/sequence_watch.hpp"

namespace iog::tools {

struct MessageCounts {
  std::uint64_t messages = 0;  // ours and readable
  std::uint64_t bytes = 0;     // in them
  std::uint64_t tiles = 0;
  std::uint64_t late = 0;            // behind a message that was sent after it, still in time
  std::uint64_t repeated = 0;        // dropped
  std::uint64_t too_late = 0;        // its frame was given up already
  std::uint64_t malformed = 0;       // lengths or numbers that contradict each other
  std::uint64_t not_ours = 0;        // another protocol
  std::uint64_t other_version = 0;   // of ours
  std::uint64_t not_understood = 0;  // a type, an encoding, a storage or a grid that is new to us
  std::uint64_t restarts = 0;        // of the target
};

class FrameAssembler {
 public:
  using FrameHandler = std::function<void(GridFrame&&)>;

  // on_frame is called for each frame, in their order, complete or not.
  explicit FrameAssembler(FrameHandler on_frame);

  // One datagram, of whatever bytes.
  void take(std::span<const std::byte> message);

  // Nothing more comes: hands over the frames that still wait for messages.
  void finish();

  [[nodiscard]] const MessageCounts& counts() const { return counts_; }
  [[nodiscard]] std::uint64_t messages_lost() const { return sequences_.lost(); }
  // Frames of which not one message came.
  [[nodiscard]] std::uint64_t frames_lost() const { return frames_lost_; }

 private:
  // A frame that waits for messages is given up when this many newer ones have begun.
  static constexpr std::size_t kMaxWaiting = 3;
  // The first message behind more than so many others, or one so many frames in the past, is not
  // late but comes from a target that has started over.
  static constexpr std::uint32_t kLateMessages = 256;
  static constexpr std::uint32_t kRestartFrames = 16;

  [[nodiscard]] bool is_restart(const stream::Header& header) const;
  void restart();
  void take_tile(GridFrame& frame, const stream::Header& header, std::span<const std::byte> body);
  void take_end(GridFrame& frame, const stream::Header& header, std::span<const std::byte> body);
  GridFrame* frame_of(const stream::Header& header);
  void hand_over_first();

  FrameHandler on_frame_;
  MessageCounts counts_;
  SequenceWatch sequences_;
  std::map<std::uint32_t, GridFrame> waiting_;  // by frame number
  bool has_handed_over_ = false;
  std::uint32_t next_frame_ = 0;  // the lowest number that has not been handed over
  std::uint32_t newest_frame_ = 0;
  std::uint64_t evidence_frames_ = 0;
  std::uint64_t frames_lost_ = 0;
};

}  // namespace iog::tools
