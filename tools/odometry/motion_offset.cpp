#include "tools/odometry/motion_offset.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "tools/program/fixed.hpp"

namespace iog::tools {
namespace {

constexpr double kStepS = 0.01;    // of the table of the log
constexpr double kCoarseS = 0.05;  // less than a turn
constexpr double kAroundS = 0.1;   // of a peak, which is a parabola there
constexpr double kSilenceS = 2.5;  // longer ones are not interpolated
constexpr std::size_t kFewestTurns = 20;
// Bounds of the time that all offsets take.
constexpr std::size_t kMostTurns = 3'000;
constexpr std::uint64_t kMostLogUs = 6 * 3'600'000'000ULL;
// By how much a lidar's ranges and an odometry's headings are off.
constexpr double kScaleSigma = 0.005;
constexpr double kDriftSigmaRps = 0.001;
// Two recorded drives have 0.021 s more than they should, of which nobody knows whose error it is.
constexpr double kSystematicS = 0.01;
constexpr double kMostSigmaS = 0.025;
constexpr double kLeastGain = 50;
constexpr double kMostRival = 0.9;
constexpr double kApartS = 1;  // of peaks that differ by more than noise

// Way and heading of the log at any time, summed from its begin.
class LogTable {
 public:
  explicit LogTable(std::span<const PoseSample> poses) {
    begin_s_ = seconds_of(poses.front());
    double way = 0;
    double heading = poses.front().heading_rad;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      const PoseSample& from = poses[i - 1];
      const PoseSample& to = poses[i];
      const double seconds = seconds_of(to) - seconds_of(from);
      const double turned = std::remainder(to.heading_rad - from.heading_rad, 2 * std::numbers::pi);
      const double first_s = seconds_of(from) - begin_s_;
      while (static_cast<double>(entries_.size()) * kStepS < first_s + seconds) {
        const double at = static_cast<double>(entries_.size()) * kStepS;
        const double part = (at - first_s) / seconds;
        entries_.push_back({way + way_in(from, to, seconds, part),
                            heading + turn_in(from, to, seconds, turned, part),
                            seconds <= kSilenceS});
      }
      way += way_in(from, to, seconds, 1);
      heading += turned;
    }
  }

  // Way and turn between two times.
  [[nodiscard]] std::optional<TurnMotion> between(double from_s, double to_s) const {
    const double from = (from_s - begin_s_) / kStepS;
    const double to = (to_s - begin_s_) / kStepS;
    if (from < 0 || to + 2 >= static_cast<double>(entries_.size())) {
      return std::nullopt;
    }
    const Entry a = at(from);
    const Entry b = at(to);
    return a.is_known && b.is_known
               ? std::optional(TurnMotion{to_s - from_s, b.way - a.way, b.heading - a.heading})
               : std::nullopt;
  }

  [[nodiscard]] double begin_s() const { return begin_s_; }
  [[nodiscard]] double end_s() const {
    return begin_s_ + static_cast<double>(entries_.size()) * kStepS;
  }

 private:
  struct Entry {
    double way;
    double heading;
    bool is_known;
  };

  static double seconds_of(const PoseSample& pose) {
    return static_cast<double>(pose.time_us) / 1e6;
  }

  // Of an even acceleration.
  static double way_in(const PoseSample& from, const PoseSample& to, double seconds, double part) {
    return seconds * part * (from.speed_mps + (to.speed_mps - from.speed_mps) * part / 2);
  }

  // Hermite's cubic, which has the yaw rates of both poses.
  static double turn_in(const PoseSample& from, const PoseSample& to, double seconds, double turned,
                        double part) {
    const double rest = 1 - part;
    return turned * part * part * (3 - 2 * part) +
           seconds * part * rest * (from.yaw_rate_rps * rest - to.yaw_rate_rps * part);
  }

  [[nodiscard]] Entry at(double place) const {
    const double whole = std::floor(place);
    const Entry& a = entries_[static_cast<std::size_t>(whole)];
    const Entry& b = entries_[static_cast<std::size_t>(whole) + 1];
    const double part = place - whole;
    return {a.way + part * (b.way - a.way), a.heading + part * (b.heading - a.heading),
            a.is_known && b.is_known};
  }

  double begin_s_;
  std::vector<Entry> entries_;
};

struct Observation {
  double from_s;
  double to_s;
  TurnMotion motion;
};

struct Comparison {
  std::vector<Observation> turns{};
  double mean_mps = 0;
  double mean_rps = 0;
  double sigma_m = 0.03;
  double sigma_rad = 0.002;
};

Comparison comparison_of(std::span<const TurnPose> turns) {
  Comparison all;
  double seconds = 0;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    if (turns[i].is_sure && turns[i - 1].is_sure && all.turns.size() < kMostTurns) {
      const TurnMotion motion = motion_between(turns[i - 1], turns[i]);
      const double to_s = static_cast<double>(turns[i].time_us) / 1e6;
      all.turns.push_back({to_s - motion.seconds, to_s, motion});
      all.mean_mps += motion.forward_m;
      all.mean_rps += motion.turn_rad;
      seconds += motion.seconds;
    }
  }
  all.mean_mps /= std::max(seconds, 1e-9);
  all.mean_rps /= std::max(seconds, 1e-9);
  return all;
}

struct Fit {
  double gain = 0;  // how much better than an even motion the log explains the turns, in sigma^2
  double squares_m = 0;
  double squares_rad = 0;
  std::size_t count = 0;
};

double squared(double value) { return value * value; }

// The way of the lidar is taken as that of the log by a scale, its turn as that of the log with a
// drift. Otherwise an error of 0.3 % in the speed of a braking car would look like 40 ms.
Fit fit_at(const Comparison& all, const LogTable& log, double offset_s) {
  const double scale_weight = squared(all.sigma_m / kScaleSigma);
  const double drift_weight = squared(all.sigma_rad / kDriftSigmaRps);
  Fit fit;
  double product = scale_weight;
  double own = scale_weight;
  double drift = 0;
  double time = drift_weight;
  double even = 0;
  for (const Observation& turn : all.turns) {
    const auto its = log.between(turn.from_s - offset_s, turn.to_s - offset_s);
    if (!its) {
      continue;
    }
    const TurnMotion& seen = turn.motion;
    even += squared((seen.forward_m - all.mean_mps * seen.seconds) / all.sigma_m) +
            squared((seen.turn_rad - all.mean_rps * seen.seconds) / all.sigma_rad);
    product += seen.forward_m * its->forward_m;
    own += its->forward_m * its->forward_m;
    fit.squares_m += squared(seen.forward_m);
    drift += (seen.turn_rad - its->turn_rad) * seen.seconds;
    time += squared(seen.seconds);
    fit.squares_rad += squared(seen.turn_rad - its->turn_rad);
    ++fit.count;
  }
  fit.squares_m += scale_weight - product * product / own;
  fit.squares_rad -= drift * drift / time;
  fit.gain = fit.count < kFewestTurns ? 0
                                      : even - fit.squares_m / squared(all.sigma_m) -
                                            fit.squares_rad / squared(all.sigma_rad);
  return fit;
}

struct Peaks {
  double best_s = 0;
  double gain = 0;
  double rival = 0;  // gain of the next peak
};

Peaks peaks_of(const Comparison& all, const LogTable& log, double first_s, double last_s) {
  Peaks peaks;
  std::vector<double> gains;
  const auto steps = static_cast<std::size_t>((last_s - first_s) / kCoarseS) + 1;
  for (std::size_t i = 0; i < steps; ++i) {
    gains.push_back(fit_at(all, log, first_s + static_cast<double>(i) * kCoarseS).gain);
  }
  const auto best = std::ranges::max_element(gains) - gains.begin();
  const auto apart = std::llround(kApartS / kCoarseS);
  for (std::ptrdiff_t i = 1; i + 1 < std::ssize(gains); ++i) {
    const bool is_peak = gains.begin()[i] >= std::max(gains.begin()[i - 1], gains.begin()[i + 1]);
    if (is_peak && std::abs(i - best) > apart) {
      peaks.rival = std::max(peaks.rival, gains.begin()[i]);
    }
  }
  peaks.best_s = first_s + static_cast<double>(best) * kCoarseS;
  peaks.gain = gains.begin()[best];
  return peaks;
}

struct Vertex {
  double at_s;
  double bend;  // minus the gain's second derivative
};

// Of the parabola around a peak, of turns that the log covers on both sides of it.
Vertex vertex_at(Comparison all, const LogTable& log, double peak_s) {
  std::erase_if(all.turns, [&](const Observation& turn) {
    return !log.between(turn.from_s - peak_s - kAroundS, turn.to_s - peak_s + kAroundS);
  });
  const double earlier = fit_at(all, log, peak_s - kAroundS).gain;
  const double middle = fit_at(all, log, peak_s).gain;
  const double later = fit_at(all, log, peak_s + kAroundS).gain;
  const double bend = (2 * middle - earlier - later) / (kAroundS * kAroundS);
  const double off_s = (later - earlier) / (2 * kAroundS * bend);
  return {peak_s + (bend > 0 ? std::clamp(off_s, -kAroundS, kAroundS) : 0), bend};
}

// Why so many offsets may be meant that they cannot be tried; empty: they can.
std::string words_of_long(const std::vector<Observation>& turns) {
  const auto [first, last] = std::ranges::minmax(turns, {}, &Observation::to_s);
  if (last.to_s - first.to_s <= static_cast<double>(kMostLogUs) / 1e6) {
    return {};
  }
  double step_s = 0;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const double its_s = turns[i].to_s - turns[i - 1].to_s;
    step_s = std::abs(its_s) > std::abs(step_s) ? its_s : step_s;
  }
  return "the capture spans more than 6 hours: a clock in it steps by " + fixed(step_s, 0) +
         " s, so cut the capture there";
}

}  // namespace

MotionOffset offset_by_motion(std::span<const TurnPose> turns, std::span<const PoseSample> poses) {
  if (poses.back().time_us - poses.front().time_us > kMostLogUs) {
    return {.refusal = "the log of poses spans more than 6 hours"};
  }
  Comparison all = comparison_of(turns);
  const LogTable log(poses);
  if (all.turns.size() < kFewestTurns) {
    return {.refusal = "too few turns of the lidar determine the motion"};
  }
  if (std::string words = words_of_long(all.turns); !words.empty()) {
    return {.refusal = std::move(words)};
  }
  const double first_s = all.turns.front().from_s - log.end_s();
  const double last_s = all.turns.back().to_s - log.begin_s();
  const Fit rough = fit_at(all, log, peaks_of(all, log, first_s, last_s).best_s);
  const auto count = static_cast<double>(std::max<std::size_t>(rough.count, 1));
  all.sigma_m = std::max(0.005, std::sqrt(rough.squares_m / count));
  all.sigma_rad = std::max(0.0003, std::sqrt(rough.squares_rad / count));
  const Peaks peaks = peaks_of(all, log, first_s, last_s);
  const Vertex rough_peak = vertex_at(all, log, peaks.best_s);
  const Vertex peak = vertex_at(all, log, rough_peak.at_s);
  MotionOffset found{.seconds = peak.at_s,
                     .sigma_s = std::hypot(kSystematicS, std::sqrt(2 / peak.bend))};
  if (peaks.gain < kLeastGain || !(peak.bend > 0) || found.sigma_s > kMostSigmaS) {
    found.refusal = "the car drives too straight and evenly to show a clock offset";
  } else if (peaks.rival > kMostRival * peaks.gain) {
    found.refusal = "the motion repeats itself, so that several clock offsets fit";
  }
  return found;
}

std::string words_of(const MotionOffset& offset) {
  return "by their motion, the packets are " + fixed(std::abs(offset.seconds), 3) + " s " +
         (offset.seconds < 0 ? "behind" : "ahead of") + " the poses, sigma " +
         fixed(std::ceil(offset.sigma_s * 1e3), 0) + " ms";
}

}  // namespace iog::tools
