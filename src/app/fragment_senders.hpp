// Lists the senders whose fragments a target reassembles. The target reassembles fragments only
// from the senders that it listens to. For each sensor or other source, the target reassembles one
// datagram at a time. Other senders cannot occupy the reassembly buffers (docs/spec.md, 1.5).
#pragma once

#include "net/reassembly.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::app {

static_assert(net::FragmentSenders::kMostDatagrams >= 2 * vehicle::kMaxSensors + 2);

// The replayer may send on behalf of any sensor. If a sensor has no configured address, its packets
// may come from any address, so the target accepts fragments from every sender. Poses and map
// chunks fit into a single Ethernet frame, so the target accepts their fragments only from
// configured addresses.
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
