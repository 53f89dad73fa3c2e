// A car as a header of constants, from which the compiler makes the tables of the target.
#pragma once

#include <string>

#include "tools/vehicles/car_file.hpp"

namespace iog::tools {

// source: the name of the car's file, for the comment.
[[nodiscard]] std::string header_of(const Car& car, const std::string& source);

}  // namespace iog::tools
