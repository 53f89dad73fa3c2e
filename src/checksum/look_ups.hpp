// Implements FastCrc32 with lookup tables, for machines without carry-less multiplication.
#pragma once

#include "checksum/crc32.hpp"
#include "checksum/reflected_crc32.hpp"
#include "checksum/reflected_field.hpp"

namespace iog::checksum {

template <std::uint32_t kPolynomial>
struct LookUps {
  // Returns the state after `bytes`.
  static std::uint32_t updated(std::uint32_t state, std::span<const std::byte> bytes) {
    ReflectedCrc32<kPolynomial, 8> crc;
    crc.set_state(state);
    crc.update(bytes);
    return crc.state();
  }
  // Returns the state after `before + FastCrc32::kPartBytes` zero bytes.
  static std::uint32_t after_zeros(std::uint32_t state, std::size_t before) {
    using Field = ReflectedField<kPolynomial>;
    std::uint32_t after =
        Field::product(state, Field::power_of_x8(FastCrc32<kPolynomial>::kPartBytes));
    for (; before > 0; --before) {
      after = Field::times_x8(after);
    }
    return after;
  }
};

}  // namespace iog::checksum
