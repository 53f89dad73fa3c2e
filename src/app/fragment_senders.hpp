// The senders whose fragments a car's target joins: those it listens to, one datagram at a time for
// each stream. Other senders cannot take their room (docs/spec.md, 1.5).
#pragma once

#include "net/reassembly.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::app {

static_assert(net::FragmentSenders::kMostDatagrams >= 2 * vehicle::kMaxSensors + 2);

// replayer: may send in the name of every sensor. A sensor without an address admits any sender,
// since its packets may come from anybody. Poses and maps without one do not: they fit into a
// frame.
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
