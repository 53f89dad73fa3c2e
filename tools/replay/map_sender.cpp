#include "tools/replay/map_sender.hpp"

#include "map/block.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/replay/pace.hpp"

namespace iog::tools {

MapSender::MapSender(std::span<const std::uint8_t> block, UdpSender& sender, std::size_t index,
                     CommandSigner& signer)
    : block_(std::as_bytes(block)),
      name_{.crc = map::Block(block).crc(), .bytes = static_cast<std::uint32_t>(block.size())},
      sender_(&sender),
      index_(index),
      signer_(&signer) {}

bool MapSender::send(std::size_t number) {
  const auto message = encoder_.encode(map::chunk_of(name_.crc, block_, number));
  return sender_->send(index_, signer_->as_sent(map::kMapChannel, message));
}

std::size_t MapSender::send_all(double chunks_per_s) {
  Pace pace(1);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < chunks() && !was_interrupted(); ++i) {
    pace.wait_for(static_cast<std::uint64_t>(static_cast<double>(i) * 1e6 / chunks_per_s));
    refused += send(i) ? 0U : 1U;
  }
  return refused;
}

}  // namespace iog::tools
