#include "tools/formats/ros/grid_messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/grid.hpp"
#include "index/recursive_set.hpp"
#include "tile_coding/tile_cells.hpp"
#include "tools/formats/ros/cdr_writer.hpp"
#include "tools/formats/ros/grid_parts.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools::ros {
namespace {

constexpr std::array kCellFields{Field{"index", FieldType::kInt8},
                                 Field{"probability_percent", FieldType::kUint8},
                                 Field{"age_frames", FieldType::kUint8}};
constexpr std::size_t kBytesPerCell = kCellFields.size();

Place place_at(std::uint64_t stamp_us, const geometry::Grid& grid) {
  return {.time_us = stamp_us,
          .frame_id = kFrameId,
          .x_m = -grid.origin_column * grid.cell_mm / 1000.0,
          .y_m = -grid.origin_row * grid.cell_mm / 1000.0,
          .grid = grid};
}

std::uint8_t age_of(const LiveGrid& grid, std::size_t tile) {
  const std::optional<std::uint32_t> age = grid.age_of(tile);
  return age ? static_cast<std::uint8_t>(std::min<std::uint32_t>(*age, kOldestAge)) : kNeverArrived;
}

}  // namespace

Percents::Percents(std::optional<double> epsilon) {
  percents_.fill(kNotKnown);
  if (!epsilon) {
    return;
  }
  const index::RecursiveSet set(*epsilon);
  constexpr std::int32_t kMax = std::numeric_limits<index::OccupancyIndex>::max();
  for (std::int32_t n = -kMax; n <= kMax; ++n) {
    percents_[static_cast<std::uint8_t>(n)] =
        static_cast<std::uint8_t>(std::lround(100 * set.probability(n)));
  }
}

std::vector<std::byte> occupancy_grid(const GridFrame& frame, std::uint64_t stamp_us,
                                      const Percents& percents) {
  constexpr std::byte kUnknown{0xFF};  // -1
  const std::vector<index::OccupancyIndex> indexes = cells_in_grid(frame);
  std::vector<std::byte> cells(indexes.size());
  std::ranges::transform(indexes, cells.begin(), [&](index::OccupancyIndex index) {
    return percents[index] == Percents::kNotKnown ? kUnknown : std::byte{percents[index]};
  });
  CdrWriter out;
  put_occupancy_head(out, place_at(stamp_us, frame.shape));
  out.put(cells);
  return out.take();
}

std::vector<std::byte> image(const GridFrame& frame, std::uint64_t stamp_us,
                             const Percents& percents) {
  constexpr std::uint32_t kWhite = 255;
  std::vector<std::byte> pixels;
  pixels.reserve(frame.shape.tile_count() * geometry::kTileCells);
  const std::uint32_t height = frame.shape.columns;
  const std::uint32_t width = frame.shape.rows;
  for (std::size_t x = height; x-- > 0;) {
    for (std::size_t y = width; y-- > 0;) {
      const std::uint32_t free = 100U - percents[frame.cells[y * frame.shape.columns + x]];
      pixels.push_back(static_cast<std::byte>((free * kWhite + 50) / 100));
    }
  }
  CdrWriter out;
  put_stamp(out, stamp_us);
  out.put(kFrameId);
  out.put(height);
  out.put(width);
  out.put(std::string_view("mono8"));
  out.put(std::uint8_t{0});  // byte order
  out.put(width);            // bytes of a row
  out.put(pixels);
  return out.take();
}

std::vector<std::byte> foxglove_grid(const LiveGrid& grid, std::uint64_t stamp_us,
                                     const Percents& percents) {
  const geometry::Grid& shape = grid.shape();
  std::vector<std::byte> cells(std::size_t{shape.columns} * shape.rows * kBytesPerCell);
  for (std::size_t tile = 0; tile < shape.tile_count(); ++tile) {
    const std::byte age{age_of(grid, tile)};
    for (std::size_t i = 0; i < tile_coding::kTileBytes; ++i) {
      const std::size_t cell = cell_of_tile(tile, i, shape);
      const index::OccupancyIndex index = grid.cells()[cell];
      cells[cell * kBytesPerCell] = static_cast<std::byte>(index);
      cells[cell * kBytesPerCell + 1] = std::byte{percents[index]};
      cells[cell * kBytesPerCell + 2] = age;
    }
  }
  CdrWriter out;
  put_foxglove_head(out, place_at(stamp_us, shape), kCellFields);
  out.put(cells);
  return out.take();
}

std::vector<std::byte> uint8_multi_array(std::span<const std::byte> bytes) {
  CdrWriter out;
  out.put(std::uint32_t{0});  // dimensions
  out.put(std::uint32_t{0});  // offset of the data
  out.put(bytes);
  return out.take();
}

std::optional<std::span<const std::byte>> bytes_of_uint8_multi_array(
    std::span<const std::byte> message) {
  wire::ByteReader in(message);
  const bool is_little_endian = in.u16_be() == 1;
  in.skip(2);
  const bool has_no_layout = in.u32_le() == 0 && in.u32_le() == 0;
  const std::span<const std::byte> bytes = in.bytes(in.u32_le());
  return in.ok() && is_little_endian && has_no_layout ? std::optional(bytes) : std::nullopt;
}

}  // namespace iog::tools::ros
