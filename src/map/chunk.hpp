// A chunk of a map block on its way to the target: SOME/IP and E2E headers as around every message
// (protection/protected_message.hpp), then 20 bytes of header and up to 1280 bytes of the block,
// big endian, byte by byte in docs/spec.md, section 7.1.
//
// Sender and target share this file: what one writes the other reads.
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

// Only the checks of the whole message are of use: chunks may come in any order.
inline constexpr protection::Channel kMapChannel{
    .event = {.service_id = 0x4F47, .event_id = 0x8004, .interface_version = 1},
    .data_id = 0x494F4704,
    .max_delta_counter = 1};

inline constexpr std::uint32_t kChunkBytes = 1280;  // of a chunk, the last may be shorter
inline constexpr std::size_t kMaxChunks = (kMaxBlockBytes + kChunkBytes - 1) / kChunkBytes;

inline constexpr std::size_t kChunkHeaderBytes = 20;
inline constexpr std::size_t kLeastChunkMessage = protection::kProtectionBytes + kChunkHeaderBytes;
static_assert(kLeastChunkMessage + kChunkBytes <= protection::kMaxMessageBytes);

// Which block a chunk is of. Two blocks that differ in either are two.
struct BlockName {
  std::uint32_t crc = 0;    // as the block itself says it
  std::uint32_t bytes = 0;  // 1 ... kMaxBlockBytes
  friend constexpr bool operator==(const BlockName&, const BlockName&) = default;
};

[[nodiscard]] constexpr std::size_t chunk_count(const BlockName& block) {
  return (block.bytes + kChunkBytes - 1) / kChunkBytes;
}

struct Chunk {
  BlockName block{};
  std::uint32_t offset = 0;            // a multiple of kChunkBytes
  std::span<const std::byte> bytes{};  // kChunkBytes of them, in a block's last chunk what is left
  [[nodiscard]] constexpr std::size_t number() const { return offset / kChunkBytes; }
};

// The chunk of this number, which is below chunk_count(). block: all of its bytes, at most
// kMaxBlockBytes and not none.
[[nodiscard]] Chunk chunk_of(std::uint32_t crc, std::span<const std::byte> block,
                             std::size_t number);

// Numbers a sender's messages from their first.
class ChunkEncoder {
 public:
  // The whole message, valid until the next one. At most kChunkBytes of the block. Fields are
  // written as they are; the decoder judges them.
  [[nodiscard]] std::span<const std::byte> encode(const Chunk& chunk);

 private:
  protection::Sender sender_{kMapChannel};
  std::array<std::byte, kLeastChunkMessage + kChunkBytes> message_{};
};

struct DecodedChunk {
  Fate fate = Fate::kTooShort;  // kTaken: a sound chunk, else why it is not one
  Chunk chunk{};                // of a sound one alone; views the datagram
};

// Any bytes may come. kTaken, kTooShort ... kOutOfRange.
[[nodiscard]] DecodedChunk decode_chunk(std::span<const std::byte> datagram);

}  // namespace iog::map
