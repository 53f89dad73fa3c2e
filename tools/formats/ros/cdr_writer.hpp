// Common Data Representation, as ROS 2 serialises messages: little endian, each number on a
// multiple of its own size behind the four bytes that say so (OMG DDSI-RTPS 2.2, 10.2;
// CORBA 3.1, 15.3).
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace iog::tools::ros {

class CdrWriter {
 public:
  CdrWriter() { bytes_.assign(kLittleEndian.begin(), kLittleEndian.end()); }

  template <std::integral Value>
  void put(Value value) {
    const auto bits = static_cast<std::uint64_t>(value);
    align(sizeof value);
    for (std::size_t i = 0; i < sizeof value; ++i) {
      bytes_.push_back(static_cast<std::byte>(bits >> 8 * i & 0xFF));
    }
  }
  void put(float value) { put(std::bit_cast<std::uint32_t>(value)); }
  void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
  // Its length with the zero at its end, and it with that.
  void put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    append(std::as_bytes(std::span(text)));
    bytes_.push_back(std::byte{0});
  }
  // A sequence of 8 bit numbers.
  void put(std::span<const std::byte> sequence) {
    put(static_cast<std::uint32_t>(sequence.size()));
    append(sequence);
  }

  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  static constexpr std::array kLittleEndian{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};

  void align(std::size_t size) {
    while ((bytes_.size() - kLittleEndian.size()) % size != 0) {
      bytes_.push_back(std::byte{0});
    }
  }
  void append(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  std::vector<std::byte> bytes_;
};

}  // namespace iog::tools::ros
