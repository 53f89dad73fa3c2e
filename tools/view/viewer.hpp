// From the messages of a target to a scene: puts frames together, keeps what is known of the grid,
// judges whether it is of now, and records when a page asks for it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tools/frames/frame_assembler.hpp"
#include "tools/frames/live_classes.hpp"
#include "tools/frames/live_grid.hpp"
#include "tools/program/time_of_day.hpp"
#include "tools/record/recording.hpp"
#include "tools/view/recorder.hpp"
#include "tools/view/scene.hpp"
#include "tools/view/status.hpp"
#include "tools/view/stream_health.hpp"

namespace iog::tools::view {

// Where the messages come from, for the eye.
struct Origin {
  std::string kind;  // Source::kind()
  std::string words;
  std::string block{};  // the CRC of the map block of this PC, in hexadecimal; empty: there is none
};

class Viewer {
 public:
  // The scene outlives the viewer.
  Viewer(Scene& scene, Origin origin, Recorder recorder);

  // From now on the other gets each datagram and each frame, too, with this PC's time. It outlives
  // the viewer.
  void show_also(Recording& other) { others_.push_back(&other); }

  // From now on nothing is shown but what is signed with this key.
  void believe_signed(const authentication::Key& key) { assembler_.believe_signed(key); }

  // One datagram of the stream, of whatever bytes. Its frame is shown as soon as it is complete,
  // unless frames are being held back.
  void take(std::span<const std::byte> datagram, std::uint64_t time_us = time_of_day_us());

  // From now on frames wait until they are shown with what surrounds them.
  void hold_frames() { is_holding_ = true; }
  [[nodiscard]] std::size_t held_frames() const { return held_.size(); }
  void show_next(const Surroundings& surroundings);

  // From time to time, at least ten times a second: does what pages have asked for and says how
  // things stand while nothing comes. overflow: messages that this PC had to drop so far.
  void tend(std::uint64_t overflow = 0);

  // Whether a page has been opened yet.
  [[nodiscard]] bool is_watched() const { return scene_->is_watched(); }

  // Nothing has come for longer than a running target is silent. The picture stays; the next one
  // says nothing of tiles that are not in it.
  void note_silence();
  // The same of a recording. Its gap may be one of whoever recorded it, so that no frame ends
  // there.
  void note_gap();
  // The recording is played once more, from its beginning or from another place.
  void begin_again();
  // The recording is over. A frame in whose middle it ends is not shown.
  void note_end();

  // A recording: how long it is, and where in it the next datagram is, in milliseconds.
  void note_span(std::uint64_t span_ms) { playback_ = Playback{.span_ms = span_ms}; }
  void note_place(std::uint64_t place_ms) { playback_->place_ms = place_ms; }
  // Where in it a page has asked to go on, once.
  [[nodiscard]] std::optional<std::uint64_t> take_jump() { return std::exchange(jump_ms_, {}); }

  // Ends a recording in good order. UsageError if that is not possible.
  void finish() { recorder_.stop(); }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::int64_t kStatusEveryMs = 200;

  [[nodiscard]] std::int64_t now_ms() const;
  void show(const GridFrame& frame, const Surroundings& surroundings);
  [[nodiscard]] std::optional<ClassFacts> take_classes(const GridFrame& frame);
  void obey(const std::string& request);
  [[nodiscard]] std::string status() const;

  Scene* scene_;
  Origin origin_;
  Recorder recorder_;
  std::vector<Recording*> others_;
  FrameAssembler assembler_;
  LiveGrid grid_;
  LiveClasses classes_;
  StreamHealth health_;
  std::optional<FrameFacts> frame_;
  std::vector<GridFrame> held_;
  bool is_holding_ = false;
  std::optional<Playback> playback_;
  std::optional<std::uint64_t> jump_ms_;
  std::optional<std::uint32_t> vehicle_id_;
  std::optional<double> epsilon_;  // of the indexes of the newest frame
  std::string problem_;
  std::uint64_t bytes_before_ = 0;
  std::uint64_t overflow_ = 0;
  std::int64_t last_status_ms_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace iog::tools::view
