#include "tools/poses/log_clock.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/program/fixed.hpp"
#include "tools/program/middle.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kNeighbours = 5;  // spans on each side that tell the speed
constexpr double kLeastStepS = 0.1;
constexpr double kMostForwardS = 2;  // a log that pauses for longer may go on where it was
constexpr double kLeastMps = 2;
constexpr double kStepPart = 0.2;   // tolerance of the time by the distance, of the step
constexpr double kSpeedPart = 0.2;  // how much the speeds on both sides differ at most

double seconds_from(const LoggedPose& from, const LoggedPose& to) {
  return static_cast<double>(static_cast<std::int64_t>(to.time_us - from.time_us)) / 1e6;
}

double way_from(const LoggedPose& from, const LoggedPose& to) {
  return std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
}

// The mean speed over kNeighbours poses; nothing if the log's period is not kept between them.
std::optional<double> speed_from(const std::vector<LoggedPose>& poses, std::size_t begin,
                                 double period_s) {
  double way_m = 0;
  for (std::size_t i = begin; i < begin + kNeighbours; ++i) {
    const double span_s = seconds_from(poses[i], poses[i + 1]);
    if (std::abs(span_s - period_s) > period_s / 2) {
      return std::nullopt;
    }
    way_m += way_from(poses[i], poses[i + 1]);
  }
  return way_m / seconds_from(poses[begin], poses[begin + kNeighbours]);
}

// The step of the log's clock after pose i; 0: none.
double step_behind(const std::vector<LoggedPose>& poses, std::size_t i, double period_s) {
  const double step_s = seconds_from(poses[i], poses[i + 1]) - period_s;
  if (std::abs(step_s) < std::max(kLeastStepS, period_s / 2) || step_s > kMostForwardS) {
    return 0;
  }
  const auto before = speed_from(poses, i - kNeighbours, period_s);
  const auto after = speed_from(poses, i + 1, period_s);
  if (!before || !after || std::min(*before, *after) < kLeastMps ||
      std::abs(*after - *before) > kSpeedPart * *before) {
    return 0;
  }
  const double by_way_s = way_from(poses[i], poses[i + 1]) / ((*before + *after) / 2);
  return std::abs(by_way_s - period_s) <= kStepPart * std::min(std::abs(step_s), period_s * 5)
             ? step_s
             : 0;
}

}  // namespace

std::string words_of_clock_step(const std::vector<LoggedPose>& poses, std::string_view unit) {
  if (poses.size() < 2 * kNeighbours + 2) {
    return {};
  }
  std::vector<double> spans_s;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    spans_s.push_back(seconds_from(poses[i - 1], poses[i]));
  }
  const double period_s = middle_value_of(spans_s);
  for (std::size_t i = kNeighbours; period_s > 0 && i + kNeighbours + 1 < poses.size(); ++i) {
    if (const double step_s = step_behind(poses, i, period_s); step_s != 0) {
      const std::size_t place = poses[i + 1].place;
      return "the log's clock steps by " + fixed(step_s, 3) + " s" +
             (place > 0 ? " at " + std::string(unit) + ' ' + std::to_string(place) : "") +
             ", as if it was set, while the positions run on: no single offset fits. Cut the log "
             "there";
    }
  }
  return {};
}

}  // namespace iog::tools
