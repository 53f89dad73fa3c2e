#include "tools/formats/ros/grid_parts.hpp"

#include "geometry/grid.hpp"

namespace iog::tools::ros {
namespace {

constexpr double kCellM = geometry::kCellMm / 1000.0;
constexpr auto kAcross = static_cast<std::uint32_t>(geometry::kCellsPerSide);
static_assert(std::size_t{kAcross} * kAcross == geometry::kCellCount &&
              kAcross == geometry::kCellsPerSide);

// geometry_msgs/Pose.
void put_corner(CdrWriter& out, const Place& place) {
  for (const double value : {place.x_m, place.y_m, 0.0, 0.0, 0.0, 0.0, 1.0}) {
    out.put(value);
  }
}

}  // namespace

void put_stamp(CdrWriter& out, std::uint64_t time_us) {
  out.put(static_cast<std::int32_t>(time_us / 1'000'000));
  out.put(static_cast<std::uint32_t>(time_us % 1'000'000 * 1000));
}

void put_occupancy_head(CdrWriter& out, const Place& place) {
  put_stamp(out, place.time_us);
  out.put(place.frame_id);
  put_stamp(out, place.time_us);
  out.put(static_cast<float>(kCellM));
  out.put(kAcross);
  out.put(kAcross);
  put_corner(out, place);
}

void put_foxglove_head(CdrWriter& out, const Place& place, std::span<const Field> fields) {
  const auto bytes_per_cell = static_cast<std::uint32_t>(fields.size());
  put_stamp(out, place.time_us);
  out.put(place.frame_id);
  put_corner(out, place);
  out.put(kAcross);
  out.put(kCellM);
  out.put(kCellM);
  out.put(kAcross * bytes_per_cell);
  out.put(bytes_per_cell);
  out.put(bytes_per_cell);  // fields
  std::uint32_t offset = 0;
  for (const Field& field : fields) {
    out.put(field.name);
    out.put(offset++);
    out.put(static_cast<std::uint8_t>(field.type));
  }
}

}  // namespace iog::tools::ros
