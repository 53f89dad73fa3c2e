// The fan of the thesis's table 4.2: a lidar in the south-west corner of a grid of 10 cm cells, 181
// beams at steps of half a degree from east to north, each 50 m long.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "numeric/division.hpp"
#include "numeric/sine_table.hpp"

namespace iog::lab {

inline constexpr std::size_t kBeamCount = 181;
inline constexpr std::int32_t kReachCells = 500;

// The cells that the beams end in lie in columns and rows 0 ... kReachCells.
inline constexpr std::int32_t kFanStride = 1024;
inline constexpr std::size_t kFanCellCount = std::size_t{kReachCells + 1} * kFanStride;

// How far a beam gets to the east and to the north, in cells and units of 2^-30.
struct BeamEnd {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

[[nodiscard]] constexpr std::array<BeamEnd, kBeamCount> make_fan() {
  constexpr numeric::SineTable kHalfDegrees = numeric::kSineTable<720>;
  std::array<BeamEnd, kBeamCount> fan{};
  for (std::uint32_t beam = 0; beam < kBeamCount; ++beam) {
    fan[beam].x = std::int64_t{kReachCells} * kHalfDegrees.cosine(beam);
    fan[beam].y = std::int64_t{kReachCells} * kHalfDegrees.sine(beam);
  }
  return fan;
}

// To the nearest multiple of 1 / parts of a cell.
[[nodiscard]] constexpr std::int32_t in_parts(std::int64_t cells, std::int32_t parts) {
  constexpr std::int64_t kOne = std::int64_t{1} << numeric::kSineFractionBits;
  return static_cast<std::int32_t>((cells * parts + kOne / 2) / kOne);
}

[[nodiscard]] constexpr double in_cells(std::int64_t cells) {
  return static_cast<double>(cells) / (std::int64_t{1} << numeric::kSineFractionBits);
}

}  // namespace iog::lab
