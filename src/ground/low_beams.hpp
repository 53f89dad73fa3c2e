// Computes the part of each beam that is close to the ground. A hit counts as moving only if a low
// beam freed its cell earlier (docs/perception.md, section 4).
//
// The height of the ground below a beam is known only per bin. If a bank rises from one bin to the
// next, a beam would be considered low above the foot of the bank as well as above the top. A hit
// between the foot and the top would then appear to be motion. The height of a beam is therefore
// measured from the lowest ground nearby, and the height of a tall return is measured from the
// highest ground nearby.
//
// The part of a beam that is less than MovedLimits::kUnderCarsMm above the ground does not open
// cells. This part of the beam may pass under a parked car, and the next beam may hit the body of
// the parked car. The rule does not apply to a sensor that is mounted at most kUnderCarsMm above
// our car's plane, because all beams of this sensor start below this height.
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
  // The part of a beam that is low, as distances along the beam's line. Both distances are rounded
  // down to multiples of 2 mm and are at most the line's length. The part is empty if from_mm >=
  // to_mm.
  struct Stretch {
    std::uint32_t from_mm = 0;
    std::uint32_t to_mm = 0;
  };

  // The sensor's lines must be at most 131,070 mm long. For a tilted sensor, the beams in the
  // middle of a sector represent all beams of the sector.
  void find(const Beams& beams, const vehicle::Sensor& sensor, std::int32_t low_mm,
            const Surface& surface);

  // Returns the part of a beam that is low. If the sensor is mounted higher than low_mm above the
  // car's plane, this part starts where the beam descends to low_mm. Otherwise, the low part
  // extends from the start of the beam to the point where the beam rises above low_mm.
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
