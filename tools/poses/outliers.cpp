#include "tools/poses/outliers.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/elementary.hpp"
#include "pose/limits.hpp"
#include "tools/program/middle.hpp"

namespace iog::tools {
namespace {

constexpr double kMostMps = pose::kMaxSpeedMmPerS / 1e3;
constexpr double kMostRps = pose::kMaxYawRateUradPerS / 1e6;
constexpr double kMostAcceleration = 10;     // m/s^2
constexpr double kMostTurnAcceleration = 3;  // rad/s^2
// What a target takes for a jump.
constexpr double kLeastSlackM = pose::kMaxResidualMm / 1e3;
constexpr double kLeastSlackRad = 0.15;  // error of a course at walking pace
constexpr double kNoiseMargin = 8;
constexpr double kSilenceS = 1.5 * pose::kLostUs / 1e6;
constexpr std::size_t kMostLeftOut = 2048;  // in a row: bounds the search
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct Way {
  double seconds = 0;
  double x_m = 0;
  double y_m = 0;
  double turn_rad = 0;
};

Way way_between(const LoggedPose& from, const LoggedPose& to) {
  return {static_cast<double>(to.time_us - from.time_us) / 1e6, to.x_m - from.x_m,
          to.y_m - from.y_m, std::remainder(*to.heading_rad - *from.heading_rad, 2 * numeric::kPi)};
}

// How far the second step departs from the motion of the first, beyond what a car's forces explain.
struct Bend {
  double place_m = 0;
  double turn_rad = 0;
};

Bend bend_of(const Way& first, const Way& second) {
  const double share = second.seconds / first.seconds;
  const double squared_s = second.seconds * (first.seconds + second.seconds) / 2;
  const double off_m = std::hypot(second.x_m - first.x_m * share, second.y_m - first.y_m * share);
  const double off_rad = std::abs(second.turn_rad - first.turn_rad * share);
  return {std::max(0.0, off_m - kMostAcceleration * squared_s),
          std::max(0.0, off_rad - kMostTurnAcceleration * squared_s)};
}

double median(const std::vector<double>& values) {
  return values.empty() ? 0 : middle_value_of(values);
}

class Chains {
 public:
  explicit Chains(const std::vector<LoggedPose>& poses) : poses_(&poses), steps_(poses.size()) {
    measure_noise();
    for (std::size_t i = poses.size(); i-- > 0;) {
      join(i);
    }
  }

  [[nodiscard]] std::vector<bool> longest() const {
    std::vector<bool> is_in(poses_->size());
    const auto begin = std::ranges::max_element(steps_, {}, &Step::length);
    for (auto i = static_cast<std::size_t>(begin - steps_.begin()); i < is_in.size();
         i = steps_[i].next) {
      is_in[i] = true;
    }
    return is_in;
  }

 private:
  // The longest chain from a pose on, and the longest from any pose from there on.
  struct Step {
    std::size_t next = kNone;
    std::size_t length = 1;
    std::size_t most = 1;
  };

  [[nodiscard]] const LoggedPose& pose(std::size_t i) const { return (*poses_)[i]; }

  [[nodiscard]] bool is_newer(std::size_t from, std::size_t to) const {
    return pose(to).time_us >= pose(from).time_us + pose::kMinSpacingUs;
  }

  void measure_noise() {
    std::vector<double> places;
    std::vector<double> turns;
    for (std::size_t i = 2; i < poses_->size(); ++i) {
      if (is_newer(i - 2, i - 1) && is_newer(i - 1, i)) {
        const Bend bend =
            bend_of(way_between(pose(i - 2), pose(i - 1)), way_between(pose(i - 1), pose(i)));
        places.push_back(bend.place_m);
        turns.push_back(bend.turn_rad);
      }
    }
    slack_.place_m = std::max(kLeastSlackM, kNoiseMargin * median(places));
    slack_.turn_rad = std::max(kLeastSlackRad, kNoiseMargin * median(turns));
  }

  [[nodiscard]] bool follows(std::size_t from, std::size_t to) const {
    if (!is_newer(from, to)) {
      return false;
    }
    const Way way = way_between(pose(from), pose(to));
    if (way.seconds > kSilenceS) {
      return true;
    }
    if (std::hypot(way.x_m, way.y_m) > kMostMps * way.seconds ||
        std::abs(way.turn_rad) > kMostRps * way.seconds) {
      return false;
    }
    const std::size_t next = steps_[to].next;
    const Way on = next == kNone ? Way{} : way_between(pose(to), pose(next));
    if (next == kNone || on.seconds > kSilenceS) {
      return true;
    }
    const Bend bend = bend_of(on, way);
    return bend.place_m <= slack_.place_m && bend.turn_rad <= slack_.turn_rad;
  }

  void join(std::size_t i) {
    Step& step = steps_[i];
    const std::size_t end = std::min(poses_->size(), i + 1 + kMostLeftOut);
    for (std::size_t next = i + 1; next < end && step.length <= steps_[next].most; ++next) {
      if (steps_[next].length >= step.length && follows(i, next)) {
        step.next = next;
        step.length = steps_[next].length + 1;
      }
    }
    step.most = i + 1 < poses_->size() ? std::max(step.length, steps_[i + 1].most) : step.length;
  }

  const std::vector<LoggedPose>* poses_;
  std::vector<Step> steps_;
  Bend slack_;
};

}  // namespace

std::vector<bool> drivable(const std::vector<LoggedPose>& poses) { return Chains(poses).longest(); }

}  // namespace iog::tools
