// A scan point for the eye: where it lies, and what became of it.
#pragma once

#include <cstdint>

#include "vehicle/beam.hpp"

namespace iog::tools {

struct SeenPoint {
  std::int16_t x_cm;  // in the vehicle frame
  std::int16_t y_cm;
  std::int16_t z_cm;
  vehicle::Fate fate;
};

}  // namespace iog::tools
