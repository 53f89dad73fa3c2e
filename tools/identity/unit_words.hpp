// Units in sentences on captures.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tools/identity/unit_watch.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// "an Ouster OS"
[[nodiscard]] std::string with_article(std::string_view name);

// "Ouster OS, legacy 64, 1024x10": what a sensor of the car is.
[[nodiscard]] std::string sensor_words(const CatalogueEntry& car, std::size_t sensor);

// Why a packet is not taken.
inline constexpr std::string_view kOfOtherMode = " in an unsupported mode";
inline constexpr std::string_view kDamaged = " whose packets are damaged";

// One of these, if iogrid supports the unit but does not take the packet; else empty.
[[nodiscard]] std::string_view fault_of(const SeenUnit& seen);

}  // namespace iog::tools
