// The content of an MCAP record while it is put together: little endian, and as long as it gets.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "tools/formats/mcap/format.hpp"

namespace iog::tools::mcap {

class RecordBytes {
 public:
  template <std::unsigned_integral Value>
  void put(Value value) {
    for (std::size_t i = 0; i < sizeof value; ++i) {
      bytes_.push_back(static_cast<std::byte>(std::uint64_t{value} >> 8 * i & 0xFF));
    }
  }
  void put(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  // Its length in 32 bits, then it.
  void put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    put(std::as_bytes(std::span(text)));
  }
  // The length in bytes of all entries, then they.
  void put(const Metadata& entries) {
    RecordBytes inner;
    for (const auto& [key, value] : entries) {
      inner.put(std::string_view(key));
      inner.put(std::string_view(value));
    }
    put(static_cast<std::uint32_t>(inner.size()));
    put(inner.view());
  }
  // A whole record.
  void put(OpCode code, std::span<const std::byte> content) {
    put(static_cast<std::uint8_t>(code));
    put(std::uint64_t{content.size()});
    put(content);
  }

  void clear() { bytes_.clear(); }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::span<const std::byte> view() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace iog::tools::mcap
