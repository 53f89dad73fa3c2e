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

Place place_of(const stream::ClassWindow& window, std::uint16_t cell_mm, window::Extent extent,
               std::uint64_t stamp_us) {
  const auto [columns, rows] = extent.cells();
  const double tile_m = geometry::kTileSide * cell_mm / 1000.0;
  return {.time_us = stamp_us,
          .frame_id = kLocalFrameId,
          .x_m = window.corner_a * tile_m,
          .y_m = window.corner_b * tile_m,
          .grid = {.cell_mm = cell_mm,
                   .columns = static_cast<std::uint16_t>(columns),
                   .rows = static_cast<std::uint16_t>(rows)}};
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
  std::vector<std::byte> cells;
  const auto [columns, rows] = classes.extent.cells();
  for (std::int32_t y = 0; y < rows; ++y) {
    for (std::int32_t x = 0; x < columns; ++x) {
      cells.push_back(static_cast<std::byte>(percent_of_class(
          classes.cells[static_cast<std::size_t>(y * geometry::kCellsPerSide + x)])));
    }
  }
  CdrWriter out;
  put_occupancy_head(out, place_of(classes.window, classes.cell_mm, classes.extent, stamp_us));
  out.put(cells);
  return out.take();
}

std::vector<std::byte> foxglove_class_grid(const LiveClasses& classes, std::uint64_t stamp_us) {
  const stream::ClassWindow& window = classes.window().value();
  const std::size_t columns = classes.extent().columns * geometry::kTileSide;
  std::vector<std::byte> cells(classes.extent().tile_count() * geometry::kTileCells *
                               kBytesPerClassCell);
  const auto put = [&](std::size_t /*number*/, window::TileNumber tile) {
    const std::size_t slot = window::slot_of(tile);
    const std::size_t in_window = tile_in_window(window, slot);
    const std::byte age = age_of(classes, slot);
    for (std::size_t i = 0; i < tile_coding::kTileBytes; ++i) {
      const auto byte = static_cast<std::byte>(classes.tile(slot)[i]);
      const std::size_t place = cell_of_tile(in_window, i);
      const std::size_t cell =
          (place / geometry::kCellsPerSide * columns + place % geometry::kCellsPerSide) *
          kBytesPerClassCell;
      cells[cell] = std::byte{stream::class_of(byte)};
      cells[cell + 1] = std::byte{stream::sureness_of(byte)};
      cells[cell + 2] = age;
    }
  };
  stream::area_of(window, classes.extent()).for_each_tile(put);
  CdrWriter out;
  put_foxglove_head(out, place_of(window, classes.cell_mm(), classes.extent(), stamp_us),
                    kClassFields);
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
