#include "map/chunk.hpp"

#include <algorithm>

#include "protection/believed.hpp"
#include "require/require.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::map {
namespace {

constexpr std::uint8_t kContentVersion = 1;

constexpr std::uint32_t chunk_bytes_at(const BlockName& block, std::uint32_t offset) {
  return std::min(block.bytes - offset, kChunkBytes);
}

constexpr bool is_possible(const BlockName& block, std::uint32_t offset) {
  return block.bytes <= kMaxBlockBytes && offset % kChunkBytes == 0 && offset < block.bytes;
}

DecodedChunk decode_content(std::span<const std::byte> content) {
  wire::ByteReader in(content);
  const std::uint8_t version = in.u8();
  const std::uint8_t reserved = in.u8();
  const std::uint16_t header_bytes = in.u16_be();
  Chunk chunk;
  chunk.block.crc = in.u32_be();
  chunk.block.bytes = in.u32_be();
  chunk.offset = in.u32_be();
  const std::uint16_t bytes = in.u16_be();
  const std::uint16_t reserved_too = in.u16_be();
  if (version != kContentVersion) {
    return {.fate = Fate::kWrongVersion};
  }
  // A later version may have a longer header.
  if (header_bytes < kChunkHeaderBytes || header_bytes > content.size() ||
      content.size() - header_bytes != bytes) {
    return {.fate = Fate::kWrongLength};
  }
  if (reserved != 0 || reserved_too != 0) {
    return {.fate = Fate::kNotZero};
  }
  if (!is_possible(chunk.block, chunk.offset)) {
    return {.fate = Fate::kOutOfRange};
  }
  if (bytes != chunk_bytes_at(chunk.block, chunk.offset)) {
    return {.fate = Fate::kWrongLength};
  }
  chunk.bytes = content.last(bytes);
  return {.fate = Fate::kTaken, .chunk = chunk};
}

}  // namespace

Chunk chunk_of(std::uint32_t crc, std::span<const std::byte> block, std::size_t number) {
  require(!block.empty() && block.size() <= kMaxBlockBytes);
  const BlockName name{.crc = crc, .bytes = static_cast<std::uint32_t>(block.size())};
  require(number < chunk_count(name));
  const auto offset = static_cast<std::uint32_t>(number) * kChunkBytes;
  return {.block = name,
          .offset = offset,
          .bytes = block.subspan(offset, chunk_bytes_at(name, offset))};
}

std::span<const std::byte> ChunkEncoder::encode(const Chunk& chunk) {
  require(chunk.bytes.size() <= kChunkBytes);
  const auto message = std::span(message_).first(kLeastChunkMessage + chunk.bytes.size());
  wire::ByteWriter out(message.subspan(protection::kProtectionBytes));
  out.u8(kContentVersion);
  out.u8(0);
  out.u16_be(kChunkHeaderBytes);
  out.u32_be(chunk.block.crc);
  out.u32_be(chunk.block.bytes);
  out.u32_be(chunk.offset);
  out.u16_be(static_cast<std::uint16_t>(chunk.bytes.size()));
  out.u16_be(0);
  out.bytes(chunk.bytes);
  sender_.protect(message);
  return message;
}

DecodedChunk decode_chunk(std::span<const std::byte> datagram) {
  if (datagram.size() < kLeastChunkMessage) {
    return {.fate = Fate::kTooShort};
  }
  const protection::Received received = protection::Receiver(kMapChannel).receive(datagram);
  if (const Fate fate = protection::fate_of(received, Fate::kTaken); fate != Fate::kTaken) {
    return {.fate = fate};
  }
  return decode_content(received.content);
}

}  // namespace iog::map
