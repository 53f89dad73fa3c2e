// Whether a capture is one of a vehicle's sensors, judged by the UDP ports that its packets go to
// and by what the first of them say of the unit that sends them.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// Packets by destination port.
using PortCounts = std::map<std::uint16_t, std::uint64_t>;

// Why none of these packets is for a sensor of the car, and which vehicle they would fit.
[[nodiscard]] std::string words_of_misfit(const CatalogueEntry& car, const PortCounts& ports);

// Reads the capture as far as its first packet for a sensor of the car of which it is certain that
// such a scanner sends it. UsageError if there is none, or one is of another scanner, or the file
// cannot be read. What is not a regular file, such as a pipe, could be read only
// once and is left alone.
void demand_fit(const std::string& path, const CatalogueEntry& car);

}  // namespace iog::tools
