// CRC-32 for any reflected polynomial with initial value and final xor of all ones, as in IEEE
// 802.3 (gzip, zlib) and AUTOSAR's CRC-32/P4.
//
// It uses slicing (Kounavis and Berry, 2005): each of kSlices bytes is looked up in its own table.
// The look-ups do not depend on each other. The tables take up kSlices KiB and are computed at
// compile time. The Cortex-A9 has a faster method (checksum/product_crc32.hpp). With 4, 8 or 16
// slices it takes 4.2 to 4.3 instructions per byte (measured). For a tile of 1 KiB this is 3.5, 2.5
// or 2.7 cycles per byte. These cycles are modelled as in docs/a9_model.md, with other tiles
// encoded in between.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "checksum/reflected_field.hpp"
#include "wire/byte_order.hpp"

namespace iog::checksum {

// `kPolynomial` is written with the highest power first and without x^32, as in the standards.
// `kSlices` is 1 for bytewise processing, or 4, 8 or 16.
template <std::uint32_t kPolynomial, std::size_t kSlices>
class ReflectedCrc32 {
  static_assert(kSlices == 1 || kSlices == 4 || kSlices == 8 || kSlices == 16);

 public:
  constexpr void update(std::span<const std::byte> bytes) {
    std::uint32_t state = state_;  // kept in a register, because `bytes` may alias the member
    if constexpr (kSlices > 1) {
      while (bytes.size() >= kSlices) {
        state = after_group(state, bytes.template first<kSlices>());
        bytes = bytes.subspan(kSlices);
      }
    }
    for (const std::byte byte : bytes) {
      state = after_byte(state ^ std::to_integer<std::uint32_t>(byte));
    }
    state_ = state;
  }

  // The CRC of all bytes so far. More bytes may follow.
  [[nodiscard]] constexpr std::uint32_t value() const { return ~state_; }

  // The internal state with x^31 in bit 0, for code that advances it by other means.
  [[nodiscard]] constexpr std::uint32_t state() const { return state_; }
  constexpr void set_state(std::uint32_t state) { state_ = state; }

  // The state times x^8. This is the state after a zero byte, or after a byte that was already
  // added to it.
  static constexpr std::uint32_t after_byte(std::uint32_t state) {
    return (state >> 8) ^ kTables[0][state & 0xFFU];
  }

 private:
  using Table = std::array<std::uint32_t, 256>;
  using Tables = std::array<Table, kSlices>;

  static constexpr std::uint32_t after_group(std::uint32_t state,
                                             std::span<const std::byte, kSlices> group) {
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < kSlices; i += 4) {
      const std::uint32_t word = state ^ wire::load_le32(group.subspan(i).template first<4>());
      state = 0;  // the state affects only the first word
      const std::size_t table = kSlices - 4 - i;
      next ^= kTables[table + 3][word & 0xFFU] ^ kTables[table + 2][(word >> 8) & 0xFFU] ^
              kTables[table + 1][(word >> 16) & 0xFFU] ^ kTables[table][word >> 24];
    }
    return next;
  }

  // Table t: the effect of a byte that is t bytes before the end of the group.
  static constexpr Tables make_tables() {
    Tables tables{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      tables[0][byte] = ReflectedField<kPolynomial>::times_x8(byte);
    }
    for (std::size_t t = 1; t < kSlices; ++t) {
      for (std::size_t byte = 0; byte < 256; ++byte) {
        const std::uint32_t before = tables[t - 1][byte];
        tables[t][byte] = (before >> 8) ^ tables[0][before & 0xFFU];
      }
    }
    return tables;
  }

  static const Tables kTables;

  std::uint32_t state_ = 0xFFFFFFFFU;
};

template <std::uint32_t kPolynomial, std::size_t kSlices>
inline constexpr typename ReflectedCrc32<kPolynomial, kSlices>::Tables
    ReflectedCrc32<kPolynomial, kSlices>::kTables =
        ReflectedCrc32<kPolynomial, kSlices>::make_tables();

}  // namespace iog::checksum
