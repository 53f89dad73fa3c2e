// Puts the frames of a stream together and gives datagrams and frames to every recording.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/frames/live_classes.hpp"
#include "tools/frames/live_grid.hpp"
#include "tools/receive/stream_census.hpp"
#include "tools/record/recording.hpp"

namespace iog::tools {

class Recorder {
 public:
  using Recordings = std::vector<std::unique_ptr<Recording>>;

  explicit Recorder(Recordings recordings);

  // The next datagram. One that is too long for a message of any target is counted, and dropped.
  void take(const CapturedDatagram& datagram);

  // Scan points of the frame that is open: the next one with evidence has them.
  void add_points(std::span<const SeenPoint> points);
  [[nodiscard]] bool wants_points() const;  // whether any recording does
  [[nodiscard]] std::uint64_t evidence_frames() const { return evidence_frames_; }

  // Nothing has come for longer than a running target is ever silent.
  void note_silence(std::uint64_t now_us);

  // The same of a file. Its gap may be one of whoever recorded it, so that no frame ends there.
  void note_gap();

  // Replaces older outputs now. The first frame with evidence does so, too.
  void keep_beginning();

  // Hands over the frames that still wait, and finishes the recordings. A frame whose end has not
  // come, because the recording was stopped in its middle, is in none but as its messages.
  void finish();

  [[nodiscard]] const StreamCensus& census() const { return census_; }
  [[nodiscard]] std::uint64_t too_long() const { return too_long_; }
  [[nodiscard]] std::uint64_t datagrams() const { return datagrams_; }
  // Whether a sound message of a target is among them.
  [[nodiscard]] bool has_messages() const {
    const FrameAssembler& assembler = census_.assembler();
    return assembler.counts().is_any_of_target() || assembler.car_refusal().has_value();
  }

 private:
  void take_frame(const GridFrame& frame);

  Recordings recordings_;
  LiveGrid live_;
  LiveClasses live_classes_;
  StreamCensus census_;
  std::uint64_t now_us_ = 0;
  std::uint64_t datagrams_ = 0;
  std::uint64_t too_long_ = 0;
  std::uint64_t evidence_frames_ = 0;
  bool is_over_ = false;
  bool is_kept_ = false;
  std::vector<SeenPoint> points_;
};

}  // namespace iog::tools
