// The cars of this folder, or of those files that a program is linked with (iog_add_cars() of
// CMakeLists.txt): read from their blocks as the firmware reads that of its image. For the tests
// and for the images of the laboratory.
#pragma once

#include <span>
#include <string_view>

#include "net/config.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicles {

struct Car {
  vehicle::Vehicle vehicle{};
  net::Config network{};
};

// In the order of their names.
[[nodiscard]] std::span<const Car> cars();

// A programmer error if there is none of that name.
[[nodiscard]] const Car& car(std::string_view name);

}  // namespace iog::vehicles
