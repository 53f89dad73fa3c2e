// A car with both kinds of scanners sends what each kind alone would, in the order of time.
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "tools/simulate/drives/drive.hpp"

namespace iog::tools {
namespace {

using ByPort = std::map<std::uint16_t, std::vector<CapturedDatagram>>;

ByPort sent_by(const CatalogueEntry& car) {
  Drive drive(car, 3, 1);
  ByPort sent;
  std::uint64_t last_us = 0;
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    for (CapturedDatagram& datagram : drive.datagrams(frame)) {
      EXPECT_GE(datagram.time_us, last_us);
      last_us = datagram.time_us;
      sent[datagram.destination.port].push_back(std::move(datagram));
    }
  }
  return sent;
}

TEST(MixedDrive, EachScannerSendsAsInADriveOfItsKind) {
  const CatalogueEntry& lux = find_vehicle("reference_car");
  const CatalogueEntry& turning = find_vehicle("roof_vlp16");
  std::vector<description::SensorConfig> configs(turning.sensors.begin(), turning.sensors.end());
  configs.insert(configs.end(), lux.sensors.begin(), lux.sensors.end());
  std::vector<vehicle::Sensor> sensors(turning.vehicle->sensors.begin(),
                                       turning.vehicle->sensors.end());
  sensors.insert(sensors.end(), lux.vehicle->sensors.begin(), lux.vehicle->sensors.end());
  vehicle::Vehicle both = *lux.vehicle;
  both.sensors = sensors;
  const CatalogueEntry mixed{&both, lux.description, configs, lux.network};

  ByPort sent = sent_by(mixed);
  ByPort expected = sent_by(lux);
  expected.merge(sent_by(turning));
  ASSERT_EQ(sent.size(), 5U);
  for (const auto& [port, datagrams] : expected) {
    ASSERT_EQ(sent[port].size(), datagrams.size()) << port;
    for (std::size_t i = 0; i < datagrams.size(); ++i) {
      EXPECT_EQ(sent[port][i].time_us, datagrams[i].time_us);
      EXPECT_EQ(sent[port][i].payload, datagrams[i].payload);
    }
  }
}

}  // namespace
}  // namespace iog::tools
