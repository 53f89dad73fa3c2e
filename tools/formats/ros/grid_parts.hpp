// What the messages of grids and poses are made of, serialised.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "geometry/grid.hpp"
#include "tools/formats/ros/cdr_writer.hpp"

namespace iog::tools::ros {

// When, in which frame, and where a grid's corner of lowest x and y is in it. Grids are not turned.
struct Place {
  std::uint64_t time_us = 0;  // by the target's clock, which counts from its start
  std::string_view frame_id;
  double x_m = 0;
  double y_m = 0;
  geometry::Grid grid{};  // its cells
};

// builtin_interfaces/Time.
void put_stamp(CdrWriter& out, std::uint64_t time_us);

// Writes a nav_msgs/OccupancyGrid except for its cells.
void put_occupancy_head(CdrWriter& out, const Place& place);

// Numbers of foxglove_msgs/PackedElementField.
enum class FieldType : std::uint8_t { kUint8 = 1, kInt8 = 2 };
struct Field {
  std::string_view name;
  FieldType type;
};

// Writes a foxglove_msgs/Grid except for its cells. Each field of a cell is one byte.
void put_foxglove_head(CdrWriter& out, const Place& place, std::span<const Field> fields);

}  // namespace iog::tools::ros
