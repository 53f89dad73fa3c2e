// A short simulated drive and what the target makes of it, for the tests of tools/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "lidar/scan_point.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

using Messages = std::vector<std::vector<std::byte>>;

std::vector<CapturedDatagram> sample_drive(const CatalogueEntry& car, std::uint64_t seed,
                                           std::uint32_t frames,
                                           std::string_view scene = kDefaultScene);

// Every message that the target sends about these datagrams; of OfflineTarget::kRunNumber, or of
// another run.
Messages messages_of(const CatalogueEntry& car, const std::vector<CapturedDatagram>& datagrams);
Messages messages_of(const CatalogueEntry& car, const std::vector<CapturedDatagram>& datagrams,
                     std::uint32_t run_number);

// Visits each point of that frame. The car's scanners are LUX.
using PointVisit = std::function<void(const vehicle::Sensor&, const lidar::ScanPoint&)>;
void for_each_point(Drive& drive, std::uint32_t frame, const CatalogueEntry& car,
                    const PointVisit& visit);

}  // namespace iog::tools
