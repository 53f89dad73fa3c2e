#include "tools/formats/ros/point_messages.hpp"

#include <array>
#include <bit>
#include <string_view>

#include "tools/formats/ros/grid_messages.hpp"
#include "tools/formats/ros/grid_parts.hpp"

namespace iog::tools::ros {
namespace {

// Numbers of sensor_msgs/PointField.
enum class PointFieldType : std::uint8_t { kUint8 = 2, kFloat32 = 7 };
struct PointField {
  std::string_view name;
  std::uint32_t offset;
  PointFieldType type;
};

constexpr std::array kPointFields{
    PointField{"x", 0, PointFieldType::kFloat32}, PointField{"y", 4, PointFieldType::kFloat32},
    PointField{"z", 8, PointFieldType::kFloat32}, PointField{"fate", 12, PointFieldType::kUint8}};
constexpr std::size_t kPointBytes = 16;

std::vector<std::byte> bytes_of(std::span<const SeenPoint> points) {
  std::vector<std::byte> bytes(points.size() * kPointBytes);
  std::span<std::byte> rest(bytes);
  for (const SeenPoint& point : points) {
    std::size_t at = 0;
    for (const std::int16_t value_cm : {point.x_cm, point.y_cm, point.z_cm}) {
      const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value_cm) / 100);
      for (std::size_t i = 0; i < sizeof bits; ++i) {
        rest[at++] = static_cast<std::byte>(bits >> 8 * i & 0xFF);
      }
    }
    rest[at] = static_cast<std::byte>(point.fate);
    rest = rest.subspan(kPointBytes);
  }
  return bytes;
}

}  // namespace

std::vector<std::byte> point_cloud(std::span<const SeenPoint> points, std::uint64_t stamp_us) {
  const auto count = static_cast<std::uint32_t>(points.size());
  CdrWriter out;
  put_stamp(out, stamp_us);
  out.put(kFrameId);
  out.put(std::uint32_t{1});  // height
  out.put(count);             // width
  out.put(static_cast<std::uint32_t>(kPointFields.size()));
  for (const PointField& field : kPointFields) {
    out.put(field.name);
    out.put(field.offset);
    out.put(static_cast<std::uint8_t>(field.type));
    out.put(std::uint32_t{1});  // of them
  }
  out.put(std::uint8_t{0});  // is_bigendian
  out.put(std::uint32_t{kPointBytes});
  out.put(static_cast<std::uint32_t>(count * kPointBytes));  // bytes of the row
  out.put(bytes_of(points));
  out.put(std::uint8_t{1});  // is_dense: none is invalid
  return out.take();
}

}  // namespace iog::tools::ros
