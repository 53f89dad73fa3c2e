// Where beams are low: at most as high over the ground as opens it (docs/perception.md, section 4).
//
// The ground below a beam is known bin by bin only. On a bank that rises from bin to bin a beam
// would be low over its foot and its top alike, and what is hit between them would have come from
// elsewhere. So a beam is low over the lowest ground nearby, as what is tall is so over the
// highest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ground/beams.hpp"
#include "ground/bins.hpp"
#include "ground/surface.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::ground {

class LowBeams {
 public:
  // Of a sensor whose lines are at most 131,070 mm long. Beams of a tilted one are taken for those
  // in the middle of their sector.
  void find(const Beams& beams, const vehicle::Sensor& sensor, std::int32_t low_mm,
            const Surface& surface);

  // Of a sensor that is higher than low_mm over the car's plane: how far along its line a beam
  // comes down to it; of another one: how far it stays below. In steps of 2 mm, rounded down; at
  // most the line's length.
  [[nodiscard]] std::uint32_t border_mm(std::uint32_t sector, std::size_t layer) const {
    return std::uint32_t{2} * borders_2_mm_[sector][layer];
  }

 private:
  using Borders = std::array<std::uint16_t, vehicle::kMaxLayers>;

  std::array<Borders, kSectors> borders_2_mm_{};
};

}  // namespace iog::ground
