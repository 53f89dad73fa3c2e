// The encoder of each kind of unit, of which packet_encoder.cpp chooses one.
#pragma once

#include "lidar/hesai.hpp"
#include "lidar/ouster.hpp"
#include "lidar/velodyne.hpp"
#include "tools/simulate/scanners/packet_encoder.hpp"

namespace iog::tools {

std::unique_ptr<PacketEncoder> ars548_encoder(const description::SensorConfig& config);
std::unique_ptr<PacketEncoder> hesai_encoder(const description::SensorConfig& config,
                                             const lidar::HesaiUnit& unit);
std::unique_ptr<PacketEncoder> mavlink_encoder(const description::SensorConfig& config);
std::unique_ptr<PacketEncoder> ouster_encoder(const description::SensorConfig& config,
                                              const lidar::OusterProfile& profile);
std::unique_ptr<PacketEncoder> points_encoder(const description::SensorConfig& config);
std::unique_ptr<PacketEncoder> velodyne_encoder(const description::SensorConfig& config,
                                                const lidar::VelodyneUnit& unit);

}  // namespace iog::tools
