// Whether the picture shows the present, and if not, why. It knows no clock: the caller gives times
// in milliseconds of any steady clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/frames/frame_assembler.hpp"

namespace iog::tools::view {

enum class StreamState : std::uint8_t {
  kWaiting,       // nothing that could be shown has ever come
  kLive,          // the newest frame is of now
  kStale,         // there was a picture, and nothing comes any more
  kIncompatible,  // what comes cannot be read: another version, or another grid
  kEnded,         // the recording is over
};

[[nodiscard]] std::string_view name_of(StreamState state);

class StreamHealth {
 public:
  static constexpr std::int64_t kStaleAfterMs = FrameAssembler::kLongestSilence.count();
  // How long a single event stays worth saying.
  static constexpr std::int64_t kRecentMs = 3000;

  void note_frame(std::int64_t now_ms) { last_frame_ms_ = now_ms; }
  // Of a frame, also if nothing of it can be shown.
  void note_points_not_taken(std::uint32_t points, std::int64_t now_ms) {
    too_slow_.note(too_slow_.count + points, now_ms);
  }
  void note_counts(const MessageCounts& counts, std::int64_t now_ms);
  void note_end() { has_ended_ = true; }
  // The recording ends in the middle of a frame.
  void note_broken_off() { breaks_off_ = true; }
  // It is played once more.
  void note_begin() { has_ended_ = breaks_off_ = false; }

  [[nodiscard]] StreamState state(std::int64_t now_ms) const;
  [[nodiscard]] bool breaks_off() const { return breaks_off_; }
  // Time since the last frame; 0 if there was none.
  [[nodiscard]] std::int64_t silent_ms(std::int64_t now_ms) const;

  [[nodiscard]] bool has_restarted_lately(std::int64_t now_ms) const;
  [[nodiscard]] bool is_corrupt_lately(std::int64_t now_ms) const;
  // The target has left points that it had no time for.
  [[nodiscard]] bool is_too_slow_lately(std::int64_t now_ms) const;
  // Messages of another version arrive or have just arrived.
  [[nodiscard]] bool has_other_version_lately(std::int64_t now_ms) const;

 private:
  // A count, and when it grew last.
  struct Watch {
    std::uint64_t count = 0;
    std::optional<std::int64_t> grown_ms{};

    void note(std::uint64_t now_count, std::int64_t now_ms);
    [[nodiscard]] bool is_recent(std::int64_t now_ms) const;
  };

  std::optional<std::int64_t> last_frame_ms_;
  bool has_ended_ = false;
  bool breaks_off_ = false;
  Watch restarts_;
  Watch corrupt_;
  Watch too_slow_;
  Watch other_version_;
  Watch not_understood_;
};

}  // namespace iog::tools::view
