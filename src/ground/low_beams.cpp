#include "ground/low_beams.hpp"

#include <algorithm>
#include <span>

#include "ground/outlook.hpp"
#include "numeric/heap_sort.hpp"
#include "vehicle/beam.hpp"

namespace iog::ground {
namespace {

// The layers of a sector, sorted from below by their slope outward.
class Fan {
 public:
  Fan(const Beams& beams, const vehicle::Sensor& sensor)
      : beams_(&beams),
        sensor_(&sensor),
        steps_per_sector_(sensor.azimuths.steps_per_turn() / kSectors),
        count_(beams.from_below().size()) {
    std::ranges::copy(beams.from_below(), layers_.begin());
    for (const std::uint8_t layer : layers()) {
      slopes_[layer] = beams.slope(layer);
    }
  }

  void turn_to(std::uint32_t sector) {
    if (sensor_->layers_share_lines) {
      return;
    }
    const vehicle::Direction direction =
        vehicle::direction_of(*sensor_, sector * steps_per_sector_ + steps_per_sector_ / 2);
    for (const std::uint8_t layer : layers()) {
      const std::int32_t end_z = vehicle::end_height_of(sensor_->layers[layer], direction);
      slopes_[layer] = beams_->slope_out(layer, beams_->slope_to(end_z));
    }
    numeric::heap_sort(std::span(layers_).first(count_), [&](std::uint8_t a, std::uint8_t b) {
      return slopes_[a] != slopes_[b] ? slopes_[a] < slopes_[b] : a < b;
    });
  }

  [[nodiscard]] std::span<const std::uint8_t> layers() const {
    return std::span(layers_).first(count_);
  }
  [[nodiscard]] Slope slope(std::size_t layer) const { return slopes_[layer]; }
  // Converts a distance outward into the distance along the beam's line.
  [[nodiscard]] std::uint32_t along_mm(std::size_t layer, std::uint32_t out_mm) const {
    return sensor_->layers_share_lines ? out_mm : beams_->along_mm(layer, out_mm);
  }

 private:
  const Beams* beams_;
  const vehicle::Sensor* sensor_;
  std::uint32_t steps_per_sector_;
  std::size_t count_;
  std::array<std::uint8_t, vehicle::kMaxLayers> layers_{};
  std::array<Slope, vehicle::kMaxLayers> slopes_{};
};

}  // namespace

// Visits the layers in the order in which they leave a height, as Outlook requires.
void LowBeams::find(const Beams& beams, const vehicle::Sensor& sensor, std::int32_t low_mm,
                    const Surface& surface) {
  constexpr std::int32_t kUnderCarsMm = vehicle::MovedLimits::kUnderCarsMm;
  const bool comes_down = beams.origin_mm() > low_mm;
  const bool passes_under = beams.origin_mm() > kUnderCarsMm;
  const auto whole = static_cast<std::uint16_t>(beams.range_mm() / 2);
  Fan fan(beams, sensor);
  for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
    fan.turn_to(sector);
    const auto left_by = [&](Outlook& outlook, std::size_t layer) {
      const std::uint32_t along_mm = fan.along_mm(layer, 2 * outlook.leave(fan.slope(layer)));
      return static_cast<std::uint16_t>(std::min(along_mm, beams.range_mm()) / 2);
    };
    const Surface::Row lowest = surface.lowest_near(sector);
    Outlook low(beams, lowest, low_mm, comes_down ? Side::kBelow : Side::kAbove);
    Outlook under(beams, surface.row(sector), kUnderCarsMm, Side::kBelow);
    const std::span<const std::uint8_t> layers = fan.layers();
    for (const std::uint8_t layer : layers) {
      ends_[sector][layer] = {.from_2_mm = comes_down ? left_by(low, layer) : std::uint16_t{0},
                              .to_2_mm = passes_under ? left_by(under, layer) : whole};
    }
    for (std::size_t i = comes_down ? 0 : layers.size(); i > 0; --i) {
      std::uint16_t& to_2_mm = ends_[sector][layers[i - 1]].to_2_mm;
      to_2_mm = std::min(to_2_mm, left_by(low, layers[i - 1]));
    }
  }
}

}  // namespace iog::ground
