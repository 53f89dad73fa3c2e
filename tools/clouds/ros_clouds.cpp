#include "tools/clouds/ros_clouds.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "lidar/points.hpp"
#include "tools/clouds/point_cloud.hpp"
#include "tools/formats/ros/cdr_reader.hpp"
#include "tools/formats/ros/recorded_messages.hpp"
#include "tools/program/exit_status.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

using ros::CdrReader;

constexpr std::string_view kPointCloud2 = "sensor_msgs/msg/PointCloud2";

// sensor_msgs/PointField: 1 ... 8.
CloudField field_of(CdrReader& in, std::size_t stride, const std::string& what) {
  using Kind = CloudField::Kind;
  struct Type {
    Kind kind;
    std::size_t bytes;
  };
  constexpr Type kTypes[]{{Kind::kSigned, 1},   {Kind::kUnsigned, 1}, {Kind::kSigned, 2},
                          {Kind::kUnsigned, 2}, {Kind::kSigned, 4},   {Kind::kUnsigned, 4},
                          {Kind::kFloat, 4},    {Kind::kFloat, 8}};
  CloudField field{.name = in.text(), .stride = stride};
  field.at = in.u32();
  const std::size_t type = in.u8();
  static_cast<void>(in.u32());  // how many
  in.must_be_whole();
  if (type == 0 || type > std::size(kTypes)) {
    throw UsageError(what + ": field " + field.name + " has an unknown type, " +
                     std::to_string(type));
  }
  field.kind = kTypes[type - 1].kind;
  field.bytes = kTypes[type - 1].bytes;
  return field;
}

}  // namespace

SeenCloud cloud_of_point_cloud2(std::span<const std::byte> message, TimeUnit unit,
                                const std::string& what) {
  CdrReader in(message, what);
  CloudRecords records{.stamp_us = in.stamp_us()};
  static_cast<void>(in.text());  // the frame's name
  const std::uint64_t height = in.u32();
  const std::uint64_t width = in.u32();
  const std::size_t fields = in.u32();
  for (std::size_t i = 0; i < fields; ++i) {
    records.fields.push_back(field_of(in, 0, what));
  }
  records.is_big_endian = in.u8() != 0;
  const std::size_t stride = in.u32();
  const std::size_t row = in.u32();
  records.bytes = in.sequence(1);
  in.must_be_whole();
  if (height > 1 && row != width * stride) {
    throw UsageError(what + ": its rows have gaps between them, which is not read");
  }
  records.count = height * width;
  for (CloudField& field : records.fields) {
    field.stride = stride;
  }
  return cloud_of(records, unit, what);
}

SeenCloud cloud_of_laser_scan(std::span<const std::byte> message, const std::string& what) {
  CdrReader in(message, what);
  SeenCloud cloud{.time_us = in.stamp_us()};
  static_cast<void>(in.text());
  const double first = in.f32();
  static_cast<void>(in.f32());  // the last angle follows
  const double step = in.f32();
  const double apart_s = in.f32();
  static_cast<void>(in.f32());  // from scan to scan
  const double least_m = in.f32();
  const double most_m = in.f32();
  const auto ranges = in.sequence(4);
  in.must_be_whole();
  const std::size_t count = ranges.size() / 4;
  if (count > kMostCloudPoints || !std::isfinite(first) || !std::isfinite(step)) {
    throw UsageError(what + ": its angles are no numbers, or it has too many ranges");
  }
  cloud.has_times = apart_s > 0 && apart_s * static_cast<double>(count) <= 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double range_m = static_cast<double>(
        std::bit_cast<float>(wire::load_le32(ranges.subspan(i * 4).first<4>())));
    if (std::isnan(range_m)) {
      ++cloud.not_finite;
      continue;
    }
    if (range_m < least_m || range_m <= 0) {
      ++cloud.nowhere;
      continue;
    }
    const double angle = first + static_cast<double>(i) * step;
    WirePoint& point = cloud.points.emplace_back();
    point.first = azimuth_parts(std::remainder(angle * 180 / std::numbers::pi, 360));
    const bool is_seen = range_m <= most_m && range_m * 1000 < lidar::kMaxRangeMm;
    point.third = is_seen ? static_cast<std::int32_t>(std::lround(range_m * 1000)) : 0;
    point.flags = is_seen ? std::uint8_t{0} : lidar::PointsPacket::kNothing;
    if (cloud.has_times) {
      point.after_us =
          static_cast<std::uint32_t>(std::lround(static_cast<double>(i) * apart_s * 1e6));
    }
  }
  return cloud;
}

std::vector<std::string> for_each_cloud(const std::string& path, const std::string& topic,
                                        TimeUnit unit,
                                        const std::function<void(SeenCloud&&)>& take) {
  std::string its = topic;
  std::uint64_t number = 0;
  const auto take_message = [&](const ros::RecordedMessage& message) {
    its = its.empty() ? message.topic : its;
    if (message.topic != its) {
      throw UsageError(path + ": " + its + " and " + std::string(message.topic) +
                       " have clouds: choose one by --topic");
    }
    ++number;
    take(message.type == kPointCloud2 ? cloud_of_point_cloud2(message.data, unit, message.where)
                                      : cloud_of_laser_scan(message.data, message.where));
  };
  std::vector<std::string> remarks =
      ros::for_each_message(path, {kPointCloud2, "sensor_msgs/msg/LaserScan"}, topic, take_message);
  if (number == 0) {
    throw UsageError(path + ": it has no PointCloud2 and no LaserScan of sensor_msgs" +
                     (topic.empty() ? "" : " on " + topic));
  }
  return remarks;
}

}  // namespace iog::tools
