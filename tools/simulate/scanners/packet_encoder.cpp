#include "tools/simulate/scanners/packet_encoder.hpp"

#include <type_traits>

#include "lidar/scanner_facts.hpp"
#include "tools/simulate/scanners/encoders.hpp"

namespace iog::tools {

std::unique_ptr<PacketEncoder> encoder_of(const description::SensorConfig& config) {
  std::unique_ptr<PacketEncoder> sender;
  lidar::with_decoder(config.format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (std::is_base_of_v<lidar::VelodynePacket, Decoder>) {
      sender = velodyne_encoder(config, Decoder::unit());
    } else if constexpr (std::is_base_of_v<lidar::HesaiPacket, Decoder>) {
      sender = hesai_encoder(config, Decoder::unit());
    } else if constexpr (std::is_base_of_v<lidar::OusterPacket, Decoder>) {
      sender = ouster_encoder(config, Decoder::profile());
    } else if constexpr (lidar::IsPoints<Decoder>) {
      sender = points_encoder(config);
    } else if constexpr (std::is_same_v<lidar::ContinentalArs548, Decoder>) {
      sender = ars548_encoder(config);
    } else if constexpr (std::is_same_v<lidar::MavlinkUltrasonic, Decoder>) {
      sender = mavlink_encoder(config);
    }
  });
  return sender;
}

}  // namespace iog::tools
