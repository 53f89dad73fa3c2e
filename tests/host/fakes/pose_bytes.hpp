// Pose messages written byte by byte from their description (docs/spec.md, sections 3.1 and 5.1),
// without any code of the encoder's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace iog::tests {

class PoseBytes {
 public:
  // The first message of a sender: run 7, measured at 3 s, everything else as small as it may be.
  PoseBytes() : bytes_(100) {
    put(0, 2, 0x4F47);
    put(2, 2, 0x8003);
    put(4, 4, 92);
    put(10, 2, 1);  // session
    put(12, 1, 1);  // protocol version
    put(13, 1, 1);  // interface version
    put(14, 1, 2);  // notification
    put(16, 2, 92);
    put(20, 4, 0x494F4703);
    put(28, 1, 1);   // version of the content
    put(30, 2, 72);  // its bytes
    put(32, 4, 7);
    put(40, 8, 3'000'000);
    put(60, 2, 1);
    put(62, 2, 1);
    seal();
  }

  PoseBytes& put(std::size_t offset, std::size_t size, std::int64_t value) {
    for (std::size_t i = 0; i < size; ++i) {
      bytes_.at(offset + i) = static_cast<std::byte>(value >> (8 * (size - 1 - i)));
    }
    return *this;
  }

  // As many bytes, the new ones zero, and every length that says so.
  PoseBytes& resize(std::size_t bytes) {
    bytes_.resize(bytes);
    put(4, 4, static_cast<std::int64_t>(bytes) - 8);
    put(16, 2, static_cast<std::int64_t>(bytes) - 8);
    return put(30, 2, static_cast<std::int64_t>(bytes) - 28);
  }

  // Makes the CRC right: CRC-32/P4, bit by bit, over bytes 8 ... 23 and from 28 on.
  PoseBytes& seal() {
    std::uint32_t crc = 0xFFFFFFFF;
    for (std::size_t i = 8; i < bytes_.size(); ++i) {
      if (i >= 24 && i < 28) {
        continue;
      }
      crc ^= std::to_integer<std::uint32_t>(bytes_[i]);
      for (int bit = 0; bit < 8; ++bit) {
        crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xC8DF352FU : 0U);  // 0xF4ACFB13, mirrored
      }
    }
    return put(24, 4, std::int64_t{~crc});
  }

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace iog::tests
