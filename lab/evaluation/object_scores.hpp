// How well things with a speed are told: what is reported of a drive, frame by frame, against what
// is true.
//
// A mover is a car or a person that counts in a frame; which do, whoever calls this says. It is in
// view from the first frame in which it counts to the last before it does not count for more than a
// second. It is told in a frame if what has most of its hits is reported to move.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "lab/evaluation/gospa.hpp"

namespace iog::lab {

// Metres, and metres a second; both of the world.
struct Mover {
  std::uint32_t thing = 0;
  bool is_person = false;
  Vector2 at{};
  Vector2 velocity{};
  std::optional<std::size_t> told_by{};  // its place in ObjectFrame::reported
};

// What most of the hits of something are on.
enum class ReportedOn : std::uint8_t {
  kMover,    // that counts in this frame
  kIgnored,  // something moves there, or has just stopped, and does not count in this frame
  kNothing,  // nothing moves there
};

// Something that is reported to move and was hit in the frame.
struct Reported {
  std::uint32_t id = 0;
  Vector2 at{};
  Vector2 velocity{};
  double deviation = 0;  // of the velocity, as it is stated
  std::uint64_t born_us = 0;
  ReportedOn on = ReportedOn::kNothing;
};

struct ObjectFrame {
  std::uint64_t time_us = 0;
  std::vector<Mover> movers{};
  std::vector<Reported> reported{};
};

// One velocity that was told.
struct VelocityError {
  double metres_a_second = 0;
  bool is_within_two_deviations = false;
};

// A mover as long as it was in view.
struct View {
  std::uint32_t thing = 0;
  bool is_person = false;
  std::uint64_t first_us = 0;
  std::uint64_t last_us = 0;
  std::uint64_t seen_us = 0;  // between frames in which it counts, at most kOftenUs apart
  std::uint32_t frames = 0;
  std::uint32_t told = 0;         // of them
  std::uint32_t late_frames = 0;  // those from kLateUs in view on
  std::uint32_t late_told = 0;
  std::optional<std::uint64_t> delay_us{};  // until it was told first
  std::uint32_t other_ids = 0;              // told by another than the last time
  std::vector<VelocityError> errors{};      // told by what was known for kLateUs or longer
};

struct ObjectTotals {
  std::uint64_t frames = 0;
  std::uint64_t movers = 0;
  std::uint64_t reported = 0;
  std::uint64_t wrong = 0;  // of them: nothing moves there
  // Movers, and what is reported but for ReportedOn::kIgnored.
  Gospa gospa{};
};

class ObjectScorer {
 public:
  static constexpr std::uint64_t kLateUs = 500'000;
  static constexpr std::uint64_t kOftenUs = 200'000;
  static constexpr std::uint64_t kGoneUs = 1'000'000;
  static constexpr double kCutM = 4;

  // Frames in the order of their times.
  void add(const ObjectFrame& frame);

  [[nodiscard]] const ObjectTotals& totals() const { return totals_; }
  // In the order in which they began.
  [[nodiscard]] const std::vector<View>& views() const { return views_; }

 private:
  struct Newest {
    std::size_t view = 0;  // its place in views_
    std::optional<std::uint32_t> id{};
  };

  void watch(std::uint64_t time_us, const Mover& mover, const std::vector<Reported>& reported);
  Newest& newest_of(std::uint64_t time_us, const Mover& mover);
  void add_gospa(const ObjectFrame& frame);

  ObjectTotals totals_{};
  std::vector<View> views_;
  std::map<std::uint32_t, Newest> newest_;  // by thing
};

}  // namespace iog::lab
