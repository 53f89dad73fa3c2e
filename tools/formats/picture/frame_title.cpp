#include "tools/formats/picture/frame_title.hpp"

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

FrameTitle title_of(const GridFrame& frame) {
  return {.number = frame.evidence_number,
          .closed_us = frame.header.closed_us,
          .vehicle_id = frame.header.vehicle_id};
}

std::string words_of(const FrameTitle& title) {
  const std::uint64_t milliseconds = title.closed_us / 1000;
  std::string fraction = std::to_string(milliseconds % 1000);
  fraction.insert(0, 3 - fraction.size(), '0');
  const CatalogueEntry* const car = vehicle_of_id(title.vehicle_id);
  return "frame " + std::to_string(title.number) + ", " + std::to_string(milliseconds / 1000) +
         "." + fraction + " s" + (car != nullptr ? ", " + std::string(car->vehicle->name) : "");
}

}  // namespace iog::tools
