#include "tools/simulate/spinning_sender.hpp"

#include <type_traits>

#include "lidar/formats.hpp"
#include "tools/simulate/hesai_sender.hpp"
#include "tools/simulate/ouster_sender.hpp"
#include "tools/simulate/velodyne_sender.hpp"

namespace iog::tools {

std::unique_ptr<SpinningSender> sender_of(const vehicle::SensorConfig& config) {
  std::unique_ptr<SpinningSender> sender;
  lidar::with_decoder(config.format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (std::is_base_of_v<lidar::VelodynePacket, Decoder>) {
      sender = std::make_unique<VelodyneSender>(config, Decoder::unit());
    } else if constexpr (std::is_base_of_v<lidar::HesaiPacket, Decoder>) {
      sender = std::make_unique<HesaiSender>(config, Decoder::unit());
    } else if constexpr (std::is_base_of_v<lidar::OusterPacket, Decoder>) {
      sender = std::make_unique<OusterSender>(config, Decoder::profile());
    }
  });
  return sender;
}

}  // namespace iog::tools
