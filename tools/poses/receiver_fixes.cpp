#include "tools/poses/receiver_fixes.hpp"

#include <algorithm>
#include <cmath>

#include "tools/program/middle.hpp"

namespace iog::tools {
namespace {

// Slower than this a course is no heading, and below that a speed is noise.
constexpr double kWalkingMps = 1.0;
constexpr double kStandingMps = 0.2;
// What bounds the turn of a car.
constexpr double kLeastRadiusM = 5;
constexpr double kMostSideways = 8;  // m/s^2
constexpr double kCourseNoiseDeg = 20;
constexpr double kUnwatchedS = 3;  // after so long a car may have any direction
// No car reverses so fast.
constexpr double kForwardsMps = 8;
constexpr double kDrivingMps = 3;
constexpr double kClearlyFaster = 1.5;

double speed_of(const Fix& fix) { return fix.speed_mps.value_or(0); }

double turn_between(double from_deg, double to_deg) {
  return std::abs(std::remainder(to_deg - from_deg, 360));
}

// Fixes whose directions follow from each other: forwards or backwards together.
struct Stretch {
  bool begins_in_motion = false;
  bool is_decided = false;  // by a stated heading
  bool is_reversed = false;
  bool is_assumed = false;
  double fastest[2]{};  // along its direction and against it
};

class Directions {
 public:
  explicit Directions(std::vector<Fix>& fixes) : fixes_(&fixes), stretch_of_(fixes.size(), kNone) {
    for (std::size_t i = 0; i < fixes.size(); ++i) {
      pass_from_the_last(i);
      take(i);
    }
  }

  void decide(PoseLog& log) {
    for (Stretch& stretch : stretches_) {
      decide(stretch);
    }
    Tally open;
    Tally assumed;
    Tally reversing;
    for (std::size_t i = 0; i < fixes_->size(); ++i) {
      Fix& fix = (*fixes_)[i];
      if (stretch_of_[i] == kNone) {
        continue;
      }
      const Stretch& stretch = stretches_[stretch_of_[i]];
      if (!stretch.is_decided) {
        open.add(fix.place);
        fix.heading_deg.reset();
        continue;
      }
      fix.heading_deg = *fix.heading_deg + (stretch.is_reversed ? 180 : 0);
      if (stretch.is_assumed) {
        assumed.add(fix.place);
      }
      if (speed_of(fix) >= kWalkingMps && turn_between(*fix.heading_deg, *fix.course_deg) > 90) {
        reversing.add(fix.place);
      }
    }
    remark(open, "heading|headings: forwards or in reverse from standstill, a course does not say",
           log.unit, log.remarks);
    remark(assumed, "heading|headings by course, assumed to begin forwards", log.unit, log.notes);
    remark(reversing, "pose|poses in reverse, by its|their course", log.unit, log.notes);
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  // How far the car can have turned since its direction was known.
  void pass_from_the_last(std::size_t i) {
    const Fix& fix = (*fixes_)[i];
    const Fix& last = (*fixes_)[i > 0 ? i - 1 : i];
    const double seconds =
        fix.time_us > last.time_us ? static_cast<double>(fix.time_us - last.time_us) / 1e6 : 0;
    const auto turn_rate = [](double speed_mps) {
      return speed_mps < kStandingMps
                 ? 0
                 : std::min(speed_mps / kLeastRadiusM, kMostSideways / speed_mps);
    };
    before_mps_ = last_mps_;
    last_mps_ = fix.speed_mps.value_or(last_mps_);
    turnable_deg_ += std::max(turn_rate(before_mps_), turn_rate(last_mps_)) * seconds / kRadians;
    if (seconds > kUnwatchedS) {
      direction_deg_.reset();
    }
  }

  void take(std::size_t i) {
    Fix& fix = (*fixes_)[i];
    const bool is_moving = speed_of(fix) >= kWalkingMps && fix.course_deg;
    if (fix.heading_deg) {
      take_stated(*fix.heading_deg);
      turnable_deg_ = 0;
    } else if (is_moving) {
      follow_course(i);
    } else if (direction_deg_ && is_by_course_ && fix.speed_mps && *fix.speed_mps < kWalkingMps) {
      fix.heading_deg = direction_deg_;
      fix.heading_doubt_rad = std::min(turnable_deg_, 180.0) * kRadians;
      stretch_of_[i] = is_stated_ ? kNone : stretches_.size() - 1;
    }
  }

  // Decides the direction of the fixes before, if the car cannot have turned about since.
  void take_stated(double heading_deg) {
    if (direction_deg_ && !is_stated_ && turnable_deg_ + kCourseNoiseDeg < 90) {
      stretches_.back().is_decided = true;
      stretches_.back().is_reversed = turn_between(*direction_deg_, heading_deg) > 90;
    }
    direction_deg_ = heading_deg;
    is_stated_ = true;
    is_by_course_ = false;
  }

  void follow_course(std::size_t i) {
    const Fix& fix = (*fixes_)[i];
    const double turn = direction_deg_ ? turn_between(*direction_deg_, *fix.course_deg) : 0;
    const double possible = turnable_deg_ + kCourseNoiseDeg;
    if (!direction_deg_ || std::max(turn, 180 - turn) <= possible) {
      const bool is_after_stop = i > 0 && before_mps_ < kWalkingMps;
      stretches_.push_back({.begins_in_motion = !direction_deg_ && !is_after_stop});
      direction_deg_ = *fix.course_deg;
      is_stated_ = false;
    } else if (std::min(turn, 180 - turn) <= possible) {
      direction_deg_ = *fix.course_deg + (turn > 90 ? 180 : 0);
    } else {
      return;  // an outlier
    }
    (*fixes_)[i].heading_deg = direction_deg_;
    is_by_course_ = true;
    turnable_deg_ = 0;
    if (is_stated_) {
      return;
    }
    stretch_of_[i] = stretches_.size() - 1;
    double& fastest =
        stretches_.back().fastest[turn_between(*direction_deg_, *fix.course_deg) > 90 ? 1 : 0];
    fastest = std::max(fastest, speed_of(fix));
  }

  static void decide(Stretch& stretch) {
    if (stretch.is_decided) {
      return;
    }
    const bool is_backwards_faster = stretch.fastest[1] > stretch.fastest[0];
    const double most = stretch.fastest[is_backwards_faster ? 1 : 0];
    const double other = stretch.fastest[is_backwards_faster ? 0 : 1];
    const bool is_certain = most >= kForwardsMps;
    const bool is_clear = is_certain || (other >= kWalkingMps && most >= kDrivingMps &&
                                         most >= kClearlyFaster * other);
    stretch.is_decided = is_clear || stretch.begins_in_motion;
    stretch.is_assumed = !is_certain;
    stretch.is_reversed = is_clear && is_backwards_faster;
  }

  std::vector<Fix>* fixes_;
  std::vector<std::size_t> stretch_of_;
  std::vector<Stretch> stretches_;
  std::optional<double> direction_deg_;
  bool is_stated_ = false;     // the direction goes on from a stated heading
  bool is_by_course_ = false;  // and was last that of a course
  double turnable_deg_ = 0;
  double before_mps_ = 0;  // the last known speeds, where a fix may be without one
  double last_mps_ = 0;
};

// The first position may be an outlier on the other side of the earth.
LocalPlane plane_of(const std::vector<Fix>& fixes) {
  const auto median = [&fixes](double Geodetic::*angle) {
    std::vector<double> angles;
    angles.reserve(fixes.size());
    for (const Fix& fix : fixes) {
      angles.push_back(fix.at.*angle);
    }
    return middle_value_of(std::move(angles));
  };
  const Geodetic most{median(&Geodetic::latitude), median(&Geodetic::longitude)};
  const auto first = std::ranges::find_if(fixes, [&most](const Fix& fix) {
    return std::abs(fix.at.latitude - most.latitude) <= 1 &&
           turn_between(fix.at.longitude, most.longitude) <= 1;
  });
  const Geodetic& at = first == fixes.end() ? fixes.front().at : first->at;
  return {at.latitude, at.longitude};
}

LoggedPose pose_of(const Fix& fix, const LocalPlane& plane) {
  const LocalPlane::Place place = plane.place_of(fix.at.latitude, fix.at.longitude);
  LoggedPose pose{.time_us = fix.time_us,
                  .x_m = place.east_m,
                  .y_m = place.north_m,
                  .sigma_m = fix.sigma_m,
                  .sigma_heading_rad = fix.sigma_heading_rad,
                  .heading_doubt_rad = fix.heading_doubt_rad,
                  .place = fix.place};
  if (fix.heading_deg) {
    pose.heading_rad = (90 - *fix.heading_deg) * kRadians;
  }
  // Along the heading: a car that reverses has a course of its own.
  if (fix.heading_deg && fix.speed_mps && fix.course_deg) {
    pose.speed_mps = *fix.speed_mps * std::cos((*fix.course_deg - *fix.heading_deg) * kRadians);
  }
  return pose;
}

}  // namespace

PoseLog log_of(std::vector<Fix> fixes, std::string_view unit) {
  PoseLog log;
  log.unit = unit;
  if (fixes.empty()) {
    return log;
  }
  Directions(fixes).decide(log);
  log.plane = plane_of(fixes);
  for (const Fix& fix : fixes) {
    log.poses.push_back(pose_of(fix, *log.plane));
  }
  return log;
}

}  // namespace iog::tools
