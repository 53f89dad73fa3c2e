// Which vehicle's sensors the packets of a capture look like. Vehicles may share UDP ports, and a
// recording of another one is fused without a complaint: each packet is sound. So what comes is
// compared with what each vehicle's sensors would send: on which ports, in which format, and, of
// LUX, how far apart their directions are.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

class VehicleLikeness {
 public:
  // A datagram of the capture, of whatever port.
  void add(const CapturedDatagram& datagram);

  // What of the packets is not as the vehicle's sensors would send them, one reason each; nothing
  // if all of it is.
  [[nodiscard]] std::vector<std::string> misfits(const CatalogueEntry& car) const;

  // The vehicle with the fewest misfits, if it has fewer than the car; nullptr otherwise, and if no
  // scan has come.
  [[nodiscard]] const CatalogueEntry* better_than(const CatalogueEntry& car) const;

  // "the packets look like those of two_lux_parking: nothing comes to UDP port 12004; ..."; empty
  // if no vehicle fits better than the car.
  [[nodiscard]] std::string words(const CatalogueEntry& car) const;

  // The vehicles that fit best, and what does not fit even them; empty if no scan has come.
  [[nodiscard]] std::string words_of_best() const;

 private:
  // What has come to a port.
  struct Port {
    std::uint64_t looked_at = 0;
    std::set<lidar::Format> formats;
    // How often two neighbouring directions of a message were so many ticks apart.
    std::map<std::int32_t, std::uint64_t> steps;
  };

  // Whether any scan has come.
  [[nodiscard]] bool has_scans() const;
  [[nodiscard]] std::string misfit_of(const vehicle::SensorConfig& sensor) const;

  std::map<std::uint16_t, Port> ports_;
};

}  // namespace iog::tools
