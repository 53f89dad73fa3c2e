// Messages with a chunk of a map, written byte by byte from their description (docs/spec.md,
// sections 3.1 and 7.1), without any code of the encoder's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fakes/message_bytes.hpp"

namespace iog::tests {

class ChunkBytes : public MessageBytes<ChunkBytes> {
 public:
  // The first message of a sender: a whole block of ten bytes in one chunk.
  ChunkBytes() : ChunkBytes(0x01020304, 10, 0, std::vector<std::byte>(10, std::byte{0x55})) {}

  ChunkBytes(std::uint32_t crc, std::uint32_t block_bytes, std::uint32_t offset,
             std::span<const std::byte> piece)
      : MessageBytes(48 + piece.size(), 0x8004, 0x494F4704) {
    put(28, 1, 1);   // version of the content
    put(30, 2, 20);  // bytes of its header
    put(32, 4, crc).put(36, 4, block_bytes).put(40, 4, offset);
    put(44, 2, static_cast<std::int64_t>(piece.size()));
    for (std::size_t i = 0; i < piece.size(); ++i) {
      put(48 + i, 1, std::to_integer<std::int64_t>(piece[i]));
    }
    seal();
  }
};

}  // namespace iog::tests
