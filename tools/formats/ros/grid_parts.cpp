#include "tools/formats/ros/grid_parts.hpp"

namespace iog::tools::ros {
namespace {

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
  out.put(static_cast<float>(place.grid.cell_mm / 1000.0));
  out.put(std::uint32_t{place.grid.columns});
  out.put(std::uint32_t{place.grid.rows});
  put_corner(out, place);
}

void put_foxglove_head(CdrWriter& out, const Place& place, std::span<const Field> fields) {
  const auto bytes_per_cell = static_cast<std::uint32_t>(fields.size());
  put_stamp(out, place.time_us);
  out.put(place.frame_id);
  put_corner(out, place);
  out.put(std::uint32_t{place.grid.columns});
  out.put(place.grid.cell_mm / 1000.0);
  out.put(place.grid.cell_mm / 1000.0);
  out.put(place.grid.columns * bytes_per_cell);
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
