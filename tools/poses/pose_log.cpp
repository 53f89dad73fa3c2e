#include "tools/poses/pose_log.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>
#include <utility>

#include "pose/limits.hpp"
#include "tools/poses/log_clock.hpp"
#include "tools/poses/outliers.hpp"
#include "tools/poses/pose_encoder.hpp"
#include "tools/poses/stated_motion.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/middle.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Of a log that states none.
constexpr double kAssumedM = 0.05;
constexpr double kAssumedRad = 0.002;

// Half way between two poses, a car that brakes by 3 m/s^2 is 23 mm off the straight line between
// them, and one whose yaw rate changes by 0.3 rad/s^2 2.3 mrad: as much as is assumed above.
constexpr std::uint64_t kMostInterpolatedUs = 250'000;

double seconds_between(const LoggedPose& from, const LoggedPose& to) {
  return static_cast<double>(to.time_us - from.time_us) / 1e6;
}

// The receiver's place less its mount.
PoseSample sample_of(const LoggedPose& pose, const PoseConversion& conversion) {
  const double heading = *pose.heading_rad - conversion.mount_yaw_rad;
  const double cos = std::cos(heading);
  const double sin = std::sin(heading);
  return {.time_us = pose.time_us,
          .run = conversion.run,
          .x_m = pose.x_m - conversion.mount_x_m * cos + conversion.mount_y_m * sin,
          .y_m = pose.y_m - conversion.mount_x_m * sin - conversion.mount_y_m * cos,
          .heading_rad = heading,
          .speed_mps = pose.speed_mps.value_or(0),
          .yaw_rate_rps = pose.yaw_rate_rps.value_or(0),
          .sigma_m = conversion.sigma_m.value_or(pose.sigma_m.value_or(kAssumedM)),
          .sigma_heading_rad = std::hypot(
              conversion.sigma_heading_rad.value_or(pose.sigma_heading_rad.value_or(kAssumedRad)),
              pose.heading_doubt_rad)};
}

// Coordinates of a country's grid, such as UTM, may be beyond what a message can say.
void count_from_near(PoseLog& log) {
  constexpr double kMostM = pose::kMaxCoordinateMm / 1000.0;
  const auto middle_of = [&log](double LoggedPose::*coordinate) {
    std::vector<double> all;
    std::ranges::transform(log.poses, std::back_inserter(all), coordinate);
    std::erase_if(all, [](double value) { return !std::isfinite(value); });
    return all.empty() ? 0 : std::round(middle_value_of(std::move(all)));
  };
  const double x_m = middle_of(&LoggedPose::x_m);
  const double y_m = middle_of(&LoggedPose::y_m);
  if (std::max(std::abs(x_m), std::abs(y_m)) <= kMostM) {
    return;
  }
  for (LoggedPose& pose : log.poses) {
    pose.x_m -= x_m;
    pose.y_m -= y_m;
  }
  log.notes.push_back("positions are counted from x " + fixed(x_m, 0) + " m, y " + fixed(y_m, 0) +
                      " m, as a target takes none beyond 1000 km");
}

// What is not interpolated.
void note_gaps(const std::vector<LoggedPose>& poses, std::vector<std::string>& notes) {
  std::size_t gaps = 0;
  double longest_s = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    gaps += poses[i].time_us - poses[i - 1].time_us > kMostInterpolatedUs ? 1U : 0U;
    longest_s = std::max(longest_s, seconds_between(poses[i - 1], poses[i]));
  }
  if (gaps > 0) {
    notes.push_back(counted(gaps, "gap|gaps between poses is|are") +
                    " longer than 0.250 s, the longest " + fixed(longest_s, 3) +
                    " s: packets in them later than 0.100 s after a pose have no place");
  }
}

// Takes out what the target would drop or no car can have driven.
std::vector<LoggedPose> usable(PoseLog& log, const PoseConversion& conversion) {
  count_from_near(log);
  Tally without_heading;
  Tally no_number;
  Tally unsayable;
  std::vector<LoggedPose> whole;
  for (const LoggedPose& pose : log.poses) {
    if (!pose.heading_rad) {
      without_heading.add(pose.place);
    } else if (!std::isfinite(pose.x_m + pose.y_m + *pose.heading_rad)) {
      no_number.add(pose.place);
    } else if (!can_be_said(sample_of(pose, conversion))) {
      unsayable.add(pose.place);
    } else {
      whole.push_back(pose);
    }
  }
  Tally not_newer;
  Tally too_close;
  Tally outliers;
  std::vector<LoggedPose> poses;
  const std::vector<bool> is_drivable = drivable(whole);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const LoggedPose& pose = whole[i];
    if (is_drivable[i]) {
      poses.push_back(pose);
    } else if (!poses.empty() && pose.time_us <= poses.back().time_us) {
      not_newer.add(pose.place);
    } else if (!poses.empty() && pose.time_us - poses.back().time_us < pose::kMinSpacingUs) {
      too_close.add(pose.place);
    } else {
      outliers.add(pose.place);
    }
  }
  remark(without_heading, "pose|poses without a heading", log.unit, log.remarks);
  remark(no_number, "pose|poses whose position or heading is not finite", log.unit, log.remarks);
  remark(unsayable, "pose|poses beyond 1000 km, 100 m/s or 10 rad/s", log.unit, log.remarks);
  remark(not_newer, "pose|poses that is|are not newer than the one before", log.unit, log.remarks);
  remark(too_close, "pose|poses less than 8 ms after the one before", log.unit, log.remarks);
  remark(outliers, "pose|poses that no car reaches from those around them", log.unit, log.remarks);
  if (outliers.count > poses.size()) {
    log.notes.emplace_back(
        "no car moves as most poses say: check the units of positions, headings and times");
  } else {
    note_gaps(poses, log.notes);
  }
  if (std::string words = words_of_clock_step(whole, log.unit); !words.empty()) {
    log.notes.push_back(std::move(words));
  }
  return poses;
}

// Fills in what the log does not say of motion, from the neighbours of each pose. Two neighbours
// further apart than a silence that breaks the history say nothing.
void add_motion(const std::vector<LoggedPose>& poses, std::vector<PoseSample>& samples) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : i;
    const std::size_t after = i + 1 < poses.size() ? i + 1 : i;
    const double span_s = seconds_between(poses[before], poses[after]);
    if (before == after || span_s * 1e6 > static_cast<double>(pose::kLostUs)) {
      continue;
    }
    PoseSample& sample = samples[i];
    const PoseSample& from = samples[before];
    const PoseSample& to = samples[after];
    if (!poses[i].speed_mps) {
      constexpr double kFastestMps = pose::kMaxSpeedMmPerS / 1000.0;
      const double speed_mps = ((to.x_m - from.x_m) * std::cos(sample.heading_rad) +
                                (to.y_m - from.y_m) * std::sin(sample.heading_rad)) /
                               span_s;
      sample.speed_mps = std::clamp(speed_mps, -kFastestMps, kFastestMps);
    }
    if (!poses[i].yaw_rate_rps) {
      sample.yaw_rate_rps = std::remainder(to.heading_rad - from.heading_rad, kTurn) / span_s;
    }
  }
}

// A target predicts for pose::kLateUs after a pose, and knows the next one only when it comes.
std::vector<PoseSample> interpolated(const std::vector<PoseSample>& samples) {
  constexpr std::uint64_t kPeriodUs = 20'000;
  std::vector<PoseSample> all;
  for (const PoseSample& to : samples) {
    const std::uint64_t gap_us = all.empty() ? 0 : to.time_us - all.back().time_us;
    if (gap_us > pose::kLateUs && gap_us <= kMostInterpolatedUs) {
      const PoseSample from = all.back();
      const std::uint64_t parts = gap_us / kPeriodUs;
      for (std::uint64_t part = 1; part < parts; ++part) {
        all.push_back(between(from, to, from.time_us + gap_us * part / parts));
      }
    }
    all.push_back(to);
  }
  return all;
}

// What the target places nothing by.
void note_imprecise(const std::vector<PoseSample>& samples, std::vector<std::string>& notes) {
  std::size_t imprecise = 0;
  pose::Sigma most{.position_mm = 0, .heading_10urad = 0};
  for (const PoseSample& sample : samples) {
    const pose::Sigma sigma = wire_sigma(sample.sigma_m, sample.sigma_heading_rad);
    imprecise +=
        sigma.position_mm > pose::kMaxSigmaMm || sigma.heading_10urad > pose::kMaxSigmaHeading ? 1U
                                                                                               : 0U;
    most.position_mm = std::max(most.position_mm, sigma.position_mm);
    most.heading_10urad = std::max(most.heading_10urad, sigma.heading_10urad);
  }
  if (imprecise > 0) {
    std::ostringstream text;
    text << counted(imprecise, "pose|poses is|are") << " too imprecise: the motion of a second has "
         << "standard deviations of up to " << most.position_mm << " mm and "
         << most.heading_10urad / 100.0 << " mrad, and a target uses none above "
         << pose::kMaxSigmaMm << " mm or " << pose::kMaxSigmaHeading / 100.0
         << " mrad; if the poses are better, --poses-sigma MM MRAD (`iog pose`: --sigma, "
            "--heading-sigma) says so";
    notes.push_back(text.str());
  }
}

// The values of a slow sensor that a log repeats until the next ones would be jumps. A car that
// stands for a second repeats itself, too.
void drop_held(PoseLog& log) {
  constexpr double kStepM = 0.1;  // smaller ones are those of the log's last digit
  const std::vector<LoggedPose>& poses = log.poses;
  std::vector<bool> is_held(poses.size());
  std::size_t steps = 0;
  std::size_t begin = 0;
  Tally held;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const LoggedPose& from = poses[begin];
    const double step_m = std::hypot(poses[i].x_m - from.x_m, poses[i].y_m - from.y_m);
    if (step_m == 0 && poses[i].heading_rad == from.heading_rad) {
      continue;
    }
    if (step_m >= kStepM && poses[i].time_us - from.time_us <= pose::kLostUs) {
      ++steps;
      for (std::size_t next = begin + 1; next < i; ++next) {
        is_held[next] = true;
        held.add(poses[next].place);
      }
    }
    begin = i;
  }
  if (held.count > steps) {
    std::size_t i = 0;
    std::erase_if(log.poses, [&](const auto& /*pose*/) { return is_held[i++]; });
    remark(held, "pose|poses that repeats|repeat the one before until the next measurement",
           log.unit, log.remarks);
  }
}

// A column of zeros is one that nobody fills in, or the car stands, and both say the same.
void forget_unfilled(std::vector<LoggedPose>& poses, std::optional<double> LoggedPose::*column) {
  if (std::ranges::all_of(poses,
                          [&](const auto& pose) { return (pose.*column).value_or(0) == 0; })) {
    std::ranges::for_each(poses, [&](auto& pose) { (pose.*column).reset(); });
  }
}

// The same for all poses: both planes stay where they are.
pose::MapTransform transform_of(const LocalPlane& plane, const PoseConversion::Map& map) {
  const LocalPlane::Frame frame = map.origin.plane().frame_of(plane);
  return {.origin = map.origin.name(),
          .local_frame = wire_pose(frame.origin.east_m, frame.origin.north_m, frame.turn_rad),
          .sigma = map.sigma};
}

}  // namespace

void remark(const Tally& tally, std::string_view what, std::string_view unit,
            std::vector<std::string>& remarks) {
  remark(tally.count, what, remarks);
  if (tally.first > 0) {
    remarks.back() += (tally.count > 1 ? " (first: " : " (") + std::string(unit) + ' ' +
                      std::to_string(tally.first) + ')';
  }
}

void remark(std::size_t count, std::string_view what, std::vector<std::string>& remarks) {
  if (count > 0) {
    remarks.push_back(counted(count, what));
  }
}

ConvertedLog converted(PoseLog log, const PoseConversion& conversion) {
  drop_held(log);
  forget_unfilled(log.poses, &LoggedPose::speed_mps);
  forget_unfilled(log.poses, &LoggedPose::yaw_rate_rps);
  const std::vector<LoggedPose> poses = usable(log, conversion);
  ConvertedLog result;
  result.poses = poses.size();
  for (const LoggedPose& pose : poses) {
    result.samples.push_back(sample_of(pose, conversion));
    result.taken_sigmas += pose.sigma_m || conversion.sigma_m ? 0U : 1U;
    result.taken_sigma_headings += pose.sigma_heading_rad || conversion.sigma_heading_rad ? 0U : 1U;
  }
  add_motion(poses, result.samples);
  if (conversion.map && log.plane) {
    if (std::string words = words_of_far_map(log, conversion.map->origin); !words.empty()) {
      throw UsageError(words);
    }
    const pose::MapTransform transform = transform_of(*log.plane, *conversion.map);
    for (PoseSample& sample : result.samples) {
      sample.map = transform;
    }
  }
  result.remarks = std::move(log.remarks);
  result.notes = std::move(log.notes);
  const auto tilted =
      static_cast<std::size_t>(std::ranges::count(poses, true, &LoggedPose::is_tilted));
  if (tilted > poses.size() / 2) {
    result.notes.push_back(counted(tilted,
                                   "pose|poses is|are tilted by more than 45 degrees: check that "
                                   "z is up, and that quaternions are x, y, z, w"));
  }
  if (std::string words = words_of_misfit(poses, result.samples); !words.empty()) {
    result.notes.push_back(std::move(words));
  }
  note_imprecise(result.samples, result.notes);
  result.samples = interpolated(result.samples);
  return result;
}

std::string words_of_far_map(const PoseLog& log, const MapOrigin& origin) {
  constexpr double kMostM = pose::kMaxCoordinateMm / 1000.0;
  const LocalPlane map = origin.plane();
  const double apart_m = log.plane ? map.metres_to(*log.plane) : 0;
  if (apart_m <= kMostM) {
    return {};
  }
  const auto words_of_place = [](const Geodetic& place) {
    return fixed(place.latitude, 4) + ',' + fixed(place.longitude, 4);
  };
  return "the log begins at " + words_of_place(log.plane->touches()) +
         ", and the map's origin is " + words_of_place(map.touches()) + " (latitude, longitude), " +
         fixed(apart_m / 1000, 0) + " km away; at most " + fixed(kMostM / 1000, 0) +
         " km is allowed: check their order";
}

void demand_poses(const ConvertedLog& log, const std::string& path) {
  if (log.samples.size() > 1) {
    return;
  }
  std::string why;
  for (const std::string& remark : log.remarks) {
    why += (why.empty() ? "; not used: " : ", ") + remark;
  }
  throw UsageError(path + (log.samples.empty() ? ": no pose in it" : ": only one pose in it") +
                   why);
}

std::vector<std::string> words_of(const ConvertedLog& log) {
  std::vector<std::string> words;
  for (const std::string& remark : log.remarks) {
    words.push_back("not used: " + remark);
  }
  words.insert(words.end(), log.notes.begin(), log.notes.end());
  const auto add_taken = [&words](std::size_t count, const char* of, double value, const char* unit,
                                  const char* option) {
    if (count > 0) {
      std::ostringstream text;
      text << "the log states no standard deviation of the " << of << " for "
           << counted(count, "pose|poses: ") << value * 1000 << unit
           << " is assumed (--poses-sigma, or `iog pose " << option << "`, sets another)";
      words.push_back(text.str());
    }
  };
  if (log.taken_sigmas == log.poses && log.taken_sigma_headings == log.poses) {
    std::ostringstream text;
    text << "the log states no standard deviations: " << kAssumedM * 1000 << " mm and "
         << kAssumedRad * 1000
         << " mrad are assumed (--poses-sigma, or `iog pose --sigma` and `--heading-sigma`, set "
            "others)";
    words.push_back(text.str());
    return words;
  }
  add_taken(log.taken_sigmas, "position", kAssumedM, " mm", "--sigma");
  add_taken(log.taken_sigma_headings, "heading", kAssumedRad, " mrad", "--heading-sigma");
  return words;
}

}  // namespace iog::tools
