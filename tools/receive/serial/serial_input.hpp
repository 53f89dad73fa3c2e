// Where the bytes of a serial link come from: a terminal device, a Unix socket as QEMU offers one,
// a pipe, or a file that was recorded.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace iog::tools {

class SerialInput {
 public:
  // A terminal is set to raw bytes, 8N1, at `baud`. UsageError if the path cannot be read, or a
  // terminal does not know the rate.
  SerialInput(const std::string& path, unsigned baud);
  ~SerialInput();
  SerialInput(const SerialInput&) = delete;
  SerialInput& operator=(const SerialInput&) = delete;

  // What has come; empty if nothing has for so long. Nothing once the other end is closed. Valid
  // until the next call.
  [[nodiscard]] std::optional<std::span<const std::byte>> take(std::chrono::milliseconds longest);

 private:
  int file_ = -1;
  std::vector<std::byte> buffer_ = std::vector<std::byte>(65'536);
};

}  // namespace iog::tools
