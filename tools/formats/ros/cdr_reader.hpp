// Reads what cdr_writer.hpp writes: messages of ROS 2, little endian.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "tools/program/exit_status.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools::ros {

class CdrReader {
 public:
  // UsageError, which begins with `what`, unless it is little endian. what outlives the reader.
  CdrReader(std::span<const std::byte> message, const std::string& what)
      : in_(message), what_(&what) {
    const std::uint32_t encapsulation = in_.u32_be() >> 16;
    if (!in_.ok() || encapsulation != 1) {
      throw UsageError(what + ": the message is not in CDR, little endian");
    }
    bytes_ = in_.remaining();
  }

  [[nodiscard]] std::uint8_t u8() { return in_.u8(); }
  [[nodiscard]] std::uint32_t u32() {
    align(sizeof(std::uint32_t));
    return in_.u32_le();
  }
  [[nodiscard]] double f32() { return static_cast<double>(std::bit_cast<float>(u32())); }
  [[nodiscard]] double f64() {
    align(sizeof(double));
    return std::bit_cast<double>(in_.u64_le());
  }
  [[nodiscard]] std::string text() {
    const std::span<const std::byte> letters = in_.bytes(u32());
    const auto* const begin = reinterpret_cast<const char*>(letters.data());
    return letters.empty() ? std::string() : std::string(begin, letters.size() - 1);
  }
  [[nodiscard]] std::span<const std::byte> sequence(std::size_t number_bytes) {
    const std::size_t count = u32();
    return in_.bytes(count * number_bytes);
  }
  [[nodiscard]] std::span<const std::byte> array(std::size_t bytes) { return in_.bytes(bytes); }
  [[nodiscard]] std::span<const std::byte> rest() { return in_.bytes(in_.remaining()); }
  [[nodiscard]] std::uint64_t stamp_us() {
    const std::uint64_t seconds = u32();
    return seconds * 1'000'000 + u32() / 1000;
  }
  // UsageError if a read was beyond the end.
  void must_be_whole() const {
    if (!in_.ok()) {
      throw UsageError(*what_ + ": the message is cut off");
    }
  }

 private:
  void align(std::size_t size) { in_.skip((size - (bytes_ - in_.remaining()) % size) % size); }

  wire::ByteReader in_;
  const std::string* what_;
  std::size_t bytes_ = 0;  // behind the encapsulation
};

}  // namespace iog::tools::ros
