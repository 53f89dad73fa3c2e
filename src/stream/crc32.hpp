// CRC-32 as in IEEE 802.3, gzip and zlib (reflected polynomial 0xEDB88320, start and final xor all
// ones; check value of "123456789": 0xCBF43926). It names grids: any tool can compute it.
//
// Slicing by four (Kounavis and Berry, 2005): four table look-ups for each word of four bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "wire/byte_order.hpp"

namespace iog::stream {

class Crc32 {
 public:
  constexpr void update(std::span<const std::byte> bytes) {
    std::uint32_t state = state_;  // in a register: bytes may alias the member
    while (bytes.size() >= 4) {
      const std::uint32_t word = state ^ wire::load_le32(bytes.first<4>());
      state = kTables[3][word & 0xFFU] ^ kTables[2][(word >> 8) & 0xFFU] ^
              kTables[1][(word >> 16) & 0xFFU] ^ kTables[0][word >> 24];
      bytes = bytes.subspan(4);
    }
    for (const std::byte byte : bytes) {
      state = (state >> 8) ^ kTables[0][(state ^ std::to_integer<std::uint32_t>(byte)) & 0xFFU];
    }
    state_ = state;
  }

  // Of all bytes so far; more may follow.
  [[nodiscard]] constexpr std::uint32_t value() const { return ~state_; }

 private:
  using Table = std::array<std::uint32_t, 256>;

  // Table t: the effect of a byte that lies t bytes before the end of the word.
  static constexpr std::array<Table, 4> make_tables() {
    std::array<Table, 4> tables{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t state = byte;
      for (int bit = 0; bit < 8; ++bit) {
        state = (state >> 1) ^ ((state & 1U) != 0 ? 0xEDB88320U : 0U);
      }
      tables[0][byte] = state;
    }
    for (std::size_t t = 1; t < tables.size(); ++t) {
      for (std::size_t byte = 0; byte < 256; ++byte) {
        const std::uint32_t before = tables[t - 1][byte];
        tables[t][byte] = (before >> 8) ^ tables[0][before & 0xFFU];
      }
    }
    return tables;
  }

  static const std::array<Table, 4> kTables;

  std::uint32_t state_ = 0xFFFFFFFFU;
};

inline constexpr std::array<Crc32::Table, 4> Crc32::kTables = Crc32::make_tables();

}  // namespace iog::stream
