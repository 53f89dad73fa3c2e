// What was found of a mount, for a person and for a car's file.
#pragma once

#include <string>

#include "tools/car/description.hpp"
#include "tools/mount/mount_fit.hpp"

namespace iog::tools {

// Rows of a table.
[[nodiscard]] std::string words_of(const MountFit& fit, const UnitTurns& unit,
                                   const description::SensorConfig& sensor);

// "mount = { x_m = 0.81, ... }": what is not fitted is that of the file. Only of a fit that is not
// refused.
[[nodiscard]] std::string toml_of(const MountFit& fit, const description::MountConfig& by_file);

}  // namespace iog::tools
