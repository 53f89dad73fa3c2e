#include "tools/clouds/ros_clouds.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tools/clouds/foxglove_clouds.hpp"
#include "tools/clouds/laser_ranges.hpp"
#include "tools/clouds/point_cloud.hpp"
#include "tools/formats/ros/cdr_reader.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/table.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

using ros::CdrReader;

constexpr std::array<std::string_view, 10> kTypes{"nav_msgs/msg/Odometry",
                                                  "tf2_msgs/msg/TFMessage",
                                                  "sensor_msgs/msg/PointCloud2",
                                                  "sensor_msgs/msg/LaserScan",
                                                  "foxglove.PointCloud",
                                                  "foxglove.LaserScan",
                                                  "foxglove_msgs/msg/PointCloud",
                                                  "foxglove_msgs/msg/LaserScan",
                                                  "livox_ros_driver2/msg/CustomMsg",
                                                  "livox_ros_driver/msg/CustomMsg"};
constexpr auto kCloudTypes = std::span(kTypes).subspan<2>();

// sensor_msgs/PointField.
CloudField field_in(CdrReader& in, const std::string& what) {
  const std::string name = in.text();
  const std::size_t at = in.u32();
  const std::size_t type = in.u8();
  static_cast<void>(in.u32());  // how many
  in.must_be_whole();
  CloudField field = field_of_type(name, type, what);
  field.at = at;
  return field;
}

// Rows that have bytes behind their points, without these; empty if they have none, or if the bytes
// are not those of so many rows. Of the last row the gap may be missing.
std::vector<std::byte> without_gaps(std::span<const std::byte> bytes, std::size_t rows,
                                    std::size_t row, std::size_t used) {
  std::vector<std::byte> packed;
  if (rows < 2 || row <= used || bytes.size() > rows * row ||
      bytes.size() < (rows - 1) * row + used) {
    return packed;
  }
  packed.reserve(rows * used);
  for (std::size_t i = 0; i < rows; ++i) {
    const auto its = bytes.subspan(i * row, used);
    packed.insert(packed.end(), its.begin(), its.end());
  }
  return packed;
}

}  // namespace

SeenCloud cloud_of_point_cloud2(std::span<const std::byte> message, TimeUnit& unit,
                                const std::string& what) {
  CdrReader in(message, what);
  CloudRecords records{.stamp_us = in.stamp_us()};
  static_cast<void>(in.text());  // the frame's name
  const std::uint64_t height = in.u32();
  const std::uint64_t width = in.u32();
  const std::size_t fields = in.u32();
  for (std::size_t i = 0; i < fields; ++i) {
    add_field(records, field_in(in, what), what);
  }
  records.is_big_endian = in.u8() != 0;
  const std::size_t stride = in.u32();
  const std::size_t row = in.u32();
  records.bytes = in.sequence(1);
  in.must_be_whole();
  records.count = height * width;
  check_count(records, what);
  const std::vector<std::byte> packed = without_gaps(records.bytes, height, row, width * stride);
  records.bytes = packed.empty() ? records.bytes : packed;
  set_stride(records, stride, what);
  return cloud_of(records, unit, what);
}

SeenCloud cloud_of_laser_scan(std::span<const std::byte> message, const std::string& what) {
  CdrReader in(message, what);
  LaserRanges scan{.stamp_us = in.stamp_us()};
  static_cast<void>(in.text());
  scan.first_rad = in.f32();
  scan.last_rad = in.f32();
  scan.step_rad = in.f32();
  scan.apart_s = in.f32();
  static_cast<void>(in.f32());  // from scan to scan
  scan.least_m = in.f32();
  scan.most_m = in.f32();
  for (auto rest = in.sequence(4); !rest.empty() && scan.ranges_m.size() <= kMostCloudPoints;
       rest = rest.subspan(4)) {
    const auto range = std::bit_cast<float>(wire::load_le32(rest.first<4>()));
    scan.ranges_m.push_back(static_cast<double>(range));
  }
  in.must_be_whole();
  return cloud_of_ranges(scan, what);
}

// offset_time (ns, behind timebase), x, y, z, reflectivity, tag and line of each point, which
// begins on a multiple of four.
SeenCloud cloud_of_livox(std::span<const std::byte> message, const std::string& what) {
  using Kind = CloudField::Kind;
  constexpr std::size_t kStride = 20;
  CdrReader in(message, what);
  CloudRecords records{.stamp_us = in.stamp_us()};
  static_cast<void>(in.text());
  static_cast<void>(in.f64());  // timebase: the stamp
  records.count = in.u32();
  static_cast<void>(in.u32());  // number of the unit, and three that mean nothing
  if (const std::size_t points = in.u32(); points != records.count) {
    throw UsageError(what + ": it has " + std::to_string(points) + " points and counts " +
                     std::to_string(records.count));
  }
  in.must_be_whole();
  records.bytes = in.rest();
  // The last point may lack the byte that aligns the next, and the message may be filled up to 4.
  const std::size_t whole = records.count * kStride;
  if (records.bytes.size() + 1 < whole || records.bytes.size() > whole + 3) {
    throw UsageError(what + ": its " +
                     counted(records.count, "point|points of " + std::to_string(kStride) +
                                                " bytes does|do not fill its ") +
                     std::to_string(records.bytes.size()) + " bytes");
  }
  records.fields = {{.name = "offset_time", .kind = Kind::kUnsigned, .at = 0, .stride = kStride},
                    {.name = "x", .at = 4, .stride = kStride},
                    {.name = "y", .at = 8, .stride = kStride},
                    {.name = "z", .at = 12, .stride = kStride}};
  TimeUnit unit = TimeUnit::kNanoseconds;
  return cloud_of(records, unit, what);
}

// All that are in CDR begin alike.
std::string frame_of(const ros::RecordedMessage& message) {
  return frame_of_foxglove(message.data, !message.type.starts_with("foxglove."), message.where);
}

SeenCloud cloud_of_message(const ros::RecordedMessage& message, TimeUnit& unit) {
  const bool is_scan = message.type.ends_with("LaserScan");
  if (message.type.starts_with("foxglove")) {
    const bool is_cdr = message.type.starts_with("foxglove_msgs");
    return is_scan ? scan_of_foxglove(message.data, is_cdr, message.where)
                   : cloud_of_foxglove(message.data, is_cdr, unit, message.where);
  }
  if (message.type.starts_with("livox")) {
    return cloud_of_livox(message.data, message.where);
  }
  return is_scan ? cloud_of_laser_scan(message.data, message.where)
                 : cloud_of_point_cloud2(message.data, unit, message.where);
}

bool is_cloud_type(std::string_view type) {
  return std::ranges::find(kCloudTypes, type) != kCloudTypes.end();
}

std::vector<std::string> for_each_cloud_or_frame(
    const std::string& path, const std::function<void(const ros::RecordedMessage&)>& take) {
  return ros::for_each_message(path, kTypes, "", take);
}

std::vector<std::string> for_each_cloud(const std::string& path, const std::string& topic,
                                        TimeUnit& unit,
                                        const std::function<void(SeenCloud&&)>& take) {
  std::string its = topic;
  std::uint64_t number = 0;
  const auto take_message = [&](const ros::RecordedMessage& message) {
    its = its.empty() ? message.topic : its;
    if (message.topic != its) {
      throw UsageError(path + ": " + printable(its) + " and " +
                       printable(std::string(message.topic)) +
                       " have clouds: choose one by --topic");
    }
    ++number;
    SeenCloud cloud = cloud_of_message(message, unit);
    cloud.frame = frame_of(message);
    take(std::move(cloud));
  };
  std::vector<std::string> remarks = ros::for_each_message(path, kCloudTypes, topic, take_message);
  if (number == 0) {
    throw UsageError(
        path + ": it has no clouds and no scans of sensor_msgs, foxglove or livox_ros_driver" +
        (topic.empty() ? "" : " on " + topic) +
        (remarks.empty() ? "" : "; " + joined(remarks, "; ")));
  }
  return remarks;
}

}  // namespace iog::tools
