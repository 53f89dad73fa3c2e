// The part of each beam that is low over the ground. Only low beams open ground: a hit counts as
// moving only where a low beam has freed the cell before (docs/perception.md, section 4).
//
// The ground below a beam is known only per bin. On a bank that rises from bin to bin, a beam would
// therefore be low over both the foot and the top. A hit between them would then look like motion.
// So beams are measured over the lowest ground nearby, and tall returns over the highest.
//
// A beam does not open ground where it is lower than MovedLimits::kUnderCarsMm over the ground
// below it. It may pass under a parked car there, while the next beam hits the body. A sensor that
// is itself mounted no higher over the car's plane has no other beams, so its beams do open ground.
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
  // The part of a beam that is low, by distance along its line. Both distances are in steps of 2
  // mm, rounded down, and at most the line's length. The stretch is empty if from_mm >= to_mm.
  struct Stretch {
    std::uint32_t from_mm = 0;
    std::uint32_t to_mm = 0;
  };

  // The sensor's lines are at most 131,070 mm long. For a tilted sensor, the beams in the middle of
  // a sector stand for the whole sector.
  void find(const Beams& beams, const vehicle::Sensor& sensor, std::int32_t low_mm,
            const Surface& surface);

  // If the sensor is higher than low_mm over the car's plane, the stretch begins where the beam
  // comes down to low_mm. Otherwise it goes from the start of the beam to where the beam rises
  // above low_mm.
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
