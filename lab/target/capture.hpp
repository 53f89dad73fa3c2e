// Reads a capture through semihosting, frame by frame: pcap in the byte order of the PC, Ethernet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>

namespace iog::lab {

struct CapturedFrame {
  std::uint64_t time_us = 0;  // since 1970-01-01 UTC
  std::span<const std::byte> bytes;
};

class Capture {
 public:
  Capture() = default;
  ~Capture();
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  // False if the file cannot be read or is another kind of capture. May be called again.
  [[nodiscard]] bool open(const char* path);

  // The next frame that was captured whole, valid until the next call; nothing at the file's end.
  [[nodiscard]] std::optional<CapturedFrame> next();

  // Nothing comes any more until it is opened again.
  void close();

 private:
  [[nodiscard]] bool read(std::span<std::byte> target);

  // The most that a capture holds of one frame (libpcap, MAXIMUM_SNAPLEN).
  static constexpr std::size_t kMaxFrameBytes = 262'144;

  std::FILE* file_ = nullptr;
  std::uint32_t fractions_per_us_ = 1;
  std::array<std::byte, kMaxFrameBytes> frame_{};
};

}  // namespace iog::lab
