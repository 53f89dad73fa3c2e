// Receives map blocks in chunks, into the unused one of two buffers.
//
// Chunks may come in any order, more than once, and with gaps. When all chunks of a block have
// arrived, the whole block is checked, a bounded part in each frame. A valid block is used from the
// frame in which the check ends. Otherwise the previous block stays in use, and the new one is
// dropped.
//
// Only one block is delivered at a time, so a late or forged chunk cannot interrupt it. Another
// block may start when nothing new of the present one has come for kPatienceUs.
//
// The CRC detects damage by a network; it is no authentication. Anyone who can send in the name of
// the configured address can replace the map.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "health/constants.hpp"
#include "map/block.hpp"
#include "map/chunk.hpp"
#include "map/fate.hpp"
#include "map/source_description.hpp"

namespace iog::map {

inline constexpr std::uint64_t kPatienceUs = 1'000'000;

// The check reads a block about twice, so 4 MiB take at least 33 frames.
inline constexpr std::size_t kCheckBytesPerFrame = 262'144;

enum class DeliveryState : std::uint8_t {
  kIdle,       // no delivery
  kReceiving,  // some chunks are missing
  kChecking,   // all chunks have arrived
};

struct DeliveryReport {
  DeliveryState state = DeliveryState::kIdle;
  BlockName incoming{};                           // unless kIdle
  std::uint32_t chunks_there = 0;                 // of the incoming block
  std::array<std::uint32_t, kFateCount> fates{};  // datagrams by outcome, since start
  std::uint32_t blocks_refused = 0;               // since start
  Refusal last_refusal = Refusal::kNone;          // reason for the last refusal
};

// Holds 8.4 MB, so it belongs in static memory.
class Delivery {
 public:
  // description.is_valid() must hold. replayer_ipv4 may also send in the name of the source; 0:
  // none.
  explicit Delivery(const SourceDescription& description, std::uint32_t replayer_ipv4 = 0);
  Delivery(const Delivery&) = delete;
  Delivery& operator=(const Delivery&) = delete;

  // Whether this port receives maps.
  [[nodiscard]] bool listens_to(std::uint16_t udp_port) const {
    return udp_port == description_.udp_port;
  }

  // Processes a datagram on the map port. Accepts any bytes. Arrival times must not decrease.
  Fate receive(std::uint32_t source_ipv4, std::span<const std::byte> payload,
               std::uint64_t arrival_us);

  // Call before the first frame with a block that exists at the start, such as one in the image.
  // The block must outlive this object. It is checked at once; a refusal is counted like any other.
  void begin_with(std::span<const std::uint8_t> block);

  // Call once per frame. Continues the check over about kCheckBytesPerFrame bytes. Only this call
  // can put another block into use.
  void work();

  // The block in use, valid until the next work(); null if there is none.
  [[nodiscard]] const Block* in_use() const { return in_use_ ? &*in_use_ : nullptr; }

  [[nodiscard]] const DeliveryReport& report() const { return report_; }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, description_, replayer_ipv4_);
  }

 private:
  using Buffer = std::array<std::uint8_t, kMaxBlockBytes>;

  [[nodiscard]] Fate accept(const Chunk& chunk, std::uint64_t arrival_us);
  [[nodiscard]] bool is_in_use(const BlockName& block) const;
  void begin(const BlockName& block);
  void put(const Chunk& chunk);
  // The bytes of the incoming block.
  [[nodiscard]] std::span<const std::uint8_t> incoming() const;
  // The result of the check; kDamaged if the block's CRC differs from the one in its chunks.
  [[nodiscard]] Refusal verdict() const;
  void refuse(Refusal refusal);

  SourceDescription description_;
  std::uint32_t replayer_ipv4_;
  DeliveryReport report_;
  std::optional<Block> in_use_;
  std::optional<Check> check_;     // of the incoming block, during the check
  std::uint64_t taken_us_ = 0;     // when a new chunk of the incoming block last arrived
  std::bitset<kMaxChunks> there_;  // chunks of the incoming block, by number
  std::size_t idle_ = 0;           // the unused buffer
  alignas(32) std::array<Buffer, 2> buffers_{};
};

}  // namespace iog::map
