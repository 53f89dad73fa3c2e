#include "tools/clouds/ros_clouds.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <string_view>

#include "lidar/points.hpp"
#include "tools/clouds/point_cloud.hpp"
#include "tools/formats/mcap/reader.hpp"
#include "tools/program/exit_status.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools {
namespace {

class CdrReader {
 public:
  CdrReader(std::span<const std::byte> message, const std::string& what)
      : in_(message), what_(&what) {
    const std::uint32_t encapsulation = in_.u32_be() >> 16;
    if (!in_.ok() || encapsulation != 1) {
      throw UsageError(what + ": the message is not in CDR, little endian");
    }
  }

  [[nodiscard]] std::uint8_t u8() { return in_.u8(); }
  [[nodiscard]] std::uint32_t u32() {
    in_.skip((kAlignment - read_from_ + in_.remaining() % kAlignment) % kAlignment);
    return in_.u32_le();
  }
  [[nodiscard]] double f32() { return static_cast<double>(std::bit_cast<float>(u32())); }
  [[nodiscard]] std::string text() {
    const std::span<const std::byte> letters = in_.bytes(u32());
    const auto* const begin = reinterpret_cast<const char*>(letters.data());
    return letters.empty() ? std::string() : std::string(begin, letters.size() - 1);
  }
  [[nodiscard]] std::span<const std::byte> sequence(std::size_t number_bytes) {
    const std::size_t count = u32();
    return in_.bytes(count * number_bytes);
  }
  [[nodiscard]] std::uint64_t stamp_us() {
    const std::uint64_t seconds = u32();
    return seconds * 1'000'000 + u32() / 1000;
  }
  void must_be_whole() const {
    if (!in_.ok()) {
      throw UsageError(*what_ + ": the message is cut off");
    }
  }

 private:
  static constexpr std::size_t kAlignment = 4;

  wire::ByteReader in_;
  const std::string* what_;
  std::size_t read_from_ = in_.remaining() % kAlignment;
};

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
  const bool is_big_endian = in.u8() != 0;
  const std::size_t stride = in.u32();
  const std::size_t row = in.u32();
  records.bytes = in.sequence(1);
  in.must_be_whole();
  if (is_big_endian) {
    throw UsageError(what + ": its points are big endian, which is not read");
  }
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

void for_each_cloud(const std::string& path, const std::string& topic, TimeUnit unit,
                    const std::function<void(SeenCloud&&)>& take) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw UsageError(path + ": there is no such file");
  }
  mcap::Reader reader(file);
  std::string its = topic;
  std::uint64_t number = 0;
  while (const auto message = reader.next()) {
    const mcap::Channel& channel = reader.channels().at(message->channel_id);
    const auto schema = reader.schemas().find(channel.schema_id);
    const std::string_view type =
        schema == reader.schemas().end() ? std::string_view() : schema->second.name;
    const bool is_cloud = type == "sensor_msgs/msg/PointCloud2";
    if ((!is_cloud && type != "sensor_msgs/msg/LaserScan") ||
        (!topic.empty() && channel.topic != topic)) {
      continue;
    }
    its = its.empty() ? channel.topic : its;
    if (channel.topic != its) {
      throw UsageError(path + ": " + its + " and " + channel.topic +
                       " have clouds: choose one by --topic");
    }
    const std::string what = path + ": message " + std::to_string(number++) + " of " + its;
    if (channel.message_encoding != "cdr") {
      throw UsageError(what + ": its encoding is " + channel.message_encoding + ", not cdr");
    }
    take(is_cloud ? cloud_of_point_cloud2(message->data, unit, what)
                  : cloud_of_laser_scan(message->data, what));
  }
  const std::uint64_t lost = reader.counts().unreadable_chunks + reader.counts().broken_chunks;
  if (lost > 0) {
    throw UsageError(path + ": " + std::to_string(lost) +
                     " chunks are damaged, or compressed by what is not read");
  }
  if (number == 0) {
    throw UsageError(path + ": it has no PointCloud2 and no LaserScan of sensor_msgs" +
                     (topic.empty() ? "" : " on " + topic));
  }
}

}  // namespace iog::tools
