// Where beams are low: at most as high over the ground as opens it (docs/perception.md, section 4).
//
// The ground below a beam is known bin by bin only. On a bank that rises from bin to bin a beam
// would be low over its foot and its top alike, and what is hit between them would have come from
// elsewhere. So a beam is low over the lowest ground nearby, as what is tall is so over the
// highest.
//
// Nor does a beam open ground where it is lower than MovedLimits::kUnderCarsMm over the ground
// below it: it may pass under a car that stands there, whose body the next one hits. A sensor that
// is itself no higher over the car's plane has no other beams, and opens by them.
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
  // Between which distances along its line a beam is low, in steps of 2 mm, rounded down; at most
  // the line's length. It never is if the first is not less than the second.
  struct Stretch {
    std::uint32_t from_mm = 0;
    std::uint32_t to_mm = 0;
  };

  // Of a sensor whose lines are at most 131,070 mm long. Beams of a tilted one are taken for those
  // in the middle of their sector.
  void find(const Beams& beams, const vehicle::Sensor& sensor, std::int32_t low_mm,
            const Surface& surface);

  // Of a sensor that is higher than low_mm over the car's plane: from where a beam comes down to
  // it. Of another one: from its start up to where it rises over it.
  [[nodiscard]] Stretch at(std::uint32_t sector, std::size_t layer) const {
    const Ends& ends = ends_[sector][layer];
    return {std::uint32_t{2} * ends.from_2_mm, std::uint32_t{2} * ends.to_2_mm};
  }

 private:
  struct Ends {
    std::uint16_t from_2_mm = 0;
    std::uint16_t to_2_mm = 0;
  };

  std::array<std::array<Ends, vehicle::kMaxLayers>, kSectors> ends_{};
};

}  // namespace iog::ground
