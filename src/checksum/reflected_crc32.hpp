// Computes a CRC-32 with any reflected polynomial. The initial value and the final xor are all
// ones, as in IEEE 802.3 (gzip, zlib) and AUTOSAR's CRC-32/P4.
//
// The algorithm is slicing (Kounavis and Berry, 2005). Slicing looks up each of kSlices bytes in a
// separate table. These lookups do not depend on each other. The tables take up kSlices KiB and are
// computed at compile time. On the Cortex-A9, checksum/product_crc32.hpp is faster. With 4, 8 or 16
// slices, slicing takes 4.2 to 4.3 instructions per byte (measured). For a tile of 1 KiB, slicing
// takes 3.5 cycles per byte with 4 slices, 2.5 with 8 slices, and 2.7 with 16 slices. These cycles
// are modelled as described in docs/a9_model.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "checksum/reflected_field.hpp"
#include "wire/byte_order.hpp"

namespace iog::checksum {

// `kPolynomial` uses the notation of the standards, with the highest power first and x^32 omitted.
// `kSlices` is 4, 8 or 16, or 1 for bytewise processing.
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

  // Returns the CRC of all bytes so far. Further calls to update() are allowed.
  [[nodiscard]] constexpr std::uint32_t value() const { return ~state_; }

  // Returns the internal state, with x^31 in bit 0. Other algorithms use the internal state to
  // continue the CRC.
  [[nodiscard]] constexpr std::uint32_t state() const { return state_; }
  constexpr void set_state(std::uint32_t state) { state_ = state; }

  // Returns the state times x^8. The result is the state after processing a zero byte. If the
  // caller has already added a byte to `state`, the result is the state after processing that byte.
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

  // Table t contains the effect of a byte that is t bytes before the end of the group.
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
