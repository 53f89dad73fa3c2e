#include "tools/odometry/drive_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <sstream>

#include "tools/formats/capture/capture_set.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/progress.hpp"
#include "tools/program/table.hpp"
#include "tools/vehicles/named_senders.hpp"

namespace iog::tools {
namespace {

constexpr double kMovesMps = 1;
constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::int64_t kEveryUs = 20'000;
constexpr double kDegrees = 180 / std::numbers::pi;

// Measured against the poses of two recorded and four simulated drives. The root mean square of
// the errors of single seconds was 3 to 47 mm and 0.1 to 1.5 mrad.
constexpr double kSigmaM = 0.02;
constexpr double kSigmaPerMetre = 0.004;
constexpr double kSigmaRad = 0.001;
constexpr double kSigmaRadPerMetre = 0.00008;
// A target does not register scans with such a pose (pose/limits.hpp).
constexpr MotionSigma kUnsure{.position_m = 1, .heading_rad = 0.1};

double seconds_of(const TurnPose& turn) { return static_cast<double>(turn.time_us) / 1e6; }

void add_row(std::ostream& out, double time_s, const Pose& pose, const TurnMotion& motion,
             const MotionSigma& sigma) {
  out << std::setprecision(6) << time_s << std::setprecision(4) << ',' << pose.translation().x()
      << ',' << pose.translation().y() << ',' << heading_rad(pose) * kDegrees << ','
      << motion.forward_m / motion.seconds << ',' << motion.turn_rad / motion.seconds * kDegrees
      << ',' << sigma.position_m << ',' << sigma.heading_rad * kDegrees << '\n';
}

}  // namespace

std::vector<TurnPose> motion_in(const std::vector<std::string>& captures, const CatalogueEntry& car,
                                std::optional<double> most_s) {
  TurnPoints points(car);
  NamedSenders senders(car);
  Odometry odometry;
  CaptureSet files(captures);
  Progress progress("packets");
  std::vector<TurnPose> turns;
  double moved_s = 0;
  while (!most_s || moved_s < *most_s) {
    const std::optional<CapturedDatagram> datagram = files.next();
    if (!datagram) {
      break;
    }
    progress.show(files.datagrams(), files.part_read());
    const bool is_strange = senders.is_stranger(datagram->source.ipv4, datagram->destination.port);
    std::optional<Turn> turn = is_strange ? std::nullopt : points.take(*datagram);
    if (!turn || (!turns.empty() && turn->end_us <= turns.back().time_us)) {
      continue;
    }
    turns.push_back(odometry.add(*std::move(turn)));
    if (turns.size() > 1) {
      const TurnMotion motion = motion_between(*(turns.end() - 2), turns.back());
      moved_s += std::abs(motion.forward_m) > kMovesMps * motion.seconds ? motion.seconds : 0;
    }
  }
  for (const CaptureSet::File& file : files.files()) {
    if (!most_s) {  // else the same captures are read once more
      warn_of(file.path, *file.reader);
    }
  }
  for (const std::string& words : {points.words_of_pace(), senders.words()}) {
    if (!most_s && !words.empty()) {
      std::cerr << "iog: " << joined(captures, ", ") << ": " << words << '\n';
    }
  }
  if (turns.size() < 2) {
    throw UsageError(joined(captures, ", ") + ": " +
                     counted(turns.size(), "whole turn|turns of a spinning lidar of ") +
                     std::string(car.vehicle->name) + ", and a motion needs two");
  }
  return turns;
}

double heading_rad(const Pose& pose) { return std::atan2(pose(1, 0), pose(0, 0)); }

TurnMotion motion_between(const TurnPose& from, const TurnPose& to) {
  const Pose motion = from.pose.inverse() * to.pose;
  return {.seconds = static_cast<double>(to.time_us - from.time_us) / 1e6,
          .forward_m = motion.translation().x(),
          .turn_rad =
              std::remainder(heading_rad(to.pose) - heading_rad(from.pose), 2 * std::numbers::pi)};
}

MotionSigma sigma_at(std::span<const TurnPose> turns, std::size_t which) {
  double way_m = 0;
  std::size_t at = which;
  for (; at > 0 && turns[which].time_us - turns[at - 1].time_us < std::uint64_t{kSecondUs}; --at) {
    if (!turns[at].is_sure) {
      return kUnsure;
    }
    way_m += (turns[at].pose.translation() - turns[at - 1].pose.translation()).norm();
  }
  return turns[at].is_sure
             ? MotionSigma{.position_m = std::hypot(kSigmaM, kSigmaPerMetre * way_m),
                           .heading_rad = std::hypot(kSigmaRad, kSigmaRadPerMetre * way_m)}
             : kUnsure;
}

std::string csv_of(std::span<const TurnPose> turns) {
  std::ostringstream out;
  out << std::fixed
      << "time_s,x_m,y_m,heading_deg,speed_m_s,yaw_rate_deg_s,sigma_m,sigma_heading_deg\n";
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const TurnPose& from = turns[i - 1];
    const TurnMotion motion = motion_between(from, turns[i]);
    const Pose whole = from.pose.inverse() * turns[i].pose;
    const auto took_us = static_cast<std::int64_t>(turns[i].time_us - from.time_us);
    const std::int64_t rows = took_us < kSecondUs ? (took_us + kEveryUs - 1) / kEveryUs : 1;
    // During the first turn, the car moved as during the second one.
    for (std::int64_t row = i == 1 ? -rows : 1; row <= rows; ++row) {
      const double part = static_cast<double>(row) / static_cast<double>(rows);
      add_row(out, seconds_of(from) + motion.seconds * part, from.pose * part_of(whole, part),
              motion, sigma_at(turns, i));
    }
  }
  return out.str();
}

std::string words_of(std::span<const TurnPose> turns) {
  double way_m = 0;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    way_m += std::abs(motion_between(turns[i - 1], turns[i]).forward_m);
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << turns.size() << " turns in "
       << seconds_of(turns.back()) - seconds_of(turns.front()) << " s, " << way_m << " m";
  const auto unsure = std::ranges::count(turns, false, &TurnPose::is_sure);
  if (unsure > 0) {
    const auto first = std::ranges::find(turns, false, &TurnPose::is_sure);
    text << "; in " << counted(static_cast<std::uint64_t>(unsure), "turn|turns, the first after ")
         << seconds_of(*first) - seconds_of(turns.front())
         << " s, the surroundings do not determine the motion (an empty plain, a tunnel, a small "
            "room, a gap in the capture): sigma is "
         << kUnsure.position_m << " m there, and targets do not use these poses";
  }
  return text.str();
}

}  // namespace iog::tools
