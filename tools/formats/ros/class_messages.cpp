#include "tools/formats/ros/class_messages.hpp"

#include <algorithm>
#include <array>

#include "numeric/elementary.hpp"
#include "tools/formats/ros/grid_parts.hpp"

namespace iog::tools::ros {
namespace {

constexpr std::array kClassFields{Field{"class", FieldType::kUint8},
                                  Field{"sureness", FieldType::kUint8},
                                  Field{"age_frames", FieldType::kUint8}};
constexpr std::size_t kBytesPerClassCell = kClassFields.size();

// By class: unknown; drivable, non-drivable, free; moving; stopped, stopped or unmapped,
// infrastructure; occupied.
constexpr std::array<std::int8_t, stream::kClassCount> kPercents{-1, 0, 10, 5, 90, 85, 80, 100, 70};

Place place_of(const stream::ClassWindow& window, std::uint16_t cell_mm, std::uint64_t stamp_us) {
  const double tile_m = geometry::kTileSide * cell_mm / 1000.0;
  return {.time_us = stamp_us,
          .frame_id = kLocalFrameId,
          .x_m = window.corner_a * tile_m,
          .y_m = window.corner_b * tile_m,
          .grid = {.cell_mm = cell_mm}};
}

std::byte age_of(const LiveClasses& classes, std::size_t slot) {
  const std::optional<std::uint8_t> age = classes.decided_ago(slot);
  return std::byte{age ? std::min(*age, kOldestAge) : kNeverArrived};
}

}  // namespace

std::int8_t percent_of_class(std::int8_t class_byte) {
  return kPercents.at(stream::class_of(static_cast<std::byte>(class_byte)));
}

std::vector<std::byte> class_occupancy_grid(const ClassGrid& classes, std::uint64_t stamp_us) {
  std::vector<std::byte> cells(classes.cells.size());
  std::ranges::transform(classes.cells, cells.begin(), [](std::int8_t byte) {
    return static_cast<std::byte>(percent_of_class(byte));
  });
  CdrWriter out;
  put_occupancy_head(out, place_of(classes.window, classes.cell_mm, stamp_us));
  out.put(cells);
  return out.take();
}

std::vector<std::byte> foxglove_class_grid(const LiveClasses& classes, std::uint64_t stamp_us) {
  const stream::ClassWindow& window = classes.window().value();
  std::vector<std::byte> cells(geometry::kCellCount * kBytesPerClassCell);
  for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
    const std::size_t tile = tile_in_window(window, slot);
    const std::byte age = age_of(classes, slot);
    for (std::size_t i = 0; i < tile_coding::kTileBytes; ++i) {
      const auto byte = static_cast<std::byte>(classes.tile(slot)[i]);
      const std::size_t cell = cell_of_tile(tile, i) * kBytesPerClassCell;
      cells[cell] = std::byte{stream::class_of(byte)};
      cells[cell + 1] = std::byte{stream::sureness_of(byte)};
      cells[cell + 2] = age;
    }
  }
  CdrWriter out;
  put_foxglove_head(out, place_of(window, classes.cell_mm(), stamp_us), kClassFields);
  out.put(cells);
  return out.take();
}

// A turn about z by an angle is the quaternion of half of it.
std::vector<std::byte> transform_of(const pose::Pose& pose, std::uint64_t stamp_us) {
  const double half = pose.heading * (numeric::kPi / 0x1p32);
  CdrWriter out;
  out.put(std::uint32_t{1});  // transforms
  put_stamp(out, stamp_us);
  out.put(kLocalFrameId);
  out.put(kFrameId);
  for (const double value : {pose.x_mm / 1000.0, pose.y_mm / 1000.0, 0.0, 0.0, 0.0,
                             numeric::sin(half), numeric::cos(half)}) {
    out.put(value);
  }
  return out.take();
}

}  // namespace iog::tools::ros
