#include "tools/info/cloud_census.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <vector>

#include "lidar/points.hpp"
#include "tools/clouds/cloud_frames.hpp"
#include "tools/clouds/ros_clouds.hpp"
#include "tools/formats/ros/cdr_reader.hpp"
#include "tools/info/static_frames.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kLookedInto = 10;  // messages of a topic; of the others the head is read
constexpr double kPartsPerDegree = lidar::PointsPacket::kPartsPerTurn / 360.0;
constexpr double kTicksPerDegree = 32;  // of scan_width_ticks
constexpr std::size_t kMostRings = 128;
constexpr std::size_t kMostListed = 8;  // that are listed

struct LaserAngles {
  double first_deg = 0;
  double last_deg = 0;
  double most_m = 0;
};

struct CloudTopic {
  std::vector<std::string> frames{};  // some of them, if there are many
  bool is_scan = false;
  bool has_times = true;  // in each message
  double apart_us = 0;    // SeenCloud's, of the first one that has it
  std::uint64_t messages = 0;
  std::uint64_t most_points = 0;
  std::uint64_t first_us = UINT64_MAX;
  std::uint64_t last_us = 0;
  std::optional<LaserAngles> angles{};
  std::vector<std::int32_t> elevations{};  // of messages that were looked into, in parts
  std::vector<std::int32_t> azimuths{};
  TimeUnit unit = TimeUnit::kFound;  // of the points' times

  void add(const ros::RecordedMessage& message);
  void look_into(const SeenCloud& cloud);
  // 0: not known.
  [[nodiscard]] double period_us() const {
    return messages < 2 || last_us <= first_us
               ? 0
               : static_cast<double>(last_us - first_us) / static_cast<double>(messages - 1);
  }
};

void CloudTopic::look_into(const SeenCloud& cloud) {
  has_times = has_times && cloud.has_times;
  apart_us = apart_us == 0 && cloud.time_us != 0 ? cloud.apart_us : apart_us;
  most_points =
      std::max(most_points, cloud.points.size() + cloud.not_finite + cloud.nowhere + cloud.untimed);
  first_us = std::min(first_us, cloud.time_us);
  last_us = std::max(last_us, cloud.time_us);
  for (std::size_t i = 0; messages < kLookedInto && i < cloud.points.size(); ++i) {
    elevations.push_back(cloud.points[i].second);
    azimuths.push_back(cloud.points[i].first);
  }
}

void CloudTopic::add(const ros::RecordedMessage& message) {
  is_scan = message.type.ends_with("LaserScan");
  const bool is_first = messages < kLookedInto;
  if (is_first || !message.type.starts_with("sensor_msgs")) {
    look_into(cloud_of_message(message, unit));
  }
  ++messages;
  const std::string frame = frame_of(message);
  if (frames.size() < kMostListed && !frame.empty() &&
      std::ranges::find(frames, frame) == frames.end()) {
    frames.push_back(frame);
  }
  if (message.type.starts_with("foxglove")) {
    return;
  }
  ros::CdrReader in(message.data, message.where);
  const std::uint64_t stamp_us = in.stamp_us();
  static_cast<void>(in.text());
  if (is_scan) {
    const auto degrees = [&] { return in.f32() * 180 / std::numbers::pi; };
    LaserAngles its{.first_deg = degrees()};
    its.last_deg = degrees();
    for (int left = 4; left > 0; --left) {  // step, two times, shortest range
      static_cast<void>(in.f32());
    }
    its.most_m = in.f32();
    most_points = std::max<std::uint64_t>(most_points, in.sequence(4).size() / 4);
    angles = is_first ? its : angles;
  } else if (message.type.ends_with("PointCloud2")) {
    const std::uint64_t height = in.u32();
    most_points = std::max(most_points, height * in.u32());
  }
  in.must_be_whole();
  first_us = std::min(first_us, stamp_us);
  last_us = std::max(last_us, stamp_us);
}

// Elevations that lie in groups with gaps between them are those of rings. Empty: they do not.
std::vector<double> rings_of(std::vector<std::int32_t> elevations) {
  constexpr auto kGap = static_cast<std::int32_t>(0.05 * kPartsPerDegree);
  constexpr auto kWidest = static_cast<std::int32_t>(0.2 * kPartsPerDegree);
  std::ranges::sort(elevations);
  std::vector<double> rings;
  for (std::size_t begin = 0; begin < elevations.size();) {
    std::size_t end = begin + 1;
    while (end < elevations.size() && elevations[end] - elevations[end - 1] <= kGap) {
      ++end;
    }
    if (elevations[end - 1] - elevations[begin] > kWidest || rings.size() == kMostRings) {
      return {};
    }
    rings.push_back(elevations[begin + (end - begin) / 2] / kPartsPerDegree);
    begin = end;
  }
  return rings;
}

// The turn without the widest gap between two directions.
double field_of_view_deg(std::vector<std::int32_t> azimuths) {
  std::ranges::sort(azimuths);
  std::int32_t widest = azimuths.empty() ? 0 : azimuths.front() - azimuths.back();
  widest += azimuths.empty() ? 0 : static_cast<std::int32_t>(lidar::PointsPacket::kPartsPerTurn);
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    widest = std::max(widest, azimuths[i] - azimuths[i - 1]);
  }
  return 360 - widest / kPartsPerDegree;
}

// Of x as much to the left as to the right, so that all directions are in it: a point outside of it
// is not sent. Upwards, but not for the noise of a float32.
std::int64_t scan_width_ticks(const CloudTopic& topic) {
  double half_deg = 0;
  if (topic.angles) {
    half_deg = std::max(std::abs(topic.angles->first_deg), std::abs(topic.angles->last_deg));
  } else {
    for (const std::int32_t azimuth : topic.azimuths) {
      half_deg = std::max(half_deg, std::abs(std::remainder(azimuth / kPartsPerDegree, 360)));
    }
  }
  return std::llround(std::ceil(std::min(2 * half_deg, 360.0) * kTicksPerDegree - 0.01));
}

bool are_evenly_apart(const std::vector<double>& rings) {
  const double apart_deg =
      (rings.back() - rings.front()) / std::max(1.0, static_cast<double>(rings.size()) - 1);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double even_deg = rings.front() + static_cast<double>(i) * apart_deg;
    if (std::abs(rings[i] - even_deg) > apart_deg / 10) {
      return false;
    }
  }
  return true;
}

// The line `layers` or `lasers`; without rings a spacing of 0.4 degrees (docs/sensors.md).
std::string layers_of(const std::vector<double>& rings, double low_deg, double high_deg) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2);
  if (!rings.empty() && !are_evenly_apart(rings)) {
    text << "    lasers = [";
    for (const double ring : rings) {
      text << (ring == rings.front() ? "" : ",") << " { elevation_deg = " << ring << " }";
    }
    return text.str() + " ]\n";
  }
  const double steps = std::clamp(std::ceil((high_deg - low_deg) / 0.4), 0.0, kMostRings - 1.0);
  text << "    layers = { from_deg = " << low_deg << ", to_deg = " << high_deg
       << ", count = " << (rings.empty() ? static_cast<std::size_t>(steps) + 1 : rings.size())
       << " }\n";
  return text.str();
}

// Lines of the car and, below them, of [[sensors]], to be pasted as they are.
std::string draft_of(const CloudTopic& topic, const std::vector<double>& rings, double low_deg,
                     double high_deg) {
  const bool is_turning = !topic.is_scan && field_of_view_deg(topic.azimuths) > kWholeTurnDeg;
  std::string of_car;
  if (!is_turning && topic.period_us() > 0) {
    of_car += "    frame_period_us = " +
              std::to_string(std::llround(
                  std::max(std::round(topic.period_us() * 1.5 / 1000) * 1000, kShortestPeriodUs))) +
              "  # 1.5 times the time from scan to scan\n";
  }
  if (topic.is_scan) {
    of_car +=
        "    z_min_m = 0.05  # obstacles and the scanner are between these heights\n"
        "    z_max_m = 0.60\n";
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(2);
  text << (of_car.empty() ? of_car : "    # of the car, above its [[sensors]]:\n" + of_car);
  text << "    [[sensors]]\n    type = \"" << (is_turning ? "points_turning" : "points") << "\"\n";
  text << layers_of(rings, low_deg, high_deg);
  if (!is_turning) {
    text << "    scan_width_ticks = " << scan_width_ticks(topic) << '\n';
  }
  if (topic.angles && topic.angles->most_m * 1000 < lidar::kMaxRangeMm) {
    text << "    range_max_mm = " << std::llround(topic.angles->most_m * 1000) << '\n';
  }
  text << "    max_points_per_scan = " << topic.most_points << '\n';
  return text.str();
}

struct Census {
  std::map<std::string, CloudTopic> topics{};
  StaticFrames frames{};
  FrameNames of_odometry{};
};

std::string words_of_frames(const std::vector<std::string>& frames, const FrameNames& of_odometry) {
  if (frames.size() < 2) {
    const std::string wrong =
        frames.empty() ? "" : words_of_wrong_frame(frames.front(), of_odometry);
    return (frames.empty() ? "" : row("frame", printable(frames.front()))) +
           row_if(!wrong.empty(), "FRAME?", "the clouds are " + wrong);
  }
  return row("frames",
             printable(joined(frames, ", ")) +
                 ": all clouds of a sensor are in one frame; record each lidar on its own topic");
}

std::string words_of(const std::string& name, const CloudTopic& topic, const Census& census) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2);
  text << row("clouds on", printable(name)) << words_of_frames(topic.frames, census.of_odometry);
  const std::string of_period = words_of_short_period(topic.period_us());
  text << row("points", "at most " + std::to_string(topic.most_points) + " in a message, " +
                            (topic.has_times ? "with times" : "without times"))
       << row_if(topic.apart_us > 0, "TIMES?", words_of_other_clock(topic.apart_us))
       << row_if(!of_period.empty(), "PERIOD?", of_period);
  if (topic.elevations.empty()) {
    return text.str() + "no point in its first messages\n";
  }
  std::vector<double> rings = rings_of(topic.elevations);
  const auto [low, high] = std::ranges::minmax(topic.elevations);
  const double low_deg = rings.empty() ? low / kPartsPerDegree : rings.front();
  const double high_deg = rings.empty() ? high / kPartsPerDegree : rings.back();
  std::ostringstream view;
  view << std::fixed << std::setprecision(4);
  if (topic.angles) {
    view << topic.angles->first_deg / 180 * std::numbers::pi << " to "
         << topic.angles->last_deg / 180 * std::numbers::pi << " rad, range_max "
         << std::setprecision(1) << topic.angles->most_m << " m";
    const double width_deg = topic.angles->last_deg - topic.angles->first_deg;
    if (width_deg < kWholeTurnDeg &&
        std::abs(topic.angles->first_deg + topic.angles->last_deg) > 1) {
      view << "; iogrid expects as much to the left of x as to the right";
    }
    text << row("angles", view.str());
  } else {
    view << std::setprecision(2) << low_deg << " to " << high_deg << " degrees, "
         << (rings.empty() ? "no rings" : std::to_string(rings.size()) + " rings");
    text << row("elevations", view.str());
  }
  return text.str() + "  for a car file (docs/first_ros_bag.md):\n" +
         draft_of(topic, rings, low_deg, high_deg) +
         (topic.frames.size() == 1 ? census.frames.mount_of(topic.frames.front()) : "");
}

// Returns why reading ended, or nothing at the end of the recording.
std::string add_messages(const std::string& path, Census& census) {
  try {
    static_cast<void>(for_each_cloud_or_frame(path, [&](const ros::RecordedMessage& message) {
      if (message.topic.ends_with("/tf_static") || message.topic.ends_with("/tf")) {
        census.frames.add(message);
      } else if (message.type == kOdometryType) {
        census.of_odometry.insert(frame_of_odometry(message));
      } else if (is_cloud_type(message.type)) {
        census.topics[std::string(message.topic)].add(message);
      }
    }));
  } catch (const UsageError& error) {
    return row("clouds", "not read on: " + std::string(error.what()));
  }
  return {};
}

}  // namespace

std::string describe_clouds(const std::string& path) {
  Census census;
  std::string text = add_messages(path, census);
  for (const auto& [name, topic] : census.topics) {
    text += topic.most_points > 0 ? words_of(name, topic, census) : "";
  }
  return text;
}

}  // namespace iog::tools
