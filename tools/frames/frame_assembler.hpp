// Puts frames together from the messages of one target, whatever the network did to them. It knows
// no socket and no clock. A frame has a grid of occupancy indexes, one of classes, or both, and
// maybe objects; which, each of its messages says.
//
// A message whose CRC is right is used where it says itself: its frame, its number and the tiles
// that it speaks of decide. So a message that comes late or twice is used once and in its place, or
// not at all. What the E2E check says of the order is only counted, as the health of the channel.
//
// Every message says to which run of the target it belongs, and only those of the newest run are
// used (RunWatch). So no frame is of two runs, and none refers to tiles of another.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "protection/protected_message.hpp"
#include "stream/channel.hpp"
#include "stream/tiles.hpp"
#include "tools/frames/grid_frame.hpp"
#include "tools/frames/message_counts.hpp"
#include "tools/frames/object_parts.hpp"
#include "tools/frames/reception_parts.hpp"
#include "tools/frames/run_watch.hpp"
#include "tools/frames/sequence_watch.hpp"
#include "tools/frames/signed_stream.hpp"
#include "tools/frames/supervision.hpp"
#include "tools/frames/tile_messages.hpp"

namespace iog::tools {

// Returns words such as "interface version 4; this iog reads 5".
[[nodiscard]] std::string words_of_version(std::uint8_t sent);

class FrameAssembler {
 public:
  using FrameHandler = std::function<void(GridFrame&&)>;

  // on_frame is called for each frame, in order, complete or not.
  explicit FrameAssembler(FrameHandler on_frame);

  // From now on nothing is believed but what is signed with this key.
  void believe_signed(const authentication::Key& key);

  // Takes one datagram; it may hold any bytes.
  void take(std::span<const std::byte> datagram);

  // A running target reports even silence every two frame periods, which are 150 ms at most.
  static constexpr std::chrono::milliseconds kLongestSilence{500};
  static constexpr std::uint64_t kLongestSilenceUs =
      std::chrono::microseconds(kLongestSilence).count();
  // To be called when nothing has come for longer than that. Hands over the frames that still wait.
  void note_silence();

  // From now on, the messages come from this process, so none can be damaged: their checksums and
  // those of the grids are not verified. Their tiles must be raw.
  void trust_raw() {
    is_trusted_ = true;
    indexes_.keep_none();
    classes_.keep_none();
  }

  // To be called when what comes next is another stream, or this one from its beginning: a
  // recording that is played again has the run numbers that it had.
  void forget();

  // To be called when nothing more comes. Hands over the frames that still wait for messages.
  void finish();

  [[nodiscard]] const MessageCounts& counts() const { return counts_; }
  [[nodiscard]] std::uint64_t messages_lost() const { return sequences_.lost(); }
  // Frames of which no message came at all.
  [[nodiscard]] std::uint64_t frames_lost() const { return frames_lost_; }
  // The interface version of the last message of another one; nothing if none has come.
  [[nodiscard]] std::optional<std::uint8_t> version_sent() const { return version_sent_; }
  // In the words of a target that has refused its car and sends no grid; nothing if none has, or
  // another run has begun since.
  [[nodiscard]] const std::optional<std::string>& car_refusal() const { return car_refusal_; }
  // The channel as AUTOSAR's state machine sees it.
  [[nodiscard]] protection::ChannelState channel() const { return supervisor_.state(); }

 private:
  // A frame that waits for messages is given up when this many newer ones have begun.
  static constexpr std::size_t kMaxWaiting = 3;

  // A frame as far as it has arrived.
  struct WaitingFrame {
    GridFrame frame;
    TileMessages indexes;
    TileMessages classes;
    ObjectParts objects;
    ReceptionParts receptions;
    bool has_window = false;  // of classes: the first message about them has come

    [[nodiscard]] bool is_complete() const {
      const bool has_indexes = !frame.header.has_indexes() || indexes.are_complete();
      const bool has_classes = !frame.classes || (frame.classes->has_end && classes.are_complete());
      const bool has_objects = !frame.header.has_objects() || objects.are_complete();
      const bool has_receptions = !frame.header.has_receptions() || receptions.are_complete();
      return frame.has_end && has_indexes && has_classes && has_objects && has_receptions;
    }
    // Whether the window is that of the frame's other messages.
    [[nodiscard]] bool agree_on(const stream::ClassWindow& window);
  };

  void count_signed();
  void hand_over_all();
  void take_message(std::span<const std::byte> datagram);
  void take_refusal(const stream::Header& header, std::span<const std::byte> body);

  // The counter under which a datagram is counted.
  using Fate = std::uint64_t MessageCounts::*;

  void take_content(std::span<const std::byte> content);
  void end_run();
  void start_over();
  void take_newest(const stream::Header& header, std::span<const std::byte> content,
                   std::span<const std::byte> body);
  [[nodiscard]] Fate take_body(const stream::Header& header, std::span<const std::byte> body);
  [[nodiscard]] static Fate take_tiles(WaitingFrame& waiting, std::span<const std::byte> body);
  [[nodiscard]] static Fate take_class_tiles(WaitingFrame& waiting,
                                             const stream::TilesHeader& tiles,
                                             std::span<const std::byte> body);
  [[nodiscard]] static Fate take_class_end(WaitingFrame& waiting, std::span<const std::byte> body);
  [[nodiscard]] static Fate take_objects(WaitingFrame& waiting, std::span<const std::byte> body);
  [[nodiscard]] static Fate take_receptions(WaitingFrame& waiting, std::span<const std::byte> body);
  [[nodiscard]] static Fate take_end(WaitingFrame& waiting, const stream::Header& header,
                                     std::span<const std::byte> body);
  WaitingFrame& frame_of(const stream::Header& header);
  void decode_indexes(WaitingFrame& waiting);
  void decode_classes(WaitingFrame& waiting);
  void take_back_if_damaged(GridFrame& frame);
  void take_back_if_damaged(ClassGrid& classes);
  void hand_over_first();

  FrameHandler on_frame_;
  bool is_trusted_ = false;
  std::unique_ptr<SignedStream> signed_;
  MessageCounts counts_;
  protection::Receiver receiver_{stream::kNetworkChannel};
  protection::Supervisor supervisor_;
  RunWatch runs_;
  SequenceWatch sequences_;
  std::map<std::uint32_t, WaitingFrame> waiting_;  // by frame number
  TileDecoder indexes_{stream::Storage::kOccupancyIndex};
  TileDecoder classes_{stream::Storage::kClass};
  // What a frame whose tiles are all lost has in common with the frame before it.
  struct Shapes {
    geometry::Grid indexes;
    geometry::Grid classes;
    std::uint16_t epsilon_e5 = 0;
  };
  Shapes shapes_;
  bool has_handed_over_ = false;
  std::uint32_t next_frame_ = 0;  // the lowest number that has not been handed over
  std::uint64_t evidence_frames_ = 0;
  std::uint64_t frames_lost_ = 0;
  std::optional<std::uint8_t> version_sent_;
  std::optional<std::string> car_refusal_;
};

}  // namespace iog::tools
