// How a map block reaches the target: in chunks, into the one of two buffers that is not in use.
//
// Chunks may come in any order, more than once, and with gaps. A block is complete when every chunk
// of it is there. Then it is checked whole, a bounded piece a frame, and in use from the frame in
// which the check ends, or refused: then the block before stays in use, and nothing of the new one
// is kept.
//
// One block is delivered at a time, so that a chunk that is late or forged stops nobody. Another
// one takes over when nothing new of the present one has come for kPatienceUs.
//
// The CRC finds what a network spoils; it is no authentication. Whoever can send in the name of the
// described address can replace the map.
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

// The check goes over a block about twice: one of 4 MiB takes 33 frames and more.
inline constexpr std::size_t kCheckBytesPerFrame = 262'144;

enum class DeliveryState : std::uint8_t {
  kIdle,       // nothing is being delivered
  kReceiving,  // chunks are missing
  kChecking,   // all chunks are there
};

struct DeliveryReport {
  DeliveryState state = DeliveryState::kIdle;
  BlockName incoming{};                           // unless kIdle
  std::uint32_t chunks_there = 0;                 // of it
  std::array<std::uint32_t, kFateCount> fates{};  // datagrams by what became of them, since start
  std::uint32_t blocks_refused = 0;               // since start
  Refusal last_refusal = Refusal::kNone;          // why the last of them was
};

// Holds 8.4 MB: belongs into static memory.
class Delivery {
 public:
  // description.is_valid(). replayer_ipv4 may send in the name of the source, 0: none.
  explicit Delivery(const SourceDescription& description, std::uint32_t replayer_ipv4 = 0);
  Delivery(const Delivery&) = delete;
  Delivery& operator=(const Delivery&) = delete;

  // Whether a datagram to this port is of maps.
  [[nodiscard]] bool listens_to(std::uint16_t udp_port) const {
    return udp_port == description_.udp_port;
  }

  // A datagram that came to the maps' port. Any bytes may come. Times do not fall.
  Fate receive(std::uint32_t source_ipv4, std::span<const std::byte> payload,
               std::uint64_t arrival_us);

  // Before the first frame: a block that was there at the start, such as one in the image. It
  // outlives the delivery. All of it is checked now; a refusal is counted as any other.
  void begin_with(std::span<const std::uint8_t> block);

  // Once a frame, and only then another block comes into use: a piece of the check of about
  // kCheckBytesPerFrame.
  void work();

  // The block in use, valid until the next work(); nullptr: there is none.
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
  // The bytes that have come of the block that is being delivered.
  [[nodiscard]] std::span<const std::uint8_t> incoming() const;
  // That of the chunks' name, or what its bytes say.
  [[nodiscard]] Refusal verdict() const;
  void refuse(Refusal refusal);

  SourceDescription description_;
  std::uint32_t replayer_ipv4_;
  DeliveryReport report_;
  std::optional<Block> in_use_;
  std::optional<Check> check_;     // of the incoming block, while it goes on
  std::uint64_t taken_us_ = 0;     // when something new of the incoming block came last
  std::bitset<kMaxChunks> there_;  // by number, of the incoming block
  std::size_t idle_ = 0;           // the buffer that is not in use
  alignas(32) std::array<Buffer, 2> buffers_{};
};

}  // namespace iog::map
