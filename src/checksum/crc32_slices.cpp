// For machines without carry-less multiplication.
#include "checksum/look_ups.hpp"

namespace iog::checksum {

template <std::uint32_t kPolynomial>
void FastCrc32<kPolynomial>::update(std::span<const std::byte> bytes) {
  state_ = LookUps<kPolynomial>::updated(state_, bytes);
}

template <std::uint32_t kPolynomial>
std::uint32_t FastCrc32<kPolynomial>::after_zeros(std::uint32_t state, std::size_t before) {
  return LookUps<kPolynomial>::after_zeros(state, before);
}

template <std::uint32_t kPolynomial>
void FastCrc32<kPolynomial>::add_remainder(std::span<const std::byte> before,
                                           std::uint32_t remainder) {
  update(before);
  add_remainder(remainder);
}

template class FastCrc32<0x04C11DB7>;
template class FastCrc32<0xF4ACFB13>;

}  // namespace iog::checksum
