// The senders whose fragments a target reassembles: those it listens to, one datagram at a time per
// stream. Other senders cannot occupy their buffers (docs/spec.md, 1.5).
#pragma once

#include "net/reassembly.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::app {

static_assert(net::FragmentSenders::kMostDatagrams >= 2 * vehicle::kMaxSensors + 2);

// replayer: may send in the name of every sensor. A sensor without an address admits any sender,
// because its packets may come from anyone. Poses and maps without an address do not, because they
// fit into a single frame.
[[nodiscard]] inline net::FragmentSenders fragment_senders(const vehicle::Vehicle& car,
                                                           net::Ipv4Address replayer) {
  net::FragmentSenders senders;
  for (const vehicle::Sensor& sensor : car.sensors) {
    senders.add({sensor.source_ipv4});
  }
  senders.add(replayer, car.sensors.size());
  for (const std::uint32_t source : {car.poses.source_ipv4, car.maps.source_ipv4}) {
    if (source != 0) {
      senders.add({source});
    }
  }
  return senders;
}

}  // namespace iog::app
