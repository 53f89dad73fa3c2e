// Defines the messages that transmit chunks of a map block. Each message consists of SOME/IP and
// E2E headers (protection/protected_message.hpp), a header of 20 bytes, and up to 1280 bytes of the
// block, in big-endian byte order. `docs/spec.md`, section 7.1, describes each byte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "map/block.hpp"
#include "map/fate.hpp"
#include "protection/protected_message.hpp"

namespace iog::map {

inline constexpr std::uint16_t kMapPort = 15011;  // UDP

// On this channel, each message is checked independently of the others, because chunks may arrive
// in any order.
inline constexpr protection::Channel kMapChannel{
    .event = {.service_id = 0x4F47, .event_id = 0x8004, .interface_version = 1},
    .data_id = 0x494F4704,
    .max_delta_counter = 1};

inline constexpr std::uint32_t kChunkBytes = 1280;  // of a chunk; the last chunk may be shorter
inline constexpr std::size_t kMaxChunks = (kMaxBlockBytes + kChunkBytes - 1) / kChunkBytes;

inline constexpr std::size_t kChunkHeaderBytes = 20;
inline constexpr std::size_t kLeastChunkMessage = protection::kProtectionBytes + kChunkHeaderBytes;
static_assert(kLeastChunkMessage + kChunkBytes <= protection::kMaxMessageBytes);

// Identifies the block to which a chunk belongs. Two blocks are different if their CRCs or their
// lengths differ.
struct BlockName {
  std::uint32_t crc = 0;    // as stated in the block itself
  std::uint32_t bytes = 0;  // 1 ... kMaxBlockBytes
  friend constexpr bool operator==(const BlockName&, const BlockName&) = default;
};

[[nodiscard]] constexpr std::size_t chunk_count(const BlockName& block) {
  return (block.bytes + kChunkBytes - 1) / kChunkBytes;
}

struct Chunk {
  BlockName block{};
  std::uint32_t offset = 0;            // a multiple of kChunkBytes
  std::span<const std::byte> bytes{};  // kChunkBytes, or fewer in the last chunk
  [[nodiscard]] constexpr std::size_t number() const { return offset / kChunkBytes; }
};

// Returns the chunk with this number. The number must be below chunk_count(). `block` contains all
// bytes of the block. The size of `block` must be in the range 1 ... kMaxBlockBytes.
[[nodiscard]] Chunk chunk_of(std::uint32_t crc, std::span<const std::byte> block,
                             std::size_t number);

// Encodes and numbers the messages of a sender.
class ChunkEncoder {
 public:
  // Returns the whole message, which is valid until the next call. The chunk must have at most
  // kChunkBytes bytes. The encoder does not check the chunk's fields, because the decoder checks
  // them.
  [[nodiscard]] std::span<const std::byte> encode(const Chunk& chunk);

 private:
  protection::Sender sender_{kMapChannel};
  std::array<std::byte, kLeastChunkMessage + kChunkBytes> message_{};
};

struct DecodedChunk {
  Fate fate = Fate::kTooShort;  // kTaken for a valid chunk, otherwise the reason for its rejection
  Chunk chunk{};                // only if the chunk is valid; refers to the datagram
};

// Decodes a chunk. The function accepts any bytes. The outcome is kTaken or one of the values from
// kTooShort to kOutOfRange.
[[nodiscard]] DecodedChunk decode_chunk(std::span<const std::byte> datagram);

}  // namespace iog::map
