// Protected messages written byte by byte from their description (docs/spec.md, section 3.1),
// without any code of the encoders'.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fakes/bitwise_crc32.hpp"

namespace iog::tests {

template <typename Derived>
class MessageBytes {
 public:
  // The first message of a sender.
  MessageBytes(std::size_t bytes, std::uint16_t event, std::uint32_t data_id) : bytes_(bytes) {
    put(0, 2, 0x4F47);
    put(2, 2, event);
    put(10, 2, 1);  // session
    put(12, 1, 1);  // protocol version
    put(13, 1, 1);  // interface version
    put(14, 1, 2);  // notification
    put(20, 4, data_id);
    put_lengths();
  }

  Derived& put(std::size_t offset, std::size_t size, std::int64_t value) {
    for (std::size_t i = 0; i < size; ++i) {
      bytes_.at(offset + i) = static_cast<std::byte>(value >> (8 * (size - 1 - i)));
    }
    return static_cast<Derived&>(*this);
  }

  // As many bytes, the new ones zero, and the lengths of SOME/IP and E2E that say so.
  Derived& resize(std::size_t bytes) {
    bytes_.resize(bytes);
    return put_lengths();
  }

  // Makes the CRC right: CRC-32/P4 over bytes 8 ... 23 and from 28 on.
  Derived& seal() {
    const std::span<const std::byte> all(bytes_);
    BitwiseCrc32 crc(BitwiseCrc32::kP4);
    crc.add(all.subspan(8, 16)).add(all.subspan(28));
    return put(24, 4, std::int64_t{crc.value()});
  }

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  Derived& put_lengths() {
    const auto behind = static_cast<std::int64_t>(bytes_.size()) - 8;
    put(4, 4, behind);
    return put(16, 2, behind);
  }

  std::vector<std::byte> bytes_;
};

}  // namespace iog::tests
