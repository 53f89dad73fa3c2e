// What the target would send, as a capture: each message a datagram from the reference board to its
// peer (board/common/main.cpp), at the time when its frame closed.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "tools/formats/capture/pcap_writer.hpp"

namespace iog::tools {

class StreamRecorder {
 public:
  // UsageError if the file cannot be written.
  explicit StreamRecorder(const std::string& path) : file_(path) {}

  // A message as app::Pipeline sends it.
  void take(std::span<const std::byte> message);

  // UsageError if not all bytes have reached the file. Nothing may be taken after it.
  void finish() { file_.finish(); }

 private:
  PcapWriter file_;
};

}  // namespace iog::tools
