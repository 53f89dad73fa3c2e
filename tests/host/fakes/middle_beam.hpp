// A beam of a tilted sensor in the middle of a sector, by where its line ends.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "ground/beams.hpp"
#include "ground/bins.hpp"
#include "ground/surface.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tests {

class MiddleBeam {
 public:
  MiddleBeam(const ground::Beams& beams, const vehicle::Sensor& sensor, std::uint32_t sector,
             std::uint8_t layer)
      : beams_(beams), layer_(layer) {
    const std::uint32_t steps = sensor.azimuths.steps_per_turn() / ground::kSectors;
    const auto direction = vehicle::direction_of(sensor, sector * steps + steps / 2);
    rise_ = beams.slope_to(vehicle::end_height_of(sensor.layers[layer], direction));
  }

  // Beyond the last bin the ground goes on as in it.
  [[nodiscard]] double height_over_mm(const ground::Surface::Row& row,
                                      std::uint32_t along_mm) const {
    const std::uint32_t out_mm = beams_.out_mm(layer_, along_mm);
    const std::uint32_t length = beams_.bins().length_mm();
    const auto bin = std::min<std::size_t>(out_mm / length, ground::kBins - 1);
    const double start = row[bin];
    const double part = static_cast<double>(out_mm) / length - static_cast<double>(bin);
    return beams_.height_mm(rise_, along_mm) - start - (row[bin + 1] - start) * part;
  }
  // Whether this place is on a bin.
  [[nodiscard]] bool has_ground_at(std::uint32_t along_mm) const {
    return beams_.out_mm(layer_, along_mm) < ground::kBins * beams_.bins().length_mm();
  }

 private:
  const ground::Beams& beams_;
  std::uint8_t layer_;
  ground::Slope rise_;
};

}  // namespace iog::tests
