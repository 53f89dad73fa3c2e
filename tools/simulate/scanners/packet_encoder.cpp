#include "tools/simulate/scanners/packet_encoder.hpp"

#include <type_traits>

#include "lidar/scanner_facts.hpp"
#include "tools/simulate/scanners/ars548_encoder.hpp"
#include "tools/simulate/scanners/hesai_encoder.hpp"
#include "tools/simulate/scanners/mavlink_encoder.hpp"
#include "tools/simulate/scanners/ouster_encoder.hpp"
#include "tools/simulate/scanners/points_encoder.hpp"
#include "tools/simulate/scanners/velodyne_encoder.hpp"

namespace iog::tools {

std::unique_ptr<PacketEncoder> encoder_of(const description::SensorConfig& config) {
  std::unique_ptr<PacketEncoder> sender;
  lidar::with_decoder(config.format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (std::is_base_of_v<lidar::VelodynePacket, Decoder>) {
      sender = std::make_unique<VelodyneEncoder>(config, Decoder::unit());
    } else if constexpr (std::is_base_of_v<lidar::HesaiPacket, Decoder>) {
      sender = std::make_unique<HesaiEncoder>(config, Decoder::unit());
    } else if constexpr (std::is_base_of_v<lidar::OusterPacket, Decoder>) {
      sender = std::make_unique<OusterEncoder>(config, Decoder::profile());
    } else if constexpr (lidar::IsPoints<Decoder>) {
      sender = std::make_unique<PointsEncoder>(config);
    } else if constexpr (std::is_same_v<lidar::ContinentalArs548, Decoder>) {
      sender = std::make_unique<Ars548Encoder>(config);
    } else if constexpr (std::is_same_v<lidar::MavlinkUltrasonic, Decoder>) {
      sender = std::make_unique<MavlinkEncoder>(config);
    }
  });
  return sender;
}

}  // namespace iog::tools
