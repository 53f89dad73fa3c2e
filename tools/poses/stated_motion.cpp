// A drive is divided into stretches that are long enough to make the receiver's noise and mount
// irrelevant: 5 m for headings and speeds, half a radian for yaw rates.
#include "tools/poses/stated_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace iog::tools {
namespace {

constexpr double kStretchM = 5;
constexpr double kStretchRad = 0.5;
constexpr double kLongestS = 10;  // what creeps may be the drift of a receiver
constexpr double kGapS = 3;
constexpr double kLeastDriveM = 20;
constexpr double kLeastTurnRad = 1;
constexpr double kMostPart = 0.25;      // of the way
constexpr double kMostTurnPart = 0.5;   // of the turn
constexpr double kMostBackwards = 0.9;  // of the way

double turn_between(const PoseSample& from, const PoseSample& to) {
  return std::remainder(to.heading_rad - from.heading_rad, 2 * std::numbers::pi);
}

double seconds_between(const PoseSample& from, const PoseSample& to) {
  return static_cast<double>(to.time_us - from.time_us) / 1e6;
}

// A motion along the headings, across the headings, and according to speeds and yaw rates. The
// latter are NaN if the log does not state them.
struct Moved {
  double ahead_m = 0;
  double beside_m = 0;
  double stated_m = 0;
  double stated_rad = 0;
};

// Sums of the absolute values of whole stretches.
struct Sums {
  double way_m = 0;
  double backwards_m = 0;
  Moved moved{};
  double speed_off_m = 0;
  double turn_rad = 0;
  double rate_off_rad = 0;
};

void add_step(const PoseSample& from, const PoseSample& to, const LoggedPose& pose, Moved& moved) {
  constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();
  const double heading = from.heading_rad + turn_between(from, to) / 2;
  const double x_m = to.x_m - from.x_m;
  const double y_m = to.y_m - from.y_m;
  moved.ahead_m += x_m * std::cos(heading) + y_m * std::sin(heading);
  moved.beside_m += y_m * std::cos(heading) - x_m * std::sin(heading);
  moved.stated_m += pose.speed_mps.value_or(kNotStated) * seconds_between(from, to);
  moved.stated_rad += pose.yaw_rate_rps.value_or(kNotStated) * seconds_between(from, to);
}

// True if the stretch ends here. Counts it in `sums`.
bool ends_way(const PoseSample& from, const PoseSample& to, const Moved& moved, Sums& sums) {
  const double way_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  if (way_m < kStretchM) {
    return seconds_between(from, to) > kLongestS;
  }
  sums.way_m += way_m;
  sums.backwards_m += moved.ahead_m < 0 ? way_m : 0;
  sums.moved.ahead_m += std::abs(moved.ahead_m);
  sums.moved.beside_m += std::abs(moved.beside_m);
  const double off_m = std::abs(moved.ahead_m - moved.stated_m);
  sums.speed_off_m += std::isnan(off_m) ? 0 : off_m;
  return true;
}

bool ends_turn(const PoseSample& from, const PoseSample& to, const Moved& moved, Sums& sums) {
  const double turn_rad = turn_between(from, to);
  const double most_rad = std::max(std::abs(turn_rad), std::abs(moved.stated_rad));
  if (std::isnan(moved.stated_rad) || most_rad < kStretchRad) {
    return seconds_between(from, to) > kLongestS;
  }
  sums.turn_rad += most_rad;
  sums.rate_off_rad += std::abs(turn_rad - moved.stated_rad);
  return true;
}

Sums sums_of(const std::vector<LoggedPose>& poses, const std::vector<PoseSample>& samples) {
  Sums sums;
  Moved on_way;
  Moved on_turn;
  std::size_t way_from = 0;
  std::size_t turn_from = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const bool is_gap = seconds_between(samples[i - 1], samples[i]) > kGapS;
    add_step(samples[i - 1], samples[i], poses[i], on_way);
    add_step(samples[i - 1], samples[i], poses[i], on_turn);
    if (is_gap || ends_way(samples[way_from], samples[i], on_way, sums)) {
      on_way = {};
      way_from = i;
    }
    if (is_gap || ends_turn(samples[turn_from], samples[i], on_turn, sums)) {
      on_turn = {};
      turn_from = i;
    }
  }
  return sums;
}

std::string rounded(double value, const char* unit) {
  return std::to_string(std::lround(value)) + unit;
}

}  // namespace

std::string words_of_misfit(const std::vector<LoggedPose>& poses,
                            const std::vector<PoseSample>& samples) {
  const Sums sums = sums_of(poses, samples);
  if (sums.way_m < kLeastDriveM) {
    return {};
  }
  std::string words;
  const double most_m = kMostPart * sums.way_m;
  if (sums.moved.beside_m > most_m || sums.way_m - sums.moved.ahead_m > most_m) {
    const double angle = std::acos(std::min(1.0, sums.moved.ahead_m / sums.way_m));
    words = "headings by " + rounded(angle * 180 / std::numbers::pi, " degrees");
  } else if (sums.speed_off_m > most_m) {
    words = "speeds by " + rounded(100 * sums.speed_off_m / sums.way_m, " %");
  } else if (sums.backwards_m > kMostBackwards * sums.way_m) {
    return "by the log the car drives backwards on " +
           rounded(100 * sums.backwards_m / sums.way_m, " % of its way") +
           ": if it did not, add 180 degrees to the headings";
  }
  if (sums.turn_rad >= kLeastTurnRad && sums.rate_off_rad > kMostTurnPart * sums.turn_rad) {
    words += (words.empty() ? "" : " and ") + std::string("yaw rates by ") +
             rounded(100 * sums.rate_off_rad / sums.turn_rad, " % of the turn");
  }
  return words.empty()
             ? words
             : "the positions contradict the log's " + words + ": check its units, signs and axes";
}

}  // namespace iog::tools
