// Reads big-endian numbers from the bytes of a block. The caller must ensure that the offsets are
// valid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "map/plane.hpp"
#include "wire/byte_order.hpp"

namespace iog::map {

class Words {
 public:
  constexpr explicit Words(std::span<const std::byte> bytes) : bytes_{bytes} {}

  [[nodiscard]] constexpr std::uint8_t u8(std::size_t at) const {
    return std::to_integer<std::uint8_t>(bytes_[at]);
  }
  [[nodiscard]] constexpr std::uint16_t u16(std::size_t at) const {
    return wire::load_be16(bytes_.subspan(at).first<2>());
  }
  [[nodiscard]] constexpr std::int16_t i16(std::size_t at) const {
    return static_cast<std::int16_t>(u16(at));
  }
  [[nodiscard]] constexpr std::uint32_t u32(std::size_t at) const {
    return wire::load_be32(bytes_.subspan(at).first<4>());
  }
  [[nodiscard]] constexpr std::int64_t i64(std::size_t at) const {
    return static_cast<std::int64_t>(wire::load_be64(bytes_.subspan(at).first<8>()));
  }
  [[nodiscard]] constexpr PointCm point(std::size_t at) const {
    return {static_cast<std::int32_t>(u32(at)), static_cast<std::int32_t>(u32(at + 4))};
  }
  [[nodiscard]] constexpr BoxCm box(std::size_t at) const { return {point(at), point(at + 8)}; }
  [[nodiscard]] constexpr std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace iog::map
