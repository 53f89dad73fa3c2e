// Ranges. At 89 degrees up, the end of a beam is 57.3 times the sensor's range above its origin. So
// a slope in units of 2^-40 stays below 2^46. Each axis of a beam's end is below 2^30 in units of
// 2^-10 subcells (vehicle.hpp), and so is the length of the vector. A cell is at most 500 mm, so
// that length in mm, times 2^20, is below 2^60.
#include "ground/beams.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "geometry/sizes.hpp"
#include "numeric/division.hpp"
#include "numeric/heap_sort.hpp"
#include "numeric/sine_table.hpp"
#include "numeric/square_root.hpp"
#include "vehicle/beam.hpp"

namespace iog::ground {
namespace {

constexpr std::int64_t kSubcells = geometry::kResolution;  // per cell
constexpr int kFineBits = 40;
constexpr std::uint32_t kWhole = std::uint32_t{1} << numeric::kSineFractionBits;

// The cosine of a layer's elevation: the distance of its beams' ends from the sensor's axis, as a
// share of the beam's length.
std::uint32_t share_of(const vehicle::Sensor& sensor, const vehicle::Layer& layer) {
  if (sensor.layers_share_lines) {
    return layer.range_share;
  }
  const auto square = [](std::int64_t part) { return static_cast<std::uint64_t>(part * part); };
  const std::uint64_t away = numeric::square_root(
      square(layer.x.forward) + square(layer.y.forward) + square(layer.z.forward));
  constexpr int kBits = numeric::kSineFractionBits - vehicle::kAxisFractionBits;
  const std::uint64_t length = std::uint64_t{sensor.range.mm()} * kSubcells;
  const std::uint64_t share = ((away * sensor.grid.cell_mm) << kBits) / length;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(share, kWhole));
}

}  // namespace

Beams::Beams(const vehicle::Sensor& sensor)
    : bins_(sensor.range.mm()),
      range_mm_(sensor.range.mm()),
      sector_shift_(std::countr_zero(sensor.azimuths.steps_per_turn()) -
                    std::countr_zero(kSectors)),
      origin_mm_(static_cast<std::int32_t>(
          numeric::div_nearest(std::int64_t{sensor.origin_z} * sensor.grid.cell_mm, kSubcells))),
      origin_z_(sensor.origin_z),
      slope_of_subcell_((std::uint64_t{sensor.grid.cell_mm} << kFineBits) /
                        (std::uint64_t{sensor.range.mm()} * kSubcells)),
      layer_count_(sensor.layer_count),
      fewest_samples_(sensor.layer_count <= 16 ? 12 : 24) {
  for (std::size_t i = 0; i < sensor.layer_count; ++i) {
    shares_[i] = share_of(sensor, sensor.layers[i]);
    along_of_out_[i] =
        static_cast<std::uint32_t>((std::uint64_t{kWhole} << kAlongBits) / shares_[i]);
    slopes_[i] = slope_to(vehicle::end_height_of(sensor.layers[i], {}));
  }
  sort_layers(sensor);
}

Slope Beams::slope_to(std::int32_t end_z) const {
  const std::int64_t fine =
      (std::int64_t{end_z} - origin_z_) * static_cast<std::int64_t>(slope_of_subcell_);
  return static_cast<Slope>(fine >> (kFineBits - kSlopeFractionBits));
}

// Averaged over a turn, the ends of a layer's beams are as high as z.base.
void Beams::sort_layers(const vehicle::Sensor& sensor) {
  const auto layers = std::span(from_below_).first(layer_count_);
  std::iota(layers.begin(), layers.end(), std::uint8_t{0});
  numeric::heap_sort(layers, [&](std::uint8_t a, std::uint8_t b) {
    const std::int64_t height_a = sensor.layers[a].z.base;
    const std::int64_t height_b = sensor.layers[b].z.base;
    return height_a != height_b ? height_a < height_b : a < b;
  });
  for (std::size_t i = 0; 3 * i < 2 * layers.size(); i += 2) {
    sampled_[sampled_count_++] = layers[i];
  }
  while (sampled_count_ << log2_firings_ < kSamples) {
    ++log2_firings_;
  }
}

}  // namespace iog::ground
