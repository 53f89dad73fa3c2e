// What is in the stream of one target: its frames, and what became of its messages.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "tools/frames/frame_assembler.hpp"
#include "tools/receive/run_statistics.hpp"

namespace iog::tools {

class StreamCensus {
 public:
  using FrameHandler = std::function<void(const GridFrame&)>;

  // on_frame, if there is one, is called for each frame in order.
  explicit StreamCensus(FrameHandler on_frame = {});
  StreamCensus(const StreamCensus&) = delete;
  StreamCensus& operator=(const StreamCensus&) = delete;

  // Whether a datagram is a message of some target, sound or not: by its service and event.
  [[nodiscard]] static bool is_message(std::span<const std::byte> datagram);

  // One datagram, of whatever bytes.
  void take(std::span<const std::byte> datagram) { assembler_.take(datagram); }
  // As FrameAssembler has them.
  void note_silence() { assembler_.note_silence(); }
  void finish() { assembler_.finish(); }

  [[nodiscard]] const FrameAssembler& assembler() const { return assembler_; }
  [[nodiscard]] const RunStatistics& statistics() const { return statistics_; }

  // Names and values: of the frames, then of the messages.
  [[nodiscard]] Facts facts() const;
  // The same for a person.
  [[nodiscard]] std::string table() const;
  // "reference_car"; "unknown (1a2b3c4d)" where no description has that name; empty before a frame.
  [[nodiscard]] std::string vehicle() const;

 private:
  FrameHandler on_frame_;
  RunStatistics statistics_;
  std::optional<stream::Header> last_;
  FrameAssembler assembler_;
};

}  // namespace iog::tools
