// For machines without carry-less multiplication: uses look-ups.
#include "checksum/crc32.hpp"
#include "checksum/reflected_crc32.hpp"
#include "checksum/reflected_field.hpp"

namespace iog::checksum {

template <std::uint32_t kPolynomial>
void FastCrc32<kPolynomial>::update(std::span<const std::byte> bytes) {
  ReflectedCrc32<kPolynomial, 8> crc;
  crc.set_state(state_);
  crc.update(bytes);
  state_ = crc.state();
}

template <std::uint32_t kPolynomial>
std::uint32_t FastCrc32<kPolynomial>::after_zeros(std::uint32_t state, std::size_t before) {
  using Field = ReflectedField<kPolynomial>;
  std::uint32_t after = Field::product(state, Field::power_of_x8(kPartBytes));
  for (; before > 0; --before) {
    after = Field::times_x8(after);
  }
  return after;
}

template class FastCrc32<0x04C11DB7>;
template class FastCrc32<0xF4ACFB13>;

}  // namespace iog::checksum
