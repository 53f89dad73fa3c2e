// Whether the packets that come to a sensor's port are of such a scanner, as far as they tell: of
// two of Velodyne's units a packet of one can pass for one of the other.
#pragma once

#include <map>
#include <string>

#include "lidar/velodyne_identity.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

class UnitFit {
 public:
  enum class Verdict {
    kInDoubt,  // nothing has come, or what has is of one of two units
    kFits,     // also where no Velodyne has sent it, which its own marks say
    kOther,    // of another unit
  };

  // car outlives it.
  explicit UnitFit(const CatalogueEntry& car) : car_(&car) {}

  // Of the packet's sensor. Only for a packet that comes to the port of one.
  Verdict take(const CapturedDatagram& packet);

  // What the packets of the last one's sensor are, what it is itself, and which vehicle they would
  // fit.
  [[nodiscard]] std::string words() const;

 private:
  const CatalogueEntry* car_;
  std::map<std::uint16_t, lidar::VelodyneIdentity> identities_;  // by port
  std::size_t sensor_ = 0;
  lidar::FormatSet possible_;
};

}  // namespace iog::tools
