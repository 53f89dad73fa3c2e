// For PCs. Nearly all of them multiply 64 bits without carry in one instruction (PCLMULQDQ); the
// others use look-ups.
//
// A register holds 16 bytes, that is a polynomial of 128 bits whose bit 127 is x^0. To fold it over
// the next d bits is to multiply it with x^d: its two halves are multiplied with x^(d + 64) and x^d
// modulo the polynomial, and the sum is added to the register d bits further on. A product of two
// 64-bit halves has bit 126 as x^0, so the factors have an exponent that is lower by one. What is
// left in the end, 16 bytes with the same remainder as all bytes before, is looked up.
#include <array>
#include <bit>
#include <wmmintrin.h>

#include "checksum/crc32.hpp"
#include "checksum/look_ups.hpp"
#include "checksum/reflected_crc32.hpp"
#include "checksum/reflected_field.hpp"
#include "wire/byte_order.hpp"

namespace iog::checksum {
namespace {

struct Register {
  __m128i bits;
};
constexpr std::size_t kRegister = sizeof(Register);
constexpr std::size_t kRegisters = 4;  // as many as hide the latency of the multiplication
constexpr std::size_t kBlock = kRegisters * kRegister;

template <std::uint32_t kPolynomial>
class Products {
  using Field = ReflectedField<kPolynomial>;

 public:
  // 16 bytes with the same remainder as these bytes after this state; a multiple of kBlock.
  [[gnu::target("pclmul")]] static std::array<std::byte, kRegister> folded(
      std::uint32_t state, std::span<const std::byte> bytes) {
    const auto load = [&bytes](std::size_t i) {
      return _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes.data()) + i);
    };
    std::array<Register, kRegisters> sums{{{load(0)}, {load(1)}, {load(2)}, {load(3)}}};
    sums[0].bits = _mm_xor_si128(sums[0].bits, _mm_cvtsi32_si128(static_cast<int>(state)));
    for (bytes = bytes.subspan(kBlock); !bytes.empty(); bytes = bytes.subspan(kBlock)) {
      for (std::size_t i = 0; i < kRegisters; ++i) {
        sums[i].bits = _mm_xor_si128(ahead<kBlock>(sums[i]), load(i));
      }
    }
    for (std::size_t i = 1; i < kRegisters; ++i) {
      sums[i].bits = _mm_xor_si128(ahead<kRegister>(sums[i - 1]), sums[i].bits);
    }
    return std::bit_cast<std::array<std::byte, kRegister>>(sums.back());
  }

  // 8 bytes with the remainder of this state and so many zero bytes.
  template <std::size_t kBytes>
  [[gnu::target("pclmul")]] static std::array<std::byte, 8> before_zeros(std::uint32_t state) {
    const __m128i factors = _mm_cvtsi64_si128(std::int64_t{kFactor<kBytes - sizeof state>});
    const __m128i product =
        _mm_clmulepi64_si128(_mm_cvtsi32_si128(static_cast<int>(state)), factors, 0);
    std::array<std::byte, 8> rest{};
    wire::store_le64(rest, static_cast<std::uint64_t>(_mm_cvtsi128_si64(product)));
    return rest;
  }

 private:
  static constexpr std::uint32_t times_x7(std::uint32_t of) {
    for (int bit = 0; bit < 7; ++bit) {
      of = Field::times_x(of);
    }
    return of;
  }
  // x^(8 kBytes - 1)
  template <std::size_t kBytes>
  static constexpr std::uint32_t kFactor = times_x7(Field::power_of_x8(kBytes - 1));
  static constexpr std::int64_t in_upper_half(std::uint32_t factor) {
    return static_cast<std::int64_t>(std::uint64_t{factor} << 32);
  }

  template <std::size_t kBytes>
  [[gnu::target("pclmul")]] static __m128i ahead(Register of) {
    const __m128i factors =
        _mm_set_epi64x(in_upper_half(kFactor<kBytes>), in_upper_half(kFactor<kBytes + 8>));
    return _mm_xor_si128(_mm_clmulepi64_si128(of.bits, factors, 0x00),
                         _mm_clmulepi64_si128(of.bits, factors, 0x11));
  }
};

bool has_products() { return __builtin_cpu_supports("pclmul"); }

}  // namespace

template <std::uint32_t kPolynomial>
void FastCrc32<kPolynomial>::update(std::span<const std::byte> bytes) {
  if (bytes.size() >= kBlock && has_products()) {
    const auto blocks = bytes.first(bytes.size() / kBlock * kBlock);
    const auto rest = Products<kPolynomial>::folded(state_, blocks);
    state_ = LookUps<kPolynomial>::updated(0, rest);
    bytes = bytes.subspan(blocks.size());
  }
  state_ = LookUps<kPolynomial>::updated(state_, bytes);
}

template <std::uint32_t kPolynomial>
std::uint32_t FastCrc32<kPolynomial>::after_zeros(std::uint32_t state, std::size_t before) {
  if (!has_products()) {
    return LookUps<kPolynomial>::after_zeros(state, before);
  }
  for (; before > 0; --before) {
    state = ReflectedCrc32<kPolynomial, 1>::after_byte(state);
  }
  const auto rest = Products<kPolynomial>::template before_zeros<kPartBytes>(state);
  return LookUps<kPolynomial>::updated(0, rest);
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
