// What the fusing of a frame consists of, for whoever asks how it can be divided: lines with the
// points on them, the blocks of the grid that they carve, and the marks.
//
// Which points carve how far is the firmware's (src/vehicle). The blocks are counted anew in double
// precision, so that cells may be of any size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {

// A square of 4 x 4 cells, and a tile of 8 x 8 blocks, on a grid of 102.4 m around the car.
struct BlockPlane {
  double cell_m = 0.1;

  [[nodiscard]] double block_m() const { return 4 * cell_m; }
  [[nodiscard]] std::int32_t side() const;  // in blocks
  [[nodiscard]] std::uint32_t tile_of(std::uint32_t block) const;
  [[nodiscard]] std::uint32_t tile_row_of(std::uint32_t block) const;
  [[nodiscard]] std::uint32_t tile_count() const;
  [[nodiscard]] std::uint32_t tile_rows() const { return static_cast<std::uint32_t>(side()) / 8; }
};

// A way on the plane, in metres from the middle of the grid.
struct Way2 {
  double x0 = 0;
  double y0 = 0;
  double x1 = 0;
  double y1 = 0;
};

// The blocks whose inside it crosses, in order, as far as they lie in the grid; row by row from the
// lowest y.
[[nodiscard]] std::vector<std::uint32_t> blocks_on(const BlockPlane& plane, const Way2& way);

// All points of a sensor at one azimuth: they share a line, and what it carves is carved once.
struct LineWork {
  std::size_t sensor = 0;
  std::size_t packet = 0;  // of the first point, counted over the frame
  std::uint32_t azimuth = 0;
  std::uint32_t points = 0;
  std::vector<std::uint32_t> blocks;  // carved, as far as the farthest point asks
  std::vector<std::uint32_t> marks;   // blocks, one for each point that marks
};

struct FusingWork {
  std::vector<LineWork> lines;  // in the order of their first points
  std::size_t packets = 0;
};

// Of a frame's packets; others are passed over.
[[nodiscard]] FusingWork work_of(const tools::CatalogueEntry& car,
                                 const std::vector<tools::CapturedDatagram>& datagrams,
                                 const BlockPlane& plane);

// Both frames as one: another car's sensors on the same roof.
void append(FusingWork& to, const FusingWork& more, std::size_t sensors_before);

}  // namespace iog::lab
