// The files of vehicles/, which the program carries, so that it knows their cars wherever it runs.
#pragma once

#include <span>
#include <string_view>

namespace iog::tools {

struct CarriedCar {
  std::string_view file;  // "reference_car.toml"
  std::string_view text;
};

[[nodiscard]] std::span<const CarriedCar> carried_cars();

}  // namespace iog::tools
