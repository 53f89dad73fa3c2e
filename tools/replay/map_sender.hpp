// Sends a map block to a target, chunk by chunk (docs/spec.md, section 7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "map/chunk.hpp"
#include "tools/replay/command_signer.hpp"
#include "tools/replay/udp_sender.hpp"

namespace iog::tools {

class MapSender {
 public:
  // A sound block, which outlives this, as the signer does. To the sender's port base + index.
  MapSender(std::span<const std::uint8_t> block, UdpSender& sender, std::size_t index,
            CommandSigner& signer);

  [[nodiscard]] std::size_t chunks() const { return map::chunk_count(name_); }
  [[nodiscard]] const map::BlockName& name() const { return name_; }

  // The chunk of a number below chunks(). False if the system did not take it.
  bool send(std::size_t number);

  // Each chunk once, so many a second; ends early when interrupted. How many the system did not
  // take.
  std::size_t send_all(double chunks_per_s);

 private:
  std::span<const std::byte> block_;
  map::BlockName name_;
  UdpSender* sender_;
  std::size_t index_;
  CommandSigner* signer_;
  map::ChunkEncoder encoder_;
};

// A target that is busy with a frame has room for 256 datagrams: a quarter of a second of these.
inline constexpr double kChunksPerSecond = 1'000;

}  // namespace iog::tools
