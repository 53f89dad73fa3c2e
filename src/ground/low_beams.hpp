// Computes the part of each beam that is close to the ground. A hit counts as motion only if a low
// beam has already freed its cell (docs/perception.md, section 4).
//
// The height of the ground below a beam is known only at the resolution of the bins. Where a bank
// rises from one bin to the next, a beam would count as low both above the foot of the bank and
// above its top. A hit between the foot and the top would then appear to be motion. Heights over
// low_mm are therefore measured from the lowest ground nearby, and the heights of tall returns from
// the highest ground nearby.
//
// A beam stops opening cells where it first comes within MovedLimits::kUnderCarsMm of the ground.
// From there on, it may pass under a parked car, and the next beam may hit the body of this car.
// The rule does not apply to sensors that are mounted at most kUnderCarsMm above the car's plane,
// because all of their beams start below this height.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ground/bins.hpp"
#include "ground/fan.hpp"
#include "ground/surface.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::ground {

class LowBeams {
 public:
  // The low part of a beam, as two distances along the beam's line. Both distances are rounded down
  // to multiples of 2 mm and are at most the line's length. The part is empty if from_mm >= to_mm.
  struct Stretch {
    std::uint32_t from_mm = 0;
    std::uint32_t to_mm = 0;
  };

  // Finds the low parts of a sector's beams. The fan must be turned to this sector.
  void find(std::uint32_t sector, const Fan& fan, std::int32_t low_mm, const Surface& surface);

  // Returns the low part of a beam. If the sensor is mounted more than low_mm above the car's
  // plane, this part starts where the beam descends to low_mm. Otherwise, it starts at the sensor
  // and ends where the beam rises above low_mm. In both cases, it ends at the latest where a sensor
  // above kUnderCarsMm has a beam that comes within kUnderCarsMm of the ground.
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
