// Receives map blocks in chunks. There are two buffers, and chunks are stored in the buffer that
// does not contain the block in use.
//
// Chunks may arrive in any order, more than once, and with gaps. When all chunks of a block have
// arrived, the entire block is checked. The check processes a limited number of bytes per frame. A
// valid block is used as soon as its check is complete. An invalid block is dropped, and the
// previous block stays in use.
//
// Only one block is delivered at a time, so a late or forged chunk cannot interrupt a delivery. The
// delivery of another block may start if no new chunk of the current block has arrived for
// kPatienceUs.
//
// The CRC detects transmission errors, but it does not authenticate the sender. Anyone who can send
// from the configured address can replace the map.
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

// The check reads a block about twice, so a block of 4 MiB takes at least 33 frames.
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
  std::array<std::uint32_t, kFateCount> fates{};  // datagrams by outcome, since start-up
  std::uint32_t blocks_refused = 0;               // since start
  Refusal last_refusal = Refusal::kNone;          // reason for the last rejection
};

// A Delivery uses 8.4 MB, so it must be in static memory.
class Delivery {
 public:
  // `description.is_valid()` must be true. The replayer at `replayer_ipv4` may also send on behalf
  // of the source. If there is no replayer, the address is 0.
  explicit Delivery(const SourceDescription& description, std::uint32_t replayer_ipv4 = 0);
  Delivery(const Delivery&) = delete;
  Delivery& operator=(const Delivery&) = delete;

  // Returns true if this port receives maps.
  [[nodiscard]] bool listens_to(std::uint16_t udp_port) const {
    return udp_port == description_.udp_port;
  }

  // Processes a datagram on the map port. The function accepts any bytes. Arrival times must not
  // decrease.
  Fate receive(std::uint32_t source_ipv4, std::span<const std::byte> payload,
               std::uint64_t arrival_us);

  // Sets the initial block, such as a block in the firmware image. Call this function before the
  // first frame. The block must outlive this object. The block is checked immediately. Rejections
  // are counted in the report.
  void begin_with(std::span<const std::uint8_t> block);

  // Continues the check for about kCheckBytesPerFrame bytes. From the first frame on, only this
  // function can change the block in use. Call this function once per frame.
  void work();

  // Returns the block in use, which is valid until the next work(). Returns null if no block is in
  // use.
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
  // Returns the bytes of the incoming block.
  [[nodiscard]] std::span<const std::uint8_t> incoming() const;
  // Returns the result of the check. If the block is valid but its CRC differs from the CRC that
  // its chunks specify, returns kDamaged.
  [[nodiscard]] Refusal verdict() const;
  void refuse(Refusal refusal);

  SourceDescription description_;
  std::uint32_t replayer_ipv4_;
  DeliveryReport report_;
  std::optional<Block> in_use_;
  std::optional<Check> check_;     // of the incoming block, during the check
  std::uint64_t taken_us_ = 0;     // arrival time of the last new chunk of the incoming block
  std::bitset<kMaxChunks> there_;  // chunks of the incoming block, by number
  std::size_t idle_ = 0;           // the unused buffer
  alignas(32) std::array<Buffer, 2> buffers_{};
};

}  // namespace iog::map
