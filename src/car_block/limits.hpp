// What the tables of a vehicle must keep to so that the loops of the target may rely on them: the
// limits of a description (vehicle/limits.hpp), asked of the integers that it has become.
#pragma once

#include "net/config.hpp"
#include "vehicle/fault.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::car_block {

// The first fault; one without a field: none. network is that of the same block.
[[nodiscard]] vehicle::Fault fault_of(const vehicle::Vehicle& car, const net::Config& network);

}  // namespace iog::car_block
